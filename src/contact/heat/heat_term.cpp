/// Heat of each point from the temperatures of both sides (see()), then residual and tangent. An interface
/// with a temperature of its own is solved at the point; an interface without one conducts straight from
/// side to side.
#include "contact/heat/heat_term.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "contact/heat/heat_run.hpp"
#include "contact/points/positive_shares.hpp"
#include "contact/surfaces/face.hpp"
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

std::array<double, 2> HeatTerm::side_shares(const AtPoint& s) {
  const OneSided sides = HeatTransferLaw::one_sided(1.0, s.slave_resistance);
  return {sides.slave, sides.master};
}

HeatTerm::HeatTerm(const mesh::Mesh& mesh, const PartnerList& partners, ContactGraph& graph,
                   const HeatTransferLaw& law, bool nodal)
    : n_owned_(mesh.n_owned_nodes),
      dimension_(mesh.dimension),
      partners_(partners),
      graph_(graph),
      law_(law),
      nodal_(nodal) {}

void HeatTerm::place(std::vector<HeatPoint> points) {
  points_ = std::move(points);
  share_out();
  fixed_.resize(law_.of_temperature() ? 0 : points_.size());
  radiation_.resize(law_.radiation_factor() > 0 ? points_.size() : 0);
  for (std::size_t p = 0; p < radiation_.size(); ++p) radiation_[p] = radiation(as_index(p));
  for (std::size_t p = 0; p < fixed_.size(); ++p)
    fixed_[p] = conductance(as_index(p), k_room_temperature).value;
}

void HeatTerm::limit_exchange(std::span<const char> nodes) {
  if (nodal_) return;
  if (nodes.empty()) {
    limited_nodes_.clear();
  } else {
    limited_nodes_.resize(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) limited_nodes_[i] |= nodes[i];
  }
  share_out();
}

bool HeatTerm::limited(Index point) const {
  if (limited_nodes_.empty() || partners_.partnered[as_size(point)] == 0) return false;
  const std::span<const Index> nodes = partners_.nodes_of(point);
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](Index node) { return limited_nodes_[as_size(node)] != 0; });
}

void HeatTerm::share_out() {
  positive_.clear();
  if (limited_nodes_.empty()) return;
  positive_ = partners_.share;
  std::vector<double> n, l;
  // Only quadratic faces have negative shares; on both sides they are replaced by positive ones with the same
  // sum, so that the limiter bounds temperatures.
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (!limited(p)) continue;
    const std::size_t first = partners_.first[as_size(p)], end = partners_.first[as_size(p) + 1],
                      middle = first + as_size(partners_.n_slave[as_size(p)]);
    for (const auto& [from, to, sign] : {std::tuple(first, middle, 1.0), std::tuple(middle, end, -1.0)}) {
      n.assign(to - from, 0.0);
      l.assign(to - from, 0.0);
      for (std::size_t a = from; a < to; ++a) n[a - from] = sign * partners_.share[a];
      positive_shares(dimension_, n, l, {});
      for (std::size_t a = from; a < to; ++a) positive_[a] = sign * l[a - from];
    }
  }
}

Conductance HeatTerm::conductance(Index point, double temperature) const {
  const HeatPoint& p = points_[as_size(point)];
  return conductance(point, p.penetration, p.pressure, temperature);
}

Conductance HeatTerm::conductance(Index point, double penetration, double pressure,
                                  double temperature) const {
  if (curvature_.empty() || !(penetration < 0)) return law_.at(penetration, pressure, temperature);
  const SurfaceCurvature& curvature = curvature_[as_size(point)];
  const double width = -penetration;
  Conductance h = law_.at(-curvature.plane_gap(width), pressure, temperature);
  h.by_penetration *= curvature.plane_gap_slope(width);
  return h;
}

SurfaceCurvature HeatTerm::master_curvature(Index point) const {
  SurfaceCurvature mean;
  if (master_curvature_.empty()) return mean;
  const std::span<const Index> nodes = partners_.nodes_of(point);
  const std::span<const double> share = partners_.share_of(point);
  for (std::size_t b = as_size(partners_.n_slave[as_size(point)]); b < nodes.size(); ++b) {
    mean.first -= share[b] * master_curvature_[as_size(nodes[b])].first;
    mean.second -= share[b] * master_curvature_[as_size(nodes[b])].second;
  }
  return mean;
}

