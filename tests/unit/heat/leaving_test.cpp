/// Bodies that leave the thermal phase: what stays goes on as if it had never had them.
#include <gtest/gtest.h>

#include <map>

#include "../mesh/split_block.hpp"
#include "block.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "system/processes.hpp"

namespace solidus {
namespace {

constexpr double k_plane = 0.02;  ///< between part (left) and mould (right) [m]

mesh::Mesh part_and_mould(mesh::Shape shape, const std::vector<std::string>& bodies) {
  mesh::RawMesh raw;
  const int rank = processes::rank();
  if (rank == 0) raw = test::split_block(shape, {0.05, 0.02}, {10, 4}, k_plane);
  return mesh::distribute(raw, bodies, {});
}

material::Material mould() {
  material::Material m = test::metal(40);
  m.phase_changes.clear();
  m.conductivity = Table({300, 900}, {20.0, 10.0});
  return m;
}

heat::ThermalConditions in_air() {
  heat::ThermalConditions air;
  air.films.push_back({"air", "between", {3000.0}, 300.0});
  return air;
}

/// Temperatures at the nodes by their number in the input.
std::map<GlobalIndex, double> by_number(const mesh::Mesh& mesh, const heat::ThermalState& state) {
  std::map<GlobalIndex, double> values;
  for (Index i = 0; i < mesh.n_owned_nodes; ++i)
    values[mesh.input_node[static_cast<std::size_t>(i)]] = state.temperature[static_cast<std::size_t>(i)];
  return values;
}

struct Case {
  mesh::Shape shape;
  heat::HeatIntegration integration;
  double range;  ///< of freezing [K]; zero: isothermal
};
class Leaving : public ::testing::TestWithParam<Case> {};

// The reference is a phase on a mesh of the part alone that starts from the part's temperatures (and, on a
// plateau, from its heat): only the linear solvers' tolerance lies between the two.
TEST_P(Leaving, ThePartGoesOnAsIfTheMouldHadNeverBeen) {
  const Case& p = GetParam();
  if (test::processes() > 1) return;  // the reference takes over the numbering of one process
  const mesh::Mesh both = part_and_mould(p.shape, {"left", "right"}),
                   alone = part_and_mould(p.shape, {"left"});
  heat::HeatOptions options;
  options.integration = p.integration;
  const material::Material metal = test::metal(p.range);
  heat::ThermalPhase phase(both, AnalysisKind::plane_strain, {metal, mould()}, {}, options);
  heat::ThermalPhase reference(alone, AnalysisKind::plane_strain, {metal}, in_air(), options);

  heat::ThermalState state = phase.states().initial(std::vector<double>{920.0, 300.0});
  for (int i = 1; i <= 5; ++i) phase.solve(state, state, i, 1.0);
  heat::ThermalConditions air = in_air();
  air.absent_bodies = {"right"};
  const heat::ThermalState before = state;
  const double carried = phase.set_conditions(air, &state).away;
  EXPECT_GT(carried, 0);
  EXPECT_EQ(state.temperature, before.temperature);

  std::map<GlobalIndex, std::size_t> place;
  for (std::size_t i = 0; i < both.x.size(); ++i) place[both.input_node[i]] = i;
  std::vector<double> start(alone.x.size());
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = state.temperature[place.at(alone.input_node[i])];
  heat::ThermalState part = reference.states().initial_at_nodes(start);
  for (std::size_t i = 0; i < part.enthalpy.size(); ++i)
    part.enthalpy[i] = state.enthalpy[place.at(alone.input_node[i])];

  for (int i = 1; i <= 20; ++i) {
    const heat::ThermalReport here = phase.solve(state, state, 5 + i, 1.0);
    const heat::ThermalReport there = reference.solve(part, part, 5 + i, 1.0);
    EXPECT_NEAR(here.balance.defect(), 0, 1e-8 * here.balance.exchanged);
    EXPECT_NEAR(here.balance.stored, there.balance.stored, 1e-7 * there.balance.exchanged);
    ASSERT_EQ(here.balance.conditions.size(), 1u);
  }
  EXPECT_NEAR(phase.states().mean_solid_fraction(state), reference.states().mean_solid_fraction(part), 1e-7);
  const auto mine = by_number(both, state), theirs = by_number(alone, part);
  for (const auto& [node, temperature] : theirs) EXPECT_NEAR(mine.at(node), temperature, 1e-5) << node;
  for (std::size_t i = 0; i < both.x.size(); ++i) {  // the mould keeps what it had
    if (both.x[i][0] <= k_plane + 1e-9) continue;
    EXPECT_EQ(state.temperature[i], before.temperature[i]);
  }
}

using mesh::Shape;
INSTANTIATE_TEST_SUITE_P(Rules, Leaving,
                         ::testing::Values(Case{Shape::quad4, heat::HeatIntegration::closed, 40},
                                           Case{Shape::quad4, heat::HeatIntegration::closed, 0},
                                           Case{Shape::tri3, heat::HeatIntegration::closed, 0},
                                           Case{Shape::quad4, heat::HeatIntegration::open, 40},
                                           Case{Shape::tri6, heat::HeatIntegration::open, 40}));

class LeavingBodies : public ::testing::TestWithParam<heat::HeatIntegration> {};
INSTANTIATE_TEST_SUITE_P(Rules, LeavingBodies,
                         ::testing::Values(heat::HeatIntegration::closed, heat::HeatIntegration::open));

TEST_P(LeavingBodies, CarryTheHeatThatIsMissingAfterwards) {
  const mesh::Mesh mesh = part_and_mould(Shape::quad4, {"left", "right"});
  heat::HeatOptions options;
  options.integration = GetParam();
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {test::metal(40), mould()}, {}, options);
  // A mould at 393.15 K, 100 K above what is counted, of 0.03 × 0.02 × 1 m³ and 2.5e6 J/(m³ K).
  const heat::ThermalState start = phase.states().initial(std::vector<double>{393.15, 393.15});
  heat::ThermalState state = start;  // a copy: with the open rule there is no storage for heat contents
  heat::ThermalConditions later;
  later.absent_bodies = {"right"};
  const double content = phase.states().heat_content(state);
  EXPECT_NEAR(phase.set_conditions(later, &state).away, 0.03 * 0.02 * 2.5e6 * 100, 1e-6);
  EXPECT_NEAR(phase.states().heat_content(state), content - 0.03 * 0.02 * 2.5e6 * 100, 1e-9 * content);
  // In a run that is continued, the heat of the bodies was removed before.
  EXPECT_EQ(phase.set_conditions(later).away, 0);
}

TEST_P(LeavingBodies, DoNotComeBackWithoutTheirHeat) {
  const mesh::Mesh mesh = part_and_mould(Shape::quad4, {"left", "right"});
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {test::metal(40), mould()}, {});
  heat::ThermalConditions later;
  later.absent_bodies = {"right"};
  phase.set_conditions(later);
  EXPECT_THROW(phase.set_conditions({}), std::invalid_argument);
}

