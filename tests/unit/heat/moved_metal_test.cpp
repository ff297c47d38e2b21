/// Metal that moves takes its heat along, and emptied places conduct and store as gas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "block.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "parallel/parallel.hpp"

namespace solidus {
namespace {

constexpr double k_height = 0.1;  // [m]
const std::vector<char> k_moves = {1};

/// A block that is cooled from below; its top is y = k_height.
struct Block {
  explicit Block(mesh::Shape shape, double range)
      : mesh(test::block_mesh(
            shape, test::is_3d(shape) ? std::vector{0.02, k_height, 0.02} : std::vector{0.02, k_height},
            test::is_3d(shape) ? std::vector{2, 10, 2} : std::vector{2, 10})),
        kind(test::is_3d(shape) ? AnalysisKind::solid : AnalysisKind::plane_strain),
        phase(mesh, kind, {test::metal(range)}, conditions()) {}

  static heat::ThermalConditions conditions() {
    heat::ThermalConditions cooled;
    cooled.films.push_back({"wall", "y_min", {2000.0}, 300.0});
    return cooled;
  }
  heat::ThermalState frozen_in_part() {
    heat::ThermalState state = phase.states().initial(std::vector<double>{950.0});
    for (int i = 1; i <= 8; ++i) phase.solve(state, state, 4.0 * i, 4.0);
    return state;
  }
  /// The top fifth has lost most of its metal, and what is below has got it.
  heat::MovedMetal drained(double left) {
    double lost = 0, below = 0;
    const auto top = [&](Index i) { return mesh.x[static_cast<std::size_t>(i)][1] > 0.8 * k_height - 1e-9; };
    for (Index i = 0; i < mesh.n_owned_nodes; ++i)
      (top(i) ? lost : below) += phase.storage().volume(i, 0) * (top(i) ? 1 - left : 1.0);
    const double gain = parallel::global_sum(lost) / parallel::global_sum(below);
    held.assign(static_cast<std::size_t>(mesh.n_owned_nodes), 1 + gain);
    filled.assign(mesh.x.size(), 1.0);
    for (Index i = 0; i < mesh.n_nodes(); ++i)
      if (top(i)) filled[static_cast<std::size_t>(i)] = left;
    for (Index i = 0; i < mesh.n_owned_nodes; ++i)
      if (top(i)) held[static_cast<std::size_t>(i)] = left;
    return {k_moves, held, filled};
  }
  double heat(const heat::ThermalState& state) const {
    double sum = 0;
    for (Index i = 0; i < mesh.n_owned_nodes; ++i) sum += state.enthalpy[static_cast<std::size_t>(i)];
    return parallel::global_sum(sum);
  }

  mesh::Mesh mesh;
  AnalysisKind kind;
  heat::ThermalPhase phase;
  std::vector<double> held, filled;
};

class MovedMetal : public ::testing::TestWithParam<mesh::Shape> {};

TEST_P(MovedMetal, TakesItsHeatAlong) {
  for (const double range : {0.0, 40.0}) {
    Block block(GetParam(), range);
    heat::ThermalState state = block.frozen_in_part();
    const heat::ThermalState before = state;
    const double heat = block.heat(state);
    const std::vector<double> solid = block.phase.states().solid_fraction(state);
    block.phase.move_metal(block.drained(0.25), &state);
    EXPECT_NEAR(block.heat(state), heat, 1e-12 * heat);
    for (Index i = 0; i < block.mesh.n_owned_nodes; ++i) {
      const auto node = static_cast<std::size_t>(i);
      // What is left at a node that lost metal is as it was; what was colder than the metal that came is
      // warmer.
      if (block.held[node] < 1)
        EXPECT_NEAR(state.temperature[node], before.temperature[node], 1e-3);
      else
        EXPECT_GT(state.enthalpy[node], before.enthalpy[node] * block.held[node] * (1 - 1e-9));
    }
    // The room of the nodes stays, and a step closes its balance as before.
    const double content = block.phase.states().heat_content(state);
    const heat::ThermalReport report = block.phase.solve(state, state, 36.0, 4.0);
    EXPECT_LT(report.newton.iterations, 30);
    const double left = content - block.phase.states().heat_content(state);
    EXPECT_GT(left, 0);
    // The same metal again moves nothing.
    const heat::ThermalState still = state;
    block.phase.move_metal(block.drained(0.25), &state);
    EXPECT_EQ(state.enthalpy, still.enthalpy);
    EXPECT_EQ(state.temperature, still.temperature);
  }
}

TEST_P(MovedMetal, GoesOnFromAStateThatHasItsHeat) {
  Block run(GetParam(), 40), again(GetParam(), 40);
  heat::ThermalState state = run.frozen_in_part();
  run.phase.move_metal(run.drained(0.1), &state);
  heat::ThermalState stopped = state;
  again.phase.move_metal(again.drained(0.1), nullptr);
  heat::forget(run.phase);
  for (int i = 1; i <= 3; ++i) {
    run.phase.solve(state, state, 36.0 + i, 1.0);
    again.phase.solve(stopped, stopped, 36.0 + i, 1.0);
  }
  EXPECT_EQ(state.enthalpy, stopped.enthalpy);
  EXPECT_EQ(state.temperature, stopped.temperature);
}

// A bar between two temperatures whose middle is empty: resistances in series, element by element, of metal
// and of air at 0.06 W/(m K).
TEST_P(MovedMetal, LeavesGasThatConducts) {
  constexpr double k_gas = 0.06, k_metal = 100, k_hot = 700, k_cold = 400, k_cell = k_height / 10;
  Block block(GetParam(), 40);
  heat::ThermalConditions held;
  held.temperatures.push_back({"cold", "y_min", k_cold});
  held.temperatures.push_back({"hot", "y_max", k_hot});
  heat::ThermalPhase phase(block.mesh, block.kind, {test::metal(40)}, held);
  std::vector<double> amount(static_cast<std::size_t>(block.mesh.n_owned_nodes), 1.0),
      filled(block.mesh.x.size(), 1.0);
  for (std::size_t i = 0; i < filled.size(); ++i)
    if (std::abs(block.mesh.x[i][1] - 0.5 * k_height) < 1.5 * k_cell) filled[i] = 0;
  phase.move_metal({k_moves, amount, filled}, nullptr);
  heat::ThermalState state = phase.states().initial(std::vector<double>{500.0});
  phase.solve_steady(state, state, 0);
  // Elements with half of their nodes empty conduct by the mean of both. Triangles and tetrahedra have a
  // third or a quarter, so that the field is one of quads and hexes alone.
  const auto resistance = [](int cell) {
    const double share = cell == 4 || cell == 5 ? 0.0 : cell == 3 || cell == 6 ? 0.5 : 1.0;
    return k_cell / (k_gas + (k_metal - k_gas) * share);
  };
  double all = 0, below = 0;
  for (int cell = 0; cell < 10; ++cell) all += resistance(cell);
  for (int cell = 0; cell < 4; ++cell) below += resistance(cell);
  for (std::size_t i = 0; i < filled.size(); ++i)
    if (std::abs(block.mesh.x[i][1] - 0.4 * k_height) < 1e-9)
      EXPECT_NEAR(state.temperature[i], k_cold + (k_hot - k_cold) * below / all, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Shapes, MovedMetal, ::testing::Values(mesh::Shape::quad4, mesh::Shape::hex8));

}  // namespace
}  // namespace solidus
