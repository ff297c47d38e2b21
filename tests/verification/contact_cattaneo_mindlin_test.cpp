/// Partial slip of two like cylinders (Cattaneo 1938, Mindlin 1949), plane strain.
///
///      P ↓  Q →
///     ╲________╱        pressed by P they touch over 2a, a² = 4 P R/(π E*), then pulled by Q < μ P:
///     ╱‾‾‾‾‾‾‾‾╲        the middle 2c sticks, c = a √(1 − Q/(μ P))
///
///   p = (2P/πa²) √(a² − x²),   q = (2μP/πa²) [√(a² − x²) − √(c² − x²)]
///
/// Like materials do not couple pressure and shear. 1/E* = 2 (1 − ν²)/E, 1/R = 2/R_1.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact_rubbing.hpp"
#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

constexpr double k_young = 200e9, k_poisson = 0.3, k_radius = 0.1, k_friction = 0.4;
constexpr double k_half = 0.02;     ///< half width and height of each body
constexpr double k_zone = 0.65e-3;  ///< half width of the fine mesh

/// Cells of one size in the zone |x| < z, growing outwards: from s in [-1, 1], `share` of the cells inside.
double grade(double s, double share) {
  const double t = std::abs(s);
  if (t <= share) return s / share * k_zone;
  // Starts with the size of the inner cells and goes on to the end with a quartic.
  const double left = (t - share) / (1 - share), slope = k_zone / share * (1 - share);
  return std::copysign(k_zone + slope * left + (k_half - k_zone - slope) * left * left * left, s);
}

test::Rubbing make_cylinders(int n, double press, double shear, contact::Formulation formulation) {
  constexpr double k_share = 0.6;
  mesh::RawMesh raw = test::raw_blocks({{2, 1}, {2, 1}, {2 * n, n}, {2 * n, n}, 0}, mesh::Shape::quad4);
  const auto place = [&](mesh::Point x) {
    const double side = x[1] > 1 ? 1 : -1;
    x[0] = grade(x[0] - 1, k_share);
    // Inner cells are squares.
    x[1] = grade((x[1] - 1), k_share);
    // Parabolas that flatten out towards the straight back.
    x[1] += side * 0.5 * x[0] * x[0] / k_radius * (1 - std::abs(x[1]) / k_half);
    return x;
  };
  // The interface belongs to both: told apart by body.
  test::map_body(raw, "lower", [&](mesh::Point x) { return place({x[0], std::min(x[1], 1.0), 0}); });
  test::map_body(raw, "upper", [&](mesh::Point x) {
    const bool surface = x[1] <= 1.0;
    mesh::Point y = place({x[0], surface ? 1.0 : x[1], 0});
    if (surface) y[1] = 0.5 * y[0] * y[0] / k_radius;
    return y;
  });
  mechanics::MechanicalConditions c;
  for (int i = 0; i < 2; ++i) c.displacements.push_back({"lower_y_min", i, 0.0});
  c.displacements.push_back({"upper_y_max", 1, Table({0, 1, 2}, {0, -press, -press})});
  c.displacements.push_back({"upper_y_max", 0, Table({0, 1, 2}, {0, 0, shear})});
  contact::ContactParameters spec =
      test::rubbing(test::coulomb(k_friction), 4 * k_young / (k_zone / (0.6 * n)));
  spec.formulation = formulation;
  if (formulation == contact::Formulation::small_sliding) spec.integration = contact::IntegrationRule::nodal;
  spec.search_distance = 5e-3;
  spec.gauss_degree = 2;  // more points than the shapes can follow make their traction waver
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.newton.tolerance = 1e-8;
  return {test::distribute_blocks(raw),
          AnalysisKind::plane_strain,
          {test::elastic(k_young, k_poisson), test::elastic(k_young, k_poisson)},
          c,
          spec,
          options};
}

