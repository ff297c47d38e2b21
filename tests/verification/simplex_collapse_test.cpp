/// Collapse loads with stabilised triangles and tetrahedra: Hill's tube and Prandtl's punch
/// (collapse_bodies.hpp), along with quads with B-bar and simplices of the displacement alone.
#include <gtest/gtest.h>

#include "collapse_bodies.hpp"
#include "simplex_bodies.hpp"

namespace solidus {
namespace {

using verification::Element;
using verification::Tube;

struct Wall {
  const char* name;
  Tube tube;
};

std::vector<Wall> walls(const Element& element) {
  std::vector<Wall> all;
  if (mesh::dimension(element.shape) == 2)
    all.push_back({"axisymmetric", verification::tube_layer(element.shape, 10)});
  all.push_back({mesh::dimension(element.shape) == 2 ? "plane strain" : "solid",
                 verification::tube_quarter(element.shape, 10)});
  for (Wall& wall : all) element.choose(wall.tube.body.options);
  return all;
}

// The mesh of ten elements is off by up to half a per cent. Without a pressure of its own the wall can be
// widened on and on against a load that grows with the bulk modulus.
TEST(CollapseOfTheTube, IsAtThePressureOfTheClosedFormWithStabilisedSimplices) {
  for (const Element& element : {verification::k_tri3, verification::k_tri3_algebraic, verification::k_tet4,
                                 verification::k_tet4_algebraic})
    for (const Wall& wall : walls(element)) {
      const std::vector<double> pressure = verification::widen(wall.tube, 20);
      printf("%-16s %-12s %.4f, %.2f N/mm2, the last step adds %.1e\n", element.name, wall.name,
             pressure.back(), 1e-6 * pressure.back() * verification::k_tube_collapse,
             pressure[19] - pressure[18]);
      EXPECT_NEAR(pressure.back(), 1, 0.02) << element.name << ", " << wall.name;
      EXPECT_NEAR(pressure[19], pressure[18], 5e-4) << element.name << ", " << wall.name;
    }
}

TEST(PrandtlsPunch, CollapsesWithStabilisedSimplicesAndSinksAgainstARisingLoadWithout) {
  constexpr int n = 20;
  const std::vector<Element> elements{verification::k_quad4,          verification::k_tri3,
                                      verification::k_tri3_algebraic, verification::k_tri3_locking,
                                      verification::k_tet4,           verification::k_tet4_locking};
  std::string header = "depth / half-width,exact_collapse";
  for (const Element& element : elements) header += std::string(",") + element.name;
  auto out = verification::table("simplex_punch", header);
  std::vector<std::vector<double>> load;
  for (const Element& element : elements) {
    const int per_half_width = mesh::dimension(element.shape) == 3 ? 4 : 6;
    test::Body body = verification::punch(element.shape, per_half_width);
    element.choose(body.options);
    load.push_back(verification::press(body, per_half_width, n));
    printf("punch %-18s %.4f, the last five steps add %.4f\n", element.name, load.back().back(),
           load.back()[19] - load.back()[14]);
    if (element.simplices == mechanics::Simplices::displacement) {
      EXPECT_GT(load.back().back(), 1.1) << element.name;
      EXPECT_GT(load.back()[19] - load.back()[14], 0.02) << element.name;
    } else {
      EXPECT_NEAR(load.back().back(), 1, 0.05) << element.name;
      EXPECT_LT(load.back()[19] - load.back()[14], 0.01) << element.name;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    out << verification::k_punch_depth * static_cast<double>(i + 1) / n << ",1";
    for (const auto& of_element : load) out << "," << of_element[i];
    out << "\n";
  }
}

}  // namespace
}  // namespace solidus
