/// Heat of a contact pair: the term of the thermal phase, and what a mechanical pass hands to it at every
/// point: gap, pressure, and the heat that friction makes and the interface stores.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "contact/forces/step.hpp"
#include "contact/heat/heat_points.hpp"
#include "contact/heat/heat_term.hpp"
#include "contact/points/geometry.hpp"
#include "contact/points/partners.hpp"
#include "system/pinned.hpp"

namespace solidus::contact {

/// Sums over the interface of a pair in one step, of all processes: heat, stored energy and entropy.
struct InterfaceSums {
  double dissipated = 0;          ///< D_c,mech [J]
  double stored = 0;              ///< Σ Θ_c (S^e_c − S^e_c,n), the heat that did not reach the bodies [J]
  double hardening = 0;           ///< work of friction less its dissipation [J]
  double energy = 0;              ///< change of E_c without springs [J] (3.69)
  double entropy = 0;             ///< change of S^e_c [J/K]
  double mechanical_energy = 0;   ///< the same up to the end of the mechanical phase [J]
  double mechanical_entropy = 0;  ///< [J/K]
  double plastic_entropy = 0;     ///< change of S^p_c [J/K] (3.53c)

  /// Adds `factor` times other sums.
  void add(const InterfaceSums& other, double factor = 1);
};

class ContactHeat : Pinned {
 public:
  /// Keeps references. Throws InputError for a law that is none.
  ContactHeat(const ContactGeometry& geometry, AnalysisKind kind, const ContactParameters& spec,
              const PairSurfaces& surfaces, const PointLaw& law, const PartnerList& partners);

  /// The points with what passes at them, and the term of the thermal phase that they make.
  HeatPoints& points() { return points_; }
  const HeatPoints& points() const { return points_; }
  HeatTerm& term() { return term_; }
  /// Whether the interface has a temperature Θ_c of its own: it rubs or stores heat.
  bool has_temperature() const { return point_law_.friction || spec_.interface_heat_capacity > 0; }

  /// Takes over a configuration point by point: clear(), add() in the order of the points, place().
  void clear(std::size_t n_points);
  /// @param from, now  at the start of the step and now
  void add(const ContactStep& step, const ContactPointState& from, const ContactPointState& now,
           const PointForces& forces);
  void place();
  /// The same of a state of which no forces are known: what the last step did is in it.
  /// @param held  of bodies that hold their deformation: friction makes no heat, and an interface with a
  ///              temperature may store what they give
  void restore(const ContactStep& step, std::span<const ContactPointState> now, bool held = false);

  /// PairHeat::predict() and commit(), the latter with `now` for the state that gets the temperatures and
  /// S^p_c found.
  void predict();
  InterfaceSums commit(std::span<const double> temperature, const ContactStep& step,
                       std::vector<ContactPointState>& now);
  /// Forgets predictions and a phase that has not been committed.
  void reset();

 private:
  HeatPoint point(const ContactStep& step, const ContactPointState& from, const ContactPointState& now,
                  const PointForces& forces) const;
  /// Takes over the slip that the thermal phase has found again.
  void take_slip(std::span<const double> temperature, const ContactStep& step,
                 std::vector<ContactPointState>& now);
  /// Sets the heat for results to that of both passes of a step in two halves, over the time of both.
  void show_whole_step();

  const ContactGeometry& geometry_;
  const ContactParameters& spec_;
  const PointLaw& point_law_;
  HeatTransferLaw law_;
  HeatPoints points_;
  HeatTerm term_;
  std::vector<HeatPoint> taken_;  ///< of the configuration that is being taken over
  std::vector<double> before_;    ///< Θ_c that the mechanical phase left, [point]
  /// D_c,mech [J/m²] and entropy [J/(m² K)] that predict() has counted in advance, [point]; or empty.
  std::vector<std::array<double, 2>> predicted_;
};

}  // namespace solidus::contact
