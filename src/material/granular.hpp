/// The law of moulds, cores and shells of grains and a binder: elastic by temperature, a Drucker–Prager cone
/// with cut-offs (laws/granular_return.hpp), a binder that burns out and bonds that break; [granular] of a
/// material file.
///
/// Of the binder and its bonds the share d is left:
///
///   ḃ = (1 − b) k_b(Θ),   κ̇ = γ̇ + μ̇_t,   d = (1 − b) max(0, 1 − κ/κ_s)
///   c = c_r + (c(Θ) − c_r) d,   p_t = p_t(Θ) d,   E = E(Θ) (r_b + (1 − r_b)(1 − b))
///
/// b and κ only grow: a binder that has burnt does not come back with the cold. Bonds that break in a step
/// are missed in the next one, so that the tangent of a step is that of a solid which does not soften, and a
/// collapse costs a run no step; with shorter steps the lag goes to zero with the first order.
///
/// Stress follows the strain of the step. What gets stiffer has bonds that were made without stress, so it
/// keeps its stress; what gets softer loses stress with its modulus:
///
///   σ^trial = min(1, C_{n+1}/C_n) σ_n + C_{n+1} : Δe
///
/// Beside the bonds grains in contact keep a share r of the stiffness, σ = (1 − r) σ^m + r C : e, which holds
/// loose sand together numerically. With a relaxation time τ (G. Duvaut, J. L. Lions, 1972) the excess above
/// the cone fades in the time τ instead of at once, which spreads the bands in which a softening solid
/// breaks:
///
///   σ^m = (σ^trial + (Δt/τ) σ^∞)/(1 + Δt/τ)
///
/// Symbols: b burnt share of the binder, k_b its rate [1/s], κ broken strain, κ_s that at which no bond is
/// left, c cohesion and c_r that of loose grains [Pa], p_t tension cut-off [Pa], E Young's modulus [Pa] and
/// r_b its share without binder, e strain without thermal strain. All inelastic work is heat.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "material/external_law.hpp"
#include "material/granular_data.hpp"
#include "material/laws/granular_return.hpp"
#include "numbers/table.hpp"

namespace solidus::material {

/// The law at the points of a mesh.
class Granular final : public ExternalLibrary {
 public:
  /// Places of the numbers of the state.
  enum : std::size_t {
    k_burnt,   ///< b
    k_broken,  ///< κ
    k_bulk,    ///< K of the last step [Pa]; zero before the first one
    k_shear,   ///< G [Pa]
    k_state
  };

  explicit Granular(const GranularData& data);

  std::size_t n_internal() const override { return k_state; }
  std::size_t n_scratch() const override { return 0; }
  TangentForm tangent_form() const override { return {}; }
  std::vector<std::string> internal_names() const override {
    return {"burnt_binder", "broken_strain", "bulk_modulus", "shear_modulus"};
  }
  bool tells_stored() const override { return false; }
  bool tells_dissipated() const override { return false; }
  double dissipated(const ExternalCall&) const override { return 0; }
  double stored(const double*) const override { return 0; }
  bool integrate(ExternalCall& call) const override;

  /// Moduli and strength at a temperature [K] with the binder and the bonds that are left.
  /// @param bulk, shear  moduli with all of the binder [Pa]
  /// @param burnt, broken  b and κ
  GranularStrength strength(double temperature, double bulk, double shear, double burnt, double broken) const;

 private:
  Table cohesion_, tension_;
  std::optional<Table> burnout_, crushing_;
  double friction_, dilatancy_, residual_cohesion_, softening_strain_, burnt_stiffness_, residual_stiffness_,
      relaxation_time_;
};

/// The material's law, ready to be evaluated. Throws InputError where its parameters do not go together: an
/// angle of dilatancy above that of friction, a tension cut-off above the apex of the cone, strengths beyond
/// the elastic modulus.
std::shared_ptr<const ExternalLaw> make_granular_law(const Material& material, const GranularData& data);

}  // namespace solidus::material
