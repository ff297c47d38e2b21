/// Small meshes written by hand and a folder of one's own, for the tests of results.
#pragma once

#include <petscsys.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "mesh/mesh.hpp"
#include "system/processes.hpp"

namespace solidus::test {

/// A folder that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "solidus-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path;
};

/// Runs on process 0 while the others wait.
template <class F>
void on_first(const F& work) {
  const int rank = processes::rank();
  if (rank == 0) work();
  MPI_Barrier(PETSC_COMM_WORLD);
}

/// The same folder on every process. Collective.
class SharedFolder {
 public:
  SharedFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "solidus-XXXXXX").string();
    on_first([&] {
      if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    });
    MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0, PETSC_COMM_WORLD);
    path = name;
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  ~SharedFolder() {
    MPI_Barrier(PETSC_COMM_WORLD);
    std::error_code ignored;
    on_first([&] { std::filesystem::remove_all(path, ignored); });
  }
  std::filesystem::path path;
};

/// Nodes and one block per shape; `nodes` of each block are local numbers.
inline mesh::Mesh make_mesh(int dimension, std::vector<mesh::Point> x,
                            std::vector<mesh::ElementBlock> blocks) {
  mesh::Mesh mesh;
  mesh.dimension = dimension;
  mesh.x = std::move(x);
  mesh.n_owned_nodes = mesh.n_nodes();
  mesh.n_global_nodes = mesh.n_nodes();
  for (Index node = 0; node < mesh.n_nodes(); ++node) {
    mesh.global_node.push_back(node);
    mesh.input_node.push_back(100 + node);
  }
  GlobalIndex element = 1;
  for (mesh::ElementBlock& block : blocks) {
    block.n_counted = block.size();
    for (Index e = 0; e < block.size(); ++e) block.input_element.push_back(element++);
  }
  mesh.blocks = std::move(blocks);
  mesh.bodies = {{"part"}, {"mould"}};
  return mesh;
}

/// Two triangles of body 0 and a quad of body 1 on [0, 2] × [0, 1], joined at x = 1.
inline mesh::Mesh triangles_and_quad() {
  mesh::ElementBlock triangles, quads;
  triangles.shape = mesh::Shape::tri3;
  triangles.body = 0;
  triangles.nodes = {0, 1, 4, 0, 4, 3};
  quads.shape = mesh::Shape::quad4;
  quads.body = 1;
  quads.nodes = {1, 2, 5, 4};
  return make_mesh(2, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}, {triangles, quads});
}

}  // namespace solidus::test
