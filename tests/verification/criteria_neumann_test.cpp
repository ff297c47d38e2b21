/// Criteria at the front of Neumann's half-space against its similarity solution (analytic/stefan.hpp).
///
/// An isotherm lies at X = 2 ξ √t: a node at x is passed at t = x²/(4 ξ²) by a front with the speed
/// v = ξ/√t = 2 ξ²/x; the gradient G there follows from the solution, and the cooling rate is G v.
#include <gtest/gtest.h>

#include <cmath>

#include "analytic/stefan.hpp"
#include "csv.hpp"
#include "freezing_run.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

using analytic::Stefan;

constexpr double k_length = 0.2, k_time = 10.0;

struct Exact {
  double xi, gradient_by_root;  ///< ξ of the isotherm; G √t

  // On the cold side of the isotherm, where a pure metal has its gradient.
  explicit Exact(const Stefan& s, double level) {
    const auto [xi_s, xi_l] = s.fronts();
    double low = 0, high = xi_l;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (s.temperature(2 * middle, 1) < level ? low : high) = middle;
    }
    xi = s.solidus == s.liquidus ? xi_s : high;
    constexpr double k_small = 1e-6;
    gradient_by_root =
        (s.temperature(2 * xi * (1 - k_small), 1) - s.temperature(2 * xi * (1 - 2 * k_small), 1)) /
        (2 * xi * k_small);
  }
  double time(double x) const { return x * x / (4 * xi * xi); }
  double speed(double x) const { return 2 * xi * xi / x; }
  double gradient(double x) const { return gradient_by_root / std::sqrt(time(x)); }
  double rate(double x) const { return gradient(x) * speed(x); }
};

struct Errors {  ///< root mean squares of relative errors
  double time = 0, gradient = 0, rate = 0, speed = 0, freezing_time = 0;
};

Errors run(double range, double superheat, int n, const std::string& file = {}) {
  const Stefan s({100.0, 2.5e6, 1e9, 400.0, 900.0 - range, 900.0, 900.0 + superheat});
  const double share = 0.1;  // of the freezing range: the default of the criteria
  const Exact exact(s, s.solidus + share * range);
  const mesh::Mesh mesh = verification::strip(mesh::Shape::quad4, k_length, n);
  heat::ThermalConditions conditions;
  conditions.temperatures.push_back({"wall", "x_min", Table(s.wall)});
  verification::Fields fields =
      verification::freeze(mesh, AnalysisKind::plane_strain, {verification::light_metal(100, range)},
                           conditions, {s.start}, k_time, k_time / n);
  std::ofstream table;
  if (!file.empty())
    table = verification::csv(file, "x[mm],gradient[1],cooling_rate[1],front_speed[1],exact[1]");
  Errors errors;
  int count = 0;
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    const double x = mesh.x[i][0], at = fields["solidified_at"][i];
    // From a tenth of the final front on, up to where the solidus has left the last elements behind.
    if (at < 0 || x < 0.1 * s.front(exact.xi, k_time) || x > 0.85 * s.front(s.fronts().first, k_time))
      continue;
    const auto square = [](double a) { return a * a; };
    const auto [xi_s, xi_l] = s.fronts();
    const double frozen = x * x / (4 * xi_s * xi_s);
    errors.time += square(at / frozen - 1);
    errors.gradient += square(fields["thermal_gradient"][i] / exact.gradient(x) - 1);
    errors.rate += square(fields["cooling_rate"][i] / exact.rate(x) - 1);
    errors.speed += square(fields["front_speed"][i] / exact.speed(x) - 1);
    if (range > 0)
      errors.freezing_time +=
          square(fields["local_solidification_time"][i] / (frozen - x * x / (4 * xi_l * xi_l)) - 1);
    ++count;
    if (!file.empty() && mesh.x[i][1] == 0)
      table << 1e3 * x << ',' << fields["thermal_gradient"][i] / exact.gradient(x) << ','
            << fields["cooling_rate"][i] / exact.rate(x) << ',' << fields["front_speed"][i] / exact.speed(x)
            << ",1\n";
  }
  for (double Errors::*e :
       {&Errors::time, &Errors::gradient, &Errors::rate, &Errors::speed, &Errors::freezing_time})
    errors.*e = std::sqrt(errors.*e / count);
  return errors;
}

struct Variant {
  const char* name;
  double range, superheat;
};

class CriteriaAtNeumannsFront : public testing::TestWithParam<Variant> {};

TEST_P(CriteriaAtNeumannsFront, ConvergeToTheSimilaritySolution) {
  const auto [name, range, superheat] = GetParam();
  std::ofstream table = verification::csv(std::string("criteria_neumann_order_") + name,
                                          "h[mm],time[1],gradient[1],rate[1],speed[1],freezing_time[1]");
  std::vector<Errors> results;
  for (const int n : {50, 100, 200, 400}) {
    results.push_back(
        run(range, superheat, n, n == 200 ? std::string("criteria_neumann_") + name : std::string()));
    const Errors& e = results.back();
    table << 1e3 * k_length / n << ',' << e.time << ',' << e.gradient << ',' << e.rate << ',' << e.speed
          << ',' << e.freezing_time << '\n';
  }
  const auto rate = [&](double Errors::*error) {
    return std::log2(results[0].*error / (results[3].*error)) / 3;
  };
  // Times and speeds follow the nodes that the front passes one by one: first order, a little less at the
  // wall.
  EXPECT_LE(results[3].time, 0.08);
  EXPECT_LE(results[3].speed, 0.04);
  EXPECT_GE(rate(&Errors::time), 0.6);
  EXPECT_GE(rate(&Errors::speed), 0.5);
  // The gradient behind a front swings as it steps over a node; its mean over the passage scatters about the
  // exact one by some per cent, whatever the size of the elements.
  for (const std::size_t k : {1U, 2U, 3U}) {
    EXPECT_LE(results[k].gradient, 0.10);
    EXPECT_LE(results[k].rate, 0.13);
  }
  if (range > 0) {
    // The liquidus and the solidus pass a node one after the other when it has the whole range in its cell.
    EXPECT_LE(results[3].freezing_time, 0.2);
    EXPECT_GE(rate(&Errors::freezing_time), 0.8);
  }
}

INSTANTIATE_TEST_SUITE_P(Criteria, CriteriaAtNeumannsFront,
                         testing::Values(Variant{"isothermal_one_phase", 0, 0},
                                         Variant{"isothermal_two_phase", 0, 60}, Variant{"range_40", 40, 60}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace solidus