HeatTerm::Radiation HeatTerm::radiation(Index point) const {
  // Across a gap of curved surfaces radiation goes between different areas, the mean of both; closed or plane
  // the factor is that of the law.
  const double gap = -points_[as_size(point)].penetration;
  if (!(gap > 0) || partners_.partnered[as_size(point)] == 0 ||
      (curvature_.empty() && master_curvature_.empty()))
    return {law_.radiation_factor(), 0};
  const SurfaceCurvature slave = curvature_.empty() ? SurfaceCurvature{} : curvature_[as_size(point)],
                         master = master_curvature(point);
  const bool meshed = as_size(partners_.n_slave[as_size(point)]) < partners_.nodes_of(point).size();
  const double of_slave = slave.area(gap), of_master = meshed ? master.area(gap) : 1 / of_slave;
  const double ratio = std::sqrt(of_slave / of_master);
  const double slope =
      meshed ? 0.5 * ratio * (slave.area_slope(gap) / of_slave - master.area_slope(gap) / of_master)
             : slave.area_slope(gap);
  return {law_.radiation_factor(ratio), law_.radiation_by_area(ratio) * slope};
}

void HeatTerm::begin_phase(const HeatSpan& span) {
  phase_ = Phase{.span = span,
                 .stage_dt = span.dt,
                 .staged = false,
                 .start = {},
                 .first_flux = {},
                 .first_dissipation = {}};
}

// Θ* of S^e_c* = S^e_c,n + carried (S^e_c − S^e_c,n); of the slip every stage has its part.
void HeatTerm::begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before) {
  if (!phase_) return;
  // A later stage starts from where the stage before it has led: temperature by the entropy carried
  // over, and the heat and dissipation that were exchanged on the way.
  if (stage.carried != 0) {
    std::vector<double> start(points_.size(), 0.0), flux(points_.size(), 0.0), made(points_.size(), 0.0);
    for (Index p = 0; p < partners_.n_points(); ++p) {
      const HeatPoint& point = points_[as_size(p)];
      start[as_size(p)] = point.step.temperature;
      // A point that stores nothing has no history to carry: its temperature follows from the
      // fluxes of the stage.
      if (!active_ || !point.has_temperature || partners_.partnered[as_size(p)] == 0) continue;
      const AtPoint s = see(p, before);
      start[as_size(p)] *= std::pow(s.interface.temperature / point.step.temperature, stage.carried);
      flux[as_size(p)] = stage.carried * phase_->stage_dt * (s.interface.flux[0] + s.interface.flux[1]);
      made[as_size(p)] = stage.carried * s.dissipation * phase_->stage_dt / phase_->span.dt;
    }
    phase_->start = std::move(start);
    phase_->first_flux = std::move(flux);
    phase_->first_dissipation = std::move(made);
    phase_->staged = true;
  } else {
    phase_->start.clear();
    phase_->first_flux.clear();
    phase_->first_dissipation.clear();
    phase_->staged = false;
  }
  phase_->stage_dt = stage.dt;
}

InterfaceStep HeatTerm::balance_step(Index point) const {
  InterfaceStep step = points_[as_size(point)].step;
  if (!phase_) return step;
  const double part = phase_->stage_dt / phase_->span.dt;
  step.time_step = phase_->stage_dt;
  step.dissipation *= part;
  step.structural_entropy *= part;
  if (phase_->staged) step.temperature = phase_->start[as_size(point)];
  return step;
}

void HeatTerm::add_to_graph(linear::NodeGraph& graph) const {
  version_ = graph_.add_to(graph);
}

void HeatTerm::bind(const linear::BlockMatrix& matrix) {
  slots_.bind(matrix, n_owned_, partners_.n_points());
  displacement_ = nullptr;  // whose pattern has changed with this one
}

