/// Bodies of the templates of viscoplastic.hpp, for double, Lane and automatic differentiation. Included by
/// viscoplastic.hpp only.
#pragma once

#include "material/viscoplastic.hpp"

namespace solidus::material {

template <class T>
Viscoplastic::Properties<T> Viscoplastic::properties_at(const T& temperature,
                                                        const T& initial_temperature) const {
  Properties<T> p;
  p.elastic = material::properties_at(*material_, temperature, initial_temperature);
  if (flow_ != nullptr) p.flow = flow_properties_at(*flow_, temperature);
  if (material_->liquid_model == LiquidModel::modified_shear && material_->solidification() != nullptr) {
    const T solidus(material_->solidification()->fraction.solidus());  // 2.77: G(Θ_S) in the mushy zone
    const T cold = select(temperature < solidus, temperature, solidus);
    p.elastic.shear = detail::value(material_->young_modulus, cold) /
                      (T(2.0) * (T(1.0) + detail::value(material_->poisson_ratio, cold)));
  }
  return p;
}

template <class T>
Viscoplastic::Shear<T> Viscoplastic::shear(const PointProperties<T>& p, double dt) const {
  const T zero(0.0), one(1.0), twice_shear = T(2.0) * p.shear;
  switch (material_->liquid_model) {
    case LiquidModel::modified_shear:
      return {T(p.solid_fraction * twice_shear), zero, one, one};
    case LiquidModel::degenerated:
      return {twice_shear, zero, one, p.solid_fraction};
    case LiquidModel::maxwell:
      break;
  }
  // 1/(2Ĝ) = f_S/(2G) + Δt λ/η times 2G η: neither limit divides by zero.
  const T lambda = one - p.solid_fraction;
  const auto fluid = lambda > zero;
  if (!any(fluid)) return {twice_shear, zero, one, one};
  const T flowing = T(dt) * lambda * twice_shear;
  const T inverse = one / select(fluid, T(p.solid_fraction * p.viscosity + flowing), one);
  return {select(fluid, T(twice_shear * p.viscosity * inverse), twice_shear),
          select(fluid, T(flowing * inverse), zero), p.solid_fraction, one};
}

template <class T>
Viscoplastic::Response<T> Viscoplastic::update(const Properties<T>& p, const State<T>& start,
                                               const Sym<T>& strain, double dt) const {
  using namespace return_mapping;
  const Shear<T> sh = shear(p.elastic, dt);
  const Sym<T> free = dev(strain) - start.plastic_strain - start.viscous_strain;  // ê
  if (flow_ == nullptr) return elastic(p, start, sh, free, strain, dt, Status::converged);

  const T w = sh.strength;
  const Sym<T> trial_deviator = sh.twice_shear * free;  // 4.131b
  const Problem<T> problem{flow_->isotropic,
                           &flow_->curves,
                           &p.flow,
                           recalls(),
                           sh.twice_shear,
                           w,
                           T(sh.flow_share * T(dt)),
                           T(T(k_root_two_thirds) * w * p.flow.recall),
                           trial_deviator,
                           start.back_strain,
                           start.hardening};
  const Yield<T> trial = yield(problem, T(0.0));
  const bool in_range = all(trial.norm < T(k_largest_stress));
  if (in_range && any(flows(problem, trial))) return plastic(p, start, sh, free, strain, dt, problem, trial);
  return elastic(p, start, sh, free, strain, dt, in_range ? Status::converged : Status::outside_range);
}

/// Elastic and viscous, given the strain that is left for both.
template <class T>
[[gnu::always_inline]] inline Viscoplastic::Response<T> Viscoplastic::elastic(
    const Properties<T>& p, const State<T>& start, const Shear<T>& sh, const Sym<T>& free,
    const Sym<T>& strain, double dt, Status status) {
  const T zero(0.0), pressure = p.elastic.bulk * (trace(strain) - p.elastic.thermal_strain);  // 2.57b
  const Sym<T> s = sh.twice_shear * free, viscous = sh.viscous_share * free;                  // 4.145
  const T dissipation = T(1.0 / dt) * dot(s, viscous);                                        // 2.114
  const Sym<T> none{{zero, zero, zero, zero, zero, zero}};  // {} would clear the whole response first
  return {{{s[0] + pressure, s[1] + pressure, s[2] + pressure, s[3], s[4], s[5]}},
          {start.viscous_strain + viscous, start.plastic_strain, start.back_strain, start.hardening},
          p.elastic.bulk,
          sh.twice_shear,
          none,
          none,
          none,
          zero,
          dissipation,
          zero,
          zero,
          dissipation,
          status};
}

/// The plastic corrector (4.137–4.147) and its tangent. Lanes inside the yield surface have γ = 0.
template <class T>
[[gnu::always_inline]] inline Viscoplastic::Response<T> Viscoplastic::plastic(
    const Properties<T>& p, const State<T>& start, const Shear<T>& sh, const Sym<T>& free,
    const Sym<T>& strain, double dt, const return_mapping::Problem<T>& problem,
    const return_mapping::Yield<T>& trial) const {
  using namespace return_mapping;
  const Solution<T> solution =
      linear_rate_ ? solve_linear_rate(problem, trial) : solve_power_rate(problem, trial);
  const T gamma = solution.gamma, stiff = sh.twice_shear, w = sh.strength, radius = T(k_root_two_thirds) * w;
  const Yield<T> end = problem.recalls ? yield(problem, gamma) : trial;
  const Sym<T>& n = end.direction;
  const Sym<T> flow = gamma * n, rest = free - flow;

  Response<T> r = elastic(p, start, sh, rest, strain, dt,  // 4.146a
                          solution.converged ? Status::converged : Status::cut_the_step);
  r.state.plastic_strain = start.plastic_strain + flow;               // 4.144a
  r.state.back_strain = end.fading * (start.back_strain - w * flow);  // 4.144b
  r.state.hardening = start.hardening + radius * gamma;               // 4.144c
  r.flow_increment = gamma;
  r.direction = n;
  r.overstress = solution.overstress;
  r.inverse_stiffness = solution.inverse_stiffness;
  r.relative_norm = end.norm;

  const T rate = T(1.0 / dt) * gamma;
  r.plastic_power = rate * stiff * dot(rest, n);
  r.plastic_dissipation = rate * (solution.overstress + radius * p.flow.flow_stress);  // 2.117
  if (problem.recalls)
    r.plastic_dissipation += rate * T(k_two_thirds) * p.flow.kinematic_modulus * problem.recall *
                             dot(r.state.back_strain, r.state.back_strain);
  r.dissipation += r.plastic_dissipation;

  const T turning = stiff * gamma / end.norm;  // share of the stiffness that the turning of n takes
  const T along = stiff * stiff * solution.inverse_stiffness;
  r.twice_shear = stiff * (T(1.0) - turning);
  r.right = n;
  r.left = T(stiff * turning - along) * n;
  if (problem.recalls) r.left -= T(along * gamma / end.norm) * (end.drift - dot(n, end.drift) * n);
  return r;
}

}  // namespace solidus::material
