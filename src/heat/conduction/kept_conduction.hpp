/// The part of the matrix of heat that does not change while the pattern stays, and the flows by it.
///
///   K_ij = Σ_m κ_m ∫∇N_i·∇N_j dV,   r_i = Σ_j K_ij (u_j − u_i)/κ, since Σ_j K_ij = 0              [W]
///
/// It is assembled when it is first needed. It stays in the matrix of the heat system, but for the diagonal,
/// where other terms have no entries besides that: 8 bytes an entry less than a copy.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "heat/conduction/conduction_elements.hpp"
#include "heat/conduction/conduction_limiter.hpp"
#include "heat/conduction/unsymmetric_part.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

/// Conduction at nodes that materials of different k(Θ)/κ share, in a symmetric matrix.
enum class SharedNodes { exact, plain };

class KeptConduction {
 public:
  /// Both must outlive this object.
  KeptConduction(const mesh::Mesh& mesh, ConductionElements& elements);

  /// The matrix has a new pattern, or there are other bodies: conduction is assembled again when it is
  /// needed.
  void bind(linear::BlockMatrix& matrix);
  /// Elements conduct otherwise than before: conduction is assembled again when it is needed.
  void forget();
  /// Whether terms other than conduction and its limits add to the diagonal of the matrix alone; on this
  /// process. False at first.
  void set_others_diagonal(bool on) { others_diagonal_ = on; }
  /// Whether conduction is limited from here on (conduction_limiter.hpp). Off at first.
  void limit(bool on);
  /// Null where conduction is not limited. Its pairs are those of the last keep().
  ConductionLimiter* limiter() { return limiter_.get(); }
  /// Assembles conduction unless it is kept. Collective.
  void keep();
  /// Copies conduction out of the matrix, which gets further terms off its diagonal.
  void keep_apart();

  /// Conduction without its limits, [local node] [W], valid until release_work(); may be added to. A uniform
  /// temperature gives no flow to the last bit, and what one node of a pair gives the other one gets.
  std::span<double> flow(std::span<const double> temperature);
  /// Assembles the matrix again where it keeps conduction: the diagonal alone. Returns false, and does
  /// nothing, where it does not.
  /// @param add_others  adds the derivatives of the other terms by temperature to the matrix
  /// @param slopes      c of nodal_potential.hpp, [local node]
  bool assemble_diagonal(std::span<const double> slopes, const std::function<void()>& add_others);
  /// Adds conduction that is kept apart, ∂r/∂v, to the matrix, symmetric; what that leaves out to `rest`.
  void add(std::span<const double> temperature, std::span<const double> slopes, SharedNodes shared,
           UnsymmetricPart& rest) const;
  void release_work();
  std::size_t bytes() const;

 private:
  /// K_ij of one body between two nodes that both belong to several bodies, i = j included.
  struct SharedPair {
    Index i, j;
    int body;
    double k;  ///< ∫∇N_i·∇N_j dV [m]
    linear::BlockMatrix::Slot slot;
  };
  bool kept() const { return !kept_.empty() || !diagonal_.empty(); }
  bool only_diagonal_beside() const;
  void find_node_bodies();
  void find_shared_pairs(int body);

  const mesh::Mesh& mesh_;
  ConductionElements& elements_;
  linear::BlockMatrix* matrix_ = nullptr;
  std::unique_ptr<ConductionLimiter> limiter_;
  /// Conduction by slot; empty until it is needed, and where the matrix keeps it: then its diagonal is in
  /// `diagonal_`, [owned node].
  std::vector<double> kept_, diagonal_;
  bool others_diagonal_ = false;
  bool apart_ = false;          ///< nodes belong to several bodies, or something else had entries there
  std::vector<int> node_body_;  ///< the body of each local node, −1 of several; empty: there is one body
  std::vector<SharedPair> shared_;
  std::vector<double> flow_;  ///< work, [local node]
};

}  // namespace solidus::heat
