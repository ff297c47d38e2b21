/// Structural heating and its energy.
#include <gtest/gtest.h>

#include "body.hpp"
#include "heated.hpp"
#include "mechanics/structural_heat.hpp"

namespace solidus {
namespace {

using mechanics::StructuralForm;
using mechanics::StructuralHeat;
using mesh::Shape;
using test::Body;
using Solved = test::Heated;

/// A distorted block stretched through its sides; moduli and expansion vary with temperature.
struct Stretched {
  Body body;
  Stretched(Shape shape, AnalysisKind kind, bool constant, double end = 1e-3)
      : body({.shape = shape,
              .cells = {2, 2, 2},
              .distortion = 0.1,
              .map =
                  [](const mesh::Point& x) {
                    return mesh::Point{x[0] + 0.5, x[1], x[2]};
                  }},
             kind, material(constant)) {
    body.hold("bottom", 1);
    body.hold("top", 1, Table({0, 1}, {0, end}, Extrapolation::linear));
    if (kind != AnalysisKind::axisymmetric) body.hold("left", 0);
    if (kind == AnalysisKind::solid) body.hold("back", 2);
    body.temperature.assign(body.mesh.x.size(), 320.0);
  }
  static material::Material material(bool constant) {
    material::Material m = test::elastic_material(2e11, 0.3, 1.2e-5);
    if (constant) return m;
    m.young_modulus = Table({300, 500}, {2e11, 1.5e11});
    m.poisson_ratio = Table({300, 500}, {0.3, 0.35});
    m.expansion = Table({300, 500}, {1.0e-5, 1.4e-5});
    return m;
  }
  /// Nodal temperatures that vary in space.
  std::vector<double> warm(double shift) const {
    std::vector<double> t;
    for (const mesh::Point& x : body.mesh.x) t.push_back(320 + 10 * x[0] - 7 * x[1] + shift);
    return t;
  }
};

std::vector<double> residual(StructuralHeat& heat, const Solved& solved,
                             const std::vector<double>& temperature) {
  std::vector<double> r(static_cast<std::size_t>(solved.phase->mesh().n_owned_nodes), 0.0);
  heat.set_deformation(solved.report.deformation);
  heat.add_residual(temperature, r);
  return r;
}

double total(const std::vector<double>& r) {
  double s = 0;
  for (double value : r) s += value;
  return parallel::global_sum(s);
}

TEST(StructuralHeat, StretchingAtConstantTemperatureTakesThermoelasticHeat) {
  Stretched s(Shape::hex8, AnalysisKind::solid, true);
  s.body.temperature.assign(s.body.mesh.x.size(), 300.0);  // no thermal strain
  const Solved solved(s.body);
  StructuralHeat heat(*solved.phase, StructuralForm::entropy);
  // Uniaxial: tr ε = (1 − 2ν) ε; S = 3 α k tr ε with constant moduli; the volume is one.
  const double bulk = 2e11 / (3 * 0.4), exact = 300 * 3 * 1.2e-5 * bulk * 0.4 * 1e-3;
  EXPECT_NEAR(total(residual(heat, solved, s.body.temperature)), exact, 1e-9 * exact);
}

TEST(StructuralHeat, TheTangentIsTheRowSumOfTheDerivative) {
  for (StructuralForm form : {StructuralForm::entropy, StructuralForm::energy})
    for (auto [shape, kind] : {std::pair{Shape::quad4, AnalysisKind::plane_strain},
                               {Shape::tri6, AnalysisKind::axisymmetric},
                               {Shape::tet4, AnalysisKind::solid}}) {
      Stretched s(shape, kind, false);
      const Solved solved(s.body);
      StructuralHeat heat(*solved.phase, form);
      linear::BlockMatrix matrix(s.body.mesh, 1, linear::NodeGraph(s.body.mesh));
      heat.bind(matrix);
      matrix.set_zero();
      heat.set_deformation(solved.report.deformation);
      heat.add_tangent(s.warm(0), matrix);
      const double h = 1e-2;
      const auto plus = residual(heat, solved, s.warm(h)), minus = residual(heat, solved, s.warm(-h));
      double size = 0;
      for (std::size_t i = 0; i < plus.size(); ++i)
        size = std::max(size, std::abs(plus[i] - minus[i]) / (2 * h));
      for (Index i = 0; i < s.body.mesh.n_owned_nodes; ++i) {
        const auto k = static_cast<std::size_t>(i);
        // differences of a smooth function: h² in the truncation
        EXPECT_NEAR(*matrix.diagonal_block(i), (plus[k] - minus[k]) / (2 * h), 1e-5 * size);
      }
    }
}

// A tangent that is lumped has the other sign at the corners of quadratic elements, next to a capacity that
// is not lumped: heat then converged by a factor of 0.8 in an iteration.
TEST(StructuralHeat, TheTangentIsTheDerivativeWhereGaussPointsStoreTheHeat) {
  for (auto [shape, kind] : {std::pair{Shape::quad8, AnalysisKind::plane_strain},
                             {Shape::tet10, AnalysisKind::solid},
                             {Shape::hex20, AnalysisKind::solid}}) {
    Stretched s(shape, kind, false);
    Solved solved(s.body);
    StructuralHeat heat(*solved.phase, StructuralForm::energy, false);
    solved.step(s.body, 2.0, 1.0);  // whose points know how their heat is spread
    linear::NodeGraph graph(s.body.mesh);
    for (const mesh::ElementBlock& block : s.body.mesh.blocks)
      graph.add_cliques(block.nodes, mesh::node_count(block.shape));
    linear::BlockMatrix matrix(s.body.mesh, 1, graph);
    heat.bind(matrix);
    matrix.set_zero();
    heat.set_deformation(solved.report.deformation);
    const std::vector<double> at = s.warm(0);
    heat.add_tangent(at, matrix);
    const double h = 1e-2;
    std::vector<double> direction, up = at, down = at;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const mesh::Point& x = s.body.mesh.x[i];
      direction.push_back(std::sin(7 * x[0]) + x[1] * x[1] - x[2]);
      up[i] += h * direction[i];
      down[i] -= h * direction[i];
    }
    const auto plus = residual(heat, solved, up), minus = residual(heat, solved, down);
    std::vector<double> product(plus.size());
    matrix.multiply(direction, product);
    double size = 0;
    for (std::size_t i = 0; i < plus.size(); ++i)
      size = std::max(size, std::abs(plus[i] - minus[i]) / (2 * h));
    for (std::size_t i = 0; i < plus.size(); ++i)
      EXPECT_NEAR(product[i], (plus[i] - minus[i]) / (2 * h), 1e-5 * size);
  }
}

// The heat of deformation of a point is Θ ΔS; at the nodes it is divided by their temperatures.
TEST(StructuralHeat, TellsTheEntropyThatSpreadingOverNodesMakes) {
  double spread[2];
  for (int k = 0; k < 2; ++k) {
    Stretched s(Shape::quad4, AnalysisKind::plane_strain, false, 1e-2);
    const Solved solved(s.body);
    StructuralHeat heat(*solved.phase, StructuralForm::entropy);
    std::vector<double> end = s.warm(0);
    for (double& theta : end) theta = 320 + (theta - 320) / (k + 1);
    const std::vector<double> heat_of_nodes = residual(heat, solved, end);  // Δt = 1
    double entropy = 0;
    for (std::size_t i = 0; i < heat_of_nodes.size(); ++i) entropy += heat_of_nodes[i] / end[i];
    const mechanics::StructuralChange change = structural_change(solved.report.deformation, end);
    spread[k] = change.spread;
    EXPECT_GT(change.spread, 0);
    EXPECT_NEAR(change.spread, parallel::global_sum(entropy) - change.entropy, 1e-12 * change.entropy);
  }
  EXPECT_NEAR(spread[0] / spread[1], 4, 0.2);  // of second order in the differences of temperature
}

TEST(StructuralHeat, TheEnergyFormGivesExactlyEnergyMinusWork) {
  Stretched s(Shape::quad4, AnalysisKind::axisymmetric, false);
  const Solved solved(s.body);
  StructuralHeat heat(*solved.phase, StructuralForm::energy);
  const auto end = s.warm(5);
  const double stored =
      structural_change(solved.report.deformation, end).energy - solved.report.work.internal_work;  // Δt = 1
  EXPECT_NEAR(total(residual(heat, solved, end)), stored, 1e-9 * std::abs(stored));
}

TEST(StructuralHeat, BothFormsDifferAtSecondOrderInTheStep) {
  double difference[2];
  for (int k = 0; k < 2; ++k) {
    const double part = k == 0 ? 1.0 : 0.5;  // of a step: displacement and temperature change in proportion
    Stretched s(Shape::quad4, AnalysisKind::plane_strain, false, 1e-3 * part);
    s.body.initial_temperature = s.body.temperature;  // stress-free at the start
    const Solved solved(s.body);
    const std::vector<double> end(s.body.mesh.x.size(), 320 + 8 * part);

    StructuralHeat entropy(*solved.phase, StructuralForm::entropy),
        energy(*solved.phase, StructuralForm::energy);
    difference[k] = total(residual(entropy, solved, end)) - total(residual(energy, solved, end));
  }
  const double order = std::log2(difference[0] / difference[1]);
  EXPECT_GT(order, 1.8);
  EXPECT_LT(order, 2.2);
}

TEST(StructuralHeat, StrainingOfAPhaseChangeIsHeldAndMakesNoSpikeInTheFreezingRange) {
  material::Material m = Stretched::material(true);
  m.specific_heat_at = material::SpecificHeatAt::constant_strain;
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(932, 933),
                             .volume_change = -0.06,
                             .solidification = true});
  Body body({.shape = Shape::quad4, .cells = {2, 2, 1}}, AnalysisKind::plane_strain, m);
  body.hold("bottom", 1);
  body.hold("top", 1, 1e-3);
  body.hold("left", 0);
  body.temperature.assign(body.mesh.x.size(), 932.5);
  body.initial_temperature.assign(body.mesh.x.size(), 940.0);
  const Solved solved(body);
  StructuralHeat heat(*solved.phase, StructuralForm::entropy);
  // With constant moduli and expansion the entropy does not depend on temperature: Θ S grows as Θ.
  const auto at = [&](double theta) {
    return total(residual(heat, solved, std::vector<double>(body.mesh.x.size(), theta)));
  };
  const double dissipation = solved.report.work.dissipation;  // Δt = 1
  EXPECT_NEAR((at(932.5) + dissipation) / 932.5, (at(931.0) + dissipation) / 931.0,
              1e-6 * std::abs(at(932.5)) / 932.5);
}

