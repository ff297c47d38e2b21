/// Conduction and radiation go from node to node or from mean to mean; the balance of an interface with a
/// temperature of its own adds what it takes from both sides.
#include "contact/heat/heat_exchange.hpp"

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

double cube(double t) {
  return t * t * t;
}

double fourth(double t) {
  return cube(t) * t;
}

/// ∂h_i/∂h of the one-sided conductances.
std::array<double, 2> side_shares(const HeatAtPoint& s) {
  const OneSided sides = HeatTransferLaw::one_sided(1.0, s.slave_resistance);
  return {sides.slave, sides.master};
}

}  // namespace

void add_exchange(const HeatAtPoint& s, std::span<const double> temperature, double weight_h, double weight_e,
                  std::span<double> heat) {
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

void add_sides(const HeatAtPoint& s, const std::array<double, 2>& flux, std::span<double> heat) {
  for (std::size_t a = 0; a < s.nodes.size(); ++a)
    heat[a] += a < s.n_slave ? s.b[a] * flux[0] : -s.b[a] * flux[1];
}

void add_point_heat(const HeatAtPoint& s, std::span<const double> temperature, double w,
                    std::span<double> heat) {
  add_exchange(s, temperature, w * s.h.value, w * s.radiation, heat);
  if (!s.has_temperature) return;
  const double conducted = s.master_takes_heat ? s.h.value * (s.slave - s.master) : 0.0;
  add_sides(s, {w * (s.interface.flux[0] - conducted), w * (s.interface.flux[1] + conducted)}, heat);
}

// With h_i = s_i h: ∂Q_i/∂h = s_i (Θ_i − Θ_c) − h_i ∂Θ_c/∂h, ∂Θ_c/∂h = Σ s_j (Θ_j − Θ_c)/stiffness, and the
// change of conduction, ±(Θ_s − Θ_m), taken off.
std::array<double, 2> flux_by_conductance(const HeatAtPoint& s) {
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

void add_point_tangent(const HeatAtPoint& s, std::span<const double> x, double w, std::span<double> k,
                       std::vector<double>& per_h) {
  // The tangent of the exchange, in pairs of nodes: with h and radiation each pair gives a positive definite
  // 2×2 part, so that the tangent stays one of conduction.
  const std::size_t n = s.nodes.size(), n_slave = s.n_slave;
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

}  // namespace solidus::contact
