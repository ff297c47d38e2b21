/// Heat of each point from the temperatures of both sides. An interface with a temperature of its own is
/// solved at the point; an interface without one conducts straight from side to side.
#include "contact/heat/heat_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "contact/points/positive_shares.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

constexpr double k_room_temperature = 293.15;

double cube(double t) {
  return t * t * t;
}

double fourth(double t) {
  return cube(t) * t;
}

}  // namespace

void HeatPoints::place(std::vector<HeatPoint> points) {
  points_ = std::move(points);
  share_out();
  fixed_.resize(interface_.law.of_temperature() ? 0 : points_.size());
  radiation_.resize(interface_.law.radiation_factor() > 0 ? points_.size() : 0);
  for (std::size_t p = 0; p < radiation_.size(); ++p) radiation_[p] = radiation(as_index(p));
  for (std::size_t p = 0; p < fixed_.size(); ++p)
    fixed_[p] =
        conductance(as_index(p), points_[p].penetration, points_[p].pressure, k_room_temperature).value;
}

void HeatPoints::limit_exchange(std::span<const char> nodes) {
  if (interface_.nodal) return;
  if (nodes.empty()) {
    limited_nodes_.clear();
  } else {
    limited_nodes_.resize(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) limited_nodes_[i] |= nodes[i];
  }
  share_out();
}

bool HeatPoints::limited(Index point) const {
  if (limited_nodes_.empty() || interface_.partners.partnered[as_size(point)] == 0) return false;
  const std::span<const Index> nodes = interface_.partners.nodes_of(point);
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](Index node) { return limited_nodes_[as_size(node)] != 0; });
}

void HeatPoints::share_out() {
  positive_.clear();
  if (limited_nodes_.empty()) return;
  positive_ = interface_.partners.share;
  std::vector<double> n, l;
  // Only quadratic faces have negative shares; on both sides they are replaced by positive ones with the same
  // sum, so that the limiter bounds temperatures.
  for (Index p = 0; p < interface_.partners.n_points(); ++p) {
    if (!limited(p)) continue;
    const std::size_t first = interface_.partners.first[as_size(p)],
                      end = interface_.partners.first[as_size(p) + 1],
                      middle = first + as_size(interface_.partners.n_slave[as_size(p)]);
    for (const auto& [from, to, sign] : {std::tuple(first, middle, 1.0), std::tuple(middle, end, -1.0)}) {
      n.assign(to - from, 0.0);
      l.assign(to - from, 0.0);
      for (std::size_t a = from; a < to; ++a) n[a - from] = sign * interface_.partners.share[a];
      positive_shares(interface_.dimension, n, l, {});
      for (std::size_t a = from; a < to; ++a) positive_[a] = sign * l[a - from];
    }
  }
}

Conductance HeatPoints::conductance(Index point, double penetration, double pressure,
                                    double temperature) const {
  if (interface_.curvature.empty() || !(penetration < 0))
    return interface_.law.at(penetration, pressure, temperature);
  const SurfaceCurvature& curvature = interface_.curvature[as_size(point)];
  const double width = -penetration;
  Conductance h = interface_.law.at(-curvature.plane_gap(width), pressure, temperature);
  h.by_penetration *= curvature.plane_gap_slope(width);
  return h;
}

SurfaceCurvature HeatPoints::master_curvature(Index point) const {
  SurfaceCurvature mean;
  if (interface_.master_curvature.empty()) return mean;
  const std::span<const Index> nodes = interface_.partners.nodes_of(point);
  const std::span<const double> share = interface_.partners.share_of(point);
  for (std::size_t b = as_size(interface_.partners.n_slave[as_size(point)]); b < nodes.size(); ++b) {
    mean.first -= share[b] * interface_.master_curvature[as_size(nodes[b])].first;
    mean.second -= share[b] * interface_.master_curvature[as_size(nodes[b])].second;
  }
  return mean;
}

HeatPoints::Radiation HeatPoints::radiation(Index point) const {
  // Across a gap of curved surfaces radiation goes between different areas, the mean of both; closed or plane
  // the factor is that of the law.
  const double gap = -points_[as_size(point)].penetration;
  if (!(gap > 0) || interface_.partners.partnered[as_size(point)] == 0 ||
      (interface_.curvature.empty() && interface_.master_curvature.empty()))
    return {interface_.law.radiation_factor(), 0};
  const SurfaceCurvature slave = interface_.curvature.empty() ? SurfaceCurvature{}
                                                              : interface_.curvature[as_size(point)],
                         master = master_curvature(point);
  const bool meshed =
      as_size(interface_.partners.n_slave[as_size(point)]) < interface_.partners.nodes_of(point).size();
  const double of_slave = slave.area(gap), of_master = meshed ? master.area(gap) : 1 / of_slave;
  const double ratio = std::sqrt(of_slave / of_master);
  const double slope =
      meshed ? 0.5 * ratio * (slave.area_slope(gap) / of_slave - master.area_slope(gap) / of_master)
             : slave.area_slope(gap);
  return {interface_.law.radiation_factor(ratio), interface_.law.radiation_by_area(ratio) * slope};
}

