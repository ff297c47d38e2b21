/// Supports that the program finds by itself.
#include "mechanics/loads/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/parts/distribute.hpp"
#include "parallel/parallel.hpp"

namespace solidus {
namespace {

/// A thin rod along the axis with a wide disc at its upper end, one element across each.
mesh::RawMesh rod_with_disc(int n_along, double off_axis) {
  mesh::RawMesh raw;
  raw.dimension = 2;
  const auto add_node = [&](double r, double z) {
    raw.x.push_back({r, z, 0});
    raw.input_node.push_back(static_cast<GlobalIndex>(raw.x.size()));
    return static_cast<Index>(raw.x.size() - 1);
  };
  mesh::RawBlock block{mesh::Shape::quad4, {}, {}};
  for (int j = 0; j <= n_along; ++j) {
    const Index left = add_node(off_axis, 1e-3 * j), right = add_node(1e-3, 1e-3 * j);
    if (j > 0) block.nodes.insert(block.nodes.end(), {left - 2, right - 2, right, left});
  }
  const Index last = static_cast<Index>(raw.x.size()) - 1;
  const Index low = add_node(1, 1e-3 * (n_along - 1)), high = add_node(1, 1e-3 * n_along);
  block.nodes.insert(block.nodes.end(), {last - 2, low, high, last});
  for (std::size_t e = 0; e < block.nodes.size() / 4; ++e)
    block.input_element.push_back(static_cast<GlobalIndex>(e + 1));
  raw.groups["rod"] = {2, {block}};
  return raw;
}

// The tolerance of the axis is a share of the largest radius of all processes: by the rod's alone, 1e-3 m,
// its nodes at 5e-12 m would be next to the axis for a process that has nothing of the disc.
TEST(Loads, NodesOnTheAxisAreHeldWhateverProcessHasThem) {
  const mesh::Mesh mesh = mesh::distribute(rod_with_disc(40, 5e-12), {"rod"}, {});
  const linear::ActiveSet active(mesh);
  const std::vector<double> start(2 * mesh.x.size(), 0.0);
  const mechanics::Loads loads(mesh, AnalysisKind::axisymmetric, {}, active, start);
  double held = 0;
  for (Index node = 0; node < mesh.n_nodes(); ++node) {
    const auto i = static_cast<std::size_t>(node);
    EXPECT_EQ(loads.fixed()[2 * i] != 0, mesh.x[i][0] < 1e-9) << mesh.x[i][1];
    EXPECT_EQ(loads.fixed()[2 * i + 1], 0);
    if (node < mesh.n_owned_nodes && loads.fixed()[2 * i]) held += 1;
  }
  EXPECT_EQ(parallel::global_sum(held), 41);
}

}  // namespace
}  // namespace solidus
