/// Each point adds what moves with the displacement times the rate of that at every node.
#include "contact/heat/heat_coupling.hpp"

#include <algorithm>

#include "contact/heat/heat_run.hpp"
#include "contact/points/positive_shares.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

double cube(double t) {
  return t * t * t;
}

double fourth(double t) {
  return cube(t) * t;
}

/// Computes the derivative with respect to g_N of the heat that every node gives off.
void add_gap_slope(const HeatPoints& points, const HeatAtPoint& s, std::span<const double> temperature,
                   std::span<double> heat) {
  const HeatPoint& point = points.list()[as_size(s.point)];
  const double w = points.interface().partners.weight[as_size(s.point)];
  // Conductance depends on the gap directly and, where the point is closed, on pressure, which the
  // penetration changes by the slope of the contact law.
  const Conductance h =
      points.conductance(s.point, point.penetration, point.pressure, 0.5 * (s.slave + s.master));
  const double slope = w * (h.by_pressure * point.pressure_slope + h.by_penetration);
  // By the penetration, which is minus the gap.
  if (s.radiation > 0) add_exchange(s, temperature, 0, -w * points.radiation_by_gap(s.point), heat);
  if (slope != 0) {
    add_exchange(s, temperature, slope, 0, heat);
    // An interface with a temperature of its own exchanges with each side by a flux that the
    // conductance changes too.
    if (s.has_temperature) {
      const std::array<double, 2> flux = flux_by_conductance(s);
      add_sides(s, {slope * flux[0], slope * flux[1]}, heat);
    }
  }
  // Where friction and temperature are solved together, pressure also changes the heat that slip
  // makes.
  if (!point.joint) return;
  const double source = -w * point.joint->source_by_pressure * point.pressure_slope;
  add_sides(s, {s.interface.by_side[0] * source, s.interface.by_side[1] * source}, heat);
}

/// Adds ∂r_a/∂B_b for one node of the master: B of the master is in Θ_m = −Σ B_b Θ_b, and says which node
/// takes the heat.
void add_share_slope(const HeatAtPoint& s, double w, std::span<const double> temperature, std::size_t b,
                     std::span<double> heat) {
  // A share B_b multiplies nodal temperature: the mean of the master moves by −Θ_b, and with it
  // both exchanges.
  const double t = temperature[as_size(s.nodes[b])];
  const double across = w * (s.h.value * t + s.radiation * fourth(t));
  for (std::size_t a = 0; a < (s.nodal ? s.n_slave : s.nodes.size()); ++a) heat[a] += s.b[a] * across;
  // The derivative of the heat that the node itself gives off.
  heat[b] += s.nodal
                 ? w * (s.h.value * (s.slave - t) + s.radiation * (s.slave_fourth - fourth(t)))
                 : w * (s.h.value * (s.slave - s.master) + s.radiation * (s.slave_fourth - s.master_fourth));
  std::array<double, 2> by_mean{};
  if (s.has_temperature) {
    // The two sides of an interface with a temperature of its own do not balance by conduction
    // alone: the difference is what it stores and what friction gives.
    const double conducted = s.h.value * (s.slave - s.master);
    heat[b] -= w * (s.interface.flux[1] + conducted);
    const auto& slope = s.interface.flux_slope;
    add_sides(s, {-w * t * (slope[0][1] + s.h.value), -w * t * (slope[1][1] - s.h.value)}, heat);
    by_mean = flux_by_conductance(s);
  }
  // The conductance of some laws depends on the mean temperature, in which the share takes part by
  // a half.
  if (s.h.by_temperature == 0) return;
  const double by_share = -0.5 * t * w * s.h.by_temperature;
  add_exchange(s, temperature, by_share, 0, heat);
  add_sides(s, {by_share * by_mean[0], by_share * by_mean[1]}, heat);
}

/// The same of every node of the master, [b][a]; with positive shares by the chain of their slopes.
void add_share_slopes(const HeatPoints& points, const HeatAtPoint& s, std::span<const double> temperature,
                      std::span<double> heat) {
  const double w = points.interface().partners.weight[as_size(s.point)];
  const std::size_t n = s.nodes.size(), n_master = n - s.n_slave;
  if (!s.limited) {
    for (std::size_t b = s.n_slave; b < n; ++b) add_share_slope(s, w, temperature, b, heat.subspan(b * n, n));
    return;
  }
  // Where positive shares are in use they change with the place through the plain ones: the chain rule.
  std::vector<double> shares(n_master), positive(n_master), slope(n_master * n_master, 0.0), of_positive(n);
  for (std::size_t b = 0; b < n_master; ++b)
    shares[b] = -points.interface().partners.share_of(s.point)[s.n_slave + b];
  positive_shares(points.interface().dimension, shares, positive, slope);
  for (std::size_t c = 0; c < n_master; ++c) {
    of_positive.assign(n, 0.0);
    add_share_slope(s, w, temperature, s.n_slave + c, of_positive);
    for (std::size_t b = 0; b < n_master; ++b)
      for (std::size_t a = 0; a < n; ++a)
        heat[(s.n_slave + b) * n + a] += slope[c * n_master + b] * of_positive[a];
  }
}

