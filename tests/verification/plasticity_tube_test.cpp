/// Hill's thick tube: first yield, plastic front, stresses and collapse pressure against the closed form of
/// analytic/plastic_tube.hpp. Radii 100 and 200 mm, von Mises, perfectly plastic at 320 N/mm²; elastic
/// constants of the tube of monograph 7.1 at 293 K (table 7.1).
#include <gtest/gtest.h>

#include "analytic/plastic_tube.hpp"
#include "plasticity_bodies.hpp"

namespace solidus {
namespace {

using analytic::PlasticTube;
using mesh::Shape;
using test::Body;
using test::Lattice;
using verification::March;

constexpr double k_inner = 0.1, k_outer = 0.2, k_yield = 320e6;  // [m], [Pa]
constexpr double k_young = 220e9;                                // [Pa]
constexpr double k_poisson = 0.3;
/// Nearly incompressible, where the closed form is exact: (1 − 2ν)² is 4e-8.
constexpr double k_incompressible = 0.4999;

PlasticTube exact(double pressure) {
  return {k_inner, k_outer, k_yield, pressure};
}
const double k_collapse = exact(0).collapse();

// The closed form by itself.

TEST(HillsTube, FormulaGivesThePublishedNumbers) {
  EXPECT_NEAR(exact(0).first_yield(), 138.56e6, 0.005e6);
  EXPECT_NEAR(exact(0).collapse(), 256.12e6, 0.005e6);
  EXPECT_NEAR(exact(200e6).front(), 0.12783, 0.000005);
  EXPECT_NEAR(exact(0).first_yield(0.5), exact(0).first_yield(), 1.0);
  EXPECT_NEAR(exact(0).first_yield(0.3), 138.33e6, 0.005e6);
}

TEST(HillsTube, FormulaIsInEquilibriumAndMeetsItsBoundaryConditionsAndTheYieldCondition) {
  for (const double pressure : {100e6, 138e6, 160e6, 200e6, 250e6}) {
    const PlasticTube tube = exact(pressure);
    EXPECT_NEAR(tube.radial(k_inner), -pressure, 1e-9 * pressure);
    EXPECT_NEAR(tube.radial(k_outer), 0, 1e-9 * pressure);
    for (double r = 0.1005; r < k_outer; r += 0.001) {
      const double h = 1e-6, difference = tube.hoop(r) - tube.radial(r);
      if (std::abs(r - tube.front()) > h) {
        const double slope = (tube.radial(r + h) - tube.radial(r - h)) / (2 * h);
        EXPECT_NEAR(slope, difference / r, 1e-4 * pressure / k_inner);  // h² of the difference quotient
      }
      EXPECT_LE(difference, 2 * tube.k() * (1 + 1e-12));
    }
    EXPECT_NEAR(tube.radial(tube.front() - 1e-9), tube.radial(tube.front() + 1e-9), 1e-6 * pressure);
  }
}

// The finite elements.

/// A layer of n elements through the wall; the pressure at time t is t [Pa].
Body layer(int n, double poisson, bool b_bar = true) {
  Lattice lattice{.shape = Shape::quad4, .cells = {n, 1, 1}, .size = {k_outer - k_inner, 0.1 / n, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + k_inner, x[1], 0}; };
  Body body(lattice, AnalysisKind::axisymmetric, verification::plastic_material(k_young, poisson, k_yield));
  body.options.b_bar = b_bar;
  body.options.newton.tolerance = 1e-9;
  body.hold("bottom", 1);
  body.hold("top", 1);
  body.conditions.pressures.push_back({"left", Table({0, 1e9}, {0, 1e9})});
  return body;
}

/// The pressure above which a step from zero dissipates.
double first_yield(const Body& body) {
  double low = 130e6, high = 150e6;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    March march(body);
    EXPECT_TRUE(march.to(middle));
    (march.report().work.dissipation > 0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

// The strain is that of points within the first element: what is missing to the bore is of first order in its
// size, and two meshes extrapolate it away.
TEST(HillsTube, YieldsFirstAtThePressureOfTheClosedForm) {
  for (const double poisson : {k_poisson, k_incompressible}) {
    const double expected = exact(0).first_yield(poisson);
    std::vector<double> pressure;
    for (const int n : {50, 100}) {
      pressure.push_back(first_yield(layer(n, poisson)));
      EXPECT_NEAR(pressure.back(), expected, 0.8 / n * expected) << n;
    }
    EXPECT_NEAR(2 * pressure[1] - pressure[0], expected, 1e-4 * expected);
    printf("first yield, nu %g: %.3f %.3f, extrapolated %.3f, closed form %.3f MPa\n", poisson,
           1e-6 * pressure[0], 1e-6 * pressure[1], 1e-6 * (2 * pressure[1] - pressure[0]), 1e-6 * expected);
  }
}

/// The radius where the plastic strain ends: r² (ε^p_θ − ε^p_r) = k/G (c² − r²) is a line in r², drawn
/// through the outermost elements that are plastic as a whole.
double front(const Body& body, const March& march) {
  const auto fields = march.fields();
  const mesh::ElementBlock& block = body.mesh.blocks[0];
  const double h = (k_outer - k_inner) / block.size();
  double outermost = 0;
  const auto plastic = [&](Index e) {
    const auto& strain = fields[0].plastic_strain[static_cast<std::size_t>(e)];
    return strain[2] - strain[0];
  };
  for (Index e = 0; e < block.size(); ++e)
    if (plastic(e) > 1e-9) outermost = std::max(outermost, verification::centre(body.mesh, block, e)[0]);
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (Index e = 0; e < block.size(); ++e) {
    const double r = verification::centre(body.mesh, block, e)[0], x = r * r, y = x * plastic(e);
    if (r > outermost - 0.5 * h || r < outermost - 5.5 * h) continue;
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return std::sqrt((sx - sy / slope) / n);
}

/// Stresses of every element against the closed form; @return the largest differences of the radial, hoop and
/// axial stress over the pressure.
std::array<double, 3> compare_stress(const Body& body, const March& march, const std::string& name) {
  const PlasticTube tube = exact(march.time());
  const auto fields = march.fields();
  const mesh::ElementBlock& block = body.mesh.blocks[0];
  auto out = verification::table(name,
                                 "radius[mm],exact_radial[MPa],exact_hoop[MPa],exact_axial[MPa],radial[MPa],"
                                 "hoop[MPa],axial[MPa]");
  std::array<double, 3> worst{};
  for (Index e = 0; e < block.size(); ++e) {
    const double r = verification::centre(body.mesh, block, e)[0];
    const std::array<double, 3> closed{tube.radial(r), tube.hoop(r), tube.axial(r)};
    const auto& stress = fields[0].stress[static_cast<std::size_t>(e)];
    const std::array<double, 3> computed{stress[0], stress[2], stress[1]};
    for (std::size_t i = 0; i < 3; ++i)
      worst[i] = std::max(worst[i], std::abs(computed[i] - closed[i]) / march.time());
    out << 1e3 * r;
    for (const double value : closed) out << "," << 1e-6 * value;
    for (const double value : computed) out << "," << 1e-6 * value;
    out << "\n";
  }
  return worst;
}

TEST(HillsTube, AtTwoHundredMegapascalsFrontAndStressesAreThoseOfTheClosedForm) {
  const double pressure = 200e6;
  struct {
    double poisson, front, in_plane, axial;  ///< tolerances [m], over the pressure
    const char* table;
  } const cases[] = {
      // what is left is the mesh: means over elements against values at their middle
      {k_incompressible, 0.02e-3, 1e-3, 1e-3, "plasticity_tube_incompressible"},
      // the axial stress of the elastic tube is ν (σ_r + σ_θ) instead of half of it; that moves the front by
      // (1 − 2ν)² of second order
      {k_poisson, 0.5e-3, 0.02, 0.2, "plasticity_tube_stress"},
  };
  for (const auto& c : cases) {
    const Body body = layer(50, c.poisson);
    March march(body);
    for (int step = 1; step <= 8; ++step) ASSERT_TRUE(march.to(pressure * step / 8));
    const double radius = front(body, march);
    const std::array<double, 3> stress = compare_stress(body, march, c.table);
    const double bore = march.u(body.mesh.surfaces.at("left").nodes[0], 0),
                 closed = exact(pressure).displacement(k_inner, k_young, c.poisson);
    printf(
        "nu %g: front %.3f mm (closed form %.3f), stresses off by %.1e, %.1e, %.1e p, bore %.5f mm (%.5f)\n",
        c.poisson, 1e3 * radius, 1e3 * exact(pressure).front(), stress[0], stress[1], stress[2], 1e3 * bore,
        1e3 * closed);
    EXPECT_NEAR(radius, exact(pressure).front(), c.front);
    EXPECT_LE(std::max(stress[0], stress[1]), c.in_plane);
    EXPECT_LE(stress[2], c.axial);
    EXPECT_NEAR(bore, closed, 1e-3 * closed);
  }
}

TEST(HillsTube, CarriesAlmostTheCollapsePressureAndNotOnePerCentMore) {
  for (const double poisson : {k_poisson, k_incompressible}) {
    const Body body = layer(50, poisson);
    March march(body);
    for (int step = 1; step <= 20; ++step) ASSERT_TRUE(march.to(0.999 * k_collapse * step / 20)) << step;
    EXPECT_FALSE(march.to(1.01 * k_collapse));
    const double most = march.as_far_as(1.01 * k_collapse, 1e-3 * k_collapse, 1e-5 * k_collapse);
    printf("nu %g: collapse at %.3f MPa (closed form %.3f)\n", poisson, 1e-6 * most, 1e-6 * k_collapse);
    EXPECT_NEAR(most, k_collapse, 2e-3 * k_collapse);
  }
}

}  // namespace
}  // namespace solidus
