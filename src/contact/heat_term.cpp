#include "contact/heat_term.hpp"

#include <algorithm>
#include <utility>

#include "contact/face.hpp"

namespace solidus::contact {

namespace {

constexpr std::size_t k_max_nodes = 2 * k_max_face_nodes;
constexpr double k_room_temperature = 293.15;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

double cube(double t) {
  return t * t * t;
}

double fourth(double t) {
  return cube(t) * t;
}

/// ∂h_i/∂h of the one-sided conductances.
std::array<double, 2> side_shares() {
  const OneSided sides = HeatTransferLaw::one_sided(1.0);
  return {sides.slave, sides.master};
}

}  // namespace

/// Points in a row that share their nodes.
struct HeatTerm::Run {
  Index first = -1;
  std::vector<Index> nodes;
  std::vector<double> values;

  bool holds(std::span<const Index> other) const {
    return first >= 0 && std::equal(other.begin(), other.end(), nodes.begin(), nodes.end());
  }
  void start(Index point, std::span<const Index> of, std::size_t n_values) {
    first = point;
    nodes.assign(of.begin(), of.end());
    values.assign(n_values, 0.0);
  }
};

HeatTerm::HeatTerm(const mesh::Mesh& mesh, const PartnerList& partners, ContactGraph& graph,
                   const HeatTransferLaw& law, bool nodal)
    : n_owned_(mesh.n_owned_nodes), partners_(partners), graph_(graph), law_(law), nodal_(nodal) {}

void HeatTerm::place(std::vector<HeatPoint> points) {
  points_ = std::move(points);
  fixed_.resize(law_.of_temperature() ? 0 : points_.size());
  for (std::size_t p = 0; p < fixed_.size(); ++p)
    fixed_[p] = law_.at(-points_[p].penetration, points_[p].pressure, k_room_temperature).value;
}

void HeatTerm::add_to_graph(algebra::NodeGraph& graph) const {
  version_ = graph_.add_to(graph);
}

void HeatTerm::bind(const algebra::BlockMatrix& matrix) {
  slots_.bind(matrix, n_owned_, partners_.n_points());
}

HeatTerm::AtPoint HeatTerm::see(Index point, std::span<const double> temperature) const {
  AtPoint s;
  s.point = point;
  s.nodes = partners_.nodes_of(point);
  s.b = partners_.share_of(point);
  s.n_slave = static_cast<std::size_t>(partners_.n_slave[at(point)]);
  const bool meshed = s.n_slave < s.nodes.size();
  s.master_takes_heat = meshed || tool_temperature_;
  if (s.master_takes_heat) s.radiation = law_.radiation_factor();
  for (std::size_t a = 0; a < s.nodes.size(); ++a) {
    const double t = temperature[at(s.nodes[a])];
    const bool slave = a < s.n_slave;
    (slave ? s.slave : s.master) += slave ? s.b[a] * t : -s.b[a] * t;
    if (s.radiation > 0) (slave ? s.slave_fourth : s.master_fourth) += (slave ? s.b[a] : -s.b[a]) * fourth(t);
  }
  if (!meshed) {
    s.master = tool_temperature_.value_or(s.slave);
    s.master_fourth = fourth(s.master);
  }
  const HeatPoint& p = points_[at(point)];
  if (fixed_.empty())
    s.h = law_.at(-p.penetration, p.pressure, 0.5 * (s.slave + s.master));
  else
    s.h.value = fixed_[at(point)];
  s.has_temperature = p.has_temperature;
  if (!p.has_temperature) return s;
  const OneSided sides = HeatTransferLaw::one_sided(s.h.value);
  s.interface = interface_balance(
      p.step, {{s.slave, s.master}, {sides.slave, s.master_takes_heat ? sides.master : 0.0}});
  return s;
}

void HeatTerm::add_exchange(const AtPoint& s, std::span<const double> temperature, double weight_h,
                            double weight_e, std::span<double> heat) const {
  if (!s.master_takes_heat) return;
  for (std::size_t a = 0; a < s.nodes.size(); ++a) {
    const double t = temperature[at(s.nodes[a])];
    double q = 0;
    if (!nodal_) {
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

void HeatTerm::add_residual(std::span<const double> x, std::span<double> r) {
  if (!active_) return;
  std::array<double, k_max_nodes> heat;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.partnered[at(p)] == 0) continue;
    const AtPoint s = see(p, x);
    const double w = partners_.weight[at(p)];
    heat.fill(0);
    add_exchange(s, x, w * s.h.value, w * s.radiation, heat);
    if (s.has_temperature) {
      const double conducted = s.master_takes_heat ? s.h.value * (s.slave - s.master) : 0.0;
      add_sides(s, {w * (s.interface.flux[0] - conducted), w * (s.interface.flux[1] + conducted)}, heat);
    }
    for (std::size_t a = 0; a < s.nodes.size(); ++a)
      if (s.nodes[a] < n_owned_) r[at(s.nodes[a])] += heat[a];
  }
}

// With h_i = s_i h: ∂Q_i/∂h = s_i (Θ_i − Θ_c) − h_i ∂Θ_c/∂h, ∂Θ_c/∂h = Σ s_j (Θ_j − Θ_c)/stiffness, and the
// change of conduction, ±(Θ_s − Θ_m), taken off.
std::array<double, 2> HeatTerm::flux_by_conductance(const AtPoint& s) {
  const bool both = s.master_takes_heat;
  const std::array<double, 2> share = side_shares();
  const std::array<double, 2> difference = {s.slave - s.interface.temperature,
                                            both ? s.master - s.interface.temperature : 0.0};
  const double moved =
      (share[0] * difference[0] + (both ? share[1] * difference[1] : 0.0)) / s.interface.stiffness;
  const double conducted = both ? s.slave - s.master : 0.0;
  return {share[0] * (difference[0] - s.h.value * moved) - conducted,
          both ? share[1] * (difference[1] - s.h.value * moved) + conducted : 0.0};
}

void HeatTerm::add_point_tangent(const AtPoint& s, std::span<const double> x, std::span<double> k) const {
  const std::size_t n = s.nodes.size(), n_slave = s.n_slave;
  const double w = partners_.weight[at(s.point)];
  const double h = w * s.h.value, e = w * s.radiation;
  if (n_slave < n) {
    for (std::size_t a = 0; a < (nodal_ ? n_slave : n); ++a)
      for (std::size_t b = nodal_ ? n_slave : a + 1; b < n; ++b) {
        double slope = h;
        if (e > 0) slope += 2 * e * (cube(x[at(s.nodes[a])]) + cube(x[at(s.nodes[b])]));
        slope *= -s.b[a] * s.b[b];
        k[a * n + a] += slope;
        k[b * n + b] += slope;
        k[a * n + b] -= slope;
        k[b * n + a] -= slope;
      }
  } else if (s.master_takes_heat) {
    for (std::size_t a = 0; a < n; ++a) {
      const double to_a = h + 4 * e * cube(x[at(s.nodes[a])]);
      if (nodal_) k[a * n + a] += s.b[a] * to_a;
      for (std::size_t b = 0; b < n && !nodal_; ++b)
        k[a * n + b] += s.b[a] * s.b[b] * 0.5 * (to_a + h + 4 * e * cube(x[at(s.nodes[b])]));
    }
  }
  const auto shape = [&](std::size_t a) { return a < n_slave ? s.b[a] : -s.b[a]; };
  if (s.has_temperature)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        const std::size_t i = a < n_slave ? 0 : 1, j = b < n_slave ? 0 : 1;
        const double conducted = s.master_takes_heat ? (i == j ? h : -h) : 0.0;
        k[a * n + b] += shape(a) * (w * s.interface.flux_slope[i][j] - conducted) * shape(b);
      }
  if (s.h.by_temperature == 0) return;
  std::array<double, k_max_nodes> per_h{};
  add_exchange(s, x, w * s.h.by_temperature, 0, per_h);
  if (s.has_temperature) {
    const std::array<double, 2> flux = flux_by_conductance(s);
    add_sides(s, {w * s.h.by_temperature * flux[0], w * s.h.by_temperature * flux[1]}, per_h);
  }
  const double side = s.master_takes_heat ? 0.5 : 1.0;  // of the mean temperature
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) k[a * n + b] += per_h[a] * side * shape(b);
}

