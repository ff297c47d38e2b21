// Messages between the program and the reader of meshes, and the restrictions of the reader.
#include "mesh/making/reader_message.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/making/reader_process.hpp"
#include "system/errors.hpp"
#include "system/sandbox.hpp"

namespace {

using namespace solidus;
using namespace solidus::mesh;

/// Bytes that one end puts and the other takes.
struct Pipe {
  std::string bytes;
  std::size_t at = 0;
  PutBytes put = [this](const void* from, std::size_t n) { bytes.append(static_cast<const char*>(from), n); };
  TakeBytes take = [this](void* to, std::size_t n) {
    if (at + n > bytes.size()) throw std::runtime_error("the end");
    if (n > 0) std::memcpy(to, bytes.data() + at, n);
    at += n;
  };
};

TEST(ReaderMessage, ARequestArrivesAsItWas) {
  MeshSource source{"part.geo", 0.001, 0.005, 2, {{"size", 8.5}, {"width", 60}}};
  source.geometry.conforming = true;
  source.geometry.groups = {{"part", true, {1, 3}, "", {}},
                            {"top", false, {}, "lid", {}},
                            {"side", false, {}, "", std::array<Point, 2>{Point{0, 0, 0}, Point{1, 2, 3}}}};
  source.trust_script = true;
  source.size_factor = 1.5;
  Pipe pipe;
  put_source(source, pipe.put);
  const MeshSource back = take_source(pipe.take);
  EXPECT_EQ(back.path, source.path);
  EXPECT_EQ(back.unit_in_metres, source.unit_in_metres);
  EXPECT_EQ(back.element_size, source.element_size);
  EXPECT_EQ(back.element_order, source.element_order);
  EXPECT_EQ(back.constants, source.constants);
  EXPECT_EQ(back.size_factor, source.size_factor);
  EXPECT_TRUE(back.geometry.conforming);
  ASSERT_EQ(back.geometry.groups.size(), 3u);
  EXPECT_EQ(back.geometry.groups[0].numbers, source.geometry.groups[0].numbers);
  EXPECT_EQ(back.geometry.groups[1].label, "lid");
  EXPECT_EQ(back.geometry.groups[2].box, source.geometry.groups[2].box);
  EXPECT_TRUE(back.trust_script);
}

TEST(ReaderMessage, AMeshArrivesAsItWas) {
  RawMesh mesh = make_block({{1, 2}, {}, {3, 4}}, Shape::quad8);
  mesh.centre_of_volume = Point{0.5, 1, 0};
  mesh.drawn_faces = {{{{-1, 0, 1, 2}, {0, 1, 2, 3}}, 0.004}, {{{-1, 3, 4, 5}}, 0}};
  Pipe pipe;
  put_mesh(mesh, pipe.put);
  const RawMesh back = take_mesh(pipe.take, 1e9);
  EXPECT_EQ(back.centre_of_volume, mesh.centre_of_volume);
  ASSERT_EQ(back.drawn_faces.size(), 2u);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(back.drawn_faces[f].facets, mesh.drawn_faces[f].facets);
    EXPECT_EQ(back.drawn_faces[f].radius, mesh.drawn_faces[f].radius);
  }
  EXPECT_EQ(back.dimension, mesh.dimension);
  EXPECT_EQ(back.x, mesh.x);
  EXPECT_EQ(back.input_node, mesh.input_node);
  ASSERT_EQ(back.groups.size(), mesh.groups.size());
  for (const auto& [name, group] : mesh.groups) {
    const RawGroup& other = back.groups.at(name);
    EXPECT_EQ(other.dimension, group.dimension);
    ASSERT_EQ(other.blocks.size(), group.blocks.size());
    for (std::size_t b = 0; b < group.blocks.size(); ++b) {
      EXPECT_EQ(other.blocks[b].shape, group.blocks[b].shape);
      EXPECT_EQ(other.blocks[b].nodes, group.blocks[b].nodes);
      EXPECT_EQ(other.blocks[b].input_element, group.blocks[b].input_element);
    }
  }
}

TEST(ReaderMessage, WhatIsNoMeshIsRefused) {
  RawMesh mesh = make_block({{1, 2}, {}, {3, 4}}, Shape::quad4);
  Pipe large;
  put_mesh(mesh, large.put);
  EXPECT_THROW(take_mesh(large.take, 100), std::runtime_error) << "larger than its limit";
  Pipe cut;
  put_mesh(mesh, cut.put);
  cut.bytes.resize(cut.bytes.size() / 2);
  EXPECT_THROW(take_mesh(cut.take, 1e9), std::runtime_error) << "cut off";
  mesh.groups.begin()->second.blocks.front().nodes.front() = 1000;
  Pipe wrong;
  put_mesh(mesh, wrong.put);
  EXPECT_THROW(take_mesh(wrong.take, 1e9), std::runtime_error) << "a node that is not there";
}

