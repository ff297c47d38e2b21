/// Thermo-viscoelastic-viscoplastic law from melt to solid: Maxwell element, J2 flow with isotropic and
/// kinematic hardening and thermal softening, Perzyna/Norton rate dependence (monograph 2.49–2.118),
/// integrated by a closest point projection at a given temperature (4.125–4.148).
///
///   σ = p 1 + s,  p = k (tr ε − e^θ),  s = 2Ĝ (dev ε − ε^v* − ε^vp)                    (2.57, 4.131)
///   Φ = ‖s − w q‖ − w √⅔ (σ_0 + K_ξ),  n = (s − w q)/‖s − w q‖                          (2.106, 2.107)
///   ε̇^vp = γ̇ n,  ξ̇ = w √⅔ γ̇,  ζ̇ = −γ̇ (w n + b ζ),  q = −⅔ K ζ                          (2.108)
///   Φ = x(γ̇/m),  Perzyna: γ̇ = m/η Φ (Φ/D)^(n−1),  η = 0: Φ <= 0                         (2.109, 2.112)
///   Ṡ^I = −γ̇ w √⅔ dσ_0/dΘ                                                              (2.119b, 4.43b)
///   ε̇^v = λ/η_l s,  λ = 1 − f_S                                                        (2.104)
///
/// The liquid models (2.3.1, laws/liquid_law.hpp) differ in 2Ĝ, in the share m of the flow and in the
/// strength factor w:
///   maxwell         1/(2Ĝ) = f_S/(2G) + Δt λ/η_l,  m = f_S,  w = 1                      (2.50, errata)
///   modified_shear  2Ĝ = 2 f_S G(Θ_S),             m = 1,    w = 1                      (2.77, 2.78)
///   degenerated     2Ĝ = 2G,                       m = 1,    w = f_S                    (2.79–2.83)
///
/// Symbols: k, G moduli, q back stress, K kinematic modulus, σ_0 flow stress, x overstress
/// (laws/rate_law.hpp), D drag stress [Pa], η, η_l [Pa s], b = w √⅔ r of the law of kinematic hardening
/// (laws/kinematic_law.hpp; b = 0: Prager), f_S solid fraction, ξ equivalent plastic strain, ζ back strain, γ
/// flow multiplier. Validity: infinitesimal strain, f_S > 0 for plastic flow. The time integration enters
/// through the start state * and the effective step: the values at t_n and Δt for backward Euler, those of
/// time_integration.hpp for the two-step method. Source: Chiumenti, Agelet de Saracibar, Cervera, CIMNE
/// monograph 48 (1999); errata.
#pragma once

#include "material/flow_properties.hpp"
#include "material/viscoelastic.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/tensor.hpp"

namespace solidus::material {
namespace return_mapping {  // return_mapping.hpp
template <class T>
struct Problem;
template <class T>
struct Yield;
template <class T>
struct Solution;
}  // namespace return_mapping

/// A trial stress above this, or not a number, is outside the law's range [Pa].
inline constexpr double k_largest_stress = 1e100;

/// The templates are compiled for double and Lane, properties_at for their Jets too (viscoplastic.cpp); who
/// needs other types of numbers includes viscoplastic_impl.hpp.
class Viscoplastic {
 public:
  template <class T>
  struct Properties {
    PointProperties<T> elastic;
    FlowProperties<T> flow;
  };

  template <class T>
  struct State {
    Sym<T> viscous_strain;  ///< ε^v, deviatoric
    Sym<T> plastic_strain;  ///< ε^vp, deviatoric
    Sym<T> back_strain;     ///< ζ, deviatoric; q = −⅔ K ζ
    T hardening{};          ///< ξ, the equivalent plastic strain
    T inelastic_entropy{};  ///< S^I (4.43b, 4.48c) [J/(m³ K)]
    /// Energy of plastic work that is stored in addition to that of hardening, with a Taylor–Quinney factor
    /// only; its force acts on nothing [J/m³].
    T cold_work{};
  };

  template <class T>
  struct Response {
    Sym<T> stress;  ///< σ [Pa]
    State<T> state;
    T bulk, twice_shear;    ///< the tangent: κ 1⊗1 + 2μ I_dev + left ⊗ right [Pa];
    Sym<T> left, right;     ///< left = c right (symmetric) but where back strain is recalled
    Sym<T> direction;       ///< n, where flow_increment > 0
    T flow_increment;       ///< γ over the effective step
    T viscous_dissipation;  ///< 2.114 [W/m³]
    T plastic_dissipation;  ///< 2.117, without the power that is stored [W/m³]
    T plastic_power;        ///< s : ε̇^vp; with a Taylor–Quinney factor its mean over the step [W/m³]
    T thermal_dissipation;  ///< D_ther = Θ Ṡ^I (2.120), Θ that of the flow stress [W/m³]
    T dissipation;          ///< D_mech, the sum of both (2.113) [W/m³]
    Status status = Status::converged;
    // These members are read by thermal_derivatives.hpp and isentropic.hpp if flow_increment > 0:
    T overstress{};         ///< x [Pa]
    T inverse_stiffness{};  ///< ∂γ/∂Φ^trial [1/Pa]
    T relative_norm{1.0};   ///< ‖β̂‖ [Pa]
  };

