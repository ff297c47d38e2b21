/// Shrink fit of two rings, a quarter in plane strain, on meshes that do not match on the curved interface.
///
/// The inner ring (a to b) is warmer than the outer one (b to c) by ΔΘ and presses against it. Lamé: under
/// the pressure p its outer radius shrinks by
///   u_1 = (1+ν_1) p b /E_1 ((1−2ν_1) b² + a²)/(b² − a²)
/// and the bore of the outer ring grows by
///   u_2 = (1+ν_2) p b /E_2 ((1−2ν_2) b² + c²)/(c² − b²);
/// with the free expansion δ = (1+ν_1) α ΔΘ b and the penetration p/ε_N left by the penalty,
///   p = δ / (u_1/p + u_2/p + 1/ε_N).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;

constexpr double k_a = 0.2, k_b = 0.3, k_c = 0.5;
constexpr double k_e1 = 70e9, k_nu1 = 0.33, k_e2 = 210e9, k_nu2 = 0.3;
constexpr double k_alpha = 2e-5, k_warmer = 100;

// Bends the two blocks into rings: x becomes the angle from the y axis, the last coordinate the radius.
mesh::RawMesh rings(Shape shape, int n) {
  const bool flat = mesh::dimension(shape) == 2;
  mesh::TwoBlocks blocks{{1, k_b - k_a}, {1, k_c - k_b}, {5 * n, 2 * n}, {3 * n, 2 * n}, 0};
  if (!flat) {
    blocks.lower = {1, 0.1, k_b - k_a};
    blocks.upper = {1, 0.1, k_c - k_b};
    blocks.lower_divisions = {5 * n, 2, 2 * n};
    blocks.upper_divisions = {3 * n, 1, 2 * n};
  }
  mesh::RawMesh raw = test::raw_blocks(blocks, shape);
  for (auto& x : raw.x) {
    const double angle = 0.5 * std::numbers::pi * (1 - x[0]), r = k_a + x[flat ? 1 : 2];
    x[0] = r * std::cos(angle);
    x[flat ? 1 : 2] = r * std::sin(angle);
  }
  return raw;
}

double exact_pressure(double penalty) {
  const auto square = [](double x) { return x * x; };
  const double inner =
      (1 + k_nu1) * k_b / k_e1 * ((1 - 2 * k_nu1) * square(k_b) + square(k_a)) / (square(k_b) - square(k_a));
  const double outer =
      (1 + k_nu2) * k_b / k_e2 * ((1 - 2 * k_nu2) * square(k_b) + square(k_c)) / (square(k_c) - square(k_b));
  return (1 + k_nu1) * k_alpha * k_warmer * k_b / (inner + outer + 1 / penalty);
}

struct Fit {
  double mean_error = 0;   ///< of ∫ p dA / A against the closed form, relative
  double worst_error = 0;  ///< of the nodal averages, relative
  double coverage = 0;
};

Fit shrink(Shape shape, int n, bool swapped) {
  const mesh::Mesh mesh = test::distribute_blocks(rings(shape, n));
  const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
  contact::ContactParameters spec = test::interface();
  if (swapped) std::swap(spec.slave, spec.master);
  spec.penalty = 1e13;
  spec.penalty_is_factor = false;
  // Faceted circles with different facets leave gaps and overlaps of the size of their sagittas.
  spec.touching = 0.01;
  contact::ContactPair pair(mesh, kind, spec);

  const int up = mesh.dimension - 1;
  mechanics::MechanicalConditions symmetry;
  for (const std::string body : {"lower", "upper"}) {
    symmetry.displacements.push_back({body + "_x_min", 0, 0.0});
    symmetry.displacements.push_back({body + "_x_max", up, 0.0});
    if (up == 2)
      for (const char* side : {"_y_min", "_y_max"}) symmetry.displacements.push_back({body + side, 1, 0.0});
  }
  const std::vector<material::Material> materials{test::elastic(k_e1, k_nu1, k_alpha),
                                                  test::elastic(k_e2, k_nu2, k_alpha)};
  const std::vector<double> cold(mesh.x.size(), 300.0);
  const std::vector<double> warm = test::nodal_field(
      mesh, 1, [](const mesh::Point&, bool outer) { return std::vector{outer ? 300.0 : 300.0 + k_warmer}; });
  mechanics::MechanicalPhase phase(mesh, kind, materials, cold, symmetry, test::strict_mechanics(),
                                   {&pair.parts().forces.term()});
  const mechanics::MechanicalState start = phase.initial_state();
  mechanics::MechanicalState end = start;
  phase.solve(start, end, warm, 1, 1);
  pair.update(end.displacement);

  const double p = exact_pressure(pair.parts().forces.law().normal.penalty);
  Fit fit;
  fit.coverage = pair.parts().geometry.kinematics().coverage();
  const contact::ContactSums sums = contact::sums(pair.view(), {});
  fit.mean_error = std::abs(sums.force / sums.closed_area / p - 1);
  for (double t_n : contact::nodal_fields(pair.view(), {}).pressure)
    fit.worst_error = std::max(fit.worst_error, std::abs(t_n / p - 1));
  fit.worst_error = parallel::global_max(fit.worst_error);
  return fit;
}

TEST(ShrinkFit, OnFacetedRingsConvergesToLamesPressureAtSecondOrder) {
  for (Shape shape : {Shape::tri3, Shape::quad4})
    for (bool swapped : {false, true}) {
      SCOPED_TRACE(mesh::name(shape));
      const Fit coarse = shrink(shape, 2, swapped), fine = shrink(shape, 4, swapped);
      const double rate = std::log2(coarse.mean_error / fine.mean_error);
      RecordProperty(fmt::format("{}_{}", mesh::name(shape), swapped ? "outer_slave" : "inner_slave"),
                     fmt::format("mean {:.1e} {:.1e} worst {:.1e} {:.1e} coverage {:.6f}", coarse.mean_error,
                                 fine.mean_error, coarse.worst_error, fine.worst_error, fine.coverage));
      EXPECT_GT(rate, 1.6);
      EXPECT_LT(rate, 2.6);
      EXPECT_LT(fine.mean_error, 0.01);
      EXPECT_GT(fine.coverage, 0.999);
    }
}

TEST(ShrinkFit, OnQuadraticRingsIsExactToAThousandth) {
  for (Shape shape : {Shape::quad8, Shape::tri6})
    for (bool swapped : {false, true}) {
      SCOPED_TRACE(mesh::name(shape));
      const Fit fit = shrink(shape, 2, swapped);
      RecordProperty(fmt::format("{}_{}", mesh::name(shape), swapped ? "outer_slave" : "inner_slave"),
                     fmt::format("mean {:.1e} worst {:.1e} coverage {:.6f}", fit.mean_error, fit.worst_error,
                                 fit.coverage));
      EXPECT_LT(fit.mean_error, 1e-3);
      EXPECT_GT(fit.coverage, 0.9999);
    }
}

TEST(ShrinkFit, InThreeDimensionsAgreesToo) {
  for (Shape shape : {Shape::hex8, Shape::tet4, Shape::hex20}) {
    SCOPED_TRACE(mesh::name(shape));
    const Fit fit = shrink(shape, shape == Shape::hex20 ? 1 : 2, false);
    RecordProperty(std::string(mesh::name(shape)),
                   fmt::format("mean {:.1e} worst {:.1e} coverage {:.6f}", fit.mean_error, fit.worst_error,
                               fit.coverage));
    EXPECT_LT(fit.mean_error, 0.02);
    EXPECT_GT(fit.coverage, 0.99);
  }
}

}  // namespace
}  // namespace solidus
