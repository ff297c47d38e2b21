#include "contact/heat_term.hpp"

#include <algorithm>
#include <array>

#include "contact/face.hpp"
#include "contact/mechanics_term.hpp"

namespace solidus::contact {

namespace {

constexpr std::size_t k_max_nodes = 2 * k_max_face_nodes;

double fourth(double t) {
  return t * t * t * t;
}

double cube(double t) {
  return t * t * t;
}

}  // namespace

HeatTerm::HeatTerm(const mesh::Mesh& mesh, const ContactPoints& points, const HeatTransferLaw& law,
                   bool nodal)
    : n_owned_(mesh.n_owned_nodes), points_(points), law_(law), nodal_(nodal) {
  std::size_t slots = 0;
  for (const Pairing& p : points.pairings) {
    first_slot_.push_back(slots);
    slots += static_cast<std::size_t>(p.n_nodes()) * static_cast<std::size_t>(p.n_nodes());
  }
  opening_.resize(points.weight.size());
  pressure_.resize(points.weight.size());
}

void HeatTerm::place(std::span<const double> penetration, std::span<const double> pressure) {
  constexpr double k_any = 300;
  const bool changes = law_.of_temperature();
  fixed_.resize(changes ? 0 : pressure.size());
  for (std::size_t p = 0; p < pressure.size(); ++p) {
    opening_[p] = -penetration[p];
    pressure_[p] = pressure[p];
    if (!changes) fixed_[p] = law_.at(opening_[p], pressure_[p], k_any).value;
  }
}

void HeatTerm::add_to_graph(algebra::NodeGraph& graph) const {
  add_pairings_to_graph(points_, graph);
}

void HeatTerm::bind(const algebra::BlockMatrix& matrix) {
  slots_ = pairing_slots(points_, n_owned_, matrix);
}

template <class Function>
void HeatTerm::for_points(const Pairing& pairing, std::span<const double> temperature, Function f) const {
  const bool radiates = law_.radiation_factor() > 0;
  const Index* nodes = points_.nodes.data() + pairing.first_node;
  const double* b = points_.shape.data() + pairing.first_shape;
  for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
    AtPoint at;
    at.point = static_cast<std::size_t>(p);
    at.b = b;
    for (int a = 0; a < pairing.n_nodes(); ++a) {
      const double t = temperature[static_cast<std::size_t>(nodes[a])];
      (a < pairing.n_slave ? at.slave : at.master) += b[a] * t;
      if (radiates) (a < pairing.n_slave ? at.slave_fourth : at.master_fourth) += b[a] * fourth(t);
    }
    at.master = -at.master;
    at.master_fourth = -at.master_fourth;
    if (fixed_.empty())
      at.h = law_.at(opening_[at.point], pressure_[at.point], 0.5 * (at.slave + at.master));
    else
      at.h.value = fixed_[at.point];
    f(at);
    b += pairing.n_nodes();
  }
}

void HeatTerm::add_heat(const Pairing& pairing, const AtPoint& at, std::span<const double> temperature,
                        double weight_h, double weight_e, std::span<double> heat) const {
  const Index* nodes = points_.nodes.data() + pairing.first_node;
  for (int a = 0; a < pairing.n_nodes(); ++a) {
    const double t = temperature[static_cast<std::size_t>(nodes[a])];
    double q = 0;
    if (!nodal_) {
      q = weight_h * (at.slave - at.master) + weight_e * (at.slave_fourth - at.master_fourth);
    } else if (a < pairing.n_slave) {
      q = weight_h * (t - at.master);
      if (weight_e != 0) q += weight_e * (fourth(t) - at.master_fourth);
    } else {
      q = weight_h * (at.slave - t);
      if (weight_e != 0) q += weight_e * (at.slave_fourth - fourth(t));
    }
    heat[static_cast<std::size_t>(a)] += at.b[a] * q;
  }
}

void HeatTerm::add_residual(std::span<const double> x, std::span<double> r) {
  if (!active_) return;
  std::array<double, k_max_nodes> heat;
  for (const Pairing& pairing : points_.pairings) {
    heat.fill(0);
    for_points(pairing, x, [&](const AtPoint& at) {
      const double w = points_.weight[at.point];
      add_heat(pairing, at, x, w * at.h.value, w * law_.radiation_factor(), heat);
    });
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    for (int a = 0; a < pairing.n_nodes(); ++a)
      if (nodes[a] < n_owned_) r[static_cast<std::size_t>(nodes[a])] += heat[static_cast<std::size_t>(a)];
  }
}

