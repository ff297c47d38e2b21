/// A Maxwell point in the mushy zone, f_S = λ = 1/2 (2.50, 2.104): spring 2G/f_S and dashpot η/λ in the
/// deviator, the bulk elastic. In shear the relaxation time is τ = η f_S/(2Gλ). Under uniaxial stress
///
///   ε = σ/E* + ε^v,  1/E* = 1/(9k) + f_S/(3G),  ε̇^v = ⅔ λ/η σ
///   strain held:     σ = σ_0 exp(−t/τ_u),  τ_u = 3η/(2λE*)
///   stress held:     ε = σ/E* + ⅔ λ/η σ t
///   strain rate ε̇:   σ = 3η/(2λ) ε̇ (1 − exp(−t/τ_u))
#include "point_paths.hpp"

namespace solidus::verification {
namespace {

constexpr double k_fraction = 0.5, k_lambda = 0.5, k_eta = 5e10;
constexpr double k_tau = k_eta * k_fraction / (2 * k_shear_modulus * k_lambda);
constexpr double k_stiffness = 1 / (1 / (9 * k_bulk) + k_fraction / (3 * k_shear_modulus));
constexpr double k_tau_uniaxial = 3 * k_eta / (2 * k_lambda * k_stiffness);
constexpr double k_at_once = 1e-9;  // of a relaxation time: a jump
/// Relaxation during the jump, and the tolerance of the solution under stress.
constexpr double k_accuracy = 4e-9;

material::Material mush() {
  material::Material m = point_material();
  m.liquid_viscosity = k_eta;
  return m;
}

const MaterialPoint::Options k_mushy{850, 850};

TEST(MaxwellPoint, RelaxesInShearAsBackwardEulersOwnClosedForm) {
  const double strain = 1e-3, dt = 0.3 * k_tau;
  const History h = run_all(
      mush(), k_mushy,
      {segment(k_at_once * k_tau, 1, {{3, strain_to(strain)}}), segment(10 * dt, 10, {{3, strain_held()}})});
  for (int n = 0; n <= 10; ++n) {
    const double exact = 2 * k_shear_modulus / k_fraction * strain * std::pow(1 + dt / k_tau, -n);
    EXPECT_NEAR(h.records[static_cast<std::size_t>(n + 1)].stress[3], exact, k_accuracy * exact);
  }
}

TEST(MaxwellPoint, CreepsUnderHeldStressExactly) {
  const double stress = 1e6;
  const History h = run_all(mush(), k_mushy,
                            {segment(k_at_once * k_tau_uniaxial, 1, {{0, stress_to(stress)}}),
                             segment(k_tau_uniaxial, 7, {{0, {{}, Control::stress}}})});
  for (const MaterialPointRecord& r : h.records) {
    if (r.time == 0) continue;
    const double exact = stress / k_stiffness + 2.0 / 3 * k_lambda / k_eta * stress * r.time;
    EXPECT_NEAR(r.strain[0], exact, k_accuracy * exact);
    EXPECT_NEAR(r.strain[1], r.strain[2], 1e-12 * exact);
  }
}

/// The largest error of uniaxial relaxation over the first stress.
double relaxation_error(point::PointIntegration integration, int steps,
                        std::vector<double>* curve = nullptr) {
  const double strain = 1e-4, end = 4 * k_tau_uniaxial;
  MaterialPoint::Options options = k_mushy;
  options.integration = integration;
  const History h = run_all(mush(), options,
                            {segment(k_at_once * k_tau_uniaxial, 1, {{0, strain_to(strain)}}),
                             segment(end, steps, {{0, strain_held()}})});
  double worst = 0;
  for (std::size_t n = 1; n < h.records.size(); ++n) {
    const double share = h.records[n].stress[0] / (k_stiffness * strain);
    if (curve) curve->push_back(share);
    worst = std::max(worst, std::abs(share - std::exp(-h.records[n].time / k_tau_uniaxial)));
  }
  return worst;
}

TEST(MaxwellPoint, RelaxesUniaxiallyAtOrderOneAndTwo) {
  auto table = csv("point_maxwell_order", "step / relaxation time,backward_Euler,two-step");
  std::vector<double> euler, two_step;
  for (const int steps : {32, 64, 128, 256, 512}) {
    euler.push_back(relaxation_error(point::PointIntegration::backward_euler, steps));
    two_step.push_back(relaxation_error(point::PointIntegration::two_step, steps));
    table << 4.0 / steps << "," << euler.back() << "," << two_step.back() << "\n";
  }
  EXPECT_NEAR(observed_order(euler[3], euler[4]), 1, 0.05);
  EXPECT_NEAR(observed_order(two_step[3], two_step[4]), 2, 0.1);

  std::vector<double> coarse_euler, coarse_two_step;
  relaxation_error(point::PointIntegration::backward_euler, 16, &coarse_euler);
  relaxation_error(point::PointIntegration::two_step, 16, &coarse_two_step);
  auto curve = csv("point_maxwell_relaxation",
                   "time / relaxation time,exact_stress / first stress,backward_Euler,two-step");
  for (std::size_t n = 0; n < coarse_euler.size(); ++n)
    curve << 0.25 * static_cast<double>(n) << "," << std::exp(-0.25 * static_cast<double>(n)) << ","
          << coarse_euler[n] << "," << coarse_two_step[n] << "\n";
}

TEST(MaxwellPoint, TendsToTheDashpotsStressUnderAStrainRate) {
  const double rate = 1e-4 / k_tau_uniaxial, end = 20 * k_tau_uniaxial;
  const History h = run_all(mush(), k_mushy, {segment(end, 400, {{0, strain_rate(rate)}})});
  const double steady = 1.5 * k_eta / k_lambda * rate;
  // exp(−20) of the exponential is left after twenty relaxation times
  EXPECT_NEAR(h.records.back().stress[0], steady, 1e-7 * steady);
  for (const MaterialPointRecord& r : h.records)
    EXPECT_NEAR(r.stress[0], steady * (1 - std::exp(-r.time / k_tau_uniaxial)), 0.01 * steady);
  // all work of steady flow is dissipated
  EXPECT_NEAR(h.records.back().viscous_dissipation, steady * rate, 1e-6 * steady * rate);
}

}  // namespace
}  // namespace solidus::verification
