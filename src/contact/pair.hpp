/// A pair of surfaces that may touch and part: forces and heat between them as terms of the two phases.
///
/// A pair is made of parts with one purpose each, which it calls one after the other:
///
///   geometry (geometry.hpp)        surfaces, points, partners in a configuration
///   history  (history.hpp)         what points and nodes remember from step to step
///   forces   (forces.hpp)          laws of the points, term of the mechanical phase, multipliers
///   heat     (heat.hpp)            term of the thermal phase, balance of the interface
///   report   (contact_report.hpp)  sums, means at nodes, work of a step, from view()
///
/// A mechanical pass goes begin(state at t_n) – Newton's iteration with mechanics() – update(solution);
/// state() is then the history at t_{n+1}, which the scheme keeps or throws away. Points do not know each
/// other, and every process brings the points that its nodes can meet to the same state.
///
/// Signs: inside of this room a gap is a penetration g_N, positive where the bodies overlap (3.5), from the
/// projection (Partner) over points (PointMotion, PointState, HeatPoint) to the conductance
/// (HeatTransferLaw::at). Laws of the gap alone take its width −g_N >= 0 (laws/gap_law.hpp), and reports for
/// people call −g_N the opening.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contact/contact_report.hpp"
#include "contact/forces/forces.hpp"
#include "contact/forces/history.hpp"
#include "contact/heat/heat.hpp"
#include "contact/points/geometry.hpp"
#include "contact/points/parameters.hpp"
#include "linear/contribution.hpp"
#include "linear/coupled_matrix.hpp"

namespace solidus::contact {

/// Input of a pass of the mechanical phase: the times, the fields at t_n and the way in which the interface's
/// temperature is found.
struct ContactPass {
  double time = 0, dt = 0;                 ///< t_{n+1} and the step [s]
  std::span<const double> displacement{};  ///< u_n, [local node][component] [m]
  std::span<const double> temperature{};   ///< Θ_n, [local node] [K]; empty: unknown
  Solidity solidity{};                     ///< at t_n
  bool isentropic = false;                 ///< the pass holds the entropy of the interface, not Θ_c
  bool simultaneous = false;  ///< Θ_c is found together with the slip (5.40), see set_temperature()
  /// Result of the pass before in a scheme whose phases are solved in alternation within the step: friction
  /// holds its Θ_c, or its entropy, and multipliers start from the ones found there, so that passes that have
  /// not come to their end go on where they were. Null: that of t_n.
  const ContactState* iterate = nullptr;
  bool further = false;  ///< a further pass of the same step: augmentations that ended early stay ended
  double share = 1;      ///< s of normal.hpp
};

class ContactPair {
 public:
  /// Finds the partners and starts with zero displacement. Collective.
  /// @param body_modulus E [Pa] of every body of the mesh, for a penalty given as a factor
  /// Throws InputError for surfaces that do not exist, have no partner at all, or for a law that is none.
  ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactParameters spec,
              std::span<const double> body_modulus = {});
  ContactPair(const ContactPair&) = delete;
  ContactPair& operator=(const ContactPair&) = delete;

  /// Off: open at every point, without force, heat, energy or stabilisation, whatever the gap; gaps are still
  /// measured. Friction's history stays, but slip is counted again after it. Between steps; holds from the
  /// next update() or restore() on.
  void activate(bool on);
  bool active() const { return active_; }

  const ContactParameters& spec() const { return spec_; }
  const ContactGeometry& geometry() const { return *geometry_; }
  const ContactHistory& history() const { return *history_; }
  const ContactForces& forces() const { return *forces_; }
  /// Whether points find their partners again as they slide.
  bool slides() const { return geometry_->kinematics().partners_change(); }
  /// MechanicsTerm::follow_weights; at first where forces() are unsymmetric anyway.
  void follow_weights(bool on) { forces_->term().follow_weights(on); }
  /// All that reports are made from, at the last update() or restore(): valid until the next one.
  ContactView view() const;

  /// The term of the mechanical phase, of the displacement it is called with and the start of the step,
  /// whatever the state of update().
  linear::Contribution& mechanics() { return forces_->term(); }
  /// The term of the thermal phase, with the configuration of the last update(); null without a heat law.
  linear::Contribution* heat() { return heat_ ? &heat_->term() : nullptr; }
  /// Whether the derivative of heat() is symmetric.
  bool symmetric_heat() const { return !heat_ || heat_->term().symmetric(); }

  /// The history where bodies of a side are new (a casting of the next shot) and without displacement: points
  /// of a new slave and nodes of a new master have none; a slave that stays keeps what wears it. Melt fills
  /// the space between deformed walls: gaps are those of the drawing, whatever the displacement of a meshed
  /// master or of a slave that stays. Local.
  /// @param displacement  [local node][component] [m]
  ContactState renewed_state(const ContactState& old, bool new_slave, bool new_master,
                             std::span<const double> displacement, double time) const {
    return history_->renewed(old, new_slave, new_master, displacement, time);
  }
  /// Begins a step from the state `old`; empty: that of bodies that have not moved. Local, no communication.
  void begin(const ContactState& old, const ContactPass& pass);
  /// Lets the tangents of mechanics() hold so many times the stabilisation (ContactParameters), until the
  /// next begin(). Forces, and so the solution, do not know it.
  void stabilise(double times) { forces_->term().hold(times); }
  /// Sets the present temperatures of the bodies within a simultaneous pass, [local node], for mechanics()
  /// and the next update(). Local.
  void set_temperature(std::span<const double> temperature);
  /// Updates forces and history of every point for a displacement, and their data for the heat term: [local
  /// node][component], ghosts up to date [m]. Returns the history at t_{n+1}. Local, no communication.
  const ContactState& update(std::span<const double> displacement);
  /// Restores the pair as it was after the update() that ended in `state` (empty: bodies that have not moved)
  /// at this displacement and time. Local.
  void restore(const ContactState& state, std::span<const double> displacement, double time);
  /// Whether the interface has a temperature Θ_c of its own: heat passes, and it rubs or stores heat.
  bool has_temperature() const { return heat_ && heat_->has_temperature(); }
  /// Begins a step of bodies that do not deform and updates the pair: heat alone, where the interface stores
  /// it. Local.
  void hold(const ContactState& old, double time, double dt, std::span<const double> temperature);
  /// State of the points at the last update() or restore().
  const ContactState& state() const { return end_.state; }