void HeatTerm::add_tangent(std::span<const double> x, algebra::BlockMatrix& matrix) {
  if (!active_) return;
  Run run;
  const auto flush = [&] {
    if (run.first < 0) return;
    const auto slots = slots_.slots(run.first, run.nodes);
    for (std::size_t e = 0; e < run.values.size(); ++e) *matrix.block(slots[e]) += run.values[e];
  };
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.partnered[at(p)] == 0) continue;
    const AtPoint s = see(p, x);
    if (!run.holds(s.nodes)) {
      flush();
      run.start(p, s.nodes, s.nodes.size() * s.nodes.size());
    }
    add_point_tangent(s, x, run.values);
  }
  flush();
}

void HeatTerm::add_gap_tangent(std::span<const Point> normal, std::span<const double> temperature,
                               algebra::CoupledMatrix& matrix) {
  if (!active_) return;
  if (displacement_ != &matrix.displacement()) {
    displacement_ = &matrix.displacement();
    displacement_slots_.bind(*displacement_, n_owned_, partners_.n_points());
  }
  const auto components = static_cast<std::size_t>(matrix.components());
  std::array<double, k_max_nodes> per_gap;  // ∂r/∂g_N of each node
  Run run;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.partnered[at(p)] == 0) continue;
    const AtPoint s = see(p, temperature);
    if (!run.holds(s.nodes)) run.start(p, s.nodes, 0);
    const HeatPoint& point = points_[at(p)];
    const Conductance h = law_.at(-point.penetration, point.pressure, 0.5 * (s.slave + s.master));
    const double slope = partners_.weight[at(p)] * (h.by_pressure * point.pressure_slope - h.by_opening);
    if (slope == 0) continue;
    per_gap.fill(0);
    add_exchange(s, temperature, slope, 0, per_gap);
    if (s.has_temperature) {
      const std::array<double, 2> flux = flux_by_conductance(s);
      add_sides(s, {slope * flux[0], slope * flux[1]}, per_gap);
    }
    const auto slots = displacement_slots_.slots(run.first, run.nodes);
    const std::size_t n = s.nodes.size();
    for (std::size_t row = 0; row < n; ++row)
      for (std::size_t a = 0; a < n; ++a) {
        double* const to = matrix.heat_by_displacement(slots[row * n + a]);
        for (std::size_t c = 0; c < components; ++c) to[c] += per_gap[row] * s.b[a] * normal[at(p)][c];
      }
  }
}

