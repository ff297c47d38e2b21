/// Sums and lists over the points, each of which says what passes at it.
#include "contact/heat/heat_measures.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

constexpr double k_room_temperature = 293.15;

}  // namespace

std::vector<InterfaceHeatFlux> surface_heat(const HeatPoints& points, std::span<const double> temperature) {
  const PartnerList& partners = points.interface().partners;
  std::vector<InterfaceHeatFlux> heat(points.list().size());
  if (!points.interface().active) return heat;
  // Heat by friction goes to both sides; what is conducted and radiated goes from one to the other.
  for (Index p = 0; p < partners.n_points(); ++p) {
    if (partners.partnered[as_size(p)] == 0) continue;
    // Signs: heat counts as positive that goes into a side, by_friction[0] into the slave and
    // by_friction[1] into the master.
    const HeatAtPoint s = points.see(p, temperature);
    const double conducted = s.master_takes_heat ? s.h.value * (s.slave - s.master) : 0.0;
    const double across = conducted + s.radiation * (s.slave_fourth - s.master_fourth);
    InterfaceHeatFlux& q = heat[as_size(p)];
    if (s.has_temperature)
      q.by_friction = {conducted - s.interface.flux[0], -conducted - s.interface.flux[1]};
    q.total = {q.by_friction[0] - across, q.by_friction[1] + across};
  }
  return heat;
}

InterfaceHeatFlux counted_heat(const HeatPoints& points, std::span<const double> temperature) {
  const PartnerList& partners = points.interface().partners;
  InterfaceHeatFlux sum;
  const std::vector<InterfaceHeatFlux> heat = surface_heat(points, temperature);
  // Only points that this process counts, so that sums over processes hold each once.
  for (Index p = 0; p < partners.n_points(); ++p) {
    if (partners.counted[as_size(p)] == 0) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      sum.total[side] += partners.weight[as_size(p)] * heat[as_size(p)].total[side];
      sum.by_friction[side] += partners.weight[as_size(p)] * heat[as_size(p)].by_friction[side];
    }
  }
  return sum;
}

std::vector<double> conductances(const HeatPoints& points, std::span<const double> temperature) {
  const PartnerList& partners = points.interface().partners;
  std::vector<double> h(points.list().size(), 0.0);
  if (!points.interface().active) return h;
  for (Index p = 0; p < partners.n_points(); ++p) {
    const HeatPoint& point = points.list()[as_size(p)];
    if (temperature.empty())
      h[as_size(p)] = points.interface().law.at(point.penetration, point.pressure, k_room_temperature).value;
    else if (partners.partnered[as_size(p)] != 0)
      h[as_size(p)] = points.see(p, temperature).h.value;
  }
  return h;
}

std::vector<HeatGap> gaps_of(const HeatPoints& points) {
  const PartnerList& partners = points.interface().partners;
  std::vector<HeatGap> gaps(points.list().size());
  for (std::size_t p = 0; p < gaps.size(); ++p)
    gaps[p] = {points.list()[p].penetration, points.list()[p].pressure, partners.partnered[p] != 0};
  return gaps;
}

void set_gaps(std::span<const HeatGap> gaps, HeatPoints& points) {
  std::vector<HeatPoint> placed = points.list();
  for (std::size_t p = 0; p < placed.size(); ++p) {
    if (!gaps[p].partnered) continue;
    placed[p].penetration = gaps[p].penetration;
    placed[p].pressure = gaps[p].pressure;
  }
  points.place(std::move(placed));
}

GapHeat gap_heat(const HeatPoints& points, std::span<const HeatGap> used, std::span<const HeatGap> right,
                 std::span<const double> temperature) {
  const PartnerList& partners = points.interface().partners;
  GapHeat heat;
  if (!points.interface().active) return heat;
  // The heat that the gap of the step has passed, and how much of it would have passed otherwise with the gap
  // as it turned out.
  for (Index p = 0; p < partners.n_points(); ++p) {
    if (partners.counted[as_size(p)] == 0 || !used[as_size(p)].partnered || !right[as_size(p)].partnered)
      continue;
    const HeatAtPoint s = points.see(p, temperature);
    const auto conductance_of = [&](const HeatGap& gap) {
      return points.conductance(p, gap.penetration, gap.pressure, 0.5 * (s.slave + s.master)).value;
    };
    const double was = conductance_of(used[as_size(p)]), is = conductance_of(right[as_size(p)]),
                 flow = partners.weight[as_size(p)] * std::abs(s.slave - s.master);
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

std::vector<double> interface_temperatures(const HeatPoints& points, std::span<const double> temperature) {
  const PartnerList& partners = points.interface().partners;
  std::vector<double> result;
  for (Index p = 0; p < partners.n_points(); ++p) {
    const HeatPoint& point = points.list()[as_size(p)];
    const bool balanced =
        points.interface().active && point.has_temperature && partners.partnered[as_size(p)] != 0;
    result.push_back(balanced ? points.see(p, temperature).interface.temperature : point.step.temperature);
  }
  return result;
}

InterfaceHeat interface_heat(const HeatPoints& points, std::span<const double> temperature) {
  const PartnerList& partners = points.interface().partners;
  InterfaceHeat heat;
  if (!points.interface().active) return heat;
  // A point without a partner keeps the heat of its friction; others give it to both sides.
  for (Index p = 0; p < partners.n_points(); ++p) {
    const HeatPoint& point = points.list()[as_size(p)];
    if (!point.has_temperature || partners.counted[as_size(p)] == 0) continue;
    const double w = partners.weight[as_size(p)];
    if (partners.partnered[as_size(p)] == 0) {
      heat.dissipated += w * point.step.dissipation;
      heat.stored += w * point.step.dissipation;
      continue;
    }
    const HeatAtPoint s = points.see(p, temperature);
    // A stage of a Runge-Kutta step covers a part of the step: what the stage before exchanged is
    // added.
    const double dt = points.stages().stage(point.step.time_step);
    // Fluxes count from the sides into the interface, which stores what it takes from them and what
    // friction makes.
    double taken = dt * (s.interface.flux[0] + s.interface.flux[1]);
    if (const FirstStage* const first = points.stages().first()) taken += first->flux[as_size(p)];
    const double made = points.stages().dissipated(p, s.dissipation);
    heat.dissipated += w * made;
    heat.stored += w * (made + taken);
  }
  return heat;
}

}  // namespace solidus::contact
