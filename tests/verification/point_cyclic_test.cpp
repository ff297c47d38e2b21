/// Strain cycles of a rate-independent solid under uniaxial stress.
///
/// Linear isotropic and kinematic hardening (H, K): on a branch of direction d = ±1 that starts at plastic
/// strain p_r and equivalent plastic strain ξ_r, the stress is E (ε − p) until d (σ − K p) = σ_0 + H ξ; from
/// there  p = p_r + d [d (E (ε − p_r) − K p_r) − σ_0 − H ξ_r]/(E + H + K).
///
/// Armstrong–Frederick (K, recall r): the back stress of the uniaxial test is α = 3/2 q_xx with
/// dα = K dp − r α |dp|, so it tends to K/r, and a stable cycle of the plastic range Δp has the amplitude
/// K/r tanh(r Δp/2).
#include "material/hardening.hpp"
#include "point_paths.hpp"

namespace solidus::verification {
namespace {

constexpr double k_flow_stress = 100e6, k_iso = 1e9, k_kin = 4e9;
const MaterialPoint::Options k_cold{300, 300};

material::Material combined() {
  material::Material m = point_material();
  m.flow.emplace();
  m.flow->flow_stress = k_flow_stress;
  m.flow->isotropic = material::IsotropicHardening::linear;
  set_hardening(*m.flow, {{"hardening_modulus", k_iso}});
  m.flow->kinematic = material::KinematicHardening::linear;
  m.flow->kinematic_modulus = k_kin;
  return m;
}

std::vector<Segment> cycles(double amplitude, int number, int steps) {
  std::vector<Segment> s = {segment(1, steps, {{0, strain_to(amplitude)}})};
  for (int i = 0; i < number; ++i)
    for (const double target : {-amplitude, amplitude})
      s.push_back(segment(2, 2 * steps, {{0, strain_to(target)}}));
  return s;
}

TEST(CyclicPoint, FollowsTheClosedFormOfCombinedHardeningForAnyStep) {
  for (const int steps : {3, 40}) {
    const History h = run_all(combined(), k_cold, cycles(0.01, 3, steps));
    double p_start = 0, xi_start = 0, p = 0, xi = 0, previous = 0, direction = 1;
    auto table = csv("point_cyclic_combined", "strain[%],exact_stress[MPa],stress[MPa]");
    for (const MaterialPointRecord& r : h.records) {
      const double strain = r.strain[0];
      if ((strain - previous) * direction < 0) direction = -direction, p_start = p, xi_start = xi;
      previous = strain;
      const double beyond =
          direction * (k_young * (strain - p_start) - k_kin * p_start) - k_flow_stress - k_iso * xi_start;
      const double flow = std::max(0.0, beyond / (k_young + k_iso + k_kin));
      p = p_start + direction * flow;
      xi = xi_start + flow;
      EXPECT_NEAR(r.stress[0], k_young * (strain - p), 1e-9 * k_flow_stress);
      EXPECT_NEAR(r.plastic_strain[0], p, 1e-12);
      EXPECT_NEAR(r.equivalent_plastic, xi, 1e-11);
      EXPECT_NEAR(1.5 * r.back_stress[0], k_kin * p, 1e-9 * k_flow_stress);
      table << 100 * strain << "," << 1e-6 * k_young * (strain - p) << "," << 1e-6 * r.stress[0] << "\n";
    }
  }
}

TEST(CyclicPoint, StoresAndDissipatesTheWorkThatItTakes) {
  const History h = run_all(combined(), k_cold, cycles(0.01, 2, 400));
  const MaterialPointRecord& last = h.records.back();
  const double elastic = 0.5 * last.stress[0] * last.stress[0] / k_young;
  const double stored = elastic + last.isotropic_energy + last.kinematic_energy;
  // the sum of rates at the ends of steps is of first order
  EXPECT_NEAR(last.work, stored + last.dissipated, 1e-3 * last.work);
  EXPECT_NEAR(last.isotropic_energy, 0.5 * k_iso * last.equivalent_plastic * last.equivalent_plastic,
              1e-9 * last.isotropic_energy);
}

constexpr double k_recall = 60;
constexpr double k_limit = k_kin / k_recall;

material::Material armstrong_frederick() {
  material::Material m = combined();
  m.flow->isotropic = material::IsotropicHardening::none;
  m.flow->kinematic = material::KinematicHardening::armstrong_frederick;
  m.flow->recall[0] = k_recall;
  return m;
}

TEST(CyclicPoint, BackStressOfArmstrongFrederickSaturates) {
  auto table = csv("point_armstrong_frederick_order", "strain step,error of the back stress / limit");
  std::vector<double> errors;
  for (const int steps : {100, 200, 400}) {
    const History h = run_all(armstrong_frederick(), k_cold, {segment(1, steps, {{0, strain_to(0.2)}})});
    double worst = 0;
    for (const MaterialPointRecord& r : h.records)
      worst = std::max(worst, std::abs(1.5 * r.back_stress[0] / k_limit -
                                       (1 - std::exp(-k_recall * r.plastic_strain[0]))));
    errors.push_back(worst);
    table << 0.2 / steps << "," << worst << "\n";
    // exp(−12) of the exponential, and first order of what is left, remain at a strain of 20 %
    EXPECT_NEAR(h.records.back().stress[0], k_flow_stress + k_limit, 1e-4 * k_limit);
  }
  EXPECT_NEAR(observed_order(errors[1], errors[2]), 1, 0.1);
}

TEST(CyclicPoint, StableLoopOfArmstrongFrederickHasTheAmplitudeOfTheClosedForm) {
  std::vector<double> errors;
  for (const int steps : {100, 200}) {
    const History h = run_all(armstrong_frederick(), k_cold, cycles(0.01, 8, steps));
    const std::size_t n = h.records.size(), branch = static_cast<std::size_t>(2 * steps);
    const MaterialPointRecord &up = h.records[n - 1], &down = h.records[n - 1 - branch];
    const double range = up.plastic_strain[0] - down.plastic_strain[0];
    const double amplitude = k_limit * std::tanh(0.5 * k_recall * range);
    EXPECT_NEAR(up.stress[0], -down.stress[0], 1e-5 * up.stress[0]);  // closed and symmetric
    errors.push_back(std::abs(up.stress[0] - k_flow_stress - amplitude) / amplitude);
    auto table = csv("point_armstrong_frederick_loop", "strain[%],stress[MPa],back_stress[MPa]");
    for (const MaterialPointRecord& r : h.records)
      table << 100 * r.strain[0] << "," << 1e-6 * r.stress[0] << "," << 1.5e-6 * r.back_stress[0] << "\n";
  }
  EXPECT_LT(errors[1], 2e-3);
  EXPECT_NEAR(observed_order(errors[0], errors[1]), 1, 0.2);
}

}  // namespace
}  // namespace solidus::verification
