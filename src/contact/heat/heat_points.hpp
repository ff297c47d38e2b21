/// The points of a contact pair as heat sees them: their gaps and pressures, how they conduct and radiate,
/// and what passes at them at given temperatures.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/heat/heat_exchange.hpp"
#include "contact/heat/heat_gap.hpp"
#include "contact/heat/heat_stages.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "contact/interface/interface_thermodynamics.hpp"
#include "contact/points/partners.hpp"
#include "contact/points/point_law.hpp"
#include "contact/surfaces/surface_curvature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// Contact state of a point after the mechanical phase, as the thermal phase needs it.
struct HeatPoint {
  double penetration = 0;        ///< g_N [m]
  double pressure = 0;           ///< t_N [Pa]
  double pressure_slope = 0;     ///< ∂t_N/∂g_N [Pa/m]
  bool has_temperature = false;  ///< friction acts or the interface stores heat: Θ_c is balanced, from `step`
  InterfaceStep step;
  /// Where the thermal phase finds the slip again (5.40–5.51): the law and its input. `step` then has the
  /// dissipation and the entropy of the mechanical phase, which are not used.
  const FrictionLaw* friction = nullptr;
  FrictionInput slip{};
  std::optional<JointSlopes> joint;  ///< slip answers Θ_c: dissipation in `step` is that of its solution
};

/// The interface that heat passes through; references must outlive what holds them.
struct HeatInterface {
  int dimension = 0;
  const PartnerList& partners;
  const HeatTransferLaw& law;
  bool nodal = false;  ///< the nodal form; for linear faces only
  /// Curvatures of the slave at every point, [point], and of the master at its nodes, [local node]; empty:
  /// faces are plane.
  std::vector<SurfaceCurvature> curvature, master_curvature;
  /// The temperature of a master without nodes [K]; absent: it takes no heat.
  std::optional<double> tool_temperature = {};
  bool active = true;  ///< false: no heat passes at all
};

class HeatPoints {
 public:
  explicit HeatPoints(HeatInterface interface) : interface_(std::move(interface)) {}
  /// The temperature of a tool and whether heat passes may change from phase to phase.
  HeatInterface& interface() { return interface_; }
  const HeatInterface& interface() const { return interface_; }

  /// Freezes the configuration, [point]; the partners are those of the list now.
  void place(std::vector<HeatPoint> points);
  const std::vector<HeatPoint>& list() const { return points_; }
  /// The phase in time that the points are in.
  HeatStages& stages() { return stages_; }
  const HeatStages& stages() const { return stages_; }
  /// As linear::Contribution::limit_exchange.
  void limit_exchange(std::span<const char> nodes);

  /// Returns the heat that passes at a point that has a partner.
  HeatAtPoint see(Index point, std::span<const double> temperature) const;
  /// h at the plane gap that resists as a gap of the point does, and its slope in the gap itself.
  Conductance conductance(Index point, double penetration, double pressure, double temperature) const;
  /// The slope of e in the width of the gap, in see() of a point that radiates [W/(m³ K⁴)].
  double radiation_by_gap(Index point) const { return radiation_[as_size(point)].by_gap; }
  /// Slip at these temperatures of every point where this phase finds it again (HeatPoint::friction); its
  /// dissipation is what the phase has made of it, in both stages. Otherwise nothing. From now on the points
  /// keep it. Before the phase ends.
  std::vector<std::optional<FrictionResponse>> keep_slip(std::span<const double> temperature);

 private:
  /// e at a point, and its slope in the width of the gap.
  struct Radiation {
    double factor = 0;  ///< [W/(m² K⁴)]
    double by_gap = 0;  ///< [W/(m³ K⁴)]
  };
  /// Whether the exchange of a point is limited.
  bool limited(Index point) const;
  /// Finds the positive shares of the points whose exchange is limited.
  void share_out();
  Radiation radiation(Index point) const;
  /// The mean of the curvatures of the master's nodes that a point meets.
  SurfaceCurvature master_curvature(Index point) const;
  /// With the law of conduction and the balance of an interface that has a temperature of its own.
  void balance(Index point, HeatAtPoint& at) const;

  HeatInterface interface_;
  std::vector<HeatPoint> points_;
  HeatStages stages_;
  std::vector<Radiation> radiation_;  ///< [point]; empty: none
  std::vector<char> limited_nodes_;   ///< by limit_exchange(), [local node]; empty: none
  std::vector<double> positive_;      ///< B of limited points, as PartnerList::share; empty: none
  std::vector<double> fixed_;         ///< h of a law that does not change with the temperature, [point]
};

/// Memory of the list of points.
std::size_t bytes(const HeatPoints& points);

}  // namespace solidus::contact