TEST(ReaderMessage, AFaceOfADrawingThatIsNoneIsRefused) {
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  for (const DrawnFace& wrong :
       {DrawnFace{{}, 0}, DrawnFace{{{-1, 0, 1, 1000}}, 0}, DrawnFace{{{-2, 0, 1, 2}}, 0},
        DrawnFace{{{-1, 0, 1, 2}}, -1}, DrawnFace{{{-1, 0, 1, 2}}, no_number}}) {
    RawMesh mesh = make_block({{1, 2}, {}, {3, 4}}, Shape::quad4);
    mesh.drawn_faces = {wrong};
    Pipe pipe;
    put_mesh(mesh, pipe.put);
    EXPECT_THROW(take_mesh(pipe.take, 1e9), std::runtime_error);
  }
}

TEST(ReaderMessage, ADamagedByteNeverTakesTheProgramDown) {
  Pipe good;
  RawMesh whole = make_block({{1, 2}, {}, {3, 4}}, Shape::quad4);
  whole.drawn_faces = {{{{-1, 0, 1, 2}}, 0.004}};
  put_mesh(whole, good.put);
  for (std::size_t i = 0; i < good.bytes.size(); i += 3) {
    Pipe damaged;
    damaged.bytes = good.bytes;
    damaged.bytes[i] = static_cast<char>(damaged.bytes[i] ^ 0x55);
    try {
      take_mesh(damaged.take, 1e6);
    } catch (const std::exception&) {  // NOLINT: either a mesh or an exception
    }
  }
}

/// Exit code of `work` in a process of its own.
int in_child(int (*work)()) {
  const pid_t child = fork();
  if (child == 0) _exit(work());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ReaderSandbox, ReadsButNeitherWritesNorStartsPrograms) {
  const auto work = [] {
    if (access("/proc/self/exe", R_OK) != 0) return 1;
    sandbox::forbid_all_but_reading();
    const int reading = open("/proc/self/maps", O_RDONLY);
    if (reading < 0) return 2;
    const std::string path = "/tmp/solidus_sandbox_" + std::to_string(getpid());
    if (open(path.c_str(), O_WRONLY | O_CREAT, 0600) >= 0) return 3;
    if (open("/tmp", O_TMPFILE | O_RDWR, 0600) >= 0) return 4;
    if (mkdir(path.c_str(), 0700) == 0) return 5;
    if (unlink("/tmp/solidus_no_such_file") == 0 || errno != EPERM) return 6;
    if (rename("/tmp/solidus_no_such_file", path.c_str()) == 0 || errno != EPERM) return 7;
    char name[] = "true";
    char* const argv[] = {name, nullptr};
    execv("/bin/true", argv);
    return errno == EPERM ? 0 : 8;
  };
  EXPECT_EQ(in_child(work), 0);
}

TEST(ReaderLimits, AreThoseOfTheEnvironmentWhereItSaysSo) {
  const MeshSource source{"nowhere.geo"};
  EXPECT_GT(reader_limits(source).memory, 1e8);
  const MeshSource there{"/proc/self/exe"};
  EXPECT_LT(reader_limits(there).time, 1000);  // of a mesh that is only read, by its size
  EXPECT_EQ(reader_limits(there, true).time, 1800);
  setenv("SOLIDUS_MESH_MEMORY", "3 GB", 1);
  setenv("SOLIDUS_MESH_TIME", "5 min", 1);
  EXPECT_EQ(reader_limits(source).memory, 3e9);
  EXPECT_EQ(reader_limits(source).time, 300);
  for (const char* wrong : {"much", "3", "-1 GB", "3 potatoes"}) {
    setenv("SOLIDUS_MESH_MEMORY", wrong, 1);
    EXPECT_THROW(reader_limits(source), InputError) << wrong;
  }
  unsetenv("SOLIDUS_MESH_MEMORY");
  setenv("SOLIDUS_MESH_TIME", "long", 1);
  EXPECT_THROW(reader_limits(source), InputError);
  unsetenv("SOLIDUS_MESH_TIME");
}

}  // namespace
