/// Heat between the two surfaces as a term of the thermal phase; an internal part of ContactPair.
#pragma once

#include <vector>

#include "algebra/contribution.hpp"
#include "algebra/coupled_matrix.hpp"
#include "contact/integration.hpp"

namespace solidus::contact {

/// The heat that each node gives off, as the sum of exchanges between pairs of nodes i, j of a pairing,
///
///   r_i += q_ij,  r_j −= q_ij,   q_ij = c_ij (Θ_i − Θ_j) + e_ij (Θ_i⁴ − Θ_j⁴),
///
/// so heat is conserved to the last bit but rounding. Nodal form: i on the slave, j on the master,
/// c_ij = Σ_p w h N_i N_j, e_ij = Σ_p w σ_r F N_i N_j. For linear shapes all c_ij >= 0: with it a matrix of
/// non-negative type stays one (6.3.1). Consistent form, ∫ h B_i (Θ_s − Θ_m) dA: the same with all pairs of
/// nodes and c_ij = −Σ_p w h B_i B_j (B: N of the slave, −N of the master; ΣB = 0).
///
/// The tangent takes 2 e_ij (Θ_i³ + Θ_j³) for radiation, the mean of the two derivatives: it keeps the matrix
/// symmetric and, being off by O(Θ_i − Θ_j), costs iterations, not accuracy.
class HeatTerm : public algebra::Contribution {
 public:
  /// @param radiation_factor σ_r F [W/(m² K⁴)]
  /// @param nodal            the nodal form
  HeatTerm(const mesh::Mesh& mesh, const ContactPoints& points, double radiation_factor, bool nodal);
  /// Freezes h [W/(m² K)], [point].
  void set_conductance(std::span<const double> conductance);

  /// Off: no term at all.
  void activate(bool on) { active_ = on; }

  void add_to_graph(algebra::NodeGraph& graph) const override;
  void bind(const algebra::BlockMatrix& matrix) override;
  void add_residual(std::span<const double> x, std::span<double> r) override;
  void add_tangent(std::span<const double> x, algebra::BlockMatrix& matrix) override;
  /// Adds ∂r/∂u through the conductance of every point, the gap being g_N = g_N⁰ + Σ_a B_a u_a·n.
  /// @param slope  ∂h/∂g_N, [point] [W/(m³ K)]
  /// @param slots  of the displacement's matrix, [pairing][a][b]
  void add_gap_tangent(std::span<const double> slope, std::span<const double> temperature,
                       std::span<const algebra::BlockMatrix::Slot> slots,
                       algebra::CoupledMatrix& matrix) const;
  /// From slave to master through the pairings that this process counts [W].
  double counted_heat(std::span<const double> temperature) const;
  std::size_t bytes() const {
    return slots_.capacity() * sizeof(algebra::BlockMatrix::Slot) +
           (conduction_.capacity() + radiation_.capacity()) * sizeof(double);
  }

 private:
  /// Sums −w f B_i B_j over the points into [pairing][i][j], i < j.
  template <class Factor>
  void exchange(std::vector<double>& coefficients, Factor factor) const;
  /// Calls f(pairing, i, j, entry) for all pairs i < j that exchange heat.
  template <class Function>
  void for_pairs(const Pairing& pairing, Function f) const;

  Index n_owned_;
  const ContactPoints& points_;
  bool nodal_;
  bool active_ = true;
  std::vector<std::size_t> first_entry_;  ///< of each pairing in the coefficients and slots: n × n
  std::vector<double> conduction_;        ///< c_ij [W/K]
  std::vector<double> radiation_;         ///< e_ij [W/K⁴]; empty without radiation
  std::vector<algebra::BlockMatrix::Slot> slots_;
};

}  // namespace solidus::contact
