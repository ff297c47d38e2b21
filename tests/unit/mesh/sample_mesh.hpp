/// Meshes for the tests of this room, and sums over processes.
#pragma once

#include <mpi.h>
#include <petscsys.h>

#include <cmath>
#include <string>
#include <vector>

#include "mesh/block_geometry.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "system/processes.hpp"

namespace solidus::test {

using namespace solidus::mesh;  // NOLINT: tests only

inline double global_sum(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return value;
}
inline int n_processes() {
  const int n = processes::count();
  return n;
}
inline int rank() {
  int r = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &r);
  return r;
}

constexpr Shape k_body_shapes[] = {Shape::tri3, Shape::tri6,  Shape::quad4, Shape::quad8,
                                   Shape::tet4, Shape::tet10, Shape::hex8,  Shape::hex20};

/// A box of 0.5 × 0.3 (× 0.4) m from `origin` on, of 4 × 3 (× 2) cells.
inline RawMesh sample_box(Shape shape, double x0 = 0) {
  OneBlock b;
  b.size = {0.5, 0.3};
  b.divisions = {4, 3};
  b.origin = {x0, 0};
  if (mesh::dimension(shape) == 3) {
    b.size.push_back(0.4);
    b.divisions.push_back(2);
    b.origin.push_back(0);
  }
  return make_block(b, shape);
}

/// Moves every node by a smooth field that leaves no edge parallel to another; elements become curved where
/// the shape allows it.
inline void distort(RawMesh& raw, double amount) {
  const bool solid = raw.dimension == 3;
  for (Point& x : raw.x) {
    const Point old = x;
    x[0] += amount * std::sin(5 * old[1] + 3 * old[2] + 1) * 0.3;
    x[1] += amount * std::sin(4 * old[0] - 2 * old[2]) * 0.3;
    if (solid) x[2] += amount * std::cos(6 * old[0] + 2 * old[1]) * 0.3;
  }
}

/// Bodies of a shape by name, all of them.
inline std::vector<std::string> bodies_of(const RawMesh& raw) {
  std::vector<std::string> names;
  for (const auto& [name, group] : raw.groups)
    if (group.dimension == raw.dimension) names.push_back(name);
  return names;
}

/// The volume of what all processes count.
inline double volume(const Mesh& mesh, AnalysisKind kind, int degree = 6) {
  double sum = 0;
  for (const ElementBlock& block : mesh.blocks) {
    const BlockGeometry g(mesh, block, kind, gauss_rule(block.shape, degree));
    for (Index b = 0; b < g.n_batches; ++b)
      for (int p = 0; p < g.n_points; ++p)
        sum += solidus::sum(g.weight_at(b, p) * g.counted[static_cast<std::size_t>(b)]);
  }
  return global_sum(sum);
}

}  // namespace solidus::test
