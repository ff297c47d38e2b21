/// A pair of surfaces that may touch and part: forces and heat between them as terms of the two phases.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "algebra/contribution.hpp"
#include "algebra/coupled_matrix.hpp"
#include "contact/integration.hpp"
#include "contact/normal.hpp"
#include "contact/spec.hpp"

namespace solidus::contact {

class MechanicsTerm;
class HeatTerm;

/// Sums over a pair, all processes (axisymmetric: of the whole revolution; plane strain: per metre).
struct ContactSums {
  GlobalIndex points = 0, closed_points = 0;
  double force = 0;        ///< ∫ t_N dA [N]
  double closed_area = 0;  ///< area of the closed points [m²]
  double energy = 0;       ///< ∫ ½ ε_N ⟨g_N⟩² dA [J]
  double heat = 0;         ///< from slave to master [W]
};

/// Averages around the nodes of both surfaces, [owned node of the surface]; NaN at nodes without a point
/// (the surface has no partner there). Weighted with w N_a².
struct ContactNodalFields {
  std::vector<Index> nodes;         ///< local numbers of owned nodes, slave's and master's, sorted
  std::vector<double> opening;      ///< [m], negative: penetration
  std::vector<double> pressure;     ///< t_N [Pa]
  std::vector<double> conductance;  ///< h without radiation [W/(m² K)]; zero without heat
};

class ContactPair {
 public:
  /// Finds the partners and starts with zero displacement. Collective.
  /// @param body_modulus E [Pa] of every body of the mesh, for a penalty given as a factor
  /// Throws InputError for surfaces that do not exist, have no partner at all, or for a law that is none.
  ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactSpec spec,
              std::span<const double> body_modulus = {});
  ~ContactPair();
  ContactPair(const ContactPair&) = delete;
  ContactPair& operator=(const ContactPair&) = delete;

  /// Off: open at every point, without force, heat, energy or stabilisation, whatever the gap; gaps are still
  /// measured. Between steps; holds from the next update() on.
  void activate(bool on);
  bool active() const { return active_; }

  /// The term of the mechanical phase: r = ∫ t_N δg_N dA of the displacement it is called with, whatever the
  /// state of update().
  algebra::Contribution& mechanics();
  /// The term of the thermal phase, at the gaps and pressures of the last update(); null without a heat law.
  algebra::Contribution* heat();

  /// Gap, pressure and conductance of every point for a displacement: [local node][component], ghosts up to
  /// date [m]. Local, no communication.
  void update(std::span<const double> displacement);

  /// Adds the derivative of the heat with respect to the displacement, through the conductances of the last
  /// update(); nothing without a heat law. The mechanical term must be bound to the displacement's matrix.
  void add_coupling(std::span<const double> temperature, algebra::CoupledMatrix& matrix) const;

  /// Sums at the last update(); `temperature` [local node] or empty (heat = 0). Collective.
  ContactSums sums(std::span<const double> temperature) const;
  /// Work that closes the gaps from an earlier penetration to that of the last update(), by the mean of the
  /// pressures at both [J]. Collective.
  /// @param share of the last update() in the mean
  double work(std::span<const double> old_penetration, double share) const;
  /// Averages at nodes, at the last update(). Local.
  /// @param temperature  [local node] [K]; empty: a law of it is taken at room temperature
  ContactNodalFields nodal_fields(std::span<const double> temperature = {}) const;
  /// Heat that leaves the slave's and enters the master's surface around every owned node [W]: positive where
  /// the node loses heat; the sum over all is zero. [owned node].
  std::vector<double> nodal_heat(std::span<const double> temperature) const;

  const ContactSpec& spec() const { return spec_; }
  const ContactPoints& points() const { return points_; }
  double penalty() const { return law_.penalty; }  ///< ε_N [Pa/m]
  /// Part of the slave surface that has a partner, 0 to 1.
  double coverage() const { return points_.paired_measure / points_.slave_measure; }
  std::span<const double> penetration() const { return penetration_; }  ///< [point] [m]
  std::span<const double> pressure() const { return pressure_; }        ///< [point] [Pa]
  std::size_t bytes() const;

 private:
  const mesh::Mesh& mesh_;
  ContactSpec spec_;
  int components_;
  bool active_ = true;
  ContactPoints points_;
  NormalPenalty law_;
  std::optional<HeatTransferLaw> heat_law_;
  std::vector<double> penetration_, pressure_;
  std::unique_ptr<MechanicsTerm> mechanics_;
  std::unique_ptr<HeatTerm> heat_;
};

}  // namespace solidus::contact
