/// Order of stabilised triangles and tetrahedra in a smooth incompressible problem.
///
/// The colliding flow u = (20 x y³, 5 x⁴ − 5 y⁴), p = 60 x² y − 20 y³ satisfies −Δu + ∇p = 0, div u = 0: the
/// displacement of an incompressible solid of shear modulus one without body force, given on the boundary of
/// the square (−1, 1)². In three dimensions the sum of its three cyclic permutations. Both keep the volume of
/// a symmetric mesh exactly, so that no pressure comes from the interpolation of the boundary. Poisson's
/// ratio is so near to one half that what it leaves of the volume is far below the error of the mesh.
/// S. Norburn, D. Silvester, Stabilised vs. stable mixed methods for incompressible flow, Comput. Meth. Appl.
/// Mech. Engng 166 (1998) 131–141.
#include <gtest/gtest.h>

#include "simplex_bodies.hpp"

namespace solidus {
namespace {

using mesh::Point;
using test::Body;
using test::Lattice;
using test::Solved;
using verification::Element;

constexpr double k_poisson = 0.4999995;

bool is_solid(const Element& element) {
  return mesh::dimension(element.shape) == 3;
}

Point plane_flow(double x, double y) {
  return {20 * x * y * y * y, 5 * x * x * x * x - 5 * y * y * y * y, 0};
}
double plane_pressure(double x, double y) {
  return 60 * x * x * y - 20 * y * y * y;
}

Point displacement(const Point& x, bool solid) {
  Point u = plane_flow(x[0], x[1]);
  if (!solid) return u;
  const Point second = plane_flow(x[1], x[2]), third = plane_flow(x[2], x[0]);
  u[1] += second[0];
  u[2] += second[1];
  u[2] += third[0];
  u[0] += third[1];
  return u;
}
double pressure(const Point& x, bool solid) {
  double p = plane_pressure(x[0], x[1]);
  if (solid) p += plane_pressure(x[1], x[2]) + plane_pressure(x[2], x[0]);
  return p;
}

struct Errors {
  double displacement, pressure, roughness;
};

Errors solve(const Element& element, int n) {
  const bool solid = is_solid(element);
  Lattice lattice{.shape = element.shape, .cells = {n, n, n}, .distortion = 0.1};
  lattice.map = [solid](const Point& x) {
    return Point{2 * x[0] - 1, 2 * x[1] - 1, solid ? 2 * x[2] - 1 : 0};
  };
  Body body(lattice, solid ? AnalysisKind::solid : AnalysisKind::plane_strain,
            test::elastic_material(2 * (1 + k_poisson), k_poisson));
  element.choose(body.options);
  const auto exact = [solid](const Point& x) { return displacement(x, solid); };
  body.hold_boundary(exact);
  const Solved solved(body);
  const verification::Cells cells(body.mesh, body.mesh.blocks[0], body.kind);
  const std::vector<double> computed = test::element_fields(solved)[0].pressure;
  std::vector<double> closed, error;
  for (std::size_t e = 0; e < computed.size(); ++e) {
    closed.push_back(pressure(cells.centre[e], solid));
    error.push_back(computed[e] - closed[e]);
  }
  return {verification::relative_l2_error(body, solved.state.displacement, exact),
          cells.spread(error) / cells.spread(closed),
          verification::roughness(body.mesh.blocks[0], cells, computed)};
}

const std::vector<Element> k_elements{verification::k_tri3, verification::k_tri3_algebraic,
                                      verification::k_tet4, verification::k_tet4_algebraic};

TEST(StabilisedSimplices, AreOfSecondOrderInDisplacementAndConvergeInPressure) {
  for (const Element& element : k_elements) {
    const std::vector<int> sides = is_solid(element) ? std::vector{4, 8, 16} : std::vector{16, 32, 64};
    auto out = verification::table(std::string("simplex_order_") + element.name,
                                   "h,displacement,pressure,first_order,second_order");
    std::vector<Errors> errors;
    for (const int n : sides) {
      errors.push_back(solve(element, n));
      const Errors& e = errors.back();
      printf("%-16s n %2d: displacement %.3e, pressure %.3e, roughness %.3f\n", element.name, n,
             e.displacement, e.pressure, e.roughness);
      out << 2.0 / n << "," << e.displacement << "," << e.pressure << "," << 2.0 / n << "," << 4.0 / n / n
          << "\n";
    }
    const double ratio = std::log(static_cast<double>(sides[2]) / sides[1]);
    const double of_displacement = std::log(errors[1].displacement / errors[2].displacement) / ratio;
    const double of_pressure = std::log(errors[1].pressure / errors[2].pressure) / ratio;
    printf("%-16s orders %.2f, %.2f\n", element.name, of_displacement, of_pressure);
    // Sixteen tetrahedra along an edge are not yet where the order is: it still rises there.
    EXPECT_NEAR(of_displacement, 2, 0.25) << element.name;
    EXPECT_GT(of_pressure, 0.9) << element.name;
    EXPECT_LT(errors[2].roughness, errors[1].roughness) << element.name;
  }
}

// The displacement is given all round, so it cannot lock much; the pressure means nothing.
TEST(DisplacementSimplices, HaveNoPressureInTheSameProblem) {
  for (const Element& element : {verification::k_tri3_locking, verification::k_tet4_locking}) {
    const int n = is_solid(element) ? 8 : 16;
    const Errors locked = solve(element, n);
    const Errors mixed = solve(is_solid(element) ? verification::k_tet4 : verification::k_tri3, n);
    printf("%-18s n %2d: displacement %.3e (mixed %.3e), pressure %.3e\n", element.name, n,
           locked.displacement, mixed.displacement, locked.pressure);
    EXPECT_GT(locked.pressure, 10) << element.name;
  }
}

}  // namespace
}  // namespace solidus
