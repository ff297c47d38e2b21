/// Bodies of the templates of viscoplastic.hpp, for double, Lane and automatic differentiation. Files that
/// include it are compiled again when a law changes that is called directly.
#pragma once

#include "material/hardening_heat.hpp"
#include "material/liquid.hpp"
#include "material/return_mapping.hpp"
#include "material/viscoplastic.hpp"

namespace solidus::material {

template <class T>
Viscoplastic::Properties<T> Viscoplastic::properties_at(const T& temperature, const T& initial_temperature,
                                                        const PhaseState<T>& phase) const {
  Properties<T> p;
  p.elastic = material::properties_at(*material_, temperature, initial_temperature, phase);
  if (flow_ != nullptr) p.flow = flow_properties_at(*flow_, temperature);
  if (holds_modulus(material_->liquid_model) && material_->solidification() != nullptr) {
    const T solidus(material_->solidification()->fraction.solidus());  // 2.77: G(Θ_S) in the mushy zone
    const T cold = select(temperature < solidus, temperature, solidus);
    p.elastic.shear = detail::value(material_->young_modulus, cold) /
                      (T(2.0) * (T(1.0) + detail::value(material_->poisson_ratio, cold)));
  }
  return p;
}

template <class T>
[[gnu::always_inline]] inline Viscoplastic::Shear<T> Viscoplastic::shear(const PointProperties<T>& p,
                                                                         double dt) const {
  const T zero(0.0), one(1.0), twice_shear = T(2.0) * p.shear;
  const LiquidShares<T> s = liquid_shares(*material_, p.solid_fraction);
  if (!has_dashpot(material_->liquid_model)) return {T(s.spring * twice_shear), zero, s.flow, s.strength};
  // 1/(2Ĝ) = a/(2G) + Δt λ/η times 2G η: neither limit divides by zero.
  const auto fluid = s.fluid > zero;
  if (!any(fluid)) return {twice_shear, zero, s.flow, s.strength};
  const T flowing = T(dt) * s.fluid * twice_shear;
  const T inverse = one / select(fluid, T(s.spring * p.viscosity + flowing), one);
  return {select(fluid, T(twice_shear * p.viscosity * inverse), twice_shear),
          select(fluid, T(flowing * inverse), zero), s.flow, s.strength};
}

template <class T>
[[gnu::always_inline]] inline return_mapping::Problem<T> Viscoplastic::problem(
    const Properties<T>& p, const Shear<T>& sh, const State<T>& start, const Sym<T>& trial, double dt) const {
  return {flow_->isotropic,
          flow_->kinematic,
          flow_->rate_dependence,
          &flow_->curves,
          &p.flow,
          recalls_,
          sh.twice_shear,
          sh.strength,
          T(sh.flow_share * T(dt)),
          trial,
          start.back_strain,
          start.hardening};
}

template <class T>
Sym<T> Viscoplastic::loading(const Properties<T>& p, const State<T>& state, const Sym<T>& strain,
                             double dt) const {
  const Shear<T> sh = shear(p.elastic, dt);
  const Sym<T> deviator = sh.twice_shear * (dev(strain) - state.plastic_strain - state.viscous_strain);
  const return_mapping::Yield<T> y = yield(problem(p, sh, state, deviator, dt), T(0.0));
  const T radius = y.norm - y.value;
  return T(T(1.0) / select(radius > y.norm, radius, y.norm)) * y.relative;
}

template <class T>
Viscoplastic::Response<T> Viscoplastic::update(const Properties<T>& p, const State<T>& start,
                                               const Sym<T>& strain, const TimeStep& step) const {
  using namespace return_mapping;
  const double dt = step.dt;
  const Shear<T> sh = shear(p.elastic, dt);
  const Sym<T> free = dev(strain) - start.plastic_strain - start.viscous_strain;  // ê
  if (flow_ == nullptr) return elastic(p, start, sh, free, strain, dt, Status::converged);

  const Sym<T> trial_deviator = sh.twice_shear * free;  // 4.131b
  const Problem<T> equation = problem(p, sh, start, trial_deviator, dt);
  const Yield<T> trial = yield(equation, T(0.0));
  const bool in_range = all(trial.norm < T(k_largest_stress));
  if (in_range && any(flows(equation, trial)))
    return plastic(p, start, sh, free, strain, step, equation, trial);
  return elastic(p, start, sh, free, strain, dt, in_range ? Status::converged : Status::outside_range);
}

/// The answer, once the plastic flow is known: one initialisation, so that its parts stay in registers until
/// then.
/// @param rest the strain that spring and dashpot share
template <class T>
[[gnu::always_inline]] inline Viscoplastic::Response<T> Viscoplastic::response(
    const Properties<T>& p, const Sym<T>& old_viscous, const Shear<T>& sh, const Sym<T>& rest,
    const Sym<T>& strain, double dt, const Flowed<T>& f) {
  const T pressure = p.elastic.bulk * (trace(strain) - p.elastic.thermal_strain);  // 2.57b
  const Sym<T> s = sh.twice_shear * rest, viscous = sh.viscous_share * rest;       // 4.146a, 4.145
  const T dissipation = T(1.0 / dt) * dot(s, viscous);                             // 2.114
  return {.stress = {{s[0] + pressure, s[1] + pressure, s[2] + pressure, s[3], s[4], s[5]}},
          .state = {old_viscous + viscous, f.plastic_strain, f.back_strain, f.hardening, f.inelastic_entropy,
                    f.cold_work},
          .bulk = p.elastic.bulk,
          .twice_shear = f.twice_shear,
          .left = f.left,
          .right = f.direction,
          .direction = f.direction,
          .flow_increment = f.solution.gamma,
          .viscous_dissipation = dissipation,
          .plastic_dissipation = f.dissipation,
          .plastic_power = f.power,
          .thermal_dissipation = f.thermal_dissipation,
          .dissipation = dissipation + f.dissipation,
          .status = f.status,
          .overstress = f.solution.overstress,
          .inverse_stiffness = f.solution.inverse_stiffness,
          .relative_norm = f.relative_norm};
}

template <class T>
[[gnu::always_inline]] inline Viscoplastic::Response<T> Viscoplastic::elastic(
    const Properties<T>& p, const State<T>& start, const Shear<T>& sh, const Sym<T>& free,
    const Sym<T>& strain, double dt, Status status) {
  const T zero(0.0), one(1.0);
  const Sym<T> none{{zero, zero, zero, zero, zero, zero}};
  return response(p, start.viscous_strain, sh, free, strain, dt,
                  Flowed<T>{start.plastic_strain,
                            start.back_strain,
                            start.hardening,
                            start.inelastic_entropy,
                            start.cold_work,
                            sh.twice_shear,
                            none,
                            none,
                            {zero, zero, zero, true},
                            one,
                            zero,
                            zero,
                            zero,
                            status});
}

/// The plastic corrector (4.137–4.147).
template <class T>
[[gnu::always_inline]] inline Viscoplastic::Response<T> Viscoplastic::plastic(
    const Properties<T>& p, const State<T>& start, const Shear<T>& sh, const Sym<T>& free,
    const Sym<T>& strain, const TimeStep& step, const return_mapping::Problem<T>& problem,
    const return_mapping::Yield<T>& trial) const {
  using namespace return_mapping;
  const Solution<T> solution = linear_rate_    ? solve_linear_rate(problem, trial)
                               : powered_rate_ ? solve_power_rate(problem, trial)
                                               : solve_rate_law(problem, trial);
  if (problem.recalls)
    return returned<true>(p, start, sh, free, strain, step, problem, solution,
                          yield(problem, solution.gamma));
  return returned<false>(p, start, sh, free, strain, step, problem, solution, trial);  // β̂ stays
}

/// K + ⅓ K ζ:ζ at the end of a step less that at its start, at one temperature [J/m³].
template <class T>
T Viscoplastic::hardening_gain(const Properties<T>& p, const State<T>& start, const T& hardening,
                               const Sym<T>& back_strain) const {
  return hardening_potential<T>(*flow_, p.flow, hardening, dot(back_strain, back_strain)) -
         hardening_potential<T>(*flow_, p.flow, start.hardening, dot(start.back_strain, start.back_strain));
}

/// The state on the (overstressed) yield surface, and the tangent. Lanes inside it have γ = 0.
template <bool recalls, class T>
[[gnu::always_inline]] inline Viscoplastic::Response<T> Viscoplastic::returned(
    const Properties<T>& p, const State<T>& start, const Shear<T>& sh, const Sym<T>& free,
    const Sym<T>& strain, const TimeStep& step, const return_mapping::Problem<T>& problem,
    const return_mapping::Solution<T>& solution, const return_mapping::Yield<T>& end) const {
  using namespace return_mapping;
  const double dt = step.dt;
  const T gamma = solution.gamma, stiff = sh.twice_shear, w = sh.strength, radius = T(k_root_two_thirds) * w;
  const T inverse_norm = T(1.0) / end.norm, rate = T(1.0 / dt) * gamma;
  const Sym<T> n = inverse_norm * end.relative, flow = gamma * n, rest = free - flow;
  const Sym<T> back_strain = end.fading * (start.back_strain - w * flow);  // 4.144b

  T dissipation = rate * (solution.overstress + radius * p.flow.flow_stress);  // 2.117
  const T turning = stiff * gamma * inverse_norm;  // share of the stiffness that the turning of n takes
  const T along = stiff * stiff * solution.inverse_stiffness;
  Sym<T> left = T(stiff * turning - along) * n;
  if constexpr (recalls) {
    dissipation +=
        rate * T(k_two_thirds) * p.flow.kinematic_modulus * end.recall * dot(back_strain, back_strain);
    left -=
        T(along * gamma * inverse_norm * end.drift) * (problem.back_strain - dot(n, problem.back_strain) * n);
  }
  const T produced = rate * radius * p.flow.softening;  // 2.119b
  T power = rate * stiff * dot(rest, n);
  const T hardening = start.hardening + radius * gamma;  // 4.144c
  T cold_work = start.cold_work;
  if (flow_->heat_share) {
    // The work is counted by what hardening gains and not by the stress at the end, so that K + ⅓ K ζ:ζ + χ
    // grows by 1 − β of it in a step of any size.
    if (!step.extrapolated)
      power = dissipation + T(1.0 / dt) * hardening_gain(p, start, hardening, back_strain);
    // Where the back stress outweighs s, flow gives work back and none of it can become heat.
    const T zero(0.0), heat = p.flow.heat_share * select(power > zero, power, zero);
    cold_work += T(dt) * (dissipation - heat);
    dissipation = heat;
  }
  return response(p, start.viscous_strain, sh, rest, strain, dt,
                  Flowed<T>{.plastic_strain = start.plastic_strain + flow,  // 4.144a
                            .back_strain = back_strain,
                            .hardening = hardening,
                            .inelastic_entropy = start.inelastic_entropy + T(dt) * produced,  // 4.43b
                            .cold_work = cold_work,
                            .twice_shear = stiff * (T(1.0) - turning),
                            .left = left,
                            .direction = n,
                            .solution = solution,
                            .relative_norm = end.norm,
                            .dissipation = dissipation,
                            .power = power,
                            .thermal_dissipation = p.flow.temperature * produced,
                            .status = solution.converged ? Status::converged : Status::cut_the_step});
}

// In viscoplastic.cpp.
extern template Viscoplastic::Properties<double> Viscoplastic::properties_at(const double&, const double&,
                                                                             const PhaseState<double>&) const;
extern template Viscoplastic::Properties<Lane> Viscoplastic::properties_at(const Lane&, const Lane&,
                                                                           const PhaseState<Lane>&) const;
extern template Viscoplastic::Properties<Jet<double>> Viscoplastic::properties_at(
    const Jet<double>&, const Jet<double>&, const PhaseState<Jet<double>>&) const;
extern template Viscoplastic::Properties<Jet<Lane>> Viscoplastic::properties_at(
    const Jet<Lane>&, const Jet<Lane>&, const PhaseState<Jet<Lane>>&) const;
extern template Viscoplastic::Response<double> Viscoplastic::update(const Properties<double>&,
                                                                    const State<double>&, const Sym<double>&,
                                                                    const TimeStep&) const;
extern template Viscoplastic::Response<Lane> Viscoplastic::update(const Properties<Lane>&, const State<Lane>&,
                                                                  const Sym<Lane>&, const TimeStep&) const;
extern template Sym<Lane> Viscoplastic::loading(const Properties<Lane>&, const State<Lane>&, const Sym<Lane>&,
                                                double) const;

}  // namespace solidus::material