TEST(StructuralHeat, DoesNotJumpWhereATableBends) {
  material::Material m = Stretched::material(false);
  m.young_modulus = Table({300, 325, 500}, {2e11, 1.95e11, 0.5e11});
  m.expansion = Table({300, 325, 500}, {1.0e-5, 1.1e-5, 2.4e-5});
  Stretched s(Shape::quad4, AnalysisKind::plane_strain, false);
  s.body.materials = {m};
  const Solved solved(s.body);  // at 320 K
  for (StructuralForm form : {StructuralForm::entropy, StructuralForm::energy}) {
    StructuralHeat heat(*solved.phase, form);
    const auto at = [&](double theta) {
      return total(residual(heat, solved, std::vector<double>(s.body.mesh.x.size(), theta)));
    };
    // Smooth: what two millikelvin change next to the bend they change across it, to the curvature.
    const double across = at(325.001) - at(324.999), beside = at(324.999) - at(324.997);
    EXPECT_NEAR(across, beside, 1e-4 * std::abs(beside));
  }
}

TEST(StructuralHeat, NoDeformationNoHeat) {
  Body body({.shape = Shape::quad4, .cells = {2, 2, 1}}, AnalysisKind::plane_strain,
            test::elastic_material(2e11, 0.3, 1e-5));
  body.hold("body", 0);
  body.hold("body", 1);
  const Solved solved(body);
  for (StructuralForm form : {StructuralForm::entropy, StructuralForm::energy}) {
    StructuralHeat heat(*solved.phase, form);
    for (double r : residual(heat, solved, body.temperature)) EXPECT_NEAR(r, 0.0, 1e-9);
    EXPECT_NEAR(structural_change(solved.report.deformation, body.temperature).energy, 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace solidus
