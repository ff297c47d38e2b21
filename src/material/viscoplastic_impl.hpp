/// Bodies of the templates of viscoplastic.hpp, for double, Lane and automatic differentiation. Included by
/// viscoplastic.hpp only.
#pragma once

#include <algorithm>

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
  const T flowing = T(dt) * lambda * twice_shear;
  const T sum = p.solid_fraction * p.viscosity + flowing;
  const auto fluid = lambda > zero;
  const T divisor = select(fluid, sum, one);
  return {select(fluid, T(twice_shear * p.viscosity / divisor), twice_shear),
          select(fluid, T(flowing / divisor), zero), p.solid_fraction, one};
}

template <class T>
Viscoplastic::Response<T> Viscoplastic::update(const Properties<T>& p, const State<T>& start,
                                               const Sym<T>& strain, double dt) const {
  const Shear<T> sh = shear(p.elastic, dt);
  const Sym<T> free = dev(strain) - start.plastic_strain - start.viscous_strain;  // ê
  Sym<T> s = sh.twice_shear * free;                                               // 4.131b, trial
  Response<T> r;
  r.state = start;
  r.bulk = p.elastic.bulk;
  r.twice_shear = sh.twice_shear;
  r.flow_increment = r.plastic_dissipation = r.plastic_power = T(0.0);
  if (flow_ != nullptr) correct(p, start, sh, Sym<T>(s), dt, r, s);

  // 4.145: Δε^v is the viscous share of what is not plastic.
  const Sym<T> viscous = sh.viscous_share * (free - (r.state.plastic_strain - start.plastic_strain));
  r.state.viscous_strain = start.viscous_strain + viscous;
  r.viscous_dissipation = T(1.0 / dt) * dot(s, viscous);  // 2.114
  r.dissipation = r.viscous_dissipation + r.plastic_dissipation;
  const T pressure = p.elastic.bulk * (trace(strain) - p.elastic.thermal_strain);  // 2.57b
  r.stress = s;
  for (int i = 0; i < 3; ++i) r.stress[i] += pressure;
  return r;
}

// The plastic corrector (4.137–4.147) and its tangent, where the trial state lies outside the yield surface.
template <class T>
void Viscoplastic::correct(const Properties<T>& p, const State<T>& start, const Shear<T>& sh,
                           const Sym<T>& trial, double dt, Response<T>& r, Sym<T>& s) const {
  using namespace return_mapping;
  const T zero(0.0), w = sh.strength;
  const Problem<T> problem{flow_->isotropic,
                           &flow_->curves,
                           &p.flow,
                           recalls(),
                           sh.twice_shear,
                           w,
                           T(sh.flow_share * T(dt)),
                           T(T(k_root_two_thirds) * w * p.flow.recall),
                           trial,
                           start.back_strain,
                           start.hardening};
  const Yield<T> at_start = yield(problem, zero);
  if (!any((at_start.value > zero) & (problem.rate > zero))) return;

  const Solution<T> solution =
      flow_->linear_rate() ? solve_linear_rate(problem, at_start) : solve_power_rate(problem, at_start);
  const T gamma = solution.gamma, stiff = sh.twice_shear;
  const Yield<T> end = problem.recalls ? yield(problem, gamma) : at_start;
  const Sym<T>& n = end.direction;
  if (!solution.converged) r.status = Status::cut_the_step;

  r.flow_increment = gamma;
  r.direction = n;
  r.state.plastic_strain = start.plastic_strain + gamma * n;                  // 4.144a
  r.state.back_strain = end.fading * (start.back_strain - T(w * gamma) * n);  // 4.144b
  r.state.hardening = start.hardening + T(k_root_two_thirds) * w * gamma;     // 4.144c
  s = trial - T(stiff * gamma) * n;                                           // 4.146a

  const T rate = T(1.0 / dt) * gamma;
  r.plastic_power = rate * dot(s, n);
  r.plastic_dissipation =
      rate * (solution.overstress + T(k_root_two_thirds) * w * p.flow.flow_stress);  // 2.117
  if (problem.recalls)
    r.plastic_dissipation += rate * T(k_two_thirds) * p.flow.kinematic_modulus * problem.recall *
                             dot(r.state.back_strain, r.state.back_strain);

  const T turning = stiff * gamma / end.norm;  // share of the stiffness that the turning of n takes
  const T along = stiff * stiff * solution.inverse_stiffness;
  r.twice_shear = stiff * (T(1.0) - turning);
  r.right = n;
  r.left = T(stiff * turning - along) * n;
  if (problem.recalls) r.left -= T(along * gamma / end.norm) * (end.drift - dot(n, end.drift) * n);
}

}  // namespace solidus::material
