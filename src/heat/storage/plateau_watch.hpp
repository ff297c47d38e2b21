/// Detects that the front of an isothermal change passes many nodes in one iteration of a step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "heat/storage/nodal_enthalpy.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

class PlateauWatch {
 public:
  /// All must outlive this object.
  /// @param matrix  its pattern tells the neighbours
  PlateauWatch(const mesh::Mesh& mesh, const NodalEnthalpy& storage, const linear::BlockMatrix& matrix,
               const parallel::GhostExchange& ghosts);

  /// Whether some node has come onto a plateau, has left one or has passed one since the last call, and all
  /// its neighbours too. False at the first call, which keeps where the nodes are. Collective.
  /// @param heat, temperature  points of the nodes' curves, [local node]
  bool passed_in_depth(std::span<const double> heat, std::span<const double> temperature);

 private:
  const mesh::Mesh& mesh_;
  const NodalEnthalpy& storage_;
  const linear::BlockMatrix& matrix_;
  const parallel::GhostExchange& ghosts_;
  std::vector<std::int16_t> branch_;  ///< NodalEnthalpy::branch() at the last call, [owned node]
};

}  // namespace solidus::heat
