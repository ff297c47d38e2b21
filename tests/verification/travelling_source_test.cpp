/// Sources that travel over plates against closed forms: Rosenthal's and, for sources of some size, the
/// superposition of the heat of every moment.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "heat/loads/travelling_heat.hpp"
#include "numbers/types.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

constexpr double k_pi = std::numbers::pi;

/// A normal distribution of the deviation σ in d dimensions that travels along x from t = 0 on in a body that
/// is infinite in d dimensions: T − T_0 = Q/(ρ c) ∫ (2 π s)^(−d/2) exp(−|x − c(τ)|²/(2 s)) dτ,
/// s = σ² + 2 α (t − τ).
struct Moving {
  double power = 0, conductivity = 40, capacity = 4e6, speed = 0, sigma = 0;
  int dimensions = 3;
  double diffusivity() const { return conductivity / capacity; }
  double temperature(double time, double behind_start, double beside) const {
    // Simpson's rule in the root of the age, which takes the peak at young ages apart.
    constexpr int k_n = 2000;
    const double last = std::sqrt(time);
    double sum = 0;
    for (int i = 0; i <= k_n; ++i) {
      const double root = last * i / k_n, age = root * root, s = sigma * sigma + 2 * diffusivity() * age;
      const double along = behind_start - speed * (time - age);
      const double f = std::pow(2 * k_pi * s, -0.5 * dimensions) *
                       std::exp(-(along * along + beside * beside) / (2 * s)) * 2 * root;
      sum += (i == 0 || i == k_n ? 1 : i % 2 == 1 ? 4 : 2) * f;
    }
    return power / capacity * sum * last / (3 * k_n);
  }
};

/// Rosenthal 1946: a point on an infinite body takes its power in all directions.
double rosenthal_thick(const Moving& m, double xi, double distance) {
  const double a = m.speed / (2 * m.diffusivity());
  return m.power / (4 * k_pi * m.conductivity * distance) * std::exp(-a * (xi + distance));
}
double rosenthal_thin(const Moving& m, double xi, double distance) {
  const double a = m.speed / (2 * m.diffusivity());
  return m.power / (2 * k_pi * m.conductivity) * std::exp(-a * xi) * std::cyl_bessel_k(0.0, a * distance);
}

/// The closed form that the computations below are compared with is Rosenthal's, two radii from a slow and
/// small source in the steady state.
TEST(Rosenthal, IsTheLimitOfASmallSourceThatHasTravelledFar) {
  const double radius = 2e-3;
  for (const int dimensions : {2, 3}) {
    const Moving m{.power = 1000, .speed = 5e-4, .sigma = radius / std::sqrt(6.0), .dimensions = dimensions};
    const double time = 4000, there = m.speed * time;
    for (const double angle : {0.0, 0.5, 1.0}) {
      const double xi = 2 * radius * std::cos(k_pi * angle), y = 2 * radius * std::sin(k_pi * angle);
      const double exact =
          dimensions == 3 ? rosenthal_thick(m, xi, 2 * radius) : rosenthal_thin(m, xi, 2 * radius);
      EXPECT_NEAR(m.temperature(time, there + xi, y) / exact, 1, 0.01) << dimensions << ' ' << angle;
    }
  }
}

struct Plate {
  double length, width, depth;
  std::vector<int> divisions;
};

/// Temperatures around a source on the edge y = 0 (and, in space, z = depth) of a plate, which is half of a
/// body twice as wide (a quarter of one twice as thick): the body is long and wide enough to be infinite for
/// as long as the source runs.
heat::ThermalState run(const Plate& plate, const mesh::Mesh& mesh, const Moving& m, double radius,
                       double start, double time, int steps) {
  const bool solid = plate.divisions.size() == 3;
  const double z = solid ? plate.depth : 0;
  const auto path = std::make_shared<TravelPath>(
      std::vector<TravelPoint>{{0, {start, 0, z}, 1}, {2 * time, {start + 2 * time * m.speed, 0, z}, 0}});
  heat::TravellingShape shape;
  shape.kind = solid ? heat::TravellingShape::Kind::double_ellipsoid : heat::TravellingShape::Kind::line;
  shape.radius = shape.width = shape.front = shape.rear = radius;
  shape.depth = solid ? radius : 1.0;  // of a plate of one metre: all of its thickness is heated
  heat::ThermalConditions conditions;
  conditions.sources = {{"torch", "block",
                         PlaceFunction(std::make_shared<heat::TravellingHeat>(path, shape, Table(1.0), 0.5)),
                         solid ? m.power / 2 : m.power}};
  material::Material metal;
  metal.name = "metal";
  metal.density = 4000;
  metal.conductivity = Table(m.conductivity);
  metal.specific_heat = Table(m.capacity / metal.density);
  heat::HeatOptions options;
  options.stepping = heat::ThermalStepping::sdirk2;
  heat::ThermalPhase phase(mesh, solid ? AnalysisKind::solid : AnalysisKind::plane_strain, {metal},
                           conditions, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{300.0});
  double brought = 0;
  for (int i = 1; i <= steps; ++i) {
    const double dt = time / steps;
    const heat::ThermalReport report =
        phase.solve(state, state, {.time = i * dt, .dt = dt, .stepping = heat::ThermalStepping::sdirk2});
    brought += report.balance.conditions[0].heat;
  }
  // Half of the plane source, a half of the power of half the space (a quarter of the space) arrive.
  EXPECT_NEAR(brought, time * m.power / (solid ? 4 : 2), 2e-3 * time * m.power / (solid ? 4 : 2));
  return state;
}

