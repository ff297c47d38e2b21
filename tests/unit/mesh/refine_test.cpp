// A refined mesh is the mesh: the same bodies, surfaces and sets, of elements of half the size, on any number
// of processes.
#include "mesh/refinement/refine.hpp"

#include <gtest/gtest.h>

#include <mpi.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "mesh/parts/distribute.hpp"
#include "mesh/quadrature.hpp"
#include "mesh/refinement/lattice.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;

struct Refined {
  Mesh mesh;
  RefinementReport report;
};

Refined refined(RawMesh raw, int times, bool curved = true, std::vector<std::string> bodies = {"block"},
                const std::vector<std::string>& replicated = {}) {
  std::vector<OtherGroup> others;
  if (processes::rank() == 0) others = prepare_refinement(raw, bodies);
  Refined made;
  made.mesh = refine(distribute(raw, bodies, replicated), {times, curved}, others, made.report);
  return made;
}

/// Volume of the counted elements of all processes, by Gauss points.
double measure(const Mesh& mesh, const std::vector<ElementBlock>& blocks) {
  double sum = 0;
  for (const ElementBlock& block : blocks) {
    const auto dim = static_cast<std::size_t>(mesh::dimension(block.shape));
    const auto n = static_cast<std::size_t>(node_count(block.shape));
    for (Index e = 0; e < block.n_counted; ++e)
      for (const QuadraturePoint& p : gauss_rule(block.shape, 3)) {
        std::vector<double> g(n * dim);
        basis_gradients(block.shape, p.xi, g);
        std::array<Point, 3> t{};
        for (std::size_t a = 0; a < n; ++a)
          for (std::size_t k = 0; k < dim; ++k)
            for (std::size_t i = 0; i < 3; ++i)
              t[k][i] += mesh.x[static_cast<std::size_t>(block.element(e)[a])][i] * g[a * dim + k];
        const Point c{t[0][1] * t[1][2] - t[0][2] * t[1][1], t[0][2] * t[1][0] - t[0][0] * t[1][2],
                      t[0][0] * t[1][1] - t[0][1] * t[1][0]};
        if (dim == 1) sum += p.weight * std::hypot(t[0][0], t[0][1], t[0][2]);
        if (dim == 2) sum += p.weight * std::hypot(c[0], c[1], c[2]);
        if (dim == 3) sum += p.weight * (c[0] * t[2][0] + c[1] * t[2][1] + c[2] * t[2][2]);
      }
  }
  return global_sum(sum);
}

double count(const std::vector<ElementBlock>& blocks) {
  double n = 0;
  for (const ElementBlock& b : blocks) n += b.n_counted;
  return global_sum(n);
}

class EveryShapeRefined : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryShapeRefined, ::testing::ValuesIn(k_body_shapes),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(EveryShapeRefined, HasTheNodesOfABoxOfTwiceTheDivisions) {
  const RawMesh raw = sample_box(GetParam());
  OneBlock twice{{0.5, 0.3}, {0, 0}, {8, 6}};
  if (raw.dimension == 3) twice = {{0.5, 0.3, 0.4}, {0, 0, 0}, {8, 6, 4}};
  const Mesh expected = distribute(make_block(twice, GetParam()), {"block"}, {});
  const Mesh m = refined(raw, 1).mesh;
  EXPECT_EQ(m.n_global_nodes, expected.n_global_nodes);
  EXPECT_EQ(count(m.blocks), count(expected.blocks));
  EXPECT_EQ(m.surfaces.size(), expected.surfaces.size());
  for (const auto& [side, surface] : expected.surfaces) {
    EXPECT_EQ(count(m.surfaces.at(side).faces), count(surface.faces)) << side;
    double nodes = 0, expected_nodes = 0;
    for (const Index i : m.node_sets.at(side)) nodes += i < m.n_owned_nodes ? 1 : 0;
    for (const Index i : expected.node_sets.at(side)) expected_nodes += i < expected.n_owned_nodes ? 1 : 0;
    EXPECT_EQ(global_sum(nodes), global_sum(expected_nodes)) << side;
  }
}

TEST_P(EveryShapeRefined, KeepsVolumeAndAreasOfAFlatBody) {
  const RawMesh raw = sample_box(GetParam());
  const Mesh whole = distribute(raw, {"block"}, {}), m = refined(raw, 2).mesh;
  EXPECT_NEAR(measure(m, m.blocks), measure(whole, whole.blocks), 1e-12 * 0.06);
  for (const auto& [side, surface] : whole.surfaces)
    EXPECT_NEAR(measure(m, m.surfaces.at(side).faces), measure(whole, surface.faces), 1e-12) << side;
}

