/// Melt that flows through mush: Darcy's law along a bar, and the pores that open where it does not get.
#include "criteria/mush_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "feeding_bodies.hpp"
#include "material/permeability.hpp"

namespace solidus {
namespace {

using criteria::MushLaw;
using criteria::MushPlace;
using mesh::Shape;

/// A bar of mush whose metal needs melt everywhere alike, with a pool at its left end.
struct Bar {
  static constexpr int k_cells = 100;
  static constexpr double k_length = 0.1, k_solid = 0.8;
  mesh::Mesh mesh = test::feeding_block(Shape::quad4, {k_length, 0.01}, {k_cells, 2});
  parallel::GhostExchange ghosts{mesh};
  criteria::FeedingGraph graph{mesh, AnalysisKind::plane_strain, {.bodies = {1}, .risers = {0}}};
  material::Material metal = test::shrinking_metal(880, 920);
  std::vector<MushLaw> laws{MushLaw(metal)};
  std::vector<double> pressure = std::vector<double>(mesh.x.size(), 0.0);

  /// @param need  melt per volume [1/s]
  criteria::MushResult solve(double need) {
    std::vector<MushPlace> place;
    for (const mesh::Point& x : mesh.x) place.push_back(x[0] < 1e-9 ? MushPlace::pool : MushPlace::mush);
    const std::vector<int> zero(mesh.x.size(), 0);
    const std::vector<double> solid(mesh.x.size(), k_solid), temperature(mesh.x.size(), 888);
    std::vector<double> flow;
    const heat::NodalEnthalpy storage(mesh, AnalysisKind::plane_strain, {metal});
    for (Index i = 0; i < mesh.n_owned_nodes; ++i) flow.push_back(need * storage.volume(i, 0));
    return criteria::flow_through_mush(graph, ghosts, laws,
                                       {.place = place,
                                        .pool = zero,
                                        .body = zero,
                                        .solid = solid,
                                        .temperature = temperature,
                                        .flow = flow,
                                        .n_pools = 1},
                                       pressure);
  }
  double mobility() const { return material::Permeability(metal.casting).mobility(k_solid); }
};

TEST(MushFlow, FollowsDarcysLaw) {
  Bar bar;
  const double lowest = 0.5e5, need = 2 * lowest * bar.mobility() / (Bar::k_length * Bar::k_length);
  const criteria::MushResult result = bar.solve(need);
  for (std::size_t i = 0; i < bar.mesh.x.size(); ++i) {
    const double x = bar.mesh.x[i][0] / Bar::k_length;
    EXPECT_NEAR(bar.pressure[i], -lowest * (2 * x - x * x), 1e-3 * lowest);
  }
  EXPECT_NEAR(result.from_pool[0], need * 0.001 * (1 - 0.5 / Bar::k_cells), 1e-5 * need * 0.001);
  for (const double pores : result.pores) EXPECT_EQ(pores, 0);
}

// Beyond x* = √(2 ΔP_cr K/(μ q)) the metal gets nothing.
TEST(MushFlow, OpensPoresBeyondTheReachOfThePressure) {
  Bar bar;
  const double reach = 0.6 * Bar::k_length, need = 2 * 1e5 * bar.mobility() / (reach * reach);
  const criteria::MushResult result = bar.solve(need);
  const double pores = parallel::global_sum(std::accumulate(result.pores.begin(), result.pores.end(), 0.0));
  EXPECT_NEAR(pores / (need * 0.001), 0.4, 0.01);
  for (std::size_t i = 0; i < result.pores.size(); ++i) {
    EXPECT_GE(bar.pressure[i], -1e5 * (1 + 1e-5));
    if (bar.mesh.x[i][0] < reach - 0.002) EXPECT_EQ(result.pores[i], 0) << bar.mesh.x[i][0];
    if (bar.mesh.x[i][0] > reach + 0.002) EXPECT_GT(result.pores[i], 0) << bar.mesh.x[i][0];
  }
}

// Mush that is thinner than an edge lets melt through to where it freezes however coarse the mesh is.
TEST(MushFlow, CountsThinMushByItsThickness) {
  const MushLaw law(test::shrinking_metal(880, 920));
  const double whole = law.mobility({0.9, 884}, {0.0, 920}), thin = law.mobility({0.9, 884}, {0.0, 1244});
  EXPECT_NEAR(thin / whole, 100, 1e-9);
}

}  // namespace
}  // namespace solidus
