/// The energy that is stored with a Taylor–Quinney factor: K + ⅓ K ζ:ζ + χ = ∫(1 − β) s : dε^vp.
#include <gtest/gtest.h>

#include "material/hardening_heat.hpp"
#include "thermal_cases.hpp"

namespace solidus::material::test {
namespace {

/// K + ⅓ K ζ:ζ + χ [J/m³].
double stored(const Viscoplastic& law, const Viscoplastic::Properties<double>& p,
              const Viscoplastic::State<double>& state) {
  return hardening_potential<double>(*law.material().flow, p.flow, state.hardening,
                                     dot(state.back_strain, state.back_strain)) +
         state.cold_work;
}

// Every law of hardening, liquid and rate, and steps from elastic ones to strains of several per cent that go
// to and fro.
TEST(ColdWork, AndHardeningStoreThePlasticWorkThatIsNoHeatWhateverTheStep) {
  Random random(41);
  int plastic = 0, below_hardening = 0;
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const auto liquid : k_liquid)
        for (const double n : {0.5, 1.0, 4.0})
          for (const double share : {0.0, 0.3, 0.9, 1.0}) {
            FlowCase c{isotropic, kinematic, 1e7, n, liquid};
            c.heat_share = share;
            const Material m = varying_material(c);
            const Viscoplastic law(m);
            const auto p = law.properties_at(k_phases[plastic % 5], k_start_temperature);
            Viscoplastic::State<double> state{};
            Sym<double> strain;
            double kept = 0, exchanged = 0;  // ∫(1 − β) s : dε^vp, ∫|s : dε^vp|
            for (int i = 0; i < 12; ++i) {
              strain += random_tensor(random, decades(random, -4, -1.5));
              const double dt = decades(random, -3, 2);
              const auto r = law.update(p, state, strain, dt);
              ASSERT_EQ(r.status, Status::converged);
              const double work = dt * r.plastic_power, heat = p.flow.heat_share * std::max(work, 0.0);
              EXPECT_NEAR(dt * r.plastic_dissipation, heat, 1e-12 * heat);
              // No more than the work of the stress at the end of the step: hardening is convex.
              const Sym<double> flow = r.state.plastic_strain - state.plastic_strain;
              EXPECT_LE(work, dot(dev(r.stress), flow) + 1e-9 * std::abs(work));
              kept += work - heat;
              exchanged += std::abs(work);
              plastic += r.flow_increment > 0;
              state = r.state;
            }
            EXPECT_NEAR(stored(law, p, state), kept, 1e-10 * exchanged)
                << static_cast<int>(isotropic) << ' ' << static_cast<int>(kinematic) << ' '
                << static_cast<int>(liquid) << ' ' << n << ' ' << share;
            below_hardening += state.cold_work < 0;
          }
  EXPECT_GT(plastic, 4000);
  EXPECT_GT(below_hardening, 20);  // hardening stores more than the factor leaves
}

// Sheared along a line, without rate dependence, the stress is on the yield surface: its work is
// ∫(σ_0 + K_ξ) dξ + ⅓ K ζ:ζ in one step and in many.
TEST(ColdWork, AndHardeningStoreAShareOfTheIntegralOfTheStressInAnyNumberOfSteps) {
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : {KinematicHardening::none, KinematicHardening::linear})
      for (const int steps : {1, 3, 40}) {
        FlowCase c{isotropic, kinematic};
        c.heat_share = 0.9;
        const Material m = flow_material(c);
        const Viscoplastic law(m);
        const auto p = law.properties_at(420.0, 420.0);
        Viscoplastic::State<double> state{};
        double heat = 0;
        for (int i = 1; i <= steps; ++i) {
          Sym<double> strain;
          strain[3] = 0.02 * i / steps;
          const auto r = law.update(p, state, strain, 1.0);
          heat += r.plastic_dissipation;
          state = r.state;
        }
        constexpr int n = 20000;  // intervals of the trapezium rule
        const double h = state.hardening / n;
        double work = p.flow.kinematic_modulus / 3 * dot(state.back_strain, state.back_strain);
        for (int i = 0; i <= n; ++i)
          work += (i % n == 0 ? 0.5 : 1.0) * h *
                  (p.flow.flow_stress +
                   hardening_stress<double>(isotropic, m.flow->curves, p.flow, i * h).stress);
        EXPECT_GT(state.hardening, 0.01);
        EXPECT_NEAR(heat, 0.9 * work, 1e-5 * work) << static_cast<int>(isotropic) << ' ' << steps;
        EXPECT_NEAR(stored(law, p, state), 0.1 * work, 1e-5 * work)
            << static_cast<int>(isotropic) << ' ' << static_cast<int>(kinematic) << ' ' << steps;
      }
}

/// A shear that grows steadily from where it yields, held at a temperature, in `steps` steps of the two-step
/// method.
/// @return the state, and ∫(1 − β) s : dε^vp by the same method
std::pair<Viscoplastic::State<double>, double> sheared(const Viscoplastic& law,
                                                       const Viscoplastic::Properties<double>& p, int steps) {
  Viscoplastic::State<double> now{}, before{};
  double kept = 0, kept_before = 0;
  const double dt = 1.0 / steps, yields = p.flow.flow_stress / (std::sqrt(3.0) * 2 * p.elastic.shear);
  for (int i = 1; i <= steps; ++i) {
    const TimeStep step = i == 1 ? TimeStep::backward_euler(dt) : TimeStep::two_step(dt, dt);
    Sym<double> strain;
    strain[3] = yields + 0.02 * i * dt;
    const auto r = law.update(p, start_state(step, now, before), strain, step);
    EXPECT_EQ(r.status, Status::converged);
    const double next =
        step.now * kept + step.before * kept_before + step.dt * (r.plastic_power - r.plastic_dissipation);
    kept_before = kept;
    kept = next;
    before = now;
    now = r.state;
  }
  return {now, kept};
}

TEST(ColdWork, IsOfSecondOrderWithTheTwoStepMethod) {
  FlowCase c{IsotropicHardening::saturation, KinematicHardening::armstrong_frederick};
  c.heat_share = 0.9;
  const Material m = varying_material(c);
  const Viscoplastic law(m);
  const auto p = law.properties_at(420.0, k_start_temperature);
  double last = 0;
  for (const int steps : {80, 160, 320}) {
    const auto [state, kept] = sheared(law, p, steps);
    const double error = std::abs(stored(law, p, state) - kept);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.3) << steps;
    }
    last = error;
    EXPECT_LT(error, 0.01 * kept);
  }
}

// Perfectly plastic metal flows steadily: each method integrates a constant rate exactly, S^I and χ as the
// strain itself.
TEST(ColdWork, AndInelasticEntropyGrowAsTheStrainDoesInTheTwoStepMethod) {
  FlowCase c;
  c.heat_share = 0.6;
  const Material m = flow_material(c);
  const Viscoplastic law(m);
  const auto p = law.properties_at(420.0, 420.0);
  const double strength = m.flow->flow_stress.value(420);
  const auto [state, kept] = sheared(law, p, 50);
  EXPECT_GT(state.hardening, 0.01);
  EXPECT_NEAR(state.inelastic_entropy, state.hardening * 1e5, 1e-9 * state.inelastic_entropy);
  EXPECT_NEAR(state.cold_work, 0.4 * strength * state.hardening, 1e-9 * state.cold_work);
  EXPECT_NEAR(state.cold_work, kept, 1e-9 * kept);
  EXPECT_NEAR(norm(state.plastic_strain), std::sqrt(1.5) * state.hardening, 1e-9);
}

}  // namespace
}  // namespace solidus::material::test