TEST_P(EveryShapeRefined, CountsEveryElementOnceAndHoldsThoseOfItsNodes) {
  const Mesh m = refined(sample_box(GetParam()), 2, true, {"block"}, {"x_max"}).mesh;
  // Numbers are those of a whole mesh: each owned node once, each counted element once.
  const std::vector<std::int64_t> first = processes::gather(std::int64_t{m.first_owned});
  EXPECT_EQ(m.first_owned, processes::sum_before(m.n_owned_nodes));
  std::set<GlobalIndex> input(m.input_node.begin(), m.input_node.end());
  EXPECT_EQ(input.size(), m.input_node.size());
  for (Index i = 0; i < m.n_nodes(); ++i) {
    const GlobalIndex g = m.global_node[static_cast<std::size_t>(i)] - m.first_owned;
    EXPECT_EQ(i < m.n_owned_nodes, g >= 0 && g < m.n_owned_nodes);
    if (i < m.n_owned_nodes) EXPECT_EQ(g, i);
  }
  // Around an owned node inside of the box the elements fill a whole sphere of angles: their shares of the
  // node sum to its full weight, which is known from the volume of all.
  double weight = 0;
  for (const ElementBlock& b : m.blocks)
    for (Index e = 0; e < b.size(); ++e)
      for (int a = 0; a < node_count(b.shape); ++a) weight += b.element(e)[a] < m.n_owned_nodes ? 1 : 0;
  double all = 0;
  for (const ElementBlock& b : m.blocks) all += static_cast<double>(b.n_counted) * node_count(b.shape);
  EXPECT_EQ(global_sum(weight), global_sum(all));
}

/// Hashes of the counted nodes with their places, and of the counted elements with their nodes, by numbers in
/// the input.
std::array<std::uint64_t, 2> hashes(const Mesh& m) {
  const auto mix = [](std::uint64_t h) {
    h *= 0x9E3779B97F4A7C15ULL;
    return h ^ h >> 31;
  };
  std::array<std::uint64_t, 2> sum{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.n_owned_nodes); ++i) {
    std::uint64_t h = mix(static_cast<std::uint64_t>(m.input_node[i]));
    for (const double c : m.x[i]) h = mix(h ^ std::bit_cast<std::uint64_t>(c));
    sum[0] += h;
  }
  for (const ElementBlock& b : m.blocks)
    for (Index e = 0; e < b.n_counted; ++e) {
      std::uint64_t h = mix(static_cast<std::uint64_t>(b.input_element[static_cast<std::size_t>(e)]));
      for (int a = 0; a < node_count(b.shape); ++a)
        h = mix(h ^ static_cast<std::uint64_t>(m.input_node[static_cast<std::size_t>(b.element(e)[a])]));
      sum[1] += h;
    }
  processes::sum(std::span<std::uint64_t>(sum));
  return sum;
}

TEST_P(EveryShapeRefined, HasTheSameNumbersAndPlacesAsOnOneProcess) {
  RawMesh raw = sample_box(GetParam());
  for (Point& x : raw.x) x[1] += 0.4 * x[0] * x[0];  // bent, so that there are arcs
  const Refined shared = refined(raw, 2);
  if (order(GetParam()) == 1) EXPECT_GT(shared.report.on_arcs, 0);
  const std::array<std::uint64_t, 2> of_all = hashes(shared.mesh);
  // Each process alone, as if there were no other.
  const int all = processes::communicator();
  processes::use_communicator(MPI_Comm_c2f(MPI_COMM_SELF));
  const std::array<std::uint64_t, 2> of_one = hashes(refined(raw, 2).mesh);
  processes::use_communicator(all);
  EXPECT_EQ(of_all, of_one);
}

/// A ball of radius 1 of tetrahedra: a cube of 2 x 2 x 2 cells with its outer nodes moved to the sphere.
RawMesh ball(Shape shape, int divisions) {
  RawMesh raw = make_block({{2, 2, 2}, {-1, -1, -1}, {divisions, divisions, divisions}}, shape);
  for (Point& x : raw.x) {
    const double far = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    const double length = std::hypot(x[0], x[1], x[2]);
    if (length > 0)
      for (double& c : x) c *= far / length;
  }
  return raw;
}

TEST(RefinedBall, ConvergesWithOrderTwo) {
  for (const Shape shape : {Shape::tet4, Shape::hex8}) {
    std::vector<double> errors;
    for (int n = 0; n <= 2; ++n) {
      const Refined r = refined(ball(shape, 4), n);
      errors.push_back(std::abs(measure(r.mesh, r.mesh.blocks) - 4 * std::numbers::pi / 3));
    }
    // Normals come from quadrics through the nodes of the first mesh, whose own error shows in the end.
    for (std::size_t n = 1; n < errors.size(); ++n) EXPECT_GT(std::log2(errors[n - 1] / errors[n]), 1.7);
    // Without arcs the ball stays the polyhedron that it was.
    const Refined flat = refined(ball(shape, 4), 1, false);
    EXPECT_GT(std::abs(measure(flat.mesh, flat.mesh.blocks) - 4 * std::numbers::pi / 3), 0.5 * errors[0]);
  }
}

}  // namespace