HeatTerm::AtPoint HeatTerm::see(Index point, std::span<const double> temperature) const {
  // First the point with its nodes and shape functions, nodal ones where limits of conduction make a sum of
  // exchanges of it.
  AtPoint s;
  s.point = point;
  s.nodes = partners_.nodes_of(point);
  s.b = partners_.share_of(point);
  s.n_slave = as_size(partners_.n_slave[as_size(point)]);
  s.nodal = nodal_;
  if (limited(point)) {
    s.b = std::span(positive_).subspan(partners_.first[as_size(point)], s.nodes.size());
    s.nodal = true;
  }
  // A rigid surface without a mesh takes heat only if it has a temperature; while heat does not flow
  // (adiabatic phases) nothing passes.
  const bool meshed = s.n_slave < s.nodes.size();
  s.master_takes_heat = meshed || tool_temperature_;
  const bool flows = !phase_ || !phase_->span.adiabatic;
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
    s.master = tool_temperature_.value_or(s.slave);
    s.master_fourth = fourth(s.master);
  }
  // The conductance is that of the mean temperature, or one that was fixed for the whole phase.
  const HeatPoint& p = points_[as_size(point)];
  if (!flows)
    s.h = {};
  else if (fixed_.empty())
    s.h = conductance(point, 0.5 * (s.slave + s.master));
  else
    s.h.value = fixed_[as_size(point)];
  // A point without a temperature of its own is done. Otherwise its resistance divides between the two sides,
  // and the balance of the interface gives its temperature.
  s.has_temperature = p.has_temperature;
  if (!p.has_temperature) return s;
  s.slave_resistance =
      law_.slave_resistance(p.penetration < 0 ? 0.0 : p.pressure, 0.5 * (s.slave + s.master));
  const OneSided one_sided = HeatTransferLaw::one_sided(s.h.value, s.slave_resistance);
  const InterfaceSides sides{{s.slave, s.master},
                             {one_sided.slave, s.master_takes_heat ? one_sided.master : 0.0},
                             HeatTransferLaw::slave_share(s.slave_resistance, s.master_takes_heat)};
  const InterfaceStep step = balance_step(point);
  s.dissipation = p.step.dissipation;
  // With friction that follows the temperature, traction and temperature are found together (return mapping
  // of the thermal phase, 5.40 to 5.51).
  if (p.friction != nullptr) {
    const InterfaceReturn found =
        interface_return_mapping(*p.friction, p.slip, phase_ ? phase_->span.dt : p.step.time_step, sides,
                                 InterfaceStage{step.time_step, step.temperature});
    s.interface = found.heat;
    s.friction = found.friction;
    s.dissipation = found.friction.dissipation;
    if (!found.heat.balanced || found.friction.status != FrictionStatus::converged)
      s.interface.flux.fill(std::numeric_limits<double>::quiet_NaN());  // the step is rejected
    return s;
  }
  // Otherwise the balance of the interface is solved at the given dissipation. In both schemes at once, the
  // slope with respect to the trial traction belongs to its response.
  s.interface = interface_balance(step, sides);
  if (p.joint && std::isfinite(p.joint->stiffness))
    s.interface = interface_response(sides, s.interface.temperature, p.joint->stiffness);
  return s;
}

void HeatTerm::add_exchange(const AtPoint& s, std::span<const double> temperature, double weight_h,
                            double weight_e, std::span<double> heat) const {
  if (!s.master_takes_heat) return;
  for (std::size_t a = 0; a < s.nodes.size(); ++a) {
    // By nodes (closed integration) each node exchanges at its own temperature with the mean of the
    // other side; otherwise all nodes of the point exchange at the two means, in which a node may
    // give off heat although it is the colder one.
    const double t = temperature[as_size(s.nodes[a])];
    double q = 0;
    if (!s.nodal) {
      q = weight_h * (s.slave - s.master) + weight_e * (s.slave_fourth - s.master_fourth);
    } else if (a < s.n_slave) {
      q = weight_h * (t - s.master);
      if (weight_e != 0) q += weight_e * (fourth(t) - s.master_fourth);
    } else {
      q = weight_h * (s.slave - t);
      if (weight_e != 0) q += weight_e * (s.slave_fourth - fourth(t));
    }
    heat[a] += s.b[a] * q;
  }
}

void HeatTerm::add_sides(const AtPoint& s, const std::array<double, 2>& flux, std::span<double> heat) {
  for (std::size_t a = 0; a < s.nodes.size(); ++a)
    heat[a] += a < s.n_slave ? s.b[a] * flux[0] : -s.b[a] * flux[1];
}

void HeatTerm::add_point_heat(const AtPoint& s, std::span<const double> temperature, double w,
                              std::span<double> heat) const {
  add_exchange(s, temperature, w * s.h.value, w * s.radiation, heat);
  if (!s.has_temperature) return;
  const double conducted = s.master_takes_heat ? s.h.value * (s.slave - s.master) : 0.0;
  add_sides(s, {w * (s.interface.flux[0] - conducted), w * (s.interface.flux[1] + conducted)}, heat);
}

void HeatTerm::add_residual(std::span<const double> x, std::span<double> r) {
  if (!active_) return;
  std::vector<double> heat;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.partnered[as_size(p)] == 0) continue;
    const AtPoint s = see(p, x);
    heat.assign(s.nodes.size(), 0.0);
    add_point_heat(s, x, partners_.weight[as_size(p)], heat);
    for (std::size_t a = 0; a < s.nodes.size(); ++a)
      if (s.nodes[a] < n_owned_) r[as_size(s.nodes[a])] += heat[a];
  }
}

