#include "contact/heat_term.hpp"

#include <algorithm>

#include "contact/mechanics_term.hpp"

namespace solidus::contact {

namespace {

double fourth(double t) {
  return t * t * t * t;
}

}  // namespace

template <class Function>
void HeatTerm::for_pairs(const Pairing& pairing, Function f) const {
  const int n = pairing.n_nodes();
  for (int i = 0; i < (nodal_ ? pairing.n_slave : n); ++i)
    for (int j = nodal_ ? pairing.n_slave : i + 1; j < n; ++j)
      f(i, j, static_cast<std::size_t>(i) * static_cast<std::size_t>(n) + static_cast<std::size_t>(j));
}

template <class Factor>
void HeatTerm::exchange(std::vector<double>& coefficients, Factor factor) const {
  std::fill(coefficients.begin(), coefficients.end(), 0.0);
  for (std::size_t k = 0; k < points_.pairings.size(); ++k) {
    const Pairing& pairing = points_.pairings[k];
    const double* b = points_.shape.data() + pairing.first_shape;
    double* c = coefficients.data() + first_entry_[k];
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      const auto point = static_cast<std::size_t>(p);
      const double f = points_.weight[point] * factor(point);
      for_pairs(pairing, [&](int i, int j, std::size_t entry) { c[entry] -= f * b[i] * b[j]; });
      b += pairing.n_nodes();
    }
  }
}

HeatTerm::HeatTerm(const mesh::Mesh& mesh, const ContactPoints& points, double radiation_factor, bool nodal)
    : n_owned_(mesh.n_owned_nodes), points_(points), nodal_(nodal) {
  std::size_t entries = 0;
  for (const Pairing& p : points.pairings) {
    first_entry_.push_back(entries);
    entries += static_cast<std::size_t>(p.n_nodes()) * static_cast<std::size_t>(p.n_nodes());
  }
  conduction_.resize(entries);
  if (radiation_factor > 0) {
    radiation_.resize(entries);
    exchange(radiation_, [&](std::size_t) { return radiation_factor; });
  }
}

void HeatTerm::set_conductance(std::span<const double> conductance) {
  exchange(conduction_, [&](std::size_t p) { return conductance[p]; });
}

void HeatTerm::add_to_graph(algebra::NodeGraph& graph) const {
  add_pairings_to_graph(points_, graph);
}

void HeatTerm::bind(const algebra::BlockMatrix& matrix) {
  slots_ = pairing_slots(points_, n_owned_, matrix);
}

void HeatTerm::add_residual(std::span<const double> x, std::span<double> r) {
  if (!active_) return;
  for (std::size_t k = 0; k < points_.pairings.size(); ++k) {
    const Pairing& pairing = points_.pairings[k];
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    const double* c = conduction_.data() + first_entry_[k];
    const double* e = radiation_.empty() ? nullptr : radiation_.data() + first_entry_[k];
    for_pairs(pairing, [&](int i, int j, std::size_t entry) {
      const Index a = nodes[i], b = nodes[j];
      const double ta = x[static_cast<std::size_t>(a)], tb = x[static_cast<std::size_t>(b)];
      double q = c[entry] * (ta - tb);
      if (e) q += e[entry] * (fourth(ta) - fourth(tb));
      if (a < n_owned_) r[static_cast<std::size_t>(a)] += q;
      if (b < n_owned_) r[static_cast<std::size_t>(b)] -= q;
    });
  }
}

void HeatTerm::add_tangent(std::span<const double> x, algebra::BlockMatrix& matrix) {
  if (!active_) return;
  for (std::size_t k = 0; k < points_.pairings.size(); ++k) {
    const Pairing& pairing = points_.pairings[k];
    const auto n = static_cast<std::size_t>(pairing.n_nodes());
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    const double* c = conduction_.data() + first_entry_[k];
    const double* e = radiation_.empty() ? nullptr : radiation_.data() + first_entry_[k];
    const algebra::BlockMatrix::Slot* slots = slots_.data() + first_entry_[k];
    for_pairs(pairing, [&](int i, int j, std::size_t entry) {
      double slope = c[entry];
      if (e) {
        const double ta = x[static_cast<std::size_t>(nodes[i])], tb = x[static_cast<std::size_t>(nodes[j])];
        slope += 2 * e[entry] * (ta * ta * ta + tb * tb * tb);
      }
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      *matrix.block(slots[a * n + a]) += slope;
      *matrix.block(slots[b * n + b]) += slope;
      *matrix.block(slots[a * n + b]) -= slope;
      *matrix.block(slots[b * n + a]) -= slope;
    });
  }
}

void HeatTerm::add_gap_tangent(std::span<const double> slope, std::span<const double> temperature,
                               std::span<const algebra::BlockMatrix::Slot> slots,
                               algebra::CoupledMatrix& matrix) const {
  const int components = matrix.components();
  std::vector<double> exchanged;  // ∂r/∂g_N of each node
  for (std::size_t k = 0; k < points_.pairings.size(); ++k) {
    const Pairing& pairing = points_.pairings[k];
    const auto n = static_cast<std::size_t>(pairing.n_nodes());
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    const algebra::BlockMatrix::Slot* of_pairing = slots.data() + first_entry_[k];
    const double* b = points_.shape.data() + pairing.first_shape;
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p, b += n) {
      const auto point = static_cast<std::size_t>(p);
      const double f = points_.weight[point] * slope[point];
      if (f == 0) continue;
      exchanged.assign(n, 0.0);
      for_pairs(pairing, [&](int i, int j, std::size_t) {
        const double difference =
            temperature[static_cast<std::size_t>(nodes[i])] - temperature[static_cast<std::size_t>(nodes[j])];
        const double q = -f * b[i] * b[j] * difference;
        exchanged[static_cast<std::size_t>(i)] += q;
        exchanged[static_cast<std::size_t>(j)] -= q;
      });
      for (std::size_t row = 0; row < n; ++row)
        for (std::size_t a = 0; a < n; ++a) {
          double* const to = matrix.heat_by_displacement(of_pairing[row * n + a]);
          for (int i = 0; i < components; ++i)
            to[i] += exchanged[row] * b[a] * points_.normal[point][static_cast<std::size_t>(i)];
        }
    }
  }
}

double HeatTerm::counted_heat(std::span<const double> temperature) const {
  if (!active_) return 0;
  double sum = 0;
  for (std::size_t k = 0; k < points_.pairings.size(); ++k) {
    const Pairing& pairing = points_.pairings[k];
    if (!pairing.counted) continue;
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    for_pairs(pairing, [&](int i, int j, std::size_t entry) {
      if (i >= pairing.n_slave || j < pairing.n_slave) return;  // within one side
      const double ta = temperature[static_cast<std::size_t>(nodes[i])];
      const double tb = temperature[static_cast<std::size_t>(nodes[j])];
      sum += conduction_[first_entry_[k] + entry] * (ta - tb);
      if (!radiation_.empty()) sum += radiation_[first_entry_[k] + entry] * (fourth(ta) - fourth(tb));
    });
  }
  return sum;
}

}  // namespace solidus::contact
