/// History of a contact pair at the ends of a step: that of bodies that have not moved, that of new bodies,
/// and the state at t_n as a step sets out from it.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "contact/forces/step.hpp"
#include "contact/points/geometry.hpp"
#include "contact/points/master_wear.hpp"
#include "contact/points/point_law.hpp"
#include "contact/surfaces/skin.hpp"

namespace solidus::contact {

class ContactHistory {
 public:
  /// Keeps references. Throws InputError where a rigid surface is to wear.
  ContactHistory(const ContactGeometry& geometry, AnalysisKind kind, const ContactParameters& spec,
                 const PairSurfaces& surfaces, const PointLaw& law);

  /// The history of bodies that have not moved.
  ContactState initial() const;
  /// The history where bodies of a side are new (a casting of the next shot) and without displacement: points
  /// of a new slave and nodes of a new master have none; a slave that stays keeps what wears it. Melt fills
  /// the space between deformed walls: gaps are those of the drawing, whatever the displacement of a meshed
  /// master or of a slave that stays. Local.
  /// @param displacement  [local node][component] [m]
  ContactState renewed(const ContactState& old, bool new_slave, bool new_master,
                       std::span<const double> displacement, double time) const;
  /// Elements have come or gone: points that have their faces now and had not begin as metal that arrives at
  /// what is there, with the gaps of the drawing whatever the displacement, closed where the drawing closes
  /// them; those that have lost a face forget everything. Local.
  /// @param before  ContactGeometry::there() until now
  void follow_elements(std::span<const char> before, std::span<const double> displacement, double time,
                       ContactState& state) const;
  /// Makes a state (empty: initial()) the one that a step sets out from.
  void set_out_from(const ContactState& state, ContactStep& step) const;
  /// Sets what the skin does at a point. Metal below coherency does not rub there; and where it touches its
  /// wall it wets it, if the pair knows an atmosphere, and stays so while it is below coherency, whatever gap
  /// opens. A gap that was there before, or that a coherent skin has left, holds air until it closes. The
  /// penalty follows the strength of the skin (PointLaw::stiffen).
  /// @param of_nodes  ContactPass::solidity; empty: nothing melts
  void find_skins(const Solidity& of_nodes, ContactStep& step) const;
  /// Sets the temperature of interface points that have none yet to that at rest between the two sides at
  /// t_n, whatever the other iterates of the step; where no heat passes Θ_c has no balance and is the sides'
  /// mean in every step. A point without a partner at t_n counts no slip in the step in which it finds one,
  /// so friction does not need its temperature.
  /// @param temperature  [local node] [K]
  /// @param slave_share  the slave's part in the mean (HeatTransferLaw::slave_share)
  /// @param balances     the interface has a temperature of its own
  /// @param tool         of a rigid master at t_n [K]
  void find_temperatures(std::span<const double> temperature, double slave_share, bool balances,
                         std::optional<double> tool, ContactStep& step) const;
  /// Adds what a point that slips wears off the master, where the master wears.
  void wear_master(const PointMotion& motion, const ContactPointState& now, const PointForces& forces,
                   std::vector<WornNode>& master) const;
  /// Wear of the master's nodes; empty where it does not wear.
  std::vector<MasterWear::Depth> depths(const ContactState& state) const;

 private:
  /// A point where the bodies are as drawn.
  ContactPointState as_drawn(Index point, const ContactKinematics& kinematics) const;
  /// Keeps the gap that a point has as drawn in the present geometry.
  static void keep_gap(Index p, const ContactKinematics& now, ContactPointState& point);

  const ContactGeometry& geometry_;
  const ContactParameters& spec_;
  const PointLaw& law_;
  std::unique_ptr<MasterWear> worn_;  ///< absent where the master does not wear
};

}  // namespace solidus::contact
