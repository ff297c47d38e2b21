/// Functions that mixed elements require of a law: the volumetric strain of a mean stress, its part of the
/// tangent, and the modulus of the stabilisation. One overload per law where they differ.
#pragma once

#include "mechanics/elements/law_parts.hpp"

namespace solidus::mechanics {

/// Volumetric strain that may be wrong where it is found by iteration; the stress has its mean anyway.
inline constexpr double k_volume_tolerance = 1e-11;
inline constexpr int k_max_volumes = 30;
/// Largest volumetric strain of one step of that iteration: beyond it no law holds.
inline constexpr double k_largest_volume_step = 0.05;
/// Behind the law's state at a point: e_v, the pore fraction, in axisymmetry p_a − p̄ of its nodes, and where
/// melt flows between dendrites its q (liquid_flow.hpp), the mean stress of compaction and e^θ
/// (compaction.hpp).
template <int n_nodes, AnalysisKind kind>
inline constexpr int k_mixed_extra = kind == AnalysisKind::axisymmetric ? 2 + n_nodes : 2;

/// The stabilisation works with at least this share of the bulk modulus: a melt that has no shear stiffness
/// at all would leave the pressure without a scale.
inline constexpr double k_least_shear = 1e-7;

/// 2Ĝ of the elastic or viscous response over a step.
inline Lane algorithmic_shear(const material::Viscoelastic&, const material::PointProperties<Lane>& p,
                              double dt) {
  const Lane twice_shear = Lane(2.0) * p.shear;
  return twice_shear /
         (p.solid_fraction + Lane(dt) * (Lane(1.0) - p.solid_fraction) / p.viscosity * twice_shear);
}
inline Lane algorithmic_shear(const material::Viscoplastic& law,
                              const material::Viscoplastic::Properties<Lane>& p, double dt) {
  return law.shear(p.elastic, dt).twice_shear;
}
inline Lane algorithmic_shear(const material::Isentropic& law,
                              const material::Isentropic::Properties<Lane>& p, double dt) {
  return law.isothermal().shear(elastic_part(law, p), dt).twice_shear;
}

/// The compliance of the flow up to now, ε^vp/s of proportional loading: (3/2) ξ/(σ_0 + K_ξ) [1/Pa]. Unlike
/// the ratio of the norms it has no zero where the load turns round.
inline Lane flow_compliance(const ViscoplasticValues<Lane>& v) {
  const Lane zero(0.0), floor(1e-300);
  return select(v.flow_stress > zero, Lane(1.5) * v.equivalent_plastic_strain / max(v.flow_stress, floor),
                zero);
}
inline Lane flow_compliance(const material::Viscoelastic&, const material::PointProperties<Lane>&,
                            const material::Viscoelastic::State<Lane>&) {
  return Lane(0.0);
}
inline Lane flow_compliance(const material::Viscoplastic& law,
                            const material::Viscoplastic::Properties<Lane>& p,
                            const material::Viscoplastic::State<Lane>& state) {
  return flow_compliance(values_of(law, p, state));
}
inline Lane flow_compliance(const material::Isentropic& law, const material::Isentropic::Properties<Lane>& p,
                            const material::Isentropic::State<Lane>& state) {
  return flow_compliance(values_of(law, p, state, p.temperature));
}

/// The secant modulus 2Ĝ that the stabilisation of a step works with [Pa].
template <class Law, class Properties, class State>
Lane secant_shear(const Law& law, const Properties& p, const State& start, double dt) {
  const Lane least = Lane(k_least_shear) * elastic_part(law, p).bulk;
  const Lane shear = max(algorithmic_shear(law, p, dt), least);
  return max(shear / (Lane(1.0) + shear * flow_compliance(law, p, start)), least);
}

/// The tangent with volume and mean stress changed for each other: with the adiabatic part f t_l ⊗ t_r, t = v
/// 1 + d,
///   δs = (2Ĝ I_dev + … + f κ/κ_v d_l ⊗ d_r) : δdev ε + left δp,   δe_v = δp/κ_v − right : δdev ε,
///   κ_v = κ + f v_l v_r,  left = f v_r/κ_v d_l,  right = f v_l/κ_v d_r.
struct VolumeTangent {
  Lane stiffness;                         ///< κ_v [Pa]
  Lane factor;                            ///< f κ/κ_v
  Sym<Lane> thermal_left, thermal_right;  ///< d_l, d_r
  Sym<Lane> left, right;
};
template <class Response>
VolumeTangent volume_tangent(const Response& r) {
  const Lane third(1.0 / 3.0), f = r.thermal_factor;
  const Lane v_left = third * trace(r.thermal_left), v_right = third * trace(r.thermal_right);
  const Lane stiffness = r.bulk + f * v_left * v_right, inverse = f / stiffness;
  const Sym<Lane> d_left = dev(r.thermal_left), d_right = dev(r.thermal_right);
  return {stiffness,
          inverse * r.bulk,
          d_left,
          d_right,
          (inverse * v_right) * d_left,
          (inverse * v_left) * d_right};
}

}  // namespace solidus::mechanics
