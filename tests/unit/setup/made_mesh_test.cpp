/// The mesh that one program makes and another one computes on.
#include "setup/made_mesh.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "mesh/making/parametric_meshes.hpp"

namespace solidus::setup {
namespace {

TEST(MadeMesh, ArrivesAsItWasSent) {
  MadeMesh made;
  made.mesh = mesh::make_block({{1, 2}, {0, 0}, {3, 2}}, mesh::Shape::quad4);
  made.mesh.unsound = InputError({"case.toml", 3, 1}, "two bodies overlap", "bodies side by side");
  made.interfaces = {{2, 0, 1, "part_to_mould", "mould_to_part", 1e-4}};
  made.seconds = 1.5;
  std::vector<char> bytes;
  put_made_mesh(made, [&](const void* from, std::size_t n) {
    const char* const at = static_cast<const char*>(from);
    bytes.insert(bytes.end(), at, at + n);
  });

  std::size_t taken = 0;
  const auto take = [&](void* to, std::size_t n) {
    if (taken + n > bytes.size()) throw mesh::MessageError("there is no more");
    std::memcpy(to, bytes.data() + taken, n);
    taken += n;
  };
  const MadeMesh same = take_made_mesh(take, 1e6);
  EXPECT_EQ(taken, bytes.size());
  EXPECT_EQ(same.mesh.x, made.mesh.x);
  EXPECT_EQ(same.mesh.groups.size(), made.mesh.groups.size());
  ASSERT_TRUE(same.mesh.unsound);
  EXPECT_STREQ(same.mesh.unsound->what(), made.mesh.unsound->what());
  ASSERT_EQ(same.interfaces.size(), 1U);
  EXPECT_EQ(same.interfaces[0].section, 2U);
  EXPECT_EQ(same.interfaces[0].b, 1);
  EXPECT_EQ(same.interfaces[0].surface_b, "mould_to_part");
  EXPECT_DOUBLE_EQ(same.interfaces[0].distance, 1e-4);
  EXPECT_DOUBLE_EQ(same.seconds, 1.5);
}

}  // namespace
}  // namespace solidus::setup
