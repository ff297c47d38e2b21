/// Reports of a contact pair: sums, means around nodes and the work of a step, made from the start and the
/// end of the step and from nothing else.
#pragma once

#include <span>
#include <vector>

#include "contact/forces/history.hpp"
#include "contact/forces/step.hpp"
#include "contact/heat/heat.hpp"
#include "contact/points/point_law.hpp"

namespace solidus::contact {

/// All that a report of a pair reads.
struct ContactView {
  const ContactParameters& spec;
  const ContactGeometry& geometry;
  const PointLaw& law;
  const ContactHistory& history;
  const ContactStep& step;
  const ContactEnd& end;
  const ContactHeat* heat;  ///< null: no heat passes
  bool active;

  bool has_temperature() const { return heat != nullptr && heat->has_temperature(); }
};

/// Sums over a pair, all processes (axisymmetric: of the whole revolution; plane strain: per metre).
struct ContactSums {
  GlobalIndex points = 0, closed_points = 0, sticking_points = 0;
  double force = 0;     ///< ∫ t_N dA [N]
  double friction = 0;  ///< ∫ ‖T‖ dA [N]
  Point resultant{};    ///< ∫ (t_N n + F T) dA, the force on the master [N]; on the slave it is the reverse
  Point moment{};       ///< its moment about the origin [N m]
  double closed_area = 0;  ///< area of the closed points [m²]
  double energy = 0;       ///< in the springs, normal and tangential [J]
  double work = 0;         ///< of friction so far, ∫ ∫ ‖T‖ dγ dA [J]
  double dissipation = 0;  ///< of friction so far [J]; the work less this is stored by hardening
  double wet_area = 0;     ///< of points that liquid metal wets [m²]
  /// The part of the liquid skin that has left its wall (ContactParameters::leaving_gap): points, area [m²]
  /// and the largest gap [m].
  GlobalIndex left_points = 0;
  double left_area = 0, left_gap = 0;
  double heat = 0;                               ///< from slave to master by conduction and radiation [W]
  double heat_to_slave = 0, heat_to_master = 0;  ///< in all, that of friction included [W]
};

/// Averages around the nodes of both surfaces, [owned node of the surface]; NaN at nodes without a point that
/// has a partner. Weighted with w N_a²; the history of friction, with w N_a over all points of the slave,
/// which keeps its integral, NaN on the master.
struct ContactNodalFields {
  std::vector<Index> nodes;     ///< local numbers of owned nodes, slave's and master's, sorted
  std::vector<double> opening;  ///< [m], negative: penetration
  /// How far the bodies lie in each other: the penetration, and what a skin has sunk in before, while it was
  /// soft (ContactPointState::sunk); negative: a gap [m].
  std::vector<double> overlap;
  std::vector<double> pressure;     ///< t_N [Pa]
  std::vector<double> conductance;  ///< h without radiation [W/(m² K)]; zero without heat
  /// ∫ N_a dA over the points that have a partner, of which the values here are means; zero where there is
  /// none [m²].
  std::vector<double> paired_area;
  /// Heat flux into the body of the node, through the gap, the spots and radiation and from friction; and its
  /// part by friction (InterfaceHeatFlux). Zero without heat or temperatures [W/m²].
  std::vector<double> heat_flux, frictional_heat_flux;
  /// With friction, else empty: 0 open, 1 sticks, 2 slips; and F T, on the master [Pa].
  std::vector<double> status;
  std::vector<Point> traction;
  /// History of the points, with friction; else empty. μ is that of ζ_c and Θ_c. A master that wears has its
  /// own dissipation and depth.
  std::vector<double> slip, internal_variable, coefficient, dissipation, wear_depth;
  std::vector<double> temperature;  ///< Θ_c, with friction or where the interface stores heat [K]
};

/// Sums at the end of the step; `temperature` [local node] or empty (heat = 0). Collective.
ContactSums sums(const ContactView& pair, std::span<const double> temperature);
/// Work that the bodies do on contact in the step, by the mean of the forces at both of its ends [J]. Contact
/// that is off has no force at the end, but the balance of a method with a mean still holds that of t_n in
/// the first step without it. Collective.
/// @param share  of the end in the mean
double work(const ContactView& pair, double share);
/// Work that a rigid master does on contact meanwhile: ∫ (t_N Δg_N + T·ΔG) dA less work(). Where a point has
/// a partner at one end of the step only, Δg_N and ΔG are those of the motion of both bodies there.
/// Collective.
double rigid_work(const ContactView& pair, double share);
/// The energy of a pair, a function of the state of its points alone [J]: of the springs, and of the
/// interface (interface_energy) where it has a temperature; where it has none, what friction's hardening
/// stores. Collective.
double stored_energy(const ContactView& pair);
/// Averages at nodes at the end of the step; without temperatures, conductances at room temperature. Local.
ContactNodalFields nodal_fields(const ContactView& pair, std::span<const double> temperature);

}  // namespace solidus::contact
