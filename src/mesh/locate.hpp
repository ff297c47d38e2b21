/// Values of nodal fields at points and averages over groups, for probes. All functions are collective.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// A linear functional of a nodal field, Σ weight · value. Each process has the terms it is to add (none, for
/// most processes and a point): the sum of all shares is the value.
struct NodalFunctional {
  std::vector<Index> nodes;     ///< local numbers
  std::vector<double> weights;  ///< same length

  /// This process's share of the value of one component of a field [local node][component] with its ghosts up
  /// to date.
  double share(std::span<const double> field, int n_components = 1, int component = 0) const;
};

/// Location of a point in the mesh. Exactly one process is `here` and has nodes and weights N_a(ξ).
struct LocatedPoint : NodalFunctional {
  bool here = false;
  Index block = -1, element = -1;  ///< of Mesh::blocks, on the process that is `here`; else −1
  Point xi{};                      ///< local coordinates in that element
  /// From the point to the mesh [m], zero inside (to rounding); the same on every process. Outside, nodes and
  /// weights belong to the nearest place of the nearest element.
  double distance = 0;
};

/// Finds the point in the elements of a body, or of all bodies for −1. Where several elements share it
/// (edges, coincident interfaces of bodies) the first body, and in it the lowest element number of the input,
/// answers, so the answer does not depend on the number of processes.
LocatedPoint locate(const Mesh& mesh, const Point& point, int body = -1);

/// The mean of a field over a named surface or body, ∫N_a dA / A (× 2π r in axisymmetry); over a set of
/// points or of lines in a solid the mean of the nodal values. Throws InputError, on every process, for a
/// name that the mesh does not have.
NodalFunctional group_mean(const Mesh& mesh, const std::string& group, AnalysisKind kind);

/// The area [m²] or volume [m³] of a surface or body: over the whole revolution in axisymmetry, of one metre
/// of thickness in plane strain; zero for groups of points.
double group_measure(const Mesh& mesh, const std::string& group, AnalysisKind kind);

}  // namespace solidus::mesh
