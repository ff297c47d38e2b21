/// One point of a material under mixed control: some components of strain, the others of stress are imposed.
///
///   find the free strains ε_f with  σ_f(ε, Θ, z*, Δt_eff) = the stress imposed
///
/// by Newton's method with the law's consistent tangent, on the free rows and columns. Where the tangent has
/// no shear stiffness (a liquid), the strain of least change is taken. Source: the law, viscoplastic.hpp.
#pragma once

#include <string>
#include <vector>

#include "material/time_integration.hpp"
#include "material/viscoplastic.hpp"
#include "point/loading.hpp"

namespace solidus::point {

enum class Integration { backward_euler, two_step };

struct PointState {
  double time = 0;  ///< [s]
  double temperature = 0;
  Sym<double> strain, stress;  ///< total strain, σ [Pa]
  material::Viscoplastic::State<double> history;
};

struct StepResult {
  PointState state;
  material::Viscoplastic::Response<double> response;
  double thermal_strain = 0;      ///< e^θ, volumetric
  std::vector<double> residuals;  ///< largest stress missing before each Newton correction [Pa]
  bool converged = false;
};

class MaterialPoint {
 public:
  /// Starts free of stress. Keeps a reference to the material.
  /// @param temperature       at the start [K]
  /// @param strain_reference  Θ_0 of 2.51, where the strain is zero [K]
  MaterialPoint(const material::Material& material, double temperature, double strain_reference,
                Integration integration);

  /// One step from the present state; nothing changes until accept().
  StepResult attempt(const Target& end, double dt) const;
  void accept(const StepResult& result);
  /// The next step is one of backward Euler: the loading turns here, and what went before does not foretell
  /// what comes.
  void restart() { step_before_ = 0; }

  const PointState& state() const { return now_; }
  const material::Viscoplastic& law() const { return law_; }
  double strain_reference() const { return strain_reference_; }

 private:
  material::Viscoplastic law_;
  double strain_reference_;
  Integration integration_;
  PointState now_;
  material::Viscoplastic::State<double> history_before_;
  double step_before_ = 0;  ///< [s]; zero: there is no step to build on
};

}  // namespace solidus::point