std::vector<SurfaceHeat> HeatTerm::surface_heat(std::span<const double> temperature) const {
  std::vector<SurfaceHeat> heat(points_.size());
  if (!active_) return heat;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.partnered[at(p)] == 0) continue;
    const AtPoint s = see(p, temperature);
    const double conducted = s.master_takes_heat ? s.h.value * (s.slave - s.master) : 0.0;
    const double across = conducted + s.radiation * (s.slave_fourth - s.master_fourth);
    SurfaceHeat& q = heat[at(p)];
    if (s.has_temperature)
      q.by_friction = {conducted - s.interface.flux[0], -conducted - s.interface.flux[1]};
    q.total = {q.by_friction[0] - across, q.by_friction[1] + across};
  }
  return heat;
}

SurfaceHeat HeatTerm::counted_heat(std::span<const double> temperature) const {
  SurfaceHeat sum;
  const std::vector<SurfaceHeat> heat = surface_heat(temperature);
  for (Index p = 0; p < partners_.n_points(); ++p) {
    if (partners_.counted[at(p)] == 0) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      sum.total[side] += partners_.weight[at(p)] * heat[at(p)].total[side];
      sum.by_friction[side] += partners_.weight[at(p)] * heat[at(p)].by_friction[side];
    }
  }
  return sum;
}

std::vector<double> HeatTerm::conductances(std::span<const double> temperature) const {
  std::vector<double> h(points_.size(), 0.0);
  if (!active_) return h;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    const HeatPoint& point = points_[at(p)];
    if (temperature.empty())
      h[at(p)] = law_.at(-point.penetration, point.pressure, k_room_temperature).value;
    else if (partners_.partnered[at(p)] != 0)
      h[at(p)] = see(p, temperature).h.value;
  }
  return h;
}

std::vector<double> HeatTerm::interface_temperatures(std::span<const double> temperature) const {
  std::vector<double> result;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    const HeatPoint& point = points_[at(p)];
    const bool balanced = active_ && point.has_temperature && partners_.partnered[at(p)] != 0;
    result.push_back(balanced ? see(p, temperature).interface.temperature : point.step.temperature);
  }
  return result;
}

InterfaceHeat HeatTerm::interface_heat(std::span<const double> temperature) const {
  InterfaceHeat heat;
  if (!active_) return heat;
  for (Index p = 0; p < partners_.n_points(); ++p) {
    const HeatPoint& point = points_[at(p)];
    if (!point.has_temperature || partners_.partnered[at(p)] == 0 || partners_.counted[at(p)] == 0) continue;
    const AtPoint s = see(p, temperature);
    const double w = partners_.weight[at(p)];
    heat.dissipated += w * point.step.dissipation;
    heat.stored +=
        w * (point.step.dissipation + point.step.time_step * (s.interface.flux[0] + s.interface.flux[1]));
  }
  return heat;
}

}  // namespace solidus::contact