HeatAtPoint HeatPoints::see(Index point, std::span<const double> temperature) const {
  // First the point with its nodes and shape functions, nodal ones where limits of conduction make a sum of
  // exchanges of it.
  HeatAtPoint s;
  s.point = point;
  s.nodes = interface_.partners.nodes_of(point);
  s.b = interface_.partners.share_of(point);
  s.n_slave = as_size(interface_.partners.n_slave[as_size(point)]);
  s.nodal = interface_.nodal;
  if (limited(point)) {
    s.b = std::span(positive_).subspan(interface_.partners.first[as_size(point)], s.nodes.size());
    s.nodal = true;
    s.limited = true;
  }
  // A rigid surface without a mesh takes heat only if it has a temperature; while heat does not flow
  // (adiabatic phases) nothing passes.
  const bool meshed = s.n_slave < s.nodes.size();
  s.master_takes_heat = meshed || interface_.tool_temperature;
  const bool flows = !stages_.adiabatic();
  if (s.master_takes_heat && flows && !radiation_.empty()) s.radiation = radiation_[as_size(point)].factor;
  // The temperatures of both sides are interpolated, and for radiation the fourth powers of the nodes instead
  // of that of the mean.
  for (std::size_t a = 0; a < s.nodes.size(); ++a) {
    const double t = temperature[as_size(s.nodes[a])];
    const bool slave = a < s.n_slave;
    (slave ? s.slave : s.master) += slave ? s.b[a] * t : -s.b[a] * t;
    if (s.radiation > 0) (slave ? s.slave_fourth : s.master_fourth) += (slave ? s.b[a] : -s.b[a]) * fourth(t);
  }
  if (!meshed) {
    s.master = interface_.tool_temperature.value_or(s.slave);
    s.master_fourth = fourth(s.master);
  }
  // The conductance is that of the mean temperature, or one that was fixed for the whole phase.
  const HeatPoint& p = points_[as_size(point)];
  if (!flows)
    s.h = {};
  else if (fixed_.empty())
    s.h = conductance(point, p.penetration, p.pressure, 0.5 * (s.slave + s.master));
  else
    s.h.value = fixed_[as_size(point)];
  balance(point, s);
  return s;
}

void HeatPoints::balance(Index point, HeatAtPoint& s) const {
  const HeatPoint& p = points_[as_size(point)];
  // A point without a temperature of its own is done. Otherwise its resistance divides between the two sides,
  // and the balance of the interface gives its temperature.
  s.has_temperature = p.has_temperature;
  if (!p.has_temperature) return;
  s.slave_resistance =
      interface_.law.slave_resistance(p.penetration < 0 ? 0.0 : p.pressure, 0.5 * (s.slave + s.master));
  const OneSided one_sided = HeatTransferLaw::one_sided(s.h.value, s.slave_resistance);
  const InterfaceSides sides{{s.slave, s.master},
                             {one_sided.slave, s.master_takes_heat ? one_sided.master : 0.0},
                             HeatTransferLaw::slave_share(s.slave_resistance, s.master_takes_heat)};
  const InterfaceStep step = stages_.step(point, p.step);
  s.dissipation = p.step.dissipation;
  // With friction that follows the temperature, traction and temperature are found together (return mapping
  // of the thermal phase, 5.40 to 5.51).
  if (p.friction != nullptr) {
    const InterfaceReturn found =
        interface_return_mapping(*p.friction, p.slip, stages_.span(p.step.time_step), sides,
                                 InterfaceStage{step.time_step, step.temperature});
    s.interface = found.heat;
    s.friction = found.friction;
    s.dissipation = found.friction.dissipation;
    if (!found.heat.balanced || found.friction.status != FrictionStatus::converged)
      s.interface.flux.fill(std::numeric_limits<double>::quiet_NaN());  // the step is rejected
    return;
  }
  // Otherwise the balance of the interface is solved at the given dissipation. In both schemes at once, the
  // slope with respect to the trial traction belongs to its response.
  s.interface = interface_balance(step, sides);
  if (p.joint && std::isfinite(p.joint->stiffness))
    s.interface = interface_response(sides, s.interface.temperature, p.joint->stiffness);
}

std::vector<std::optional<FrictionResponse>> HeatPoints::keep_slip(std::span<const double> temperature) {
  std::vector<std::optional<FrictionResponse>> slip(points_.size());
  if (!interface_.active) return slip;
  // Points that have a temperature keep the friction of the solution with its dissipation.
  for (Index p = 0; p < interface_.partners.n_points(); ++p) {
    HeatPoint& point = points_[as_size(p)];
    // A point whose slip was not part of the thermal phase has nothing new: the mechanical phase's
    // result holds.
    if (point.friction == nullptr || !point.has_temperature || interface_.partners.partnered[as_size(p)] == 0)
      continue;
    const HeatAtPoint s = see(p, temperature);
    slip[as_size(p)] = s.friction;
    slip[as_size(p)]->dissipation = point.step.dissipation = stages_.dissipated(p, s.dissipation);
    point.step.structural_entropy = s.friction.structural_entropy;
    point.friction = nullptr;
  }
  return slip;
}

std::size_t bytes(const HeatPoints& points) {
  return points.list().capacity() * sizeof(HeatPoint);
}

}  // namespace solidus::contact