// With h_i = s_i h: ∂Q_i/∂h = s_i (Θ_i − Θ_c) − h_i ∂Θ_c/∂h, ∂Θ_c/∂h = Σ s_j (Θ_j − Θ_c)/stiffness, and the
// change of conduction, ±(Θ_s − Θ_m), taken off.
std::array<double, 2> HeatTerm::flux_by_conductance(const AtPoint& s) const {
  const bool both = s.master_takes_heat;
  const std::array<double, 2> share = side_shares(s);
  const std::array<double, 2> difference = {s.slave - s.interface.temperature,
                                            both ? s.master - s.interface.temperature : 0.0};
  const double moved =
      (share[0] * difference[0] + (both ? share[1] * difference[1] : 0.0)) / s.interface.stiffness;
  const double conducted = both ? s.slave - s.master : 0.0;
  return {share[0] * (difference[0] - s.h.value * moved) - conducted,
          both ? share[1] * (difference[1] - s.h.value * moved) + conducted : 0.0};
}

void HeatTerm::add_point_tangent(const AtPoint& s, std::span<const double> x, std::span<double> k,
                                 std::vector<double>& per_h) const {
  // The tangent of the exchange, in pairs of nodes: with h and radiation each pair gives a positive definite
  // 2×2 part, so that the tangent stays one of conduction.
  const std::size_t n = s.nodes.size(), n_slave = s.n_slave;
  const double w = partners_.weight[as_size(s.point)];
  const double h = w * s.h.value, e = w * s.radiation;
  if (n_slave < n) {
    for (std::size_t a = 0; a < (s.nodal ? n_slave : n); ++a)
      for (std::size_t b = s.nodal ? n_slave : a + 1; b < n; ++b) {
        double slope = h;
        if (e > 0) slope += 2 * e * (cube(x[as_size(s.nodes[a])]) + cube(x[as_size(s.nodes[b])]));
        slope *= -s.b[a] * s.b[b];
        k[a * n + a] += slope;
        k[b * n + b] += slope;
        k[a * n + b] -= slope;
        k[b * n + a] -= slope;
      }
    // Without master nodes the surroundings are a rigid tool: the slope acts on the diagonal, or consistently
    // on all slave nodes.
  } else if (s.master_takes_heat) {
    for (std::size_t a = 0; a < n; ++a) {
      const double to_a = h + 4 * e * cube(x[as_size(s.nodes[a])]);
      if (s.nodal) k[a * n + a] += s.b[a] * to_a;
      for (std::size_t b = 0; b < n && !s.nodal; ++b)
        k[a * n + b] += s.b[a] * s.b[b] * 0.5 * (to_a + h + 4 * e * cube(x[as_size(s.nodes[b])]));
    }
  }
  // A temperature of the interface changes what passes to each side: the difference to plain conduction is
  // added.
  const auto shape = [&](std::size_t a) { return a < n_slave ? s.b[a] : -s.b[a]; };
  if (s.has_temperature)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        const std::size_t i = a < n_slave ? 0 : 1, j = b < n_slave ? 0 : 1;
        const double conducted = s.master_takes_heat ? (i == j ? h : -h) : 0.0;
        k[a * n + b] += shape(a) * (w * s.interface.flux_slope[i][j] - conducted) * shape(b);
      }
  // A conductance that follows the mean temperature adds a part that is not symmetric; it is the same for all
  // columns up to their share in that mean.
  if (s.h.by_temperature == 0) return;
  per_h.assign(n, 0.0);
  add_exchange(s, x, w * s.h.by_temperature, 0, per_h);
  if (s.has_temperature) {
    const std::array<double, 2> flux = flux_by_conductance(s);
    add_sides(s, {w * s.h.by_temperature * flux[0], w * s.h.by_temperature * flux[1]}, per_h);
  }
  const double side = s.master_takes_heat ? 0.5 : 1.0;  // of the mean temperature
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) k[a * n + b] += per_h[a] * side * shape(b);
}

void HeatTerm::add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) {
  if (!active_) return;
  Run run;
  std::vector<double> per_h;
  // Entries go to the matrix run by run: neighbouring points share their nodes, and a sum in a
  // small array is cheaper than one in the matrix.
  const auto flush = [&] {
    if (run.first < 0) return;
    const auto slots = slots_.slots(run.first, run.nodes);
    for (std::size_t e = 0; e < run.values.size(); ++e) *matrix.block(slots[e]) += run.values[e];
  };
  // Successive points of the same nodes are summed before they go into the matrix.
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.partnered[as_size(p)] == 0) continue;
    const AtPoint s = see(p, x);
    if (!run.holds(s.nodes)) {
      flush();
      run.start(p, s.nodes, s.nodes.size() * s.nodes.size());
    }
    add_point_tangent(s, x, run.values, per_h);
  }
  flush();
}

}  // namespace solidus::contact