void HeatTerm::add_tangent(std::span<const double> x, algebra::BlockMatrix& matrix) {
  if (!active_) return;
  std::array<double, k_max_nodes * k_max_nodes> k;
  std::array<double, k_max_nodes> per_h;
  for (std::size_t i = 0; i < points_.pairings.size(); ++i) {
    const Pairing& pairing = points_.pairings[i];
    const auto n = static_cast<std::size_t>(pairing.n_nodes());
    const auto n_slave = static_cast<std::size_t>(pairing.n_slave);
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    std::fill_n(k.begin(), n * n, 0.0);
    for_points(pairing, x, [&](const AtPoint& at) {
      const double w = points_.weight[at.point];
      const double h = w * at.h.value, e = w * law_.radiation_factor();
      for (std::size_t a = 0; a < (nodal_ ? n_slave : n); ++a)
        for (std::size_t b = nodal_ ? n_slave : a + 1; b < n; ++b) {
          double slope = h;
          if (e > 0)
            slope +=
                2 * e *
                (cube(x[static_cast<std::size_t>(nodes[a])]) + cube(x[static_cast<std::size_t>(nodes[b])]));
          slope *= -at.b[a] * at.b[b];
          k[a * n + a] += slope;
          k[b * n + b] += slope;
          k[a * n + b] -= slope;
          k[b * n + a] -= slope;
        }
      if (at.h.by_temperature == 0) return;
      per_h.fill(0);
      add_heat(pairing, at, x, w * at.h.by_temperature, 0, per_h);
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
          k[a * n + b] += per_h[a] * 0.5 * (b < n_slave ? at.b[b] : -at.b[b]);
    });
    const algebra::BlockMatrix::Slot* slots = slots_.data() + first_slot_[i];
    for (std::size_t e = 0; e < n * n; ++e) *matrix.block(slots[e]) += k[e];
  }
}

void HeatTerm::add_gap_tangent(std::span<const double> pressure_slope, std::span<const double> temperature,
                               std::span<const algebra::BlockMatrix::Slot> slots,
                               algebra::CoupledMatrix& matrix) const {
  if (!active_) return;
  const int components = matrix.components();
  std::array<double, k_max_nodes> per_gap;  // ∂r/∂g_N of each node
  for (std::size_t i = 0; i < points_.pairings.size(); ++i) {
    const Pairing& pairing = points_.pairings[i];
    const auto n = static_cast<std::size_t>(pairing.n_nodes());
    const algebra::BlockMatrix::Slot* of_pairing = slots.data() + first_slot_[i];
    for_points(pairing, temperature, [&](const AtPoint& at) {
      const Conductance h = law_.at(opening_[at.point], pressure_[at.point], 0.5 * (at.slave + at.master));
      const double slope = h.by_pressure * pressure_slope[at.point] - h.by_opening;
      if (slope == 0) return;
      per_gap.fill(0);
      add_heat(pairing, at, temperature, points_.weight[at.point] * slope, 0, per_gap);
      for (std::size_t row = 0; row < n; ++row)
        for (std::size_t a = 0; a < n; ++a) {
          double* const to = matrix.heat_by_displacement(of_pairing[row * n + a]);
          for (int c = 0; c < components; ++c)
            to[c] += per_gap[row] * at.b[a] * points_.normal[at.point][static_cast<std::size_t>(c)];
        }
    });
  }
}

double HeatTerm::counted_heat(std::span<const double> temperature) const {
  if (!active_) return 0;
  double sum = 0;
  for (const Pairing& pairing : points_.pairings) {
    if (!pairing.counted) continue;
    for_points(pairing, temperature, [&](const AtPoint& at) {
      sum += points_.weight[at.point] * (at.h.value * (at.slave - at.master) +
                                         law_.radiation_factor() * (at.slave_fourth - at.master_fourth));
    });
  }
  return sum;
}

std::vector<double> HeatTerm::conductances(std::span<const double> temperature) const {
  constexpr double k_room = 293.15;
  std::vector<double> h(pressure_.size(), 0.0);
  if (!active_) return h;
  if (temperature.empty()) {
    for (std::size_t p = 0; p < h.size(); ++p) h[p] = law_.at(opening_[p], pressure_[p], k_room).value;
    return h;
  }
  for (const Pairing& pairing : points_.pairings)
    for_points(pairing, temperature, [&](const AtPoint& at) { h[at.point] = at.h.value; });
  return h;
}

}  // namespace solidus::contact
