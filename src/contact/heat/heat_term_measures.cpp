/// Measures of the heat term at given temperatures: fluxes, conductances, gaps, the interface.
#include <algorithm>
#include <cmath>

#include "contact/heat/heat_term.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

constexpr double k_room_temperature = 293.15;

}  // namespace

std::vector<InterfaceHeatFlux> HeatTerm::surface_heat(std::span<const double> temperature) const {
  std::vector<InterfaceHeatFlux> heat(points_.size());
  if (!active_) return heat;
  // Heat by friction goes to both sides; what is conducted and radiated goes from one to the other.
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.partnered[as_size(p)] == 0) continue;
    // Signs: heat counts as positive that goes into a side, by_friction[0] into the slave and
    // by_friction[1] into the master.
    const AtPoint s = see(p, temperature);
    const double conducted = s.master_takes_heat ? s.h.value * (s.slave - s.master) : 0.0;
    const double across = conducted + s.radiation * (s.slave_fourth - s.master_fourth);
    InterfaceHeatFlux& q = heat[as_size(p)];
    if (s.has_temperature)
      q.by_friction = {conducted - s.interface.flux[0], -conducted - s.interface.flux[1]};
    q.total = {q.by_friction[0] - across, q.by_friction[1] + across};
  }
  return heat;
}

InterfaceHeatFlux HeatTerm::counted_heat(std::span<const double> temperature) const {
  InterfaceHeatFlux sum;
  const std::vector<InterfaceHeatFlux> heat = surface_heat(temperature);
  // Only points that this process counts, so that sums over processes hold each once.
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.counted[as_size(p)] == 0) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      sum.total[side] += partners_.weight[as_size(p)] * heat[as_size(p)].total[side];
      sum.by_friction[side] += partners_.weight[as_size(p)] * heat[as_size(p)].by_friction[side];
    }
  }
  return sum;
}

std::vector<double> HeatTerm::conductances(std::span<const double> temperature) const {
  std::vector<double> h(points_.size(), 0.0);
  if (!active_) return h;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    const HeatPoint& point = points_[as_size(p)];
    if (temperature.empty())
      h[as_size(p)] = law_.at(point.penetration, point.pressure, k_room_temperature).value;
    else if (partners_.partnered[as_size(p)] != 0)
      h[as_size(p)] = see(p, temperature).h.value;
  }
  return h;
}

std::vector<HeatGap> HeatTerm::gaps() const {
  std::vector<HeatGap> gaps(points_.size());
  for (std::size_t p = 0; p < gaps.size(); ++p)
    gaps[p] = {points_[p].penetration, points_[p].pressure, partners_.partnered[p] != 0};
  return gaps;
}

void HeatTerm::set_gaps(std::span<const HeatGap> gaps) {
  std::vector<HeatPoint> points = points_;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!gaps[p].partnered) continue;
    points[p].penetration = gaps[p].penetration;
    points[p].pressure = gaps[p].pressure;
  }
  place(std::move(points));
}

GapHeat HeatTerm::gap_heat(std::span<const HeatGap> used, std::span<const HeatGap> right,
                           std::span<const double> temperature) const {
  GapHeat heat;
  if (!active_) return heat;
  // The heat that the gap of the step has passed, and how much of it would have passed otherwise with the gap
  // as it turned out.
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.counted[as_size(p)] == 0 || !used[as_size(p)].partnered || !right[as_size(p)].partnered)
      continue;
    const AtPoint s = see(p, temperature);
    const auto conductance_of = [&](const HeatGap& gap) {
      return conductance(p, gap.penetration, gap.pressure, 0.5 * (s.slave + s.master)).value;
    };
    const double was = conductance_of(used[as_size(p)]), is = conductance_of(right[as_size(p)]),
                 flow = partners_.weight[as_size(p)] * std::abs(s.slave - s.master);
    heat.passed += flow * std::max(was, is);
    heat.misplaced += flow * std::abs(is - was);
  }
  return heat;
}

std::vector<HeatGap> middle(const std::vector<HeatGap>& start, const std::vector<HeatGap>& end) {
  std::vector<HeatGap> mean = start;
  for (std::size_t p = 0; p < mean.size() && p < end.size(); ++p) {
    if (!start[p].partnered || !end[p].partnered) continue;
    mean[p].penetration = 0.5 * (start[p].penetration + end[p].penetration);
    mean[p].pressure = mean[p].penetration < 0 ? 0.0 : 0.5 * (start[p].pressure + end[p].pressure);
  }
  return mean;
}

std::vector<double> HeatTerm::interface_temperatures(std::span<const double> temperature) const {
  std::vector<double> result;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    const HeatPoint& point = points_[as_size(p)];
    const bool balanced = active_ && point.has_temperature && partners_.partnered[as_size(p)] != 0;
    result.push_back(balanced ? see(p, temperature).interface.temperature : point.step.temperature);
  }
  return result;
}

InterfaceHeat HeatTerm::interface_heat(std::span<const double> temperature) const {
  InterfaceHeat heat;
  if (!active_) return heat;
  // A point without a partner keeps the heat of its friction; others give it to both sides.
  for (Index p = 0; p < partners_.n_points(); ++p) {
    const HeatPoint& point = points_[as_size(p)];
    if (!point.has_temperature || partners_.counted[as_size(p)] == 0) continue;
    const double w = partners_.weight[as_size(p)];
    if (partners_.partnered[as_size(p)] == 0) {
      heat.dissipated += w * point.step.dissipation;
      heat.stored += w * point.step.dissipation;
      continue;
    }
    const AtPoint s = see(p, temperature);
    // A stage of a Runge-Kutta step covers a part of the step: what the stage before exchanged is
    // added.
    const double dt = phase_ ? phase_->stage_dt : point.step.time_step;
    // Fluxes count from the sides into the interface, which stores what it takes from them and what
    // friction makes.
    double taken = dt * (s.interface.flux[0] + s.interface.flux[1]);
    if (phase_ && phase_->staged) taken += phase_->first_flux[as_size(p)];
    const double made = dissipated(s);
    heat.dissipated += w * made;
    heat.stored += w * (made + taken);
  }
  return heat;
}

double HeatTerm::dissipated(const AtPoint& s) const {
  if (!phase_ || !phase_->staged) return s.dissipation;
  return phase_->first_dissipation[as_size(s.point)] + s.dissipation * phase_->stage_dt / phase_->span.dt;
}

std::vector<std::optional<FrictionResponse>> HeatTerm::keep_slip(std::span<const double> temperature) {
  std::vector<std::optional<FrictionResponse>> slip(points_.size());
  if (!active_) return slip;
  // Points that have a temperature keep the friction of the solution with its dissipation.
  for (Index p = 0; p < partners_.n_points(); ++p) {
    HeatPoint& point = points_[as_size(p)];
    // A point whose slip was not part of the thermal phase has nothing new: the mechanical phase's
    // result holds.
    if (point.friction == nullptr || !point.has_temperature || partners_.partnered[as_size(p)] == 0) continue;
    const AtPoint s = see(p, temperature);
    slip[as_size(p)] = s.friction;
    slip[as_size(p)]->dissipation = point.step.dissipation = dissipated(s);
    point.step.structural_entropy = s.friction.structural_entropy;
    point.friction = nullptr;
  }
  return slip;
}

}  // namespace solidus::contact
