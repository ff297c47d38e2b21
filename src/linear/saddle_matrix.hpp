/// The saddle-point matrix of nodal displacements u and nodal pressures p, in block rows:
///
///   ⎡ A   B ⎤ ⎧u⎫       A  displacement matrix (block_matrix.hpp), only its upper half where it is symmetric
///   ⎣ Bᵀ −C ⎦ ⎩p⎭       B  gradient of the pressure, C  compliance and stabilisation
///
/// A node has `components` displacements and `fields` pressures. The pressure entries of a pair of nodes are
/// stored as one border per slot of A, so that both fields share a pattern and a product needs no copy in
/// another format. Where only half of A is stored, the border of a slot includes that of the transposed slot.
#pragma once

#include <span>
#include <vector>

#include "linear/block_matrix.hpp"

namespace solidus::linear {

class SaddleMatrix {
 public:
  using Slot = BlockMatrix::Slot;

  /// @param displacement  A; must outlive this object
  /// @param fields        pressures of a node
  SaddleMatrix(BlockMatrix& displacement, int fields);

  int components() const { return displacement_.block_size(); }
  int fields() const { return fields_; }
  BlockMatrix& displacement() { return displacement_; }
  const BlockMatrix& displacement() const { return displacement_; }

  /// Sets the borders to zero and leaves A as it is. Returns true if the pattern of A has changed.
  bool set_zero();
  /// The border of a pair (row node, column node): ∂r_u/∂p [component][field], then ∂r_p/∂u
  /// [field][component], then ∂r_p/∂p [field][field], which is −C. Slots are those of A, also the one without
  /// a row.
  double* border(Slot s) { return border_.data() + (s + 1) * border_size(); }
  const double* border(Slot s) const { return border_.data() + (s + 1) * border_size(); }

  /// (y_u, y_p) = K (u, p). u and p are [local node][…] with ghosts up to date, y_u and y_p are on owned
  /// nodes. Prescribed degrees of freedom and constraints are ignored.
  void multiply(std::span<const double> u, std::span<const double> p, std::span<double> y_u,
                std::span<double> y_p) const;
  /// y_u = B p, likewise.
  void multiply_gradient(std::span<const double> p, std::span<double> y_u) const;
  /// y_p = Bᵀ u, likewise.
  void multiply_divergence(std::span<const double> u, std::span<double> y_p) const;
  std::size_t bytes() const { return border_.capacity() * sizeof(double); }

 private:
  std::ptrdiff_t border_size() const { return 2 * components() * fields_ + fields_ * fields_; }

  BlockMatrix& displacement_;
  int fields_;
  int pattern_ = 0;
  std::vector<double> border_;  ///< a scrap border, then one per slot
};

}  // namespace solidus::linear
