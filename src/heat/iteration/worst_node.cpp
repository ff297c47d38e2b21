/// The largest value of each process is compared over all; its owner composes the text.
#include "heat/iteration/worst_node.hpp"

#include <fmt/format.h>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::heat {

Index WorstNode::owned() const {
  const bool seen = size > -HUGE_VAL;
  return processes::find_largest(size).rank == processes::rank() && seen ? as_index(node) : -1;
}

std::string WorstNode::text(const mesh::Mesh& mesh, std::span<const double> temperature,
                            std::span<const double> residual) const {
  const int owner = processes::find_largest(size).rank;
  std::string place;
  if (owner == processes::rank() && mesh.n_owned_nodes > 0) {
    const mesh::Point& p = mesh.x[node];
    place = fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g}) m: {:.6g} K", mesh.input_node[node], p[0], p[1],
                        p[2], temperature[node]);
    if (!residual.empty()) place += fmt::format(", unbalanced heat {:.4g} W", residual[node]);
  }
  processes::broadcast(place, owner);
  return place;
}

}  // namespace solidus::heat