struct PartialSlip {
  double width = 0, stick = 0;        ///< a and c, computed over closed form
  double element = 0;                 ///< of the element next to the surface, over a
  double pressure = 0, traction = 0;  ///< largest deviation beyond 1.5 elements from the edges, over the peak
  double share = 0;                   ///< Q/(μP)
  int iterations = 0;
};

PartialSlip pull(int n, contact::Formulation formulation) {
  test::Rubbing bodies = make_cylinders(n, 7e-6, 2e-6, formulation);
  bodies.advance(1, 1);
  bodies.advance(2, 1);
  const contact::ContactSums sums = bodies.sums();
  const double p = sums.force, q = std::abs(sums.resultant[0]);
  const double modulus = 0.5 * k_young / (1 - k_poisson * k_poisson), radius = 0.5 * k_radius;
  const double a = std::sqrt(4 * p * radius / (std::numbers::pi * modulus));
  const double c = a * std::sqrt(1 - q / (k_friction * p)), p0 = 2 * p / (std::numbers::pi * a);
  PartialSlip r{.element = k_zone / (0.6 * n) / a, .share = q / (k_friction * p)};
  std::ofstream csv;
  if (n == 60 && formulation == contact::Formulation::large_sliding)
    csv = verification::table("contact_cattaneo_mindlin",
                              "x/a,pressure/p0,traction/(mu_p0),exact_pressure,exact_traction");
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  double closed = 0, sticking = 0;
  for (std::size_t i = 0; i < bodies.contact.points.size(); ++i) {
    const auto particle = bodies.pair.parts().geometry.kinematics().particle(static_cast<Index>(i));
    if (!particle.counted) continue;
    const contact::ContactPointState& point = bodies.contact.points[i];
    const double x = particle.position[0];
    if (point.status != contact::PointStatus::open) closed += 0.5 * particle.weight;
    if (point.status == contact::PointStatus::sticks) sticking += 0.5 * particle.weight;
    const double exact_p = p0 * root(1 - x * x / (a * a));
    const double exact_q = k_friction * p0 / a * (root(a * a - x * x) - root(c * c - x * x));
    if (std::abs(x) < 1.3 * a)
      csv << fmt::format("{},{},{},{},{}\n", x / a, point.pressure / p0,
                         std::abs(point.traction[0]) / (k_friction * p0), exact_p / p0,
                         exact_q / (k_friction * p0));
    const double margin = 1.5 * r.element * a;
    if (std::abs(std::abs(x) - a) < margin) continue;
    r.pressure = std::max(r.pressure, std::abs(point.pressure - exact_p) / p0);
    if (std::abs(std::abs(x) - c) < margin) continue;
    r.traction = std::max(r.traction, std::abs(contact::norm(point.traction) - exact_q) / (k_friction * p0));
  }
  r.width = closed / a;
  r.stick = sticking / c;
  r.iterations = bodies.most_iterations;
  return r;
}

TEST(CattaneoMindlin, SticksInTheMiddleWithinAnElementAndHasTheTractionWithinFivePercent) {
  for (const auto formulation : {contact::Formulation::small_sliding, contact::Formulation::large_sliding})
    for (const int n : {30, 60}) {
      const PartialSlip r = pull(n, formulation);
      const std::string name = formulation == contact::Formulation::small_sliding ? "small" : "large";
      SCOPED_TRACE(name + std::to_string(n));
      ::testing::Test::RecordProperty(
          name + std::to_string(n),
          fmt::format(
              "Q/muP {:.3f} a {:.4f} c {:.4f} element/a {:.3f} pressure {:.3f} traction {:.3f} Newton {}",
              r.share, r.width, r.stick, r.element, r.pressure, r.traction, r.iterations));
      // The slave's points tell the edges to the size of an element.
      EXPECT_NEAR(r.width, 1, r.element);
      EXPECT_NEAR(r.stick, 1, r.element);
      EXPECT_LT(r.pressure, 0.03);
      EXPECT_LT(r.traction, 0.05);
      EXPECT_NEAR(r.share, 0.5, 0.05);
    }
}

}  // namespace
}  // namespace solidus
