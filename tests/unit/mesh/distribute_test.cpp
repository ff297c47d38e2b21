// The parts of a distributed mesh together are the mesh, on any number of processes.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <metis.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesh/parts/distribute.hpp"
#include "sample_mesh.hpp"
#include "system/common_failure.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace {

/// Simulated answer of METIS; if it is not METIS_OK, METIS is not called.
int answer_of_metis = METIS_OK;

}  // namespace

// Is linked before METIS's own function, which it calls unless METIS shall fail.
extern "C" int METIS_PartGraphRecursive(idx_t* n, idx_t* n_constraints, idx_t* start, idx_t* node,
                                        idx_t* weight, idx_t* size, idx_t* edge_weight, idx_t* n_parts,
                                        real_t* target, real_t* imbalance, idx_t* options, idx_t* cut,
                                        idx_t* part) {
  if (answer_of_metis != METIS_OK) return answer_of_metis;
  using Function = decltype(&METIS_PartGraphRecursive);
  static const auto of_library = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "METIS_PartGraphRecursive"));
  return of_library(n, n_constraints, start, node, weight, size, edge_weight, n_parts, target, imbalance,
                    options, cut, part);
}

namespace {

using namespace solidus;
using namespace solidus::test;

const CylinderInMould k_cylinder{0.015, 0.07, 0.02, 0.02, 0.1, 0.0015, 0.003};

Mesh cylinder(Shape shape = Shape::tri3,
              const std::vector<std::string>& replicated = {"part_surface", "mould_surface"}) {
  return distribute(make_cylinder_in_mould(k_cylinder, shape), {"part", "mould"}, replicated);
}

class EveryBodyShapeInParts : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryBodyShapeInParts, ::testing::ValuesIn(k_body_shapes),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(EveryBodyShapeInParts, EveryElementAndFaceIsCountedOnce) {
  const RawMesh raw = sample_box(GetParam());
  const Mesh m = distribute(raw, {"block"}, {"x_max"});
  double elements = 0, in_raw = 0;
  for (const ElementBlock& b : m.blocks) elements += b.n_counted;
  for (const RawBlock& b : raw.groups.at("block").blocks)
    in_raw += static_cast<double>(b.nodes.size()) / node_count(b.shape);
  EXPECT_EQ(global_sum(elements), in_raw);
  for (const auto& [side, group] : raw.groups) {
    if (group.dimension != raw.dimension - 1) continue;
    double faces = 0, faces_in_raw = 0;
    if (m.surfaces.contains(side))
      for (const ElementBlock& b : m.surfaces.at(side).faces) faces += b.n_counted;
    for (const RawBlock& b : group.blocks)
      faces_in_raw += static_cast<double>(b.nodes.size()) / node_count(b.shape);
    EXPECT_EQ(global_sum(faces), faces_in_raw) << side;
  }
}

TEST_P(EveryBodyShapeInParts, EveryElementAndFaceOfAnOwnedNodeIsHere) {
  const RawMesh raw = sample_box(GetParam());
  const Mesh m = distribute(raw, {"block"}, {});
  std::set<GlobalIndex> owned(m.input_node.begin(), m.input_node.begin() + m.n_owned_nodes);
  std::size_t expected = 0, here = 0;
  const auto count = [&](const std::vector<RawBlock>& blocks) {
    for (const RawBlock& b : blocks) {
      const auto nn = static_cast<std::size_t>(node_count(b.shape));
      for (std::size_t e = 0; e < b.nodes.size(); e += nn)
        for (std::size_t a = 0; a < nn; ++a)
          if (owned.contains(raw.input_node[static_cast<std::size_t>(b.nodes[e + a])])) {
            ++expected;
            break;
          }
    }
  };
  for (const auto& [group_name, group] : raw.groups) count(group.blocks);
  for (const ElementBlock& b : m.blocks) here += static_cast<std::size_t>(b.size());
  for (const auto& [side, surface] : m.surfaces)
    for (const ElementBlock& b : surface.faces) here += static_cast<std::size_t>(b.size());
  EXPECT_EQ(here, expected);
}

TEST(Distribute, NumbersAreContiguousAndGhostsFollowTheOwnedNodes) {
  const Mesh m = cylinder();
  EXPECT_EQ(global_sum(m.n_owned_nodes), static_cast<double>(m.n_global_nodes));
  EXPECT_GT(m.n_owned_nodes, 0);
  for (Index i = 0; i < m.n_owned_nodes; ++i)
    EXPECT_EQ(m.global_node[static_cast<std::size_t>(i)], m.first_owned + i);
  for (Index i = m.n_owned_nodes; i < m.n_nodes(); ++i) {
    const GlobalIndex g = m.global_node[static_cast<std::size_t>(i)];
    EXPECT_TRUE(g < m.first_owned || g >= m.first_owned + m.n_owned_nodes);
  }
}

TEST(Distribute, GlobalAndInputNumbersMeanTheSameNodeOnEveryProcess) {
  const RawMesh raw = make_cylinder_in_mould(k_cylinder, Shape::tri6);
  const Mesh m = distribute(raw, {"part", "mould"}, {});
  std::map<GlobalIndex, std::size_t> at;
  for (std::size_t i = 0; i < raw.x.size(); ++i) at[raw.input_node[i]] = i;
  double weighted = 0;
  for (Index i = 0; i < m.n_nodes(); ++i) {
    const auto ii = static_cast<std::size_t>(i);
    EXPECT_EQ(m.x[ii], raw.x[at.at(m.input_node[ii])]);
    if (i < m.n_owned_nodes) weighted += static_cast<double>(m.global_node[ii]);
  }
  // Each global number occurs once: their sum is that of 0 … n − 1.
  const auto n = static_cast<double>(m.n_global_nodes);
  EXPECT_EQ(global_sum(weighted), n * (n - 1) / 2);
}

TEST(Distribute, AReplicatedSurfaceIsWholeOnEveryProcess) {
  const RawMesh raw = make_cylinder_in_mould(k_cylinder, Shape::quad4);
  const Mesh m = distribute(raw, {"part", "mould"}, {"part_surface"});
  const Surface& s = m.surfaces.at("part_surface");
  EXPECT_TRUE(s.replicated);
  EXPECT_FALSE(m.surfaces.contains("part_top") && m.surfaces.at("part_top").replicated);
  std::size_t faces = 0;
  std::set<GlobalIndex> nodes, in_raw;
  for (const ElementBlock& b : s.faces) faces += static_cast<std::size_t>(b.size());
  for (const Index i : s.nodes) nodes.insert(m.input_node[static_cast<std::size_t>(i)]);
  std::size_t faces_in_raw = 0;
  for (const RawBlock& b : raw.groups.at("part_surface").blocks) {
    faces_in_raw += b.nodes.size() / 2;
    for (const Index i : b.nodes) in_raw.insert(raw.input_node[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(faces, faces_in_raw);
  EXPECT_EQ(nodes, in_raw);
}

TEST(Distribute, PartAndMouldHaveNodesOfTheirOwnAtTheInterface) {
  const Mesh m = cylinder();
  std::set<Index> part(m.surfaces.at("part_surface").nodes.begin(),
                       m.surfaces.at("part_surface").nodes.end());
  for (const Index i : m.surfaces.at("mould_surface").nodes) EXPECT_FALSE(part.contains(i));
  for (const ElementBlock& b : m.surfaces.at("part_surface").faces) EXPECT_EQ(b.body, 0);
  for (const ElementBlock& b : m.surfaces.at("mould_surface").faces) EXPECT_EQ(b.body, 1);
}

TEST(Distribute, OneBodyAloneDropsTheNodesAndSurfacesOfTheOthers) {
  const RawMesh raw = make_cylinder_in_mould(k_cylinder, Shape::tri3);
  const Mesh m = distribute(raw, {"part"}, {});
  std::set<Index> used;
  for (const RawBlock& b : raw.groups.at("part").blocks) used.insert(b.nodes.begin(), b.nodes.end());
  EXPECT_EQ(m.n_global_nodes, static_cast<GlobalIndex>(used.size()));
  EXPECT_FALSE(m.surfaces.contains("mould_surface"));
  EXPECT_FALSE(m.node_sets.contains("mould"));
}

TEST(Distribute, BodiesKeepTheOrderTheyAreNamedIn) {
  const RawMesh raw = make_cylinder_in_mould(k_cylinder, Shape::tri3);
  const Mesh m = distribute(raw, {"mould", "part"}, {});
  ASSERT_EQ(m.bodies.size(), 2u);
  EXPECT_EQ(m.bodies[0].name, "mould");
  EXPECT_EQ(m.bodies[1].name, "part");
}

TEST(Distribute, ABodyOrSurfaceThatIsNotThereIsNamedOnEveryProcess) {
  const RawMesh raw = rank() == 0 ? make_cylinder_in_mould(k_cylinder, Shape::tri3) : RawMesh{};
  try {
    distribute(raw, {"prat"}, {});
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("'prat'"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("mould, part"), std::string::npos) << e.what();
  }
  EXPECT_THROW(distribute(raw, {"part", "mould"}, {"part_side"}), InputError);
}

TEST(Distribute, TheSameMeshGivesTheSameParts) {
  const Mesh a = cylinder(), b = cylinder();
  EXPECT_EQ(a.global_node, b.global_node);
  EXPECT_EQ(a.input_node, b.input_node);
  EXPECT_EQ(a.blocks[0].nodes, b.blocks[0].nodes);
}

TEST(Distribute, PartsAreOfSimilarSize) {
  const Mesh m = cylinder();
  const double share = static_cast<double>(m.n_global_nodes) / n_processes();
  EXPECT_LT(m.n_owned_nodes, 1.1 * share + 1);  // METIS allows 3 % by default
}

// Half the nodes conduct only and cost next to nothing: every process must get its share of the other half.
TEST(Distribute, WorkIsSharedOutAndNotNodes) {
  const RawMesh raw =
      make_two_blocks({{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}, {12, 12, 12}, {12, 12, 12}, 0.01}, Shape::hex8);
  const Mesh m = distribute(raw, {"lower", "upper"}, {}, {BodyWork::all, BodyWork::heat});
  std::set<Index> moving;
  for (const ElementBlock& b : m.blocks)
    if (b.body == 0)
      for (const Index i : b.nodes)
        if (i < m.n_owned_nodes) moving.insert(i);
  const auto here = static_cast<double>(moving.size());
  const double share = global_sum(here) / n_processes();
  EXPECT_EQ(global_sum(here), 13 * 13 * 13);
  // METIS is asked for equal sums within 0.1 %; nodes at the rim have smaller rows, so their number may
  // differ.
  EXPECT_LT(here, 1.1 * share);
}

// On one process METIS has nothing to do.
TEST(Distribute, AFailureOfMetisOrOfMemoryIsNotTheUsers) {
  const int n_processes = processes::count();
  if (n_processes == 1) return;
  answer_of_metis = METIS_ERROR_MEMORY;
  EXPECT_THROW(cylinder(), std::bad_alloc);
  answer_of_metis = METIS_ERROR;
  try {
    cylinder();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    ADD_FAILURE() << error.what();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("METIS could not"), std::string::npos);
  }
  answer_of_metis = METIS_OK;
  EXPECT_GT(cylinder().n_owned_nodes, 0);
}

// The failing process throws its own exception, the others one of the same kind.
TEST(CommonFailure, IsOfTheSameKindOnEveryProcess) {
  const int rank = processes::rank(), n_processes = processes::count();
  const auto last = [&](auto error) {
    run_collectively([&] {
      if (rank == n_processes - 1) throw error;
    });
  };
  EXPECT_THROW(last(InputError({"case.toml", 3, 1}, "no such key")), InputError);
  EXPECT_THROW(last(std::bad_alloc()), std::bad_alloc);
  EXPECT_THROW(last(std::logic_error("a mistake")), std::exception);
  if (rank < n_processes - 1) {
    EXPECT_THROW(last(std::logic_error("a mistake")), std::runtime_error);
    EXPECT_THROW(last(std::string("a library's complaint")), std::runtime_error);
  } else {
    EXPECT_THROW(last(std::logic_error("a mistake")), std::logic_error);
    EXPECT_THROW(last(std::string("a library's complaint")), std::string);
  }
  EXPECT_THROW(on_first_process([] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_NO_THROW(run_collectively([] {}));
}

}  // namespace
