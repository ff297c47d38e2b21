#include "mesh/making/coats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "mesh/quality.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace solidus::test {
namespace {

using ::testing::HasSubstr;

constexpr double k_edge = 0.02;  ///< of the cube that is coated [m]
/// A round of 8 mm in edges of 5 mm: its chords lie up to 0.4 mm within it.
constexpr double k_chords = 0.04;

/// A block of 60 mm, in which a cube of 20 mm is the body "part" and the rest "block".
/// @param floor  of the cube [m]: 20 mm in the middle of the block, 40 mm where both end at the top
RawMesh cube_in_block(Shape shape, double floor, int divisions = 12) {
  OneBlock b;
  b.size = {0.06, 0.06, 0.06};
  b.divisions = {divisions, divisions, divisions};
  RawMesh mesh = make_block(b, shape);
  const std::string all = bodies_of(mesh).front();
  RawGroup part{3, {}}, rest{3, {}};
  for (const RawBlock& block : mesh.groups.at(all).blocks) {
    RawBlock inside{block.shape, {}, {}}, outside = inside;
    const auto n = static_cast<std::size_t>(node_count(block.shape));
    for (std::size_t e = 0; e < block.nodes.size() / n; ++e) {
      Point c{};
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          c[i] += mesh.x[static_cast<std::size_t>(block.nodes[e * n + a])][i] / static_cast<double>(n);
      const bool is_part = std::abs(c[0] - 0.03) < 0.01 && std::abs(c[1] - 0.03) < 0.01 &&
                           std::abs(c[2] - floor - 0.01) < 0.01;
      RawBlock& to = is_part ? inside : outside;
      to.nodes.insert(to.nodes.end(), block.nodes.begin() + static_cast<std::ptrdiff_t>(e * n),
                      block.nodes.begin() + static_cast<std::ptrdiff_t>((e + 1) * n));
      to.input_element.push_back(block.input_element[e]);
    }
    part.blocks.push_back(inside);
    rest.blocks.push_back(outside);
  }
  mesh.groups.clear();
  mesh.groups["part"] = part;
  mesh.groups["block"] = rest;
  return mesh;
}

double volume_of(const RawMesh& mesh, const std::string& body) {
  const auto groups = assess(mesh).groups;
  return std::ranges::find(groups, body, &GroupReport::name)->measure;
}

double distance_to_cube(const Point& x, double floor) {
  const auto beyond = [](double c, double low) { return std::max({low - c, c - low - k_edge, 0.0}); };
  return std::hypot(beyond(x[0], 0.02), beyond(x[1], 0.02), beyond(x[2], floor));
}

/// Volume between a cube and its offset (Steiner's formula).
double around_cube(double d) {
  return 6 * k_edge * k_edge * d + 3 * std::numbers::pi * k_edge * d * d +
         4.0 / 3 * std::numbers::pi * d * d * d;
}

/// How many elements have each face, by its vertices.
std::map<std::array<Index, 3>, int> faces_of(const RawMesh& mesh) {
  std::map<std::array<Index, 3>, int> count;
  for (const auto& [name, group] : mesh.groups)
    for (const RawBlock& block : group.blocks) {
      if (group.dimension != 3) continue;
      const auto n = static_cast<std::size_t>(node_count(block.shape));
      for (std::size_t e = 0; e < block.nodes.size(); e += n)
        for (std::size_t without = 0; without < 4; ++without) {
          std::array<Index, 3> face{};
          for (std::size_t a = 0, k = 0; a < 4; ++a)
            if (a != without) face[k++] = block.nodes[e + a];
          std::ranges::sort(face);
          ++count[face];
        }
    }
  return count;
}

std::string complaint_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

class CoatsOf : public ::testing::TestWithParam<Shape> {};

TEST_P(CoatsOf, HaveTheVolumeOfTheOffsetAndEndOnIt) {
  if (rank() > 0) return;
  RawMesh mesh = cube_in_block(GetParam(), 0.02);
  const auto reports = make_coats(mesh, "block", {{"face_coat", 0.002}, {"back_up", 0.006}}, false, "mesh");
  EXPECT_FALSE(mesh.groups.contains("block"));
  EXPECT_NEAR(volume_of(mesh, "part"), std::pow(k_edge, 3), 1e-15);
  EXPECT_NEAR(volume_of(mesh, "face_coat") / around_cube(0.002), 1, k_chords);
  EXPECT_NEAR(volume_of(mesh, "back_up") / (around_cube(0.008) - around_cube(0.002)), 1, k_chords);
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_NEAR(reports[1].volume, volume_of(mesh, "back_up"), 1e-6 * reports[1].volume);
  // Elements fit together, and what has no neighbour ends where the shell does.
  for (const auto& [face, elements] : faces_of(mesh)) {
    EXPECT_LE(elements, 2);
    if (elements == 1)
      for (const Index node : face)
        EXPECT_NEAR(distance_to_cube(mesh.x[static_cast<std::size_t>(node)], 0.02), 0.008, 3e-4);
  }
  for (const GroupReport& group : assess(mesh).groups) EXPECT_GT(group.worst_quality, 0.05) << group.name;
}

TEST_P(CoatsOf, AreOpenWhereTheBlockEndsWithThePart) {
  if (rank() > 0) return;
  RawMesh mesh = cube_in_block(GetParam(), 0.04);
  make_coats(mesh, "block", {{"shell", 0.008}}, false, "mesh");
  const double a = k_edge, d = 0.008, pi = std::numbers::pi;
  const double open = 5 * a * a * d + 2 * pi * a * d * d + 2.0 / 3 * pi * d * d * d;
  EXPECT_NEAR(volume_of(mesh, "shell") / open, 1, k_chords);
  double highest = 0;
  for (const Point& x : mesh.x) highest = std::max(highest, x[2]);
  EXPECT_EQ(highest, 0.06);
  for (const auto& [face, elements] : faces_of(mesh))
    if (elements == 1)
      for (const Index node : face) {
        const Point& x = mesh.x[static_cast<std::size_t>(node)];
        EXPECT_TRUE(x[2] > 0.06 - 1e-12 || std::abs(distance_to_cube(x, 0.04) - d) < 3e-4);
      }
}

INSTANTIATE_TEST_SUITE_P(Tetrahedra, CoatsOf, ::testing::Values(Shape::tet4, Shape::tet10),
                         [](const auto& shape) { return std::string(mesh::name(shape.param)); });

TEST(Coats, LackLessThanAQuarterOfTheChordsWithHalfTheEdges) {
  if (rank() > 0) return;
  const auto lacking = [](int divisions) {
    RawMesh mesh = cube_in_block(Shape::tet4, 0.02, divisions);
    make_coats(mesh, "block", {{"shell", 0.008}}, false, "mesh");
    return 1 - volume_of(mesh, "shell") / around_cube(0.008);
  };
  const double coarse = lacking(12), fine = lacking(24);
  EXPECT_GT(coarse, 0.02);
  EXPECT_LT(fine, 0.25 * coarse);
  EXPECT_GT(fine, 0.0);
}

TEST(Coats, ABedKeepsWhatLiesBeyondThem) {
  if (rank() > 0) return;
  RawMesh mesh = cube_in_block(Shape::tet4, 0.02);
  make_coats(mesh, "block", {{"shell", 0.008}}, true, "mesh");
  EXPECT_NEAR(volume_of(mesh, "shell") / around_cube(0.008), 1, k_chords);
  EXPECT_NEAR(volume_of(mesh, "shell") + volume_of(mesh, "block") + volume_of(mesh, "part"),
              std::pow(0.06, 3), 1e-12);
  for (const auto& [face, elements] : faces_of(mesh))
    if (elements == 1)
      for (const Index node : face) {
        const Point& x = mesh.x[static_cast<std::size_t>(node)];
        EXPECT_TRUE(std::ranges::any_of(x, [](double c) { return c < 1e-12 || c > 0.06 - 1e-12; }));
      }
}

TEST(Coats, RefuseWhatTheyCannotBeMadeOf) {
  if (rank() > 0) return;
  const auto coat = [](RawMesh mesh, const char* name) {
    return complaint_of([&] { make_coats(mesh, "block", {{name, 0.005}}, false, "part.step"); });
  };
  EXPECT_THAT(coat(cube_in_block(Shape::tet4, 0.02), "part"),
              HasSubstr("part.step: the coat 'part' has the name of a group of the geometry"));
  EXPECT_THAT(coat(cube_in_block(Shape::hex8, 0.02), "shell"), HasSubstr("hex8"));
  RawMesh alone = cube_in_block(Shape::tet4, 0.02);
  alone.groups.erase("part");
  EXPECT_THAT(coat(alone, "shell"), HasSubstr("nothing to be coated"));
}

}  // namespace
}  // namespace solidus::test
