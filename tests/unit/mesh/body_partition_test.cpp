// Which of the groups that hold the same elements are bodies.
#include "mesh/files/body_partition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Six quadrilaterals in a row, and groups of some of them by number.
RawMesh row_with(const std::map<std::string, std::vector<Index>>& groups) {
  RawMesh mesh;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 2; ++j) {
      mesh.x.push_back({1.0 * i, 1.0 * j, 0});
      mesh.input_node.push_back(2 * i + j + 1);
    }
  for (const auto& [name, elements] : groups) {
    RawBlock block{Shape::quad4, {}, {}};
    for (const Index e : elements) {
      for (const Index n : {2 * e, 2 * e + 2, 2 * e + 3, 2 * e + 1}) block.nodes.push_back(n);
      block.input_element.push_back(e + 1);
    }
    mesh.groups[name] = {2, {block}};
  }
  return mesh;
}

std::vector<std::string> bodies(const std::map<std::string, std::vector<Index>>& groups) {
  return partition_of(row_with(groups), "row").bodies;
}

TEST(BodyPartition, GroupsThatShareNoElementAreAllBodies) {
  const BodyPartition partition = partition_of(row_with({{"b", {3, 4, 5}}, {"a", {0, 1, 2}}}), "row");
  EXPECT_THAT(partition.bodies, ElementsAre("a", "b"));
  EXPECT_THAT(partition.left_out, IsEmpty());
  EXPECT_THAT(partition.notes, IsEmpty());
}

TEST(BodyPartition, AGroupThatOthersFillIsLeftOutAndSaid) {
  const BodyPartition partition =
      partition_of(row_with({{"shaft", {0, 1, 2}}, {"hub", {3, 4, 5}}, {"both", {0, 1, 2, 3, 4, 5}}}), "row");
  EXPECT_THAT(partition.bodies, ElementsAre("hub", "shaft"));
  EXPECT_THAT(partition.notes, ElementsAre(HasSubstr("'both' holds all of 'hub', 'shaft'")));
}

TEST(BodyPartition, NamesThatPeopleGiveComeBeforeThoseOfPrograms) {
  EXPECT_THAT(
      bodies({{"Volume1", {0, 1, 2}}, {"Volume2", {3, 4, 5}}, {"shaft", {0, 1, 2}}, {"hub", {3, 4, 5}}}),
      ElementsAre("hub", "shaft"));
  // One body of two volumes.
  EXPECT_THAT(bodies({{"Volume1", {0, 1, 2}}, {"Volume2", {3, 4, 5}}, {"shaft", {0, 1, 2, 3, 4, 5}}}),
              ElementsAre("shaft"));
  EXPECT_THAT(bodies({{"Eall", {0, 1, 2, 3, 4, 5}}, {"Evolumes", {0, 1, 2, 3, 4, 5}}}), ElementsAre("Eall"));
}

TEST(BodyPartition, AGroupInsideOfABodyIsNoBody) {
  const BodyPartition partition =
      partition_of(row_with({{"Eall", {0, 1, 2, 3, 4, 5}}, {"watched", {1, 2}}}), "row");
  EXPECT_THAT(partition.bodies, ElementsAre("Eall"));
  EXPECT_THAT(partition.notes, ElementsAre(HasSubstr("'watched', 2 elements, lies in 'Eall'")));
}

TEST(BodyPartition, GroupsThatOverlapInPartAreRefused) {
  try {
    bodies({{"shaft", {0, 1, 2, 3}}, {"hub", {3, 4, 5}}});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("have elements in common"));
  }
}

}  // namespace