// A part that comes back is the next one: the phase goes on as one that has never lost a body would from that
// state.
TEST_P(LeavingBodies, ComeBackNew) {
  const mesh::Mesh mesh = part_and_mould(Shape::quad4, {"left", "right"});
  heat::HeatOptions options;
  options.integration = GetParam();
  const std::vector<material::Material> materials{test::metal(40), mould()};
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, materials, {}, options);
  heat::ThermalPhase reference(mesh, AnalysisKind::plane_strain, materials, {}, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{920.0, 300.0});
  for (int i = 1; i <= 5; ++i) phase.solve(state, state, i, 1.0);
  heat::ThermalConditions alone;
  alone.absent_bodies = {"left"};
  phase.set_conditions(alone, &state);
  for (int i = 6; i <= 8; ++i) phase.solve(state, state, i, 1.0);

  const double content = phase.states().heat_content(state);
  const heat::ThermalState before = state;
  const heat::CarriedHeat carried = phase.set_conditions({}, &state, [&](Index, int body) {
    EXPECT_EQ(body, 0);
    return phase.storage().body_enthalpy(body, 920.0);
  });
  EXPECT_EQ(carried.away, 0);
  EXPECT_GT(carried.along, 0);
  EXPECT_NEAR(phase.states().heat_content(state), content + carried.along, 1e-9 * (content + carried.along));
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    if (mesh.x[i][0] < k_plane - 1e-9) {
      EXPECT_NEAR(state.temperature[i], 920.0, 1e-9);
    } else if (mesh.x[i][0] > k_plane + 1e-9) {
      EXPECT_EQ(state.temperature[i], before.temperature[i]);
    } else {  // mixed by their heats
      EXPECT_GT(state.temperature[i], before.temperature[i]);
    }
  }

  heat::ThermalState other = state;
  for (int i = 9; i <= 14; ++i) {
    const heat::ThermalReport here = phase.solve(state, state, i, 1.0);
    reference.solve(other, other, i, 1.0);
    EXPECT_NEAR(here.balance.defect(), 0, 1e-8 * here.balance.exchanged);
  }
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    EXPECT_NEAR(state.temperature[i], other.temperature[i], 1e-5) << i;
}

}  // namespace
}  // namespace solidus
