/// A thick tube without axial strain, against closed forms: Lamé's under inner pressure, and the thermal
/// stress of a steady temperature that falls from the inner to the outer surface.
///
///        axis     a          b
///          |      ├──┬──┬──┬──┤   one layer of axisymmetric cells, held axially
///          |   p →├──┴──┴──┴──┤
///
/// Lamé:     u = p a² (1 + ν)/(E (b² − a²)) [(1 − 2ν) r + b²/r]
/// Thermal:  u = α (1 + ν)/(1 − ν) [I(a, r) + ((1 − 2ν) r² + a²)/(b² − a²) I(a, b)]/r,  I = ∫ ϑ r dr,
///           ϑ = ϑ_a ln(b/r)/ln(b/a)          (Timoshenko and Goodier, Theory of Elasticity, §151)
#include <gtest/gtest.h>

#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Lattice;
using test::Solved;

constexpr double k_a = 0.1, k_b = 0.2;                    // [m]
constexpr double k_young = 2e11, k_alpha = 1.2e-5;        // [Pa], [1/K]
constexpr double k_pressure = 2e8, k_inner_warmth = 100;  // [Pa], [K]
constexpr double k_a2 = k_a * k_a, k_b2 = k_b * k_b;

double lame(double poisson, double r) {
  return k_pressure * k_a2 * (1 + poisson) / (k_young * (k_b2 - k_a2)) * ((1 - 2 * poisson) * r + k_b2 / r);
}
double warmth(double r) {
  return k_inner_warmth * std::log(k_b / r) / std::log(k_b / k_a);
}
/// ∫_a^r ϑ r dr
double warmth_integral(double r) {
  const auto primitive = [](double s) { return s * s / 2 * (std::log(k_b / s) + 0.5); };
  return k_inner_warmth / std::log(k_b / k_a) * (primitive(r) - primitive(k_a));
}
double thermal(double poisson, double r) {
  return k_alpha * (1 + poisson) / (1 - poisson) / r *
         (warmth_integral(r) + ((1 - 2 * poisson) * r * r + k_a2) / (k_b2 - k_a2) * warmth_integral(k_b));
}

enum class Load { pressure, temperature };

Body tube(Shape shape, int n, double poisson, Load load) {
  Lattice lattice{.shape = shape, .cells = {n, 1, 1}, .size = {k_b - k_a, (k_b - k_a) / n, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + k_a, x[1], 0}; };
  Body body(lattice, AnalysisKind::axisymmetric, test::elastic_material(k_young, poisson, k_alpha));
  body.hold("bottom", 1);
  body.hold("top", 1);
  if (load == Load::pressure)
    body.conditions.pressures.push_back({"left", k_pressure});
  else
    for (std::size_t i = 0; i < body.temperature.size(); ++i)
      body.temperature[i] += warmth(body.mesh.x[i][0]);
  return body;
}

/// Errors of n = 4, 8, 16, 32 cells through the wall.
std::vector<double> errors(Shape shape, Load load) {
  std::vector<double> result;
  for (int n : {4, 8, 16, 32}) {
    const Body body = tube(shape, n, 0.3, load);
    const Solved solved(body);
    result.push_back(
        verification::relative_l2_error(body, solved.state.displacement, [load](const mesh::Point& x) {
          return mesh::Point{load == Load::pressure ? lame(0.3, x[0]) : thermal(0.3, x[0]), 0, 0};
        }));
  }
  return result;
}

void converges(Load load, const std::string& name) {
  const std::vector<Shape> shapes{Shape::tri3, Shape::quad4, Shape::tri6, Shape::quad8};
  std::vector<std::vector<double>> all;
  for (Shape shape : shapes) {
    all.push_back(errors(shape, load));
    for (std::size_t i = 1; i < all.back().size(); ++i) {
      const double p = verification::order(all.back()[i - 1], all.back()[i]);
      const double expected = mesh::order(shape) + 1;
      // From eight cells on the curvature 1/r of the solution is resolved.
      EXPECT_NEAR(p, expected, i == 1 ? 0.3 : 0.1) << mesh::name(shape) << " " << i;
    }
  }
  auto out = verification::table(name, "h[mm],tri3,quad4_B-bar,tri6,quad8");
  for (std::size_t i = 0; i < 4; ++i) {
    out << 1e3 * (k_b - k_a) / (4 << i);
    for (const auto& e : all) out << "," << e[i];
    out << "\n";
  }
}

TEST(Tube, UnderPressureConvergesToLameAtTheOrderOfItsElements) {
  converges(Load::pressure, "mechanics_tube_convergence");
}

TEST(Tube, WithATemperatureGradientConvergesToTheClosedFormAtTheOrderOfItsElements) {
  converges(Load::temperature, "mechanics_warm_tube_convergence");
}

TEST(Tube, StressesThroughTheWallFollowLame) {
  const int n = 16;
  const Body body = tube(Shape::quad4, n, 0.3, Load::pressure);
  const Solved solved(body);
  auto out = verification::table("mechanics_tube_stress",
                                 "radius[mm],exact_radial[MPa],exact_hoop[MPa],radial[MPa],hoop[MPa]");
  const auto fields = test::element_fields(solved);
  const mesh::ElementBlock& block = body.mesh.blocks[0];
  for (Index e = 0; e < block.size(); ++e) {
    double r = 0;
    for (int a = 0; a < 4; ++a) r += body.mesh.x[static_cast<std::size_t>(block.element(e)[a])][0] / 4;
    const double p0 = k_pressure * k_a2 / (k_b2 - k_a2);
    const double radial = p0 * (1 - k_b2 / (r * r)), hoop = p0 * (1 + k_b2 / (r * r));
    const auto& stress = fields[0].stress[static_cast<std::size_t>(e)];
    // A mean over the element against the value at its middle: second order, (h/r)² = 4e-3 at the inside.
    EXPECT_NEAR(stress[0], radial, 5e-3 * k_pressure);
    EXPECT_NEAR(stress[2], hoop, 5e-3 * k_pressure);
    out << 1e3 * r << "," << 1e-6 * radial << "," << 1e-6 * hoop << "," << 1e-6 * stress[0] << ","
        << 1e-6 * stress[2] << "\n";
  }
}

}  // namespace
}  // namespace solidus
