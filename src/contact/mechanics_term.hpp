/// Contact forces as a term of the mechanical phase; an internal part of ContactPair.
#pragma once

#include <vector>

#include "algebra/contribution.hpp"
#include "contact/integration.hpp"
#include "contact/normal.hpp"

namespace solidus::contact {

/// r_a = Σ_p w t_N B_a n, with B the shape functions of the slave and minus those of the master, so that
/// g_N = g_N⁰ + Σ_a B_a u_a·n and the virtual work of contact is t_N δg_N. Tangent: Σ w ε_N B_a B_b n⊗n over
/// closed points, symmetric, exact away from g_N = 0.
class MechanicsTerm : public algebra::Contribution {
 public:
  /// Keeps references to the points and the law.
  MechanicsTerm(const mesh::Mesh& mesh, int components, const ContactPoints& points, const NormalPenalty& law,
                double stabilisation);
  void add_to_graph(algebra::NodeGraph& graph) const override;
  void bind(const algebra::BlockMatrix& matrix) override;
  /// Off: no term at all.
  void activate(bool on) { active_ = on; }
  void add_residual(std::span<const double> x, std::span<double> r) override;
  void add_tangent(std::span<const double> x, algebra::BlockMatrix& matrix) override;

  /// g_N of point `p` of a pairing at the displacement [m].
  double penetration(const Pairing& pairing, Index p, std::span<const double> displacement) const;
  /// Of the matrix it is bound to, [pairing][a][b].
  std::span<const algebra::BlockMatrix::Slot> slots() const { return slots_; }
  std::size_t bytes() const { return slots_.capacity() * sizeof(algebra::BlockMatrix::Slot); }

 private:
  template <int dim>
  void add_pairing_tangent(const Pairing& pairing, std::span<const double> x,
                           const algebra::BlockMatrix::Slot* slots, algebra::BlockMatrix& matrix) const;

  Index n_owned_;
  int components_;
  const ContactPoints& points_;
  const NormalPenalty& law_;
  double stabilisation_;
  bool active_ = true;
  std::vector<algebra::BlockMatrix::Slot> slots_;  ///< [pairing][a][b]
};

/// Couples all nodes of every pairing with each other.
void add_pairings_to_graph(const ContactPoints& points, algebra::NodeGraph& graph);
/// Slots of all pairs of nodes of every pairing, [pairing][a][b]; rows of other processes are k_no_slot.
std::vector<algebra::BlockMatrix::Slot> pairing_slots(const ContactPoints& points, Index n_owned,
                                                      const algebra::BlockMatrix& matrix);

}  // namespace solidus::contact
