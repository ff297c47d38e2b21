/// The derivatives of the update with respect to temperature and strain against automatic differentiation.
#include "material/derivatives/thermal_derivatives_impl.hpp"

#include <gtest/gtest.h>

#include "dual.hpp"
#include "material/derivatives/structural_partials.hpp"
#include "material/free_energy.hpp"
#include "structural_state.hpp"
#include "thermal_cases.hpp"

namespace solidus::material::test {
namespace {

// Variables: ε (0–5), Θ (6).
using Ad = LongDual<7>;
constexpr int k_theta = 6;

double slope(const Ad& a, int i) {
  return static_cast<double>(a.derivatives()[static_cast<std::size_t>(i)]);
}

/// A number with the temperature derivative that it is stated to have.
Ad reseeded(const Jet<Ad>& a) {
  return Ad(a.v.value(), 7, k_theta).with_slopes_times(a.d.value());
}

/// The properties as numbers whose temperature derivative is zero where frozen.
Viscoplastic::Properties<Ad> properties(const Viscoplastic& law, const Ad& theta, Frozen frozen) {
  const auto p = thermal_properties(law, Ad(theta.value()), Ad(k_start_temperature), frozen);
  Viscoplastic::Properties<Ad> r;
  const auto& e = p.elastic;
  const auto& f = p.flow;
  r.elastic = {reseeded(e.bulk), reseeded(e.shear), reseeded(e.thermal_strain), reseeded(e.solid_fraction),
               reseeded(e.viscosity)};
  r.flow = {reseeded(f.flow_stress),
            reseeded(f.hardening_origin),
            {reseeded(f.hardening[0]), reseeded(f.hardening[1]), reseeded(f.hardening[2]),
             reseeded(f.hardening[3])},
            reseeded(f.kinematic_modulus),
            {reseeded(f.recall[0]), reseeded(f.recall[1])},
            {reseeded(f.rate[0]), reseeded(f.rate[1]), reseeded(f.rate[2])},
            reseeded(f.temperature),
            Ad(0.0),
            reseeded(f.softening),
            reseeded(f.heat_share)};
  return r;
}

/// S of W + M + K at the end of the update, from the functions that know nothing of the update.
Ad reference_entropy(const Viscoplastic& law, const Viscoplastic::Response<Ad>& r, const Sym<Ad>& strain,
                     const Ad& theta) {
  const Material& m = law.material();
  if (m.liquid_model == LiquidModel::maxwell) {
    // through the stress deviator, where nothing divides by the solid fraction
    const Sym<Ad> s = dev(r.stress);
    Ad entropy = structural_state<Ad>(m, properties_at(m, theta, Ad(k_start_temperature)),
                                      derivatives_at(m, theta, Ad(k_start_temperature)), theta, trace(strain),
                                      dot(s, s))
                     .entropy;
    const Sym<Ad>& zeta = r.state.back_strain;
    entropy += hardening_state<Ad>(*m.flow, r.state.hardening, dot(zeta, zeta), theta).entropy;
    return entropy;
  }
  const StateVariables<Ad> state{strain + Ad(-1.0) * (r.state.viscous_strain + r.state.plastic_strain),
                                 r.state.hardening, r.state.back_strain};
  return thermal_state<Ad>(law, state, theta, Ad(k_start_temperature)).entropy -
         sensible_heat<Ad>(m, Ad(k_start_temperature), theta).entropy;
}

/// Difference of a scalar's derivatives to the exact ones, in parts of their sizes.
double error(const Derivatives<double>& a, const Ad& exact, double strain_size, double theta_size) {
  double by_strain = 0;
  for (int i = 0; i < 6; ++i)
    by_strain = std::max(by_strain, std::abs(a.strain[i] * (i < 3 ? 1 : 2) - slope(exact, i)));
  return std::max({std::abs(a.value - exact.value()) / (std::abs(exact.value()) + 1e-12 * theta_size),
                   by_strain / strain_size, std::abs(a.temperature - slope(exact, k_theta)) / theta_size});
}
double largest_slope(const Ad& a) {
  double largest = 1e-300;
  for (int i = 0; i < 6; ++i) largest = std::max(largest, std::abs(slope(a, i)));
  return largest;
}

struct Errors {
  double stress = 0, entropy = 0, dissipation = 0, gamma = 0;
  int plastic = 0, elastic = 0;
};

void compare(const Viscoplastic& law, double temperature, Frozen frozen,
             const Viscoplastic::State<double>& start, const Sym<double>& strain, double dt, Errors& e) {
  const auto p = thermal_properties(law, temperature, k_start_temperature, frozen);
  const auto r = law.update(law.properties_at(temperature, k_start_temperature), start, strain, dt);
  const auto d = thermal_derivatives(law, p, start, strain, dt, r);
  ++(r.flow_increment > 0 ? e.plastic : e.elastic);

  const Ad theta(temperature, 7, k_theta);
  Sym<Ad> strain_ad;
  for (int i = 0; i < 6; ++i) strain_ad[i] = Ad(strain[i], 7, i);
  const bool free = !(frozen.phase || frozen.flow_stress);
  const auto p_ad = free ? law.properties_at(theta, Ad(k_start_temperature)) : properties(law, theta, frozen);
  const auto exact = law.update(p_ad, convert<Ad>(start), strain_ad, dt);

  double size = 1e-300, off = 0;
  for (int i = 0; i < 6; ++i) {
    size = std::max(size, std::abs(slope(exact.stress[i], k_theta)));
    off = std::max(off, std::abs(d.stress[i] - slope(exact.stress[i], k_theta)));
  }
  e.stress = std::max(e.stress, off / size);
  const Ad &work = exact.dissipation, &gamma = exact.flow_increment;
  if (work.value() > 0)
    e.dissipation = std::max(e.dissipation, error(d.dissipation, work, largest_slope(work),
                                                  std::abs(slope(work, k_theta)) + 1e-3 * work.value()));
  if (gamma.value() > 0 && law.material().flow->heat_share) {
    const Ad& stored = exact.state.cold_work;
    const Variation<double> update(law, p, start, strain, dt, r);
    e.dissipation = std::max(
        e.dissipation, error(update.cold_work(), stored, largest_slope(stored) + dt * largest_slope(work),
                             std::abs(slope(stored, k_theta)) + 1e-3 * dt * work.value()));
  }
  if (gamma.value() > 0)
    e.gamma = std::max(e.gamma, error(d.flow_increment, gamma, largest_slope(gamma),
                                      std::abs(slope(gamma, k_theta)) + 1e-3 * gamma.value()));
  if (free) {
    const Ad s = reference_entropy(law, exact, strain_ad, theta);
    e.entropy = std::max(e.entropy, error(d.entropy, s, largest_slope(s), std::abs(slope(s, k_theta)) + 1));
  }
}

void check(LiquidModel liquid, Frozen frozen) {
  Random random(5);
  Errors e;
  // f_S = 1e-12, or 1e-6 where it varies: differentiating γ = f_S Φ/(η + f_S D) before f_S cancels loses
  // f_S,Θ/f_S = 2e4 of the digits, which the reference has to spare.
  const double almost_liquid = frozen.phase ? 930 - 5e-11 : 930 - 5e-5;
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const double n : {0.5, 1.0, 3.0, 8.0})
        for (const double eta : {0.0, 1e3, 1e7, 1e12}) {
          if (n < 1 && eta != 1e7) continue;
          FlowCase c{isotropic, kinematic, eta, n, liquid};
          const Material without = varying_material(c);
          c.heat_share = 0.9;
          const Material with_share = varying_material(c);
          for (const double temperature : {420.0, 650.0, 730.0, 880 + 5e-11, 905.0, almost_liquid, 945.0})
            for (const double size : {2e-4, 2e-3, 3e-2}) {
              // In what is all but liquid the plastic power cancels to nothing.
              const Viscoplastic law(n == 3 && temperature < 910 ? with_share : without);
              Errors one;
              compare(law, temperature, frozen, random_state(random), random_tensor(random, size),
                      decades(random, -2, 2), one);
              ASSERT_LT(std::max({one.stress, one.dissipation, one.gamma, one.entropy}), 1e-9)
                  << "isotropic " << static_cast<int>(isotropic) << " kinematic "
                  << static_cast<int>(kinematic) << " n " << n << " eta " << eta << " T " << temperature
                  << " strain " << size << " errors " << one.stress << ' ' << one.dissipation << ' '
                  << one.gamma << ' ' << one.entropy;
              e.plastic += one.plastic;
              e.elastic += one.elastic;
            }
        }
  EXPECT_GT(e.plastic, 500);
  EXPECT_GT(e.elastic, 300);
}

TEST(ThermalDerivatives, AreThoseOfTheUpdateWithAMaxwellLiquid) {
  check(LiquidModel::maxwell, {});
}
TEST(ThermalDerivatives, AreThoseOfTheUpdateWithAModifiedShearModulus) {
  check(LiquidModel::modified_shear, {});
}
TEST(ThermalDerivatives, AreThoseOfTheUpdateInTheDegeneratedModel) {
  check(LiquidModel::degenerated, {});
}
TEST(ThermalDerivatives, LeaveOutWhatIsFrozen) {
  for (const auto liquid : k_liquid) check(liquid, Frozen::dissipation());
  check(LiquidModel::maxwell, {true, false, false, false});
  check(LiquidModel::maxwell, {false, true, false, false});
}

TEST(ThermalDerivatives, OfFrozenPropertiesAreZeroAndTheOthersStay) {
  const Material m =
      varying_material({IsotropicHardening::saturation, KinematicHardening::armstrong_frederick, 1e6, 3});
  const Viscoplastic law(m);
  const auto all = thermal_properties(law, 905.0, k_start_temperature, {});
  const auto held = thermal_properties(law, 905.0, k_start_temperature, Frozen::dissipation());
  EXPECT_EQ(held.elastic.solid_fraction.d, 0);
  EXPECT_EQ(held.flow.flow_stress.d, 0);
  EXPECT_EQ(held.flow.rate[Perzyna::viscosity].d, 0);
  EXPECT_EQ(held.flow.recall[0].d, 0);
  EXPECT_NE(all.flow.flow_stress.d, 0);
  EXPECT_EQ(held.flow.hardening_origin.d, all.flow.hardening_origin.d);
  EXPECT_EQ(held.elastic.bulk.d, all.elastic.bulk.d);
  EXPECT_EQ(held.flow.flow_stress.v, all.flow.flow_stress.v);
  // the straining of solidification falls by 3 % over 50 K
  EXPECT_NEAR(all.elastic.thermal_strain.d - held.elastic.thermal_strain.d, 0.03 / 50, 1e-12);
}

/// W + M + K at the end of the update and its entropy, from the functions that know nothing of the update;
/// outside phase changes, with their fractions held.
struct Structural {
  Ad entropy, energy;
};
Structural reference_state(const Viscoplastic& law, const Viscoplastic::Response<Ad>& r,
                           const Sym<Ad>& strain, const Ad& theta) {
  const StateVariables<Ad> state{strain + Ad(-1.0) * (r.state.viscous_strain + r.state.plastic_strain),
                                 r.state.hardening, r.state.back_strain};
  const auto at = thermal_state<Ad>(law, state, theta, Ad(k_start_temperature));
  const auto sensible = sensible_heat<Ad>(law.material(), Ad(k_start_temperature), theta);
  return {at.entropy - sensible.entropy, at.internal_energy - sensible.heat};
}

TEST(StructuralPartials, AlongTheUpdateAreTheDerivativesOfEntropyAndEnergy) {
  Random random(11);
  int plastic = 0;
  for (const auto liquid : k_liquid)
    for (const auto isotropic : k_isotropic)
      for (const auto kinematic : k_kinematic)
        for (const double theta : {420.0, 650.0, 800.0})  // solid, between the changes
          for (const double size : {2e-4, 2e-3, 3e-2}) {
            Material m = varying_material({isotropic, kinematic, 1e7, 3.0, liquid});
            m.specific_heat_at =
                theta < 500 ? SpecificHeatAt::constant_strain : SpecificHeatAt::constant_pressure;
            const Viscoplastic law(m);
            const auto start = random_state(random);
            const auto strain = random_tensor(random, size);
            const auto p = thermal_properties(law, theta, k_start_temperature, Frozen{.phase = true});
            const auto r = law.update(law.properties_at(theta, k_start_temperature), start, strain, 0.5);
            const Variation<double> update(law, p, start, strain, 0.5, r);
            const Sym<double> elastic = dev(strain - r.state.viscous_strain - r.state.plastic_strain);
            const auto partials =
                structural_partials(law.material(), p.elastic, law.material().flow ? &p.flow : nullptr, theta,
                                    trace(strain), dot(elastic, elastic), true, r.state.hardening,
                                    dot(r.state.back_strain, r.state.back_strain));

            const Ad theta_ad(theta, 7, k_theta);
            Sym<Ad> strain_ad;
            for (int i = 0; i < 6; ++i) strain_ad[i] = Ad(strain[i], 7, i);
            const auto exact = law.update(law.properties_at(theta_ad, Ad(k_start_temperature)),
                                          convert<Ad>(start), strain_ad, 0.5);
            const Structural s = reference_state(law, exact, strain_ad, theta_ad);
            plastic += r.flow_increment > 0;
            EXPECT_LT(error(update.along(partials.entropy), s.entropy, largest_slope(s.entropy),
                            std::abs(slope(s.entropy, k_theta)) + 1),
                      1e-9);
            EXPECT_LT(error(update.along(partials.internal_energy), s.energy, largest_slope(s.energy),
                            std::abs(slope(s.energy, k_theta)) + 1e3),
                      1e-9);
          }
  EXPECT_GT(plastic, 50);
}

TEST(ThermalDerivatives, EntropyAndStressAreTheMixedDerivativesOfOnePotentialWhereDissipationIsFrozen) {
  // ∂S/∂ε = −∂σ/∂Θ along the update: the Maxwell relation of the incremental potential
  Random random(9);
  for (const auto liquid : k_liquid)
    for (const auto isotropic : k_isotropic) {
      const Material m = varying_material({isotropic, KinematicHardening::linear, 1e7, 3, liquid});
      const Viscoplastic law(m);
      for (const double theta : k_phases) {
        const auto start = random_state(random);
        const auto strain = random_tensor(random, 5e-3);
        const auto r = law.update(law.properties_at(theta, k_start_temperature), start, strain, 1.0);
        const auto d = thermal_derivatives(
            law, thermal_properties(law, theta, k_start_temperature, Frozen::dissipation()), start, strain,
            1.0, r);
        const double size = norm(d.stress);
        for (int i = 0; i < 6; ++i) EXPECT_NEAR(d.entropy.strain[i], -d.stress[i], 1e-12 * size);
      }
    }
}

}  // namespace
}  // namespace solidus::material::test
