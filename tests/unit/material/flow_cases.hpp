/// Materials and random states for the tests of the viscoplastic law.
#pragma once

#include <cmath>
#include <optional>
#include <random>

#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"
#include "material/viscoplastic.hpp"

namespace solidus::material::test {

/// Steel-like; solid below 880 K, liquid above 930 K.
struct FlowCase {
  IsotropicHardening isotropic = IsotropicHardening::none;
  KinematicHardening kinematic = KinematicHardening::none;
  double viscosity = 0, exponent = 1;  ///< η of the overstress [Pa s], n
  LiquidModel liquid = LiquidModel::maxwell;
  double liquid_viscosity = 1e9;
  std::optional<double> heat_share = {};  ///< of Taylor and Quinney
};

inline Material flow_material(const FlowCase& c) {
  Material m;
  m.name = "flow case";
  m.density = 7800;
  m.young_modulus = Table({300, 900}, {200e9, 100e9});
  m.poisson_ratio = 0.3;
  m.expansion = 1e-5;
  m.liquid_viscosity = c.liquid_viscosity;
  m.phase_changes = {{"solidification", PhaseFraction::linear(880, 930), 1e5, -0.03, true}};
  m.liquid_model = c.liquid;
  Flow& f = m.flow.emplace();
  f.flow_stress = Table({300, 900}, {120e6, 60e6});
  f.isotropic = c.isotropic;
  set_hardening(f, {{"hardening_modulus", 1e9},
                    {"saturation_stress", Table({300, 900}, {220e6, 100e6})},
                    {"saturation_rate", 50},
                    {"reference_strain", 1e-3},
                    {"hardening_exponent", 0.2}});
  if (c.isotropic == IsotropicHardening::table)
    f.curves =
        FlowCurves({0, 2e-3, 0.01, 0.05}, {300, 900}, {120e6, 150e6, 200e6, 230e6, 60e6, 70e6, 95e6, 110e6});
  f.kinematic = c.kinematic;
  f.kinematic_modulus = c.kinematic == KinematicHardening::none ? 0 : 5e9;
  f.recall[0] = c.kinematic == KinematicHardening::armstrong_frederick ? 100 : 0;
  f.rate[Perzyna::viscosity] = c.viscosity;
  f.rate[Perzyna::exponent] = c.exponent;
  f.rate[Perzyna::drag_stress] = 50e6;
  if (c.heat_share) f.heat_share = *c.heat_share;
  return m;
}

inline constexpr IsotropicHardening k_isotropic[] = {IsotropicHardening::none, IsotropicHardening::linear,
                                                     IsotropicHardening::saturation,
                                                     IsotropicHardening::power, IsotropicHardening::table};
inline constexpr KinematicHardening k_kinematic[] = {KinematicHardening::none, KinematicHardening::linear,
                                                     KinematicHardening::armstrong_frederick};
inline constexpr LiquidModel k_liquid[] = {LiquidModel::maxwell, LiquidModel::modified_shear,
                                           LiquidModel::degenerated};

using Random = std::mt19937;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
/// 10^low … 10^high, every decade as likely.
inline double decades(Random& random, double low, double high) {
  return std::pow(10.0, uniform(random, low, high));
}
inline Sym<double> random_tensor(Random& random, double size) {
  Sym<double> a;
  for (int i = 0; i < 6; ++i) a[i] = uniform(random, -size, size);
  return a;
}
inline Viscoplastic::State<double> random_state(Random& random) {
  return {dev(random_tensor(random, 1e-4)), dev(random_tensor(random, 1e-4)),
          dev(random_tensor(random, 1e-4)), uniform(random, 0, 4e-3)};
}

/// The number in every place of a state, a tensor, the properties.
template <class T, class From>
Sym<T> convert(const Sym<From>& a) {
  Sym<T> r;
  for (int i = 0; i < 6; ++i) r[i] = T(a[i]);
  return r;
}
template <class T, class From>
Viscoplastic::State<T> convert(const Viscoplastic::State<From>& s) {
  return {convert<T>(s.viscous_strain), convert<T>(s.plastic_strain),
          convert<T>(s.back_strain),    T(s.hardening),
          T(s.inelastic_entropy),       T(s.cold_work)};
}

template <class T, class From>
Viscoplastic::Properties<T> convert(const Viscoplastic::Properties<From>& p) {
  const PointProperties<From>& e = p.elastic;
  const FlowProperties<From>& f = p.flow;
  return {{T(e.bulk), T(e.shear), T(e.thermal_strain), T(e.solid_fraction), T(e.viscosity)},
          {T(f.flow_stress),
           T(f.hardening_origin),
           {T(f.hardening[0]), T(f.hardening[1]), T(f.hardening[2]), T(f.hardening[3])},
           T(f.kinematic_modulus),
           {T(f.recall[0]), T(f.recall[1])},
           {T(f.rate[0]), T(f.rate[1]), T(f.rate[2])},
           T(f.temperature),
           T(f.beyond),
           T(f.softening),
           T(f.heat_share)}};
}

/// ‖s − w q‖ − w √⅔ (σ_0 + K_ξ) at a state (2.106, 2.107).
inline double yield_function(const Viscoplastic& law, const Viscoplastic::Properties<double>& p, double w,
                             const Sym<double>& stress, const Viscoplastic::State<double>& state) {
  const Flow& flow = *law.material().flow;
  const Sym<double> q = -2.0 / 3 * p.flow.kinematic_modulus * state.back_strain;
  const double k = hardening_stress<double>(flow.isotropic, flow.curves, p.flow, state.hardening).stress;
  return norm(dev(stress) - w * q) - w * std::sqrt(2.0 / 3) * (p.flow.flow_stress + k);
}

}  // namespace solidus::material::test
