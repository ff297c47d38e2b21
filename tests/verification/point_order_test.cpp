/// Order in the time step on a smooth viscoplastic path: uniaxial stress, strain a sine of time, saturation
/// hardening, Armstrong–Frederick back stress, overstress of power n = 3 (smooth where the flow begins).
/// Reference: the ordinary differential equations of the uniaxial test by a Runge–Kutta method of fourth
/// order, which shares nothing with the law:
///
///   σ = E (ε − p),  Φ = √⅔ (|σ − α| − σ_0 − K_ξ),  γ̇ = D/η (Φ/D)^n,  ṗ = √⅔ γ̇ sign(σ − α),
///   ξ̇ = √⅔ γ̇,  α̇ = K ṗ − r α ξ̇
#include <random>

#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"
#include "point_paths.hpp"

namespace solidus::verification {
namespace {

constexpr double k_end = 1, k_amplitude = 0.004;
constexpr double k_flow_stress = 40e6, k_saturation = 90e6, k_rate = 200, k_kin = 5e9, k_recall = 80;
constexpr double k_eta = 5e9, k_drag = 30e6;
constexpr double k_yield = 0.81649658092772603;  // √⅔

double strain_at(double t) {
  return k_amplitude * std::sin(5 * t);
}

material::Material sample() {
  material::Material m = point_material();
  material::Flow& f = m.flow.emplace();
  f.flow_stress = k_flow_stress;
  f.isotropic = material::IsotropicHardening::saturation;
  set_hardening(f, {{"saturation_stress", k_saturation}, {"saturation_rate", k_rate}});
  f.kinematic = material::KinematicHardening::armstrong_frederick;
  f.kinematic_modulus = k_kin;
  f.recall[0] = k_recall;
  f.rate[material::Perzyna::viscosity] = k_eta;
  f.rate[material::Perzyna::exponent] = 3;
  f.rate[material::Perzyna::drag_stress] = k_drag;
  return m;
}

struct Uniaxial {
  double plastic = 0, xi = 0, back = 0;
};
Uniaxial operator+(Uniaxial a, const Uniaxial& b) {
  return {a.plastic + b.plastic, a.xi + b.xi, a.back + b.back};
}
Uniaxial operator*(double s, const Uniaxial& a) {
  return {s * a.plastic, s * a.xi, s * a.back};
}

Uniaxial rate_of(const Uniaxial& u, double t) {
  const double relative = k_young * (strain_at(t) - u.plastic) - u.back;
  const double hardening = (k_saturation - k_flow_stress) * (1 - std::exp(-k_rate * u.xi));
  const double phi = k_yield * (std::abs(relative) - k_flow_stress - hardening);
  if (phi <= 0) return {};
  const double xi = k_yield * k_drag / k_eta * std::pow(phi / k_drag, 3);
  const double plastic = std::copysign(xi, relative);
  return {plastic, xi, k_kin * plastic - k_recall * u.back * xi};
}

Uniaxial reference() {
  const int n = 200000;
  const double h = k_end / n;
  Uniaxial u;
  for (int i = 0; i < n; ++i) {
    const double t = i * h;
    const Uniaxial a = rate_of(u, t), b = rate_of(u + 0.5 * h * a, t + 0.5 * h),
                   c = rate_of(u + 0.5 * h * b, t + 0.5 * h), d = rate_of(u + h * c, t + h);
    u = u + h / 6 * (a + 2 * b + 2 * c + d);
  }
  return u;
}

/// Sizes of n steps: equal, or each varied at random by up to a third; the same proportions are refined by
/// halving every step.
std::vector<double> sizes(int n, bool varied, int halvings) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> vary(-1.0 / 3, 1.0 / 3);
  std::vector<double> h;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += h.emplace_back(varied ? 1 + vary(random) : 1);
  std::vector<double> fine;
  const int parts = 1 << halvings;
  for (const double each : h)
    for (int k = 0; k < parts; ++k) fine.push_back(each / sum * k_end / parts);
  return fine;
}

/// |σ − reference| at the end.
double error(point::PointIntegration integration, const std::vector<double>& steps, const Uniaxial& exact) {
  const material::Material m = sample();
  MaterialPoint p(m, {300, 300, integration});
  point::Target target{};
  target.of.fill(Control::stress);
  target.of[0] = Control::strain;
  target.temperature = 300;
  double t = 0;
  for (const double dt : steps) {
    t += dt;
    target.value[0] = strain_at(t);
    const auto result = p.attempt(target, dt);
    EXPECT_TRUE(result.converged);
    p.accept(result);
  }
  return std::abs(p.state().stress[0] - k_young * (strain_at(k_end) - exact.plastic));
}

TEST(TimeIntegration, IsOfOrderOneAndTwoForEqualAndVaryingSteps) {
  const Uniaxial exact = reference();
  auto table = csv("point_time_order",
                   "step[s],backward_Euler[MPa],backward_Euler_varied[MPa],"
                   "two-step[MPa],two-step_varied[MPa]");
  std::vector<std::array<double, 4>> errors;
  for (int halvings = 0; halvings < 5; ++halvings) {
    errors.emplace_back();
    std::size_t k = 0;
    for (const auto integration :
         {point::PointIntegration::backward_euler, point::PointIntegration::two_step})
      for (const bool varied : {false, true})
        errors.back()[k++] = error(integration, sizes(100, varied, halvings), exact);
    table << 0.01 / (1 << halvings);
    for (const double e : errors.back()) table << "," << 1e-6 * e;
    table << "\n";
  }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(observed_order(errors[3][k], errors[4][k]), k < 2 ? 1 : 2, k < 2 ? 0.05 : 0.15) << k;
  EXPECT_LT(errors.back()[2], 1e-2 * errors.back()[0]);
}

TEST(NewtonOfThePoint, ConvergesQuadratically) {
  // One large step into flow; residuals r_{k+1} = c r_k^2: the exponent from three in a row.
  const material::Material m = sample();
  MaterialPoint p(m, {300, 300});
  point::Target target{};
  target.of.fill(Control::stress);
  target.of[0] = target.of[3] = Control::strain;
  target.temperature = 300;
  target.value[0] = 0.004;
  target.value[3] = 0.003;
  const auto result = p.attempt(target, 0.05);
  ASSERT_TRUE(result.converged);
  const std::vector<double>& r = result.residuals;
  ASSERT_GE(r.size(), 4u);
  auto table = csv("point_newton", "iteration,log10 of the missing stress in Pa");
  for (std::size_t i = 0; i < r.size(); ++i) table << i << "," << std::log10(r[i]) << "\n";
  double best = 0;
  for (std::size_t i = 2; i < r.size(); ++i)
    if (r[i] > 1e-4)  // above the rounding of the pressure
      best = std::log(r[i] / r[i - 1]) / std::log(r[i - 1] / r[i - 2]);
  EXPECT_NEAR(best, 2, 0.2);
}

}  // namespace
}  // namespace solidus::verification
