/// Heat from outside: contributions that couple two bodies.
#include <gtest/gtest.h>

#include "block.hpp"

namespace solidus {
namespace {

/// A conductance between facing nodes of two bodies, as a contact would add it. One process only.
class Bridge : public linear::Contribution {
 public:
  Bridge(std::vector<std::array<Index, 2>> pairs, double conductance)
      : pairs_(std::move(pairs)), conductance_(conductance) {}
  void add_to_graph(linear::NodeGraph& graph) const override {
    for (const auto& pair : pairs_) graph.add_cliques(pair, 2);
  }
  void bind(const linear::BlockMatrix& matrix) override {
    for (const auto& pair : pairs_) slots_.push_back(matrix.clique_slots(pair, 2));
  }
  void add_residual(std::span<const double> x, std::span<double> r) override {
    for (const auto& [a, b] : pairs_) {
      const double q = conductance_ * (x[static_cast<std::size_t>(a)] - x[static_cast<std::size_t>(b)]);
      r[static_cast<std::size_t>(a)] += q;
      r[static_cast<std::size_t>(b)] -= q;
    }
  }
  void add_tangent(std::span<const double>, linear::BlockMatrix& matrix) override {
    for (const auto& s : slots_)
      for (std::size_t i = 0; i < 4; ++i) *matrix.block(s[i]) += (i == 0 || i == 3 ? 1 : -1) * conductance_;
  }

 private:
  std::vector<std::array<Index, 2>> pairs_;
  std::vector<std::vector<linear::BlockMatrix::Slot>> slots_;
  double conductance_;
};

TEST(Contributions, BringTwoBodiesToTheTemperatureAtWhichTheirHeatsAddUp) {
  if (test::processes() > 1) return;  // the bridge of this test knows local nodes only
  mesh::RawMesh raw =
      mesh::make_two_blocks({{0.01, 0.01}, {0.01, 0.01}, {4, 4}, {4, 4}, 0.001}, mesh::Shape::quad4);
  mesh::validate_and_orient(raw, "blocks");
  const mesh::Mesh mesh = mesh::distribute(raw, {"lower", "upper"}, {});
  std::vector<std::array<Index, 2>> pairs;
  for (const Index a : mesh.surfaces.at("lower_top").nodes)
    for (const Index b : mesh.surfaces.at("upper_bottom").nodes)
      if (std::abs(mesh.x[static_cast<std::size_t>(a)][0] - mesh.x[static_cast<std::size_t>(b)][0]) < 1e-9)
        pairs.push_back({a, b});
  ASSERT_EQ(pairs.size(), 5U);
  Bridge bridge(pairs, 20.0);
  material::Material mould = test::metal(40);
  mould.phase_changes.clear();
  // The melt gives up a quarter of its latent heat at 900 K: 7e8/4 J/m³ warm the mould by 70 K, to 900 K.
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {test::metal(0), mould}, {}, {}, {&bridge});
  heat::ThermalState state = phase.states().initial(std::vector<double>{900.0, 830.0});
  double time = 0;
  for (int i = 0; i < 40; ++i) {
    const double dt = std::pow(1.3, i);
    time += dt;
    const heat::ThermalReport report = phase.solve(state, state, time, dt);
    EXPECT_NEAR(report.balance.contributions[0], 0.0, 1e-9 * report.balance.exchanged + 1e-9);
    EXPECT_NEAR(report.balance.stored, 0.0, 1e-8 * report.balance.exchanged + 1e-7);
  }
  for (double t : state.temperature) EXPECT_NEAR(t, 900.0, 1e-6);
  EXPECT_NEAR(phase.states().mean_solid_fraction(state, 0), 0.25, 1e-8);
  EXPECT_NEAR(phase.states().mean_solid_fraction(state), 0.25, 1e-8);  // the mould cannot melt
  EXPECT_EQ(phase.states().mean_solid_fraction(state, 1), 1.0);
}

}  // namespace
}  // namespace solidus
