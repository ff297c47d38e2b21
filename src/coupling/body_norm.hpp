/// The size of a nodal field: its root mean square over the volume of a body, in the body where it is
/// largest.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::coupling {

class BodyNorm {
 public:
  BodyNorm(const mesh::Mesh& mesh, AnalysisKind kind);

  /// max_b sqrt(Σ_i w_ib |v_i|² / Σ_i w_ib) with the closed rule's nodal weights w_ib of body b
  /// (mesh::nodal_weights); |v_i| is the length of the node's vector. Collective; the same bits on every
  /// process.
  /// @param values [local node][component]; empty: zero
  double operator()(std::span<const double> values) const { return (*this)(values, {}); }
  /// The same norm over the nodes that count; the others are zero, but their volume counts in the mean.
  /// @param counts [local node]; empty: all do
  double operator()(std::span<const double> values, std::span<const char> counts) const;
  /// The same as the first of what is left of a displacement when the rigid motion that fits it best is taken
  /// away from every body: a translation and a small rotation, in plane strain about z; along the axis where
  /// the analysis is axisymmetric. Fitted to the nodes that count. Collective.
  /// @param displacement [local node][component] [m]
  double of_distortion(std::span<const double> displacement, std::span<const char> counts) const;
  /// What is left at the node that lies farthest from there [m]; a value that is not a number stays one.
  /// Collective.
  double farthest_distortion(std::span<const double> displacement, std::span<const char> counts) const;
  /// max_b |Σ_i w_ib v_i| / Σ_i w_ib of values with one component: how far the mean of a body is off. As
  /// above.
  double mean(std::span<const double> values) const;

 private:
  struct Share {
    Index node;  ///< owned
    int body;
    double weight;  ///< share of the body's volume
  };
  struct Moments;  ///< of the displacement of a body
  std::vector<Moments> moments(std::span<const double> displacement, std::span<const char> counts) const;
  /// Calls `take` with each share of a node that counts, its place from the centre of the body and its
  /// displacement.
  template <class Take>
  void each_displaced(std::span<const double> displacement, std::span<const char> counts,
                      const Take& take) const;
  double largest(const std::vector<double>& squares) const;

  const mesh::Mesh* mesh_;
  AnalysisKind kind_;
  std::vector<Share> shares_;
  std::vector<mesh::Point> centre_;  ///< of each body
  std::size_t n_bodies_ = 0, n_nodes_ = 0;
};

}  // namespace solidus::coupling