  /// Keeps a reference to the material. Without Material::flow the solid is elastic.
  explicit Viscoplastic(const Material& material);

  /// @param initial_temperature Θ_0 of 2.51 [K]
  template <class T>
  Properties<T> properties_at(const T& temperature, const T& initial_temperature) const {
    return properties_at(temperature, initial_temperature,
                         phase_state_at(*material_, temperature, initial_temperature));
  }
  /// With the phases of a step (elasticity.hpp).
  template <class T>
  Properties<T> properties_at(const T& temperature, const T& initial_temperature,
                              const PhaseState<T>& phase) const;

  /// @param start  history at the start of the effective step
  /// @param strain total strain at t_{n+1}
  template <class T>
  Response<T> update(const Properties<T>& p, const State<T>& start, const Sym<T>& strain,
                     const TimeStep& step) const;

  /// (s − w q)/max(‖s − w q‖, R) of a state at rest: the direction in which it is loaded, as long as the part
  /// of the yield radius R = w √⅔ (σ_0 + K_ξ) that it takes, one at most. The material has Material::flow.
  template <class T>
  Sym<T> loading(const Properties<T>& p, const State<T>& state, const Sym<T>& strain, double dt) const;

  /// Stiffness and strength with the model of the liquid.
  template <class T>
  struct Shear {
    T twice_shear;    ///< 2Ĝ [Pa]
    T viscous_share;  ///< Δε^v = viscous_share (dev ε − ε^v* − ε^vp)
    T flow_share;     ///< m
    T strength;       ///< w
  };
  template <class T>
  Shear<T> shear(const PointProperties<T>& p, double dt) const;

  /// False where the tangent is not symmetric, since back strain is recalled.
  bool symmetric() const { return !recalls_; }
  const Material& material() const { return *material_; }

 private:
  /// The return mapping's equation from `start`; it refers to `p`, `trial` and `start`.
  /// @param trial 2Ĝ ê
  template <class T>
  return_mapping::Problem<T> problem(const Properties<T>& p, const Shear<T>& shear, const State<T>& start,
                                     const Sym<T>& trial, double dt) const;
  /// Result of plastic flow at a point: members as in Response and State.
  template <class T>
  struct Flowed {
    Sym<T> plastic_strain, back_strain;
    T hardening, inelastic_entropy, cold_work, twice_shear;
    Sym<T> left, direction;
    return_mapping::Solution<T> solution;
    T relative_norm, dissipation, power, thermal_dissipation;
    Status status;
  };
  template <class T>
  static Response<T> response(const Properties<T>& p, const Sym<T>& old_viscous, const Shear<T>& shear,
                              const Sym<T>& rest, const Sym<T>& strain, double dt, const Flowed<T>& f);
  template <class T>
  static Response<T> elastic(const Properties<T>& p, const State<T>& start, const Shear<T>& shear,
                             const Sym<T>& free, const Sym<T>& strain, double dt, Status status);
  template <class T>
  Response<T> plastic(const Properties<T>& p, const State<T>& start, const Shear<T>& shear,
                      const Sym<T>& free, const Sym<T>& strain, const TimeStep& step,
                      const return_mapping::Problem<T>& problem, const return_mapping::Yield<T>& trial) const;
  template <class T>
  T hardening_gain(const Properties<T>& p, const State<T>& start, const T& hardening,
                   const Sym<T>& back_strain) const;
  template <bool recalls, class T>
  Response<T> returned(const Properties<T>& p, const State<T>& start, const Shear<T>& shear,
                       const Sym<T>& free, const Sym<T>& strain, const TimeStep& step,
                       const return_mapping::Problem<T>& problem, const return_mapping::Solution<T>& solution,
                       const return_mapping::Yield<T>& end) const;

  const Material* material_;
  const Flow* flow_;
  bool recalls_;       ///< the law of kinematic hardening does
  bool linear_rate_;   ///< Flow::linear_rate
  bool powered_rate_;  ///< Flow::powered_rate
};

/// The tangent as a 6×6 matrix.
template <class T>
Sym4<T> full_tangent(const Viscoplastic::Response<T>& r) {
  Sym4<T> c = Sym4<T>::isotropic(r.bulk, r.twice_shear);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) c[i][as_size(j)] += r.left[i] * r.right[j];
  return c;
}

}  // namespace solidus::material
