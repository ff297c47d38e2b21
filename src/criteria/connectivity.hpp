/// Connected parts of a set of nodes, over the elements of chosen bodies and over processes.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

/// A part is told by the least number in the input (Mesh::input_node) of its nodes: the same whatever the
/// number of processes.
struct ConnectedParts {
  static constexpr double k_none = -1;
  std::vector<double> label;  ///< [local node], k_none outside of the set
  std::vector<double> whole;  ///< labels, rising: parts that hold a whole element, the same everywhere
};

class Connectivity {
 public:
  /// @param chosen  one per body: its elements connect
  Connectivity(const mesh::Mesh& mesh, const parallel::GhostExchange& ghosts, std::vector<char> chosen);

  /// Two nodes of the set are connected where an element has both. Collective.
  /// @param inside  [local node]; ghosts as their owners say
  ConnectedParts parts(std::span<const char> inside) const;

 private:
  void join_over_processes(std::span<const char> inside, std::vector<double>& label) const;

  const mesh::Mesh& mesh_;
  const parallel::GhostExchange& ghosts_;
  std::vector<char> chosen_;
};

}  // namespace solidus::criteria