  /// Begins a thermal phase over `dt`, which need not be the time step of the mechanical pass; an adiabatic
  /// phase has no fluxes. commit_heat() ends it. Without this call the heat is that of the mechanical pass.
  void begin_heat(double dt, bool adiabatic);
  /// Θ_c of the points if what their slip has heated flowed to the bodies in its step, at temperatures of the
  /// bodies [local node] [K]; empty where the interface has none. Between thermal phases. Local.
  std::vector<double> conducted_temperatures(std::span<const double> temperature) const;
  /// Holds the present deformation: the heat of friction of the last update() is dropped, so that a thermal
  /// phase that follows has none.
  void hold_deformation();
  /// The gaps that heat passes through, at the last update() or restore(), or those of conduct_through():
  /// [point]; empty without a heat law. Local.
  std::vector<HeatGap> heat_gaps() const;
  /// The gaps as they would be at a later displacement [local node][component], ghosts up to date [m], and
  /// time, seen from state(): open ones widen or close with the motion; those that carry a pressure, or melt
  /// that clings to its wall, stay closed, since their forces do not follow from the motion alone. Local.
  std::vector<HeatGap> heat_gaps_ahead(std::span<const double> displacement, double time) const;
  /// Conducts through these gaps until the next update() or restore(), wherever a point has a partner in
  /// both. Local.
  void conduct_through(std::span<const HeatGap> gaps);
  /// The heat that passes at these temperatures [local node] through the gaps `used` instead of the right
  /// ones. Collective.
  GapHeat gap_heat(std::span<const HeatGap> used, std::span<const HeatGap> right,
                   std::span<const double> temperature) const;
  /// Predicts the heat of the second of two equal mechanical passes of a step by that of the first. The
  /// thermal phase between them takes heat and entropy of the slip of the first pass twice, and the same
  /// amount is subtracted from those of the second pass.
  void predict_heat();
  /// Ends the thermal phase: computes Θ_c and S^p_c of every point at the temperatures found [local node] and
  /// commits them to state(). Zero without friction or heat. Collective.
  InterfaceSums commit_heat(std::span<const double> temperature);

  /// Augments the multipliers once, from the last update() (augmented_lagrangian.hpp). Collective.
  void augment(AugmentedBy by = AugmentedBy::means) { forces_->augment(end_.state, step_, by); }
  /// The largest mean penetration around a node of the slave at the last update(), over closed points, as a
  /// share of what is allowed; zero where there is no augmented Lagrangian. Collective.
  double excess() const { return forces_->excess(end_.state); }
  /// Lets augmentations that do not settle end early, from now on: a last resort (augmented_lagrangian.hpp).
  void allow_early_end(bool on) { forces_->multipliers().allow_early_end(on); }
  /// Takes the last augmentation back and ends the augmentations of the step; ends them with the multipliers
  /// of now.
  void take_back_turn() { forces_->take_back_turn(step_); }
  void end_turns() { forces_->multipliers().end_turns(); }
  /// The largest mean penetration around a node where the augmentations of the present step have ended early,
  /// as a share of the mean size of the slave's faces; zero elsewhere. Collective.
  double left_penetration() const;
  /// The same as a share of what the penalty alone would leave. Collective.
  double pressure_error() const { return forces_->pressure_error(end_.state); }

  /// Drops the recorded sparsity pattern (coupling/scheme.hpp, forget()).
  void forget() { geometry_->graph().forget(); }
  /// Adds the derivatives of the heat with respect to the displacement and of the forces with respect to the
  /// temperature, at the last update(); nothing without a heat law.
  void add_coupling(std::span<const double> temperature, linear::CoupledMatrix& matrix) const;
  /// Heat that leaves the slave's and enters the master's surface around every owned node [W]: positive where
  /// the node loses heat; the sum over all is zero. [owned node].
  std::vector<double> nodal_heat(std::span<const double> temperature) const;
  /// Temperature of a rigid master at the last update() or restore() [K]; absent: it takes no heat.
  std::optional<double> tool_temperature() const { return tool_temperature_at(end_.time); }
  /// Partners of the points at the last update().
  const PartnerList& partners() const { return partners_; }
  std::size_t bytes() const;

 private:
  std::optional<double> tool_temperature_at(double time) const;

  ContactParameters spec_;
  bool active_ = true;
  std::unique_ptr<ContactGeometry> geometry_;
  ContactStep step_;
  ContactEnd end_;
  PartnerList partners_;
  std::unique_ptr<ContactForces> forces_;
  std::unique_ptr<ContactHistory> history_;
  std::unique_ptr<ContactHeat> heat_;  ///< null without a heat law
};

}  // namespace solidus::contact
