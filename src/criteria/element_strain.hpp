/// The mean strain of an element, ∫ sym ∇u dV / V: the strain in which B-bar and the standard operator agree
/// (6.24).
#pragma once

#include <span>
#include <vector>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/tensor.hpp"

namespace solidus::criteria {

/// Mean values over the elements of one block, eight elements at a time.
class ElementStrain {
 public:
  ElementStrain(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind);

  Index n_batches() const { return n_batches_; }
  Index n_elements() const { return n_elements_; }
  /// @param displacement [local node][component] [m]
  Sym<Lane> strain(std::span<const double> displacement, Index batch) const;
  /// The mean of a nodal field, [local node].
  Lane mean(std::span<const double> nodal, Index batch) const;
  /// The magnitude of the mean gradient of a nodal field, [local node].
  Lane gradient(std::span<const double> nodal, Index batch) const;
  /// [m³], zero of padding; in two dimensions per depth, with an axis of the whole revolution.
  const Lane& volume(Index batch) const { return volume_[as_size(batch)]; }
  std::size_t bytes() const;

 private:
  const Index* nodes(Index batch) const {
    return nodes_.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes_ * k_lanes;
  }

  int n_nodes_, dim_;
  bool axisymmetric_;
  Index n_elements_, n_batches_;
  std::vector<Index> nodes_;   ///< [batch][node][lane]
  PackVector<Lane> gradient_;  ///< mean of ∂N_a/∂x_i, [batch][node][dim] [1/m]
  PackVector<Lane> hoop_;      ///< mean of N_a/r, [batch][node] [1/m]; axisymmetric only
  PackVector<Lane> share_;     ///< mean of N_a, [batch][node]
  PackVector<Lane> volume_;    ///< [batch]
};

}  // namespace solidus::criteria