/// Adds blocks of all pairs of nodes to the derivative of heat by displacements.
void add_blocks(std::span<const double> values, std::span<const SlotCache::Slot> slots,
                linear::CoupledMatrix& matrix) {
  const auto components = as_size(matrix.components());
  for (std::size_t e = 0; e < slots.size(); ++e) {
    double* const to = matrix.heat_by_displacement(slots[e]);
    for (std::size_t c = 0; c < components; ++c) to[c] += values[e * components + c];
  }
}

bool at_rest(std::span<const Point> rates) {
  return std::all_of(rates.begin(), rates.end(), [](const Point& v) { return v == Point{}; });
}

/// Whether a point moves along the master: most points of a step do not, and the slopes of their shares,
/// which cost most, are not computed.
bool moves(const HeatAtPoint& s, std::span<const Point> share) {
  const std::size_t n = s.nodes.size();
  for (std::size_t a = s.n_slave; a < n; ++a)
    if (!at_rest(share.subspan(a * n, n))) return true;
  return false;
}

}  // namespace

/// Slots are those of this matrix and pattern from here on.
void HeatCoupling::bind(const linear::BlockMatrix& displacement) {
  if (displacement_ == &displacement && bindings_ == term_.bindings()) return;
  bindings_ = term_.bindings();
  displacement_ = &displacement;
  slots_.bind(displacement, n_owned_, points_.interface().partners.n_points());
}

void HeatCoupling::add(const std::function<HeatRates(Index point)>& rates_of,
                       std::span<const double> temperature, linear::CoupledMatrix& matrix) {
  if (!points_.interface().active) return;
  const PartnerList& partners = points_.interface().partners;
  bind(matrix.displacement());
  // Each point adds ∂r_a by what moves with the displacement (gap, weight, trial traction, place on the
  // master) times the rate of that at every node. Points with the same nodes are summed in one run of blocks,
  // which is then added to the matrix.
  const auto components = as_size(matrix.components());
  std::vector<double> per_gap, per_trial, per_share, per_weight;  // ∂r_a
  HeatRun run;
  for (Index p = 0; p < partners.n_points(); ++p) {
    if (partners.partnered[as_size(p)] == 0) continue;
    const HeatRates rates = rates_of(p);
    if (rates.penetration.empty()) continue;
    const HeatAtPoint s = points_.see(p, temperature);
    const std::size_t n = s.nodes.size();
    if (!run.holds(s.nodes)) run.start(p, s.nodes, n * n * components);
    std::fill(run.values.begin(), run.values.end(), 0.0);
    // Adds the outer product of a derivative of the heat and a rate by every node's displacement.
    const auto add = [&](std::span<const double> heat, const auto& rate_of) {
      for (std::size_t row = 0; row < n; ++row)
        for (std::size_t b = 0; b < n; ++b)
          for (std::size_t c = 0; c < components; ++c)
            run.values[(row * n + b) * components + c] += heat[row] * rate_of(b)[c];
    };
    // First the gap, through conductance and radiation.
    per_gap.assign(n, 0.0);
    add_gap_slope(points_, s, temperature, per_gap);
    add(per_gap, [&](std::size_t b) -> const Point& { return rates.penetration[b]; });
    // Then the weight of the point, where segments are cut again as bodies slide: the heat itself is
    // proportional to it.
    if (!rates.weight.empty()) {
      per_weight.assign(n, 0.0);
      add_point_heat(s, temperature, 1.0, per_weight);
      add(per_weight, [&](std::size_t b) -> const Point& { return rates.weight[b]; });
    }
    // Then the trial traction, which sets the heat of friction where both are solved together.
    if (const auto& joint = points_.list()[as_size(p)].joint; joint && !rates.trial.empty()) {
      per_trial.assign(n, 0.0);
      const double source = -partners.weight[as_size(p)] * joint->source_by_trial;
      add_sides(s, {s.interface.by_side[0] * source, s.interface.by_side[1] * source}, per_trial);
      add(per_trial, [&](std::size_t b) -> const Point& { return rates.trial[b]; });
    }
    // Last the place on the master, by the rates of the shares of its nodes.
    const bool moved = moves(s, rates.share);
    if (moved) {
      per_share.assign(n * n, 0.0);
      add_share_slopes(points_, s, temperature, per_share);
    }
    for (std::size_t a = s.n_slave; a < n && moved; ++a) {
      const auto rates_of_node = rates.share.subspan(a * n, n);
      if (!at_rest(rates_of_node))
        add(std::span(per_share).subspan(a * n, n),
            [&](std::size_t b) -> const Point& { return rates_of_node[b]; });
    }
    add_blocks(run.values, slots_.slots(run.first, run.nodes), matrix);
  }
}

}  // namespace solidus::contact
