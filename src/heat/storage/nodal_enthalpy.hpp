/// The closed rule's storage of heat: one monotone graph H_i(Θ) = Σ_m w_im h_m(Θ) per node (monograph 6.3.1,
/// 4.149).
///
/// The weights are those of the closed rule (mesh::nodal_weights), the curves those of the materials around
/// the node. The graph rises strictly and is vertical where a change is isothermal, so its inverse Θ_i(H) is
/// a continuous function with slope zero there: a plateau.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "heat/storage/node_shares.hpp"
#include "linear/active_set.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

class NodalEnthalpy {
 public:
  /// @param materials one per body; copied as far as needed
  NodalEnthalpy(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<material::Material>& materials);

  /// The part of a node's heat that bodies which are there hold [J].
  double held_by(const linear::ActiveSet& active, Index node, double heat, double temperature) const;
  /// From here on nodes hold the heat of active bodies alone, those that come back included; nodes that
  /// belong to other bodies alone store nothing.
  void set_active(const linear::ActiveSet& active);
  /// Removes the bodies of which kept[body] is zero for good.
  void keep_bodies(std::span<const char> kept);
  /// From here on nodes hold other amounts of some bodies than they have room for: volume() is the room as
  /// before, all heats are those of what is held. Not together with set_active().
  /// @param moves  [body]: whether it counts
  /// @param held   [owned node]: what is held of these bodies over what fills their room, above zero
  void hold(std::span<const char> moves, std::span<const double> held);
  /// The part of a node's heat that bodies of which of[body] is not zero have [J].
  double heat_of(std::span<const char> of, Index node, double heat, double temperature) const;

  Index n_nodes() const { return shares_.n_nodes(); }  ///< owned ones
  /// Θ_i(H) [K]; H in joules. Not of a node that stores nothing.
  double temperature(Index node, double heat) const;
  /// dΘ_i/dH [K/J]; zero within a plateau and where nothing is stored.
  double slope(Index node, double heat) const;
  /// Θ_i(H) and dΘ_i/dH by one look-up.
  struct Point {
    double temperature;  ///< [K]
    double slope;        ///< [K/J]
  };
  Point point(Index node, double heat) const;
  /// The share of the only body that stores heat at the node; nothing where there are several or none.
  std::optional<NodeShare> only_share(Index node) const {
    const NodeShares::List list = shares_[node];
    return list.size() == 1 ? std::optional(list.front()) : std::nullopt;
  }
  std::size_t n_bodies() const { return curves_.size(); }
  const material::EnthalpyCurve& body_curve(int body) const { return curves_[as_size(body)]; }
  /// H_i at a temperature; at a jump both ends.
  double lower(Index node, double temperature) const;
  double upper(Index node, double temperature) const;
  /// Share of the isothermal change at this temperature that is done: from 0 at the cold end to 1 at the hot
  /// end; 1 without a jump.
  double plateau_share(Index node, double heat, double temperature) const;
  /// Returns the position of the node among its plateaus: twice the number of those below it, and one more on
  /// a plateau.
  int branch(Index node, double heat, double temperature) const;
  /// Mean solid fraction of the materials of a node that can melt, 1 if none can (2.65).
  double solid_fraction(Index node, double heat, double temperature) const;
  /// True when a material has an isothermal change.
  bool has_plateaus() const;
  /// ∫ dH/Θ of sensible and latent heat up to a constant, temperatures above zero [J/K].
  double entropy(Index node, double heat, double temperature) const;
  /// The heat of all phase changes of materials that have an isothermal one [J].
  double latent_capacity(Index node) const;
  /// The part of the heat that is latent [J].
  double latent(Index node, double heat, double temperature) const;
  /// Σ_m w_im h_m of what `per_volume(body)` says each body holds at the node [J/m³] [J].
  template <class PerVolume>
  double sum_of_bodies(Index node, const PerVolume& per_volume) const {
    double total = 0;
    for (const NodeShare s : shares_[node]) total += s.weight * per_volume(s.body);
    return total;
  }
  /// h(Θ) of the material of a body; molten at the temperature of a change [J/m³].
  double body_enthalpy(int body, double temperature) const {
    return curves_[as_size(body)].upper(temperature);
  }
  /// Volume [m³] that the node holds of a body.
  double volume(Index node, int body) const;
  /// Solid volume [m³] that the node holds of a body.
  double solid_volume(Index node, int body, double heat, double temperature) const;
  bool can_melt(int body) const { return materials_[as_size(body)].solidification() != nullptr; }
  const material::Material& material(int body) const { return materials_[as_size(body)]; }
  /// Σ_m w_im of something that the materials around the node have per volume.
  template <class PerVolume>
  double sum(Index node, const PerVolume& per_volume) const {
    double total = 0;
    for (const NodeShare s : shares_[node]) total += s.weight * per_volume(materials_[as_size(s.body)]);
    return total;
  }
  /// ∂H/∂Θ at the node without jumps [J/K].
  double capacity(Index node, double temperature) const;
  std::size_t bytes() const;

 private:
  const material::EnthalpyCurve& curve(const NodeShare& share) const { return curves_[as_size(share.body)]; }
  bool jumps_at(Index node, double temperature) const;
  double mixed_temperature(const NodeShares::List& shares, double heat, bool& plateau) const;
  void filter(const NodeShares& from, std::span<const char> kept);

  std::vector<material::Material> materials_;
  std::vector<material::EnthalpyCurve> curves_;  ///< per body
  std::vector<std::vector<double>> starts_;      ///< per body, h at the start of each piece [J/m³]
  std::vector<double> breaks_;                   ///< temperatures where any curve bends or jumps, rising [K]
  NodeShares shares_;
  std::optional<NodeShares> all_;  ///< with those of inactive bodies; none as long as none has been inactive
  std::optional<NodeShares> rooms_;  ///< the shares without hold(); none before its first call
};

}  // namespace solidus::heat
