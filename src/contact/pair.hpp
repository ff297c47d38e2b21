/// A pair of surfaces that may touch and part: forces and heat between them as terms of the two phases.
///
/// A pair is made of parts with one purpose each (PairParts), which it calls one after the other and which
/// callers ask for what concerns one of them alone:
///
///   geometry       (geometry.hpp)        surfaces, points, partners in a configuration
///   history        (history.hpp)         what points and nodes remember from step to step
///   forces         (forces.hpp)          laws of the points, term of the mechanical phase
///   augmentations  (augmentations.hpp)   multipliers that hold penetrations small
///   heat           (pair_heat.hpp)       term of the thermal phase, balance of the interface
///   gaps           (heat_gaps.hpp)       through which heat passes
///   report         (contact_report.hpp)  sums, means at nodes, work of a step, from view()
///
/// A mechanical pass goes begin(state at t_n) – Newton's iteration with the term of the forces –
/// update(solution); state() is then the history at t_{n+1}, which the scheme keeps or throws away. Points do
/// not know each other, and every process brings the points that its nodes can meet to the same state.
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
#include "contact/forces/augmentations.hpp"
#include "contact/forces/forces.hpp"
#include "contact/forces/history.hpp"
#include "contact/heat_gaps.hpp"
#include "contact/pair_heat.hpp"
#include "contact/points/geometry.hpp"
#include "contact/points/parameters.hpp"
#include "contact/points/partners.hpp"
#include "system/pinned.hpp"

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

/// Temperature of a rigid master at a time [K]; absent: it takes no heat.
std::optional<double> tool_temperature(const ContactParameters& spec, double time);

struct PairParts : Pinned {
  /// @param chosen  with the roles of the surfaces
  PairParts(const mesh::Mesh& mesh, AnalysisKind kind, const ContactParameters& chosen,
            const PairSurfaces& surfaces, std::span<const double> body_modulus);

  /// Whether points find their partners again as they slide.
  bool slides() const { return geometry.kinematics().partners_change(); }

  const ContactParameters spec;
  ContactGeometry geometry;
  ContactStep step;      ///< from its start
  ContactEnd end;        ///< at the last update() or restore()
  PartnerList partners;  ///< of the points there
  /// Its term is that of the mechanical phase, of the displacement it is called with and the start of the
  /// step, whatever the state of update().
  ContactForces forces;
  ContactHistory history;
  PairHeat heat;
  HeatGaps gaps;
  Augmentations augmentations;
};

class ContactPair {
 public:
  /// Finds the partners and starts with zero displacement. Collective.
  /// @param body_modulus E [Pa] of every body of the mesh, for a penalty given as a factor
  /// Throws InputError for surfaces that do not exist, have no partner at all, or for a law that is none.
  ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactParameters spec,
              std::span<const double> body_modulus = {});

  const PairParts& parts() const { return *parts_; }
  PairParts& parts() { return *parts_; }

  /// Off: open at every point, without force, heat, energy or stabilisation, whatever the gap; gaps are still
  /// measured. Friction's history stays, but slip is counted again after it. Between steps; holds from the
  /// next update() or restore() on.
  void activate(bool on);
  /// All that reports are made from, at the last update() or restore(): valid until the next one.
  ContactView view() const;
  /// Begins a step from the state `old`; empty: that of bodies that have not moved. Local, no communication.
  void begin(const ContactState& old, const ContactPass& pass);
  /// Sets the present temperatures of the bodies within a simultaneous pass, [local node], for the term of
  /// the forces and the next update(). Local.
  void set_temperature(std::span<const double> temperature);
  /// Updates forces and history of every point for a displacement, and their data for the heat term: [local
  /// node][component], ghosts up to date [m]. Returns the history at t_{n+1}. Local, no communication.
  const ContactState& update(std::span<const double> displacement);
  /// Restores the pair as it was after the update() that ended in `state` (empty: bodies that have not moved)
  /// at this displacement and time. Local.
  void restore(const ContactState& state, std::span<const double> displacement, double time);
  /// Begins a step of bodies that do not deform and updates the pair: heat alone, where the interface stores
  /// it. Local.
  void hold(const ContactState& old, double time, double dt, std::span<const double> temperature);
  /// Elements have come or gone (ContactParameters::growing): the points of these faces take part from here
  /// on, and the pair is as after restore(). Local.
  /// @param faces  that are there now
  /// @param pass   time, displacement (empty: bodies that do not deform) and temperature of now
  /// @param state  gets the history of new points; null: it has it, or there is none
  void follow_elements(const FacesThere& faces, const ContactPass& pass, ContactState* state);
  /// State of the points at the last update() or restore().
  const ContactState& state() const { return parts_->end.state; }
  std::size_t bytes() const;

 private:
  std::unique_ptr<PairParts> parts_;
};

}  // namespace solidus::contact
