/// A viscoplastic solid under uniaxial stress (2.109b with exponent n and drag stress D). There the
/// overstress is Φ = √⅔ (σ − σ_0) and the plastic strain grows as ε̇^vp = √⅔ γ̇ with γ̇ = D/η (Φ/D)^n, so
///
///   steady flow at ε̇:  σ = σ_0 + √(3/2) D (η √(3/2) ε̇/D)^(1/n)
///   strain held:        ẋ = −c x^n,  x = Φ/D,  c = ⅔ E/η
///                       x = x_0 exp(−c t) for n = 1,  x^(1−n) = x_0^(1−n) + (n − 1) c t else
#include "material/laws/perzyna.hpp"
#include "point_paths.hpp"

namespace solidus::verification {
namespace {

constexpr double k_flow_stress = 50e6, k_drag = 20e6;
const double k_root = std::sqrt(2.0 / 3);

material::Material viscoplastic(double n, double eta) {
  material::Material m = point_material();
  m.flow.emplace();
  m.flow->flow_stress = k_flow_stress;
  m.flow->rate[material::Perzyna::viscosity] = eta;
  m.flow->rate[material::Perzyna::exponent] = n;
  m.flow->rate[material::Perzyna::drag_stress] = k_drag;
  return m;
}

const MaterialPoint::Options k_solid{500, 500};

TEST(PerzynaPoint, FlowsAtTheSteadyStressOfTheRateForExponentsAboveAndBelowOne) {
  auto table =
      csv("point_perzyna_overstress",
          "log10 of the strain rate in 1/s,exact_log10 of the overstress in MPa n=1,n=1,exact_n=3,n=3,"
          "exact_n=5,n=5,exact_n=0.5,n=0.5");
  const double eta = 5e8;
  for (const double power : {-3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.0}) {
    const double rate = std::pow(10, power);
    table << power;
    for (const double n : {1.0, 3.0, 5.0, 0.5}) {
      const double over = k_drag / k_root * std::pow(eta / k_root * rate / k_drag, 1 / n);
      // The transient falls by e within over/(n E).
      const double strain = (k_flow_stress + 30 * over / std::min(n, 1.0)) / k_young;
      // Where the overstress is small, most steps are elastic.
      const int steps = n < 1 ? 3000 : 300;
      const History h =
          run_all(viscoplastic(n, eta), k_solid, {segment(strain / rate, steps, {{0, strain_to(strain)}})});
      const MaterialPointRecord& last = h.records.back();
      // exp(-30) of the transient and Newton's tolerance are left
      EXPECT_NEAR(last.stress[0], k_flow_stress + over, 1e-8 * over) << "rate " << rate << ", n " << n;
      EXPECT_NEAR(last.plastic_power, last.stress[0] * rate, 1e-7 * last.plastic_power);
      table << "," << std::log10(1e-6 * over) << "," << std::log10(1e-6 * (last.stress[0] - k_flow_stress));
    }
    table << "\n";
  }
}

double exact_overstress(double n, double x0, double c, double t) {
  if (n == 1) return x0 * std::exp(-c * t);
  return std::pow(std::pow(x0, 1 - n) + (n - 1) * c * t, 1 / (1 - n));
}

struct Relaxation {
  double error;                                ///< largest, over the first overstress
  std::vector<double> times, exact, computed;  ///< overstress over D
};

/// @param unit_times  to the end, in 3 η/(2 E)
Relaxation relax(double n, point::PointIntegration integration, int steps, double unit_times = 4) {
  const double eta = 1e11, c = 2.0 / 3 * k_young / eta, x0 = 2, end = unit_times / c;
  const double strain = (k_flow_stress + k_drag * x0 / k_root) / k_young;
  MaterialPoint::Options options = k_solid;
  options.integration = integration;
  const History h =
      run_all(viscoplastic(n, eta), options,
              {segment(1e-9 / c, 1, {{0, strain_to(strain)}}), segment(end, steps, {{0, strain_held()}})});
  Relaxation r{};
  for (std::size_t i = 1; i < h.records.size(); ++i) {
    const double t = h.records[i].time;
    r.times.push_back(c * t);
    r.exact.push_back(exact_overstress(n, x0, c, t));
    r.computed.push_back(k_root * (h.records[i].stress[0] - k_flow_stress) / k_drag);
    r.error = std::max(r.error, std::abs(r.computed.back() - r.exact.back()) / x0);
  }
  return r;
}

TEST(PerzynaPoint, RelaxesAsTheClosedFormAtOrderOneAndTwo) {
  auto table = csv("point_perzyna_order",
                   "step / unit of time,backward_Euler_n=1,backward_Euler_n=3,"
                   "two-step_n=1,two-step_n=3");
  std::vector<std::array<double, 4>> errors;
  for (const int steps : {256, 512, 1024, 2048, 4096}) {
    errors.emplace_back();
    std::size_t k = 0;
    for (const auto integration :
         {point::PointIntegration::backward_euler, point::PointIntegration::two_step})
      for (const double n : {1.0, 3.0}) errors.back()[k++] = relax(n, integration, steps).error;
    table << 4.0 / steps;
    for (const double error : errors.back()) table << "," << error;
    table << "\n";
  }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(observed_order(errors[3][k], errors[4][k]), k < 2 ? 1 : 2, 0.1) << k;

  auto curve = csv("point_perzyna_relaxation", "time / (3 eta / 2 E),exact_n=1,n=1,exact_n=3,n=3");
  const Relaxation one = relax(1, point::PointIntegration::two_step, 40);
  const Relaxation three = relax(3, point::PointIntegration::two_step, 40);
  for (std::size_t i = 0; i < one.times.size(); ++i)
    curve << one.times[i] << "," << one.exact[i] << "," << one.computed[i] << "," << three.exact[i] << ","
          << three.computed[i] << "\n";
}

// With n = 1/2 the overstress falls as a parabola, and is gone after 2.83 units of time.
TEST(PerzynaPoint, RelaxesAsTheClosedFormWithAnExponentBelowOne) {
  for (const auto integration :
       {point::PointIntegration::backward_euler, point::PointIntegration::two_step}) {
    const double coarse = relax(0.5, integration, 1024, 2).error,
                 fine = relax(0.5, integration, 2048, 2).error;
    EXPECT_NEAR(observed_order(coarse, fine), integration == point::PointIntegration::backward_euler ? 1 : 2,
                0.1);
    EXPECT_LT(fine, 1e-3);
  }
}

TEST(PerzynaPoint, WithoutViscosityStaysOnTheYieldSurface) {
  material::Material m = viscoplastic(1, 0);
  const History h = run_all(m, k_solid, {segment(1, 20, {{0, strain_to(0.01)}})});
  EXPECT_NEAR(h.records.back().stress[0], k_flow_stress, 1e-9 * k_flow_stress);
}

}  // namespace
}  // namespace solidus::verification