/// The largest relative error at nodes about two radii from the source.
double error_at_two_radii(const mesh::Mesh& mesh, const heat::ThermalState& state, const Moving& m,
                          double radius, double start, double time, double z) {
  double worst = 0;
  int seen = 0;
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    const mesh::Point& x = mesh.x[i];
    const double beside = std::hypot(x[1], x[2] - z), along = x[0] - start - m.speed * time;
    if (std::abs(std::hypot(along, beside) - 2 * radius) > 0.15 * radius) continue;
    const double exact = m.temperature(time, x[0] - start, beside);
    worst = std::max(worst, std::abs(state.temperature[i] - 300 - exact) / exact);
    ++seen;
  }
  EXPECT_GT(seen, 10);
  return worst;
}

/// Half the width of the isotherm of a rise, across the source on the surface: along y from the nodes on the
/// edge where it is widest.
double half_width(const std::function<double(double x, double y)>& rise, double isotherm, double from,
                  double to, double widest) {
  double width = 0;
  for (int i = 0; i <= 200; ++i) {
    const double x = from + (to - from) * i / 200;
    double low = 0, high = widest;
    if (rise(x, 0) < isotherm) continue;
    for (int k = 0; k < 40; ++k) {
      const double y = 0.5 * (low + high);
      (rise(x, y) > isotherm ? low : high) = y;
    }
    width = std::max(width, low);
  }
  return width;
}

/// Linear between the nodes of a row of equal squares.
double interpolated(const heat::ThermalState& state, const std::function<std::size_t(int, int)>& node,
                    double h, double x, double y) {
  const int i = static_cast<int>(x / h), j = static_cast<int>(y / h);
  const double a = x / h - i, b = y / h - j;
  const auto t = [&](int p, int q) { return state.temperature[node(i + p, j + q)] - 300; };
  return (1 - a) * ((1 - b) * t(0, 0) + b * t(0, 1)) + a * ((1 - b) * t(1, 0) + b * t(1, 1));
}

class Plates : public ::testing::TestWithParam<int> {};

TEST_P(Plates, HaveTheTemperaturesAndTheWidthOfTheClosedForm) {
  const bool solid = GetParam() == 3;
  const double radius = 3e-3, start = 12e-3, time = 6, h = solid ? 1.5e-3 : 0.75e-3;
  const Plate plate = solid ? Plate{45e-3, 15e-3, 15e-3, {30, 10, 10}} : Plate{60e-3, 24e-3, 0, {80, 32}};
  const Moving m{.power = solid ? 2000.0 : 2e5,
                 .speed = 3e-3,
                 .sigma = radius / std::sqrt(6.0),
                 .dimensions = GetParam()};
  const mesh::Mesh mesh = verification::block(
      solid ? mesh::Shape::hex8 : mesh::Shape::quad4,
      solid ? std::vector{plate.length, plate.width, plate.depth} : std::vector{plate.length, plate.width},
      plate.divisions);
  const heat::ThermalState state = run(plate, mesh, m, radius, start, time, solid ? 20 : 80);
  const double error = error_at_two_radii(mesh, state, m, radius, start, time, solid ? plate.depth : 0);

  // The isotherm of a fifth of the rise at the source.
  std::map<std::pair<int, int>, std::size_t> nodes;
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    if (!solid || std::abs(mesh.x[i][2] - plate.depth) < 1e-9)
      nodes[{static_cast<int>(std::lround(mesh.x[i][0] / h)),
             static_cast<int>(std::lround(mesh.x[i][1] / h))}] = i;
  const double isotherm = 0.2 * m.temperature(time, m.speed * time, 0), there = start + m.speed * time;
  const double exact = half_width([&](double x, double y) { return m.temperature(time, x - start, y); },
                                  isotherm, start, there, 0.6 * plate.width),
               found = half_width(
                   [&](double x, double y) {
                     return interpolated(
                         state,
                         [&](int i, int j) {
                           return nodes.at({i, j});
                         },
                         h, x, y);
                   },
                   isotherm, start, there, 0.6 * plate.width);
  verification::csv(std::string("travelling_source_") + (solid ? "thick" : "thin"),
                    "error_at_two_radii[1],width[m],exact_width[m]")
      << error << ',' << found << ',' << exact << '\n';
  // Of second order: with elements of a third of the radius in space 2.1 %.
  EXPECT_LT(error, solid ? 0.06 : 0.01);
  EXPECT_NEAR(found / exact, 1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(All, Plates, ::testing::Values(2, 3), [](const auto& instance) {
  return std::string(instance.param == 3 ? "thick" : "thin");
});

}  // namespace
}  // namespace solidus
