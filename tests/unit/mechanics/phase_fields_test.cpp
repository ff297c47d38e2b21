/// Phase fractions of the mechanical phase.
#include "mechanics/state/phase_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body.hpp"
#include "mechanics/elements/structural_points.hpp"

namespace solidus {
namespace {

using material::PhaseFraction;

material::Material with(std::vector<material::PhaseChange> changes) {
  material::Material m = test::elastic_material(6e10, 0.3);
  m.phase_changes = std::move(changes);
  return m;
}

/// Two bodies of one element each on the same three nodes.
mesh::Mesh shared_nodes() {
  mesh::Mesh mesh;
  mesh.x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.n_owned_nodes = 3;
  mesh.bodies = {{"first"}, {"second"}};
  for (int body = 0; body < 2; ++body) {
    mesh::ElementBlock block;
    block.shape = mesh::Shape::tri3;
    block.body = body;
    block.nodes = {0, 1, 2};
    mesh.blocks.push_back(block);
  }
  return mesh;
}

TEST(NodalPhases, AreThoseOfTheBodysOwnMaterial) {
  const mesh::Mesh mesh = shared_nodes();
  const std::vector<material::Material> materials = {
      with({{"freezing", PhaseFraction::linear(900, 900), 4e5, -0.06, true}}),
      with({{"freezing", PhaseFraction::linear(850, 950), 4e5, 0.02, true},
            {"in the solid", PhaseFraction::linear(870, 870), 1e4, 0.01, false}})};
  const std::vector<double> initial(3, 1000.0), temperature = {900, 870, 899};
  mechanics::NodalPhases phases(mesh, materials, initial);

  const std::vector<double> share = {0.25, 0.4, 1};
  const mechanics::PhaseFields first = phases.evaluate(0, {temperature, share}, {});
  EXPECT_THAT(first.solid_fraction, testing::ElementsAre(0.75, 1, 1));
  EXPECT_DOUBLE_EQ(first.straining[0], -0.06 * 0.75);
  EXPECT_DOUBLE_EQ(first.straining[1], -0.06);
  const mechanics::PhaseFields second = phases.evaluate(1, {temperature, share}, {});
  EXPECT_THAT(second.solid_fraction,
              testing::ElementsAre(testing::DoubleEq(0.5), testing::DoubleEq(0.8), testing::DoubleEq(0.51)));
  EXPECT_DOUBLE_EQ(second.straining[1], 0.02 * 0.8 + 0.01 * 0.6);
  EXPECT_DOUBLE_EQ(second.straining[2], 0.02 * 0.51);
}

TEST(NodalPhases, StartMoltenAtTheTemperatureOfAnIsothermalChange) {
  const mesh::Mesh mesh = shared_nodes();
  const std::vector<material::Material> materials(
      2, with({{"freezing", PhaseFraction::linear(900, 900), 4e5, -0.06, true}}));
  const std::vector<double> initial(3, 900.0);
  mechanics::NodalPhases phases(mesh, materials, initial);
  const mechanics::PhaseFields start = phases.evaluate(0, {initial, {}}, {});
  EXPECT_THAT(start.solid_fraction, testing::Each(0.0));
  EXPECT_THAT(start.straining, testing::Each(0.0));
  const std::vector<double> cold(3, 899.9);
  EXPECT_THAT(phases.evaluate(0, {cold, {}}, {}).straining, testing::Each(-0.06));
}

TEST(NodalPhases, OfAStepAreTheMeanOfItsEndsAndItsStrainIsThatOfTheEnd) {
  const mesh::Mesh mesh = shared_nodes();
  std::vector<material::Material> materials = {
      with({{"freezing", PhaseFraction::linear(850, 950), 4e5, -0.06, true}}),
      with({{"freezing", PhaseFraction::linear(900, 1000), 4e5, 0.02, true}})};
  materials[1].name = "another";
  const std::vector<double> initial(3, 1000.0), before = {950, 900, 850}, now = {900, 850, 800};
  mechanics::NodalPhases phases(mesh, materials, initial);
  EXPECT_THAT(phases.initial_solid_fraction(), testing::Each(0.0));
  const std::vector<double> at_start = phases.solid_fraction({before, {}});
  const mechanics::PhaseFields first = phases.evaluate(0, {now, {}}, at_start);
  EXPECT_THAT(first.solid_fraction,
              testing::ElementsAre(testing::DoubleEq(0.25), testing::DoubleEq(0.75), testing::DoubleEq(1)));
  EXPECT_DOUBLE_EQ(first.straining[0], -0.06 * 0.5);
  EXPECT_DOUBLE_EQ(first.straining[1], -0.06);
  // Bodies of other materials have their own fractions at the nodes that they share.
  const mechanics::PhaseFields second = phases.evaluate(1, {now, {}}, at_start);
  EXPECT_THAT(second.solid_fraction,
              testing::ElementsAre(testing::DoubleEq(0.75), testing::DoubleEq(1), testing::DoubleEq(1)));
  const std::vector<double> mean = phases.mean_solid_fraction(at_start, {now, {}});
  ASSERT_EQ(phases.fields().n_fields, 2);
  EXPECT_DOUBLE_EQ(mean[0], 0.25);
  EXPECT_DOUBLE_EQ(mean[1], 0.75);
}

TEST(NodalPhases, AreSolidInAStepOnlyIfTheyWereSoAtBothEnds) {
  const mesh::Mesh mesh = shared_nodes();
  const std::vector<material::Material> materials(
      2, with({{"freezing", PhaseFraction::linear(900, 900), 4e5, -0.06, true}}));
  const std::vector<double> initial(3, 1000.0), cold(3, 800.0);
  mechanics::NodalPhases phases(mesh, materials, initial);
  const std::vector<double> melt = phases.initial_solid_fraction(), solid = phases.solid_fraction({cold, {}});
  EXPECT_THAT(phases.evaluate(0, {cold, {}}, melt).solid_fraction, testing::Each(0.5));
  EXPECT_THAT(phases.evaluate(0, {initial, {}}, solid).solid_fraction, testing::Each(0.5));
  EXPECT_THAT(phases.evaluate(0, {cold, {}}, solid).solid_fraction, testing::Each(1.0));
}

TEST(NodalPhases, ContractAsSolidIfTheyCompleteAnIsothermalChangeInAStep) {
  const mesh::Mesh mesh = shared_nodes();
  const std::vector<material::Material> materials(
      2, with({{"freezing", PhaseFraction::linear(900, 900), 4e5, -0.06, true}}));
  const std::vector<double> initial(3, 1000.0), now = {900, 890, 800};
  mechanics::NodalPhases phases(mesh, materials, initial);
  const std::vector<double> before = {0.2, 0.8, 1}, share = {0.5, 0, 0};
  const mechanics::PhaseFields step = phases.evaluate(0, {now, share}, before);
  EXPECT_THAT(step.solid_fraction,
              testing::ElementsAre(testing::DoubleEq(0.35), testing::DoubleEq(0.9), testing::DoubleEq(1)));
  EXPECT_THAT(step.contracting, testing::ElementsAre(testing::DoubleEq(0.35), 1, 1));
  // Metal that stays within the change, or melts a little again, is not complete.
  const std::vector<double> plateau(3, 900.0), stays = {0.5, 0.6, 0.999}, liquid = {0.5, 0.41, 0.01};
  EXPECT_THAT(
      phases.evaluate(0, {plateau, liquid}, stays).contracting,
      testing::ElementsAre(testing::DoubleEq(0.5), testing::DoubleEq(0.595), testing::DoubleEq(0.9945)));
}

TEST(NodalPhases, OfAMaterialWithoutPhaseChangesAreNone) {
  const mesh::Mesh mesh = shared_nodes();
  const std::vector<material::Material> materials(2, with({}));
  const std::vector<double> initial(3, 900.0);
  mechanics::NodalPhases phases(mesh, materials, initial);
  EXPECT_TRUE(phases.evaluate(0, {initial, {}}, {}).solid_fraction.empty());
  EXPECT_TRUE(phases.evaluate(0, {initial, {}}, {}).straining.empty());
}

/// Quadratic basis functions are negative in places; a fraction between 0 and 1 at the nodes stays there.
TEST(WithinNodes, NoPointLeavesTheRangeOfItsNodes) {
  for (const mesh::Shape shape :
       {mesh::Shape::tri6, mesh::Shape::quad8, mesh::Shape::tet10, mesh::Shape::hex20}) {
    const mesh::Mesh mesh = test::make_mesh({.shape = shape, .cells = {2, 2, 2}, .distortion = 0.2});
    const AnalysisKind kind = mesh::dimension(shape) == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain;
    const mesh::BlockGeometry geometry(mesh, mesh.blocks.front(), kind, mesh::stiffness_rule(shape));
    std::vector<double> fraction, uniform(mesh.x.size(), 1.0 / 3);
    for (std::size_t i = 0; i < mesh.x.size(); ++i) fraction.push_back(i % 2 == 0 ? 0.0 : 1.0);
    bool beyond = false;
    for (Index batch = 0; batch < geometry.n_batches; ++batch)
      for (int q = 0; q < geometry.n_points; ++q)
        for (int lane = 0; lane < k_lanes; ++lane) {
          const double value = mechanics::within_nodes(geometry, batch, q, fraction)[lane];
          EXPECT_GE(value, 0);
          EXPECT_LE(value, 1);
          const double plain = mechanics::temperature_at(geometry, batch, q, fraction)[lane];
          beyond = beyond || plain < 0 || plain > 1;
          EXPECT_EQ(mechanics::within_nodes(geometry, batch, q, uniform)[lane], 1.0 / 3);
        }
    EXPECT_TRUE(beyond || mesh.blocks.front().size() == 0) << "the test shows nothing";
  }
}

}  // namespace
}  // namespace solidus
