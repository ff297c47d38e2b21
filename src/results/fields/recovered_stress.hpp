/// Recovers stresses at nodes from the means of the elements, so that values at a surface are those of the
/// surface.
///
/// Around each node of a body a linear function is fitted to the stresses of the elements that meet there, at
/// their centroids, by least squares: superconvergent patch recovery (Zienkiewicz and Zhu 1992, Int. J.
/// Numer. Meth. Engng 33, 1331). On the boundary the centroids may span fewer directions than around a node
/// inside (those of hexahedra at a face lie in a plane): such a node takes the mean of what the fits of the
/// better ones among its neighbours give at its place. At a node of several bodies the value of one of
/// them, or the mean.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/types.hpp"
#include "parallel/parallel.hpp"

namespace solidus::results {

class StressRecovery {
 public:
  /// Finds centroids and volumes; keeps a reference to the mesh.
  StressRecovery(const mesh::Mesh& mesh, AnalysisKind kind);

  /// @param stress  [cell][6] as mechanics::MechanicalPhase::element_field has it
  /// @param body    that of Mesh::bodies whose stress it is at nodes that it shares; −1: the mean of the
  /// bodies
  /// @return [local node][6], ghosts up to date; zero at nodes without elements (of the body). Collective.
  std::vector<double> at_nodes(std::span<const double> stress, int body = -1) const;

 private:
  /// Elements of one body around a node.
  struct Patch {
    Index node = 0;
    int body = 0, rank = 0;  ///< directions in which the centroids spread
    std::vector<std::size_t> cells;
    std::array<double, 9>
        inverse{};         ///< of Σ d dᵀ, d from the mean centroid [1/m²], in the directions of rank
    mesh::Point centre{};  ///< mean centroid [m]
  };
  void measure_cells(AnalysisKind kind);
  void spread(Patch& patch) const;
  /// Fits a linear stress to the elements of a patch: its mean and its gradient about their centre; the rank
  /// says how many directions it could determine.
  void find_fit(const Patch& patch, std::span<const double> stress, double* fit) const;

  const mesh::Mesh& mesh_;
  parallel::GhostExchange ghosts_;
  std::vector<mesh::Point> centroid_;  ///< [cell]
  std::vector<std::array<double, 9>>
      moment_;                  ///< mean of d dᵀ, d from the centroid to the nodes, [cell] [m²]
  std::vector<Patch> patches_;  ///< of owned nodes, one for each body of a node
};

/// A principal value of each symmetric tensor: [node] from [node][6].
/// @param rank  0 the largest, 2 the least
std::vector<double> principal_values(std::span<const double> tensors, int rank);
/// √(3/2 s:s) of each: [node] from [node][6].
std::vector<double> von_mises_values(std::span<const double> tensors);

}  // namespace solidus::results
