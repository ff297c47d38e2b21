/// One point of a material under mixed control: some components of strain, the others of stress are imposed.
///
///   find the free strains ε_f with  σ_f(ε, Θ, z*, Δt_eff) = the stress imposed
///
/// by Newton's method with the law's consistent tangent, on the free rows and columns. Where the tangent has
/// no shear stiffness (a liquid), the strain of least change is taken. Source: the law, viscoplastic.hpp.
///
/// A melt whose material gives no viscosity has that of material/melt.hpp; a point has no height, so the
/// atmosphere stands for its head.
///
/// An adiabatic point finds its temperature from the first law, mechanical and thermal part at once:
///
///   E(Θ) + L(Θ) − (E + L)_n = ½ (σ + σ_n) : (ε − ε_n)
///
/// so that heating by dissipation, cooling by elastic strain and latent heat need no formula of their own.
#pragma once

#include <string>
#include <vector>

#include "material/external_law.hpp"
#include "material/time_integration.hpp"
#include "material/viscoplastic.hpp"
#include "point/loading.hpp"

namespace solidus::point {

enum class PointIntegration { backward_euler, two_step };
enum class Thermal { prescribed, adiabatic };

struct MaterialPointState {
  double time = 0;  ///< [s]
  double temperature = 0;
  Sym<double> strain, stress;  ///< total strain, σ [Pa]
  /// The history; with a law from outside it is what follows from the stress (material/external_law.hpp).
  material::Viscoplastic::State<double> history;
  std::vector<double> outside;  ///< the numbers of a law from outside
};

struct StepResult {
  MaterialPointState state;
  material::Viscoplastic::Response<double> response;
  double effective_step = 0;      ///< of the law [s]
  std::vector<double> residuals;  ///< largest stress missing before each Newton correction [Pa]
  bool converged = false;
  std::string complaint;  ///< Answer::complaint
};

/// Energy, entropy and heat capacity of a state.
struct Stored {
  double energy;    ///< E + L [J/m³], zero for the free material at Θ_0
  double entropy;   ///< S^E + S^pc [J/(m³ K)]
  double capacity;  ///< ∂(E + L)/∂Θ [J/(m³ K)]
};

/// Stress, history and tangent of a law at a strain.
struct Answer {
  /// The answer of the law; one from outside leaves out what belongs to plastic flow alone.
  material::Viscoplastic::Response<double> response;
  Sym4<double> tangent;         ///< ∂σ/∂ε on engineering shears [Pa]
  std::vector<double> outside;  ///< MaterialPointState::outside
  std::string complaint;        ///< of a law from outside that found no answer
};

class MaterialPoint {
 public:
  struct Options {
    double temperature = 293.15;       ///< at the start [K]
    double strain_reference = 293.15;  ///< Θ_0 of 2.51, where the strain is zero [K]
    PointIntegration integration = PointIntegration::backward_euler;
    Thermal thermal = Thermal::prescribed;
  };

  /// Starts free of stress. Keeps a reference to the material. Throws InputError for a law from outside that
  /// is not loaded, or that is to be integrated by two steps.
  MaterialPoint(const material::Material& material, const Options& options);

  /// One step from the present state; nothing changes until accept(). An adiabatic point does not read the
  /// target's temperature.
  StepResult attempt(const Target& end, double dt) const;
  void accept(const StepResult& result);
  /// The law at a strain and temperature after a step of backward Euler from the present state.
  Answer answer(double temperature, const Sym<double>& strain, double dt) const;
  /// Makes the next step one of backward Euler: the loading turns here, so earlier steps do not predict it.
  void restart() { step_before_ = 0; }

  const MaterialPointState& state() const { return now_; }
  const material::Viscoplastic& law() const { return law_; }
  double strain_reference() const { return options_.strain_reference; }
  Stored stored(const MaterialPointState& state) const;

 private:
  material::Viscoplastic::Properties<double> properties(double temperature, double effective_step) const;
  Answer answer(const material::Viscoplastic::Properties<double>& p, double temperature,
                const material::Viscoplastic::State<double>& start, const Sym<double>& strain,
                const material::TimeStep& step) const;
  StepResult attempt_at(double temperature, const Target& end, double dt) const;
  StepResult attempt_adiabatic(const Target& end, double dt) const;

  material::Viscoplastic law_;
  const material::ExternalLaw* outside_;  ///< null: law_ it is
  Options options_;
  MaterialPointState now_;
  material::Viscoplastic::State<double> history_before_;
  double step_before_ = 0;  ///< [s]; zero: there is no step to build on
};

}  // namespace solidus::point
