/// Heat between the two surfaces as a term of the thermal phase; an internal part of ContactPair.
#pragma once

#include <span>
#include <vector>

#include "algebra/contribution.hpp"
#include "algebra/coupled_matrix.hpp"
#include "contact/heat_transfer.hpp"
#include "contact/integration.hpp"

namespace solidus::contact {

/// The heat that each node gives off. With the surfaces' temperatures Θ_s = Σ N_i Θ_i and Θ_m = Σ N_j Θ_j at
/// a point, h at their mean:
///
///   nodal form       r_i += w N_i [h (Θ_i − Θ_m) + e (Θ_i⁴ − Σ_j N_j Θ_j⁴)]    on the slave
///                    r_j −= w N_j [h (Θ_s − Θ_j) + e (Σ_i N_i Θ_i⁴ − Θ_j⁴)]    on the master
///   consistent form  r_a += w B_a [h Σ_b B_b Θ_b + e Σ_b B_b Θ_b⁴]             B: N of the slave, −N of the
///   master
///
/// e = σ_r F. Both are sums of exchanges between pairs of nodes, so heat is conserved to rounding. In the
/// nodal form the pairs are one of the slave and one of the master, with h N_i N_j >= 0 for linear shapes:
/// with it a matrix of non-negative type stays one (6.3.1).
///
/// The tangent takes 2 e N_i N_j (Θ_i³ + Θ_j³) for radiation, the mean of the two derivatives: it keeps the
/// matrix symmetric and, being off by O(Θ_i − Θ_j), costs iterations, not accuracy. A law that changes with
/// the temperature has its exact tangent, which is not symmetric.
class HeatTerm : public algebra::Contribution {
 public:
  /// Keeps references to the points and the law.
  /// @param nodal  the nodal form
  HeatTerm(const mesh::Mesh& mesh, const ContactPoints& points, const HeatTransferLaw& law, bool nodal);
  /// Freezes the configuration: g_N [m] and t_N [Pa], [point].
  void place(std::span<const double> penetration, std::span<const double> pressure);
  /// Off: no term at all.
  void activate(bool on) { active_ = on; }
  /// Whether the tangent is symmetric.
  bool symmetric() const { return !law_.of_temperature(); }

  void add_to_graph(algebra::NodeGraph& graph) const override;
  void bind(const algebra::BlockMatrix& matrix) override;
  void add_residual(std::span<const double> x, std::span<double> r) override;
  void add_tangent(std::span<const double> x, algebra::BlockMatrix& matrix) override;
  /// Adds ∂r/∂u through the conductance of every point, the gap being g_N = g_N⁰ + Σ_a B_a u_a·n.
  /// @param pressure_slope  ∂t_N/∂g_N, [point] [Pa/m]
  /// @param slots           of the displacement's matrix, [pairing][a][b]
  void add_gap_tangent(std::span<const double> pressure_slope, std::span<const double> temperature,
                       std::span<const algebra::BlockMatrix::Slot> slots,
                       algebra::CoupledMatrix& matrix) const;
  /// From slave to master through the pairings that this process counts [W].
  double counted_heat(std::span<const double> temperature) const;
  /// h [W/(m² K)] of every point at these temperatures; without any, at room temperature.
  std::vector<double> conductances(std::span<const double> temperature) const;
  std::size_t bytes() const {
    return slots_.capacity() * sizeof(algebra::BlockMatrix::Slot) +
           (fixed_.capacity() + opening_.capacity() + pressure_.capacity()) * sizeof(double);
  }

 private:
  /// What a point of a pairing sees.
  struct AtPoint {
    std::size_t point = 0;
    const double* b = nullptr;                   ///< B of every node
    double slave = 0, master = 0;                ///< Θ_s, Θ_m
    double slave_fourth = 0, master_fourth = 0;  ///< Σ N Θ⁴
    Conductance h;
  };
  /// Calls f(at) for the points of a pairing.
  template <class Function>
  void for_points(const Pairing& pairing, std::span<const double> temperature, Function f) const;
  /// Adds `weight` × what every node gives off when h is `h` and e is `e`.
  void add_heat(const Pairing& pairing, const AtPoint& at, std::span<const double> temperature,
                double weight_h, double weight_e, std::span<double> heat) const;

  Index n_owned_;
  const ContactPoints& points_;
  const HeatTransferLaw& law_;
  bool nodal_;
  bool active_ = true;
  std::vector<double> opening_, pressure_;  ///< [point]
  std::vector<double> fixed_;               ///< h of a law that does not change with the temperature, [point]
  std::vector<std::size_t> first_slot_;     ///< of each pairing
  std::vector<algebra::BlockMatrix::Slot> slots_;
};

}  // namespace solidus::contact
