/// Freezing of a half-space (Neumann–Stefan): front and temperatures against the similarity solution.
#include <gtest/gtest.h>

#include <cmath>

#include "analytic/stefan.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

using analytic::Stefan;

// A metal like aluminium with rounded numbers; the strip is long enough for its end to stay at the start
// temperature.
constexpr double k_length = 0.2, k_time = 10.0;

Stefan problem(double range, double superheat) {
  return Stefan({100.0, 2.5e6, 1e9, 400.0, 930.0 - range, 930.0, 930.0 + superheat});
}

material::Material material_of(const Stefan& s) {
  material::Material m;
  m.name = "metal";
  m.density = 2500;
  m.conductivity = Table(s.conductivity);
  m.specific_heat = Table(s.capacity / m.density);
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(s.solidus, s.liquidus),
                      s.latent / m.density, 0.0, true}};
  return m;
}

struct Result {
  double front_error = 0;        ///< of the frozen volume, relative, at the end
  double worst_front_error = 0;  ///< from a tenth of the time on
  double temperature_error = 0;  ///< L2, over the range of temperatures
};

Result run(const Stefan& exact, mesh::Shape shape, int n, int steps, heat::HeatIntegration rule,
           const std::string& file = {}) {
  const mesh::Mesh mesh = verification::strip(shape, k_length, n);
  heat::ThermalConditions conditions;
  conditions.temperatures.push_back({"wall", "x_min", Table(exact.wall)});
  heat::HeatOptions options;
  options.integration = rule;
  heat::ThermalPhase phase(mesh,
                           verification::is_3d(shape) ? AnalysisKind::solid : AnalysisKind::plane_strain,
                           {material_of(exact)}, conditions, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{exact.start});
  std::ofstream out;
  if (!file.empty()) out = verification::csv(file, "time[s],frozen[mm],exact[mm]");
  Result result;
  const double dt = k_time / steps;
  for (int i = 1; i <= steps; ++i) {
    phase.solve(state, state, i * dt, dt);
    const double frozen = k_length * phase.states().mean_solid_fraction(state, 0),
                 expected = exact.frozen(i * dt);
    if (!file.empty()) out << i * dt << ',' << 1e3 * frozen << ',' << 1e3 * expected << '\n';
    result.front_error = std::abs(frozen / expected - 1);
    if (10 * i >= steps) result.worst_front_error = std::max(result.worst_front_error, result.front_error);
  }
  result.temperature_error =
      verification::l2_error(mesh, AnalysisKind::plane_strain, state.temperature,
                             [&](const mesh::Point& x) { return exact.temperature(x[0], k_time); }) /
      (exact.start - exact.wall);
  return result;
}

struct Variant {
  const char* name;
  double range, superheat;
};

class StefanProblem : public testing::TestWithParam<Variant> {};

TEST_P(StefanProblem, FindsTheFrontWithinOneAndAHalfPerCentAndAtFirstOrder) {
  const auto [name, range, superheat] = GetParam();
  const Stefan exact = problem(range, superheat);
  std::ofstream table =
      verification::csv(std::string("stefan_order_") + name, "h[mm],front_error[1],temperature_error[1]");
  std::vector<Result> results;
  for (const int n : {50, 100, 200, 400}) {
    // h and Δt fall together: both errors are of first order.
    results.push_back(run(exact, mesh::Shape::quad4, n, n, heat::HeatIntegration::closed,
                          n == 200 ? std::string("stefan_front_") + name : ""));
    table << 1e3 * k_length / n << ',' << results.back().front_error << ','
          << results.back().temperature_error << '\n';
  }
  EXPECT_LE(results[2].worst_front_error, 0.015);
  // Fronts and temperatures step from node to node, so single ratios scatter about the first order.
  const auto rate = [&](double Result::*error) {
    return std::log2(results[0].*error / (results[3].*error)) / 3;
  };
  EXPECT_GE(rate(&Result::temperature_error), 0.7);
  EXPECT_LE(rate(&Result::temperature_error), 1.7);
  EXPECT_GE(rate(&Result::worst_front_error), 0.7);
  EXPECT_LE(rate(&Result::worst_front_error), 1.7);
}

INSTANTIATE_TEST_SUITE_P(Freezing, StefanProblem,
                         testing::Values(Variant{"isothermal_one_phase", 0, 0},
                                         Variant{"isothermal_two_phase", 0, 60}, Variant{"range_40", 40, 60}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(StefanProblem, IsSolvedByEveryShapeAndBothRules) {
  const Stefan exact = problem(40, 60);
  using mesh::Shape;
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet4, Shape::tet10,
                            Shape::hex8, Shape::hex20})
    for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open}) {
      const Result result = run(exact, shape, 100, 100, rule);
      EXPECT_LE(result.front_error, 0.015) << mesh::name(shape);
    }
}

TEST(StefanProblem, IsSolvedByTheOpenRuleWithTheHeatOfAnIsothermalChangeAtTheNodes) {
  const Result result = run(problem(0, 60), mesh::Shape::quad4, 100, 100, heat::HeatIntegration::open);
  printf("open isothermal %.3e %.3e\n", result.front_error, result.temperature_error);
  EXPECT_LE(result.front_error, 0.008);
}

}  // namespace
}  // namespace solidus
