#include "contact/mechanics_term.hpp"

#include <algorithm>
#include <array>

#include "contact/face.hpp"

namespace solidus::contact {

namespace {

constexpr std::size_t k_max_nodes = 2 * k_max_face_nodes;

const double* shape_at(const ContactPoints& points, const Pairing& pairing, Index p) {
  return points.shape.data() + pairing.first_shape +
         static_cast<std::size_t>(p - pairing.first_point) * static_cast<std::size_t>(pairing.n_nodes());
}

}  // namespace

void add_pairings_to_graph(const ContactPoints& points, algebra::NodeGraph& graph) {
  for (const Pairing& p : points.pairings)
    graph.add_cliques(std::span(points.nodes).subspan(p.first_node, static_cast<std::size_t>(p.n_nodes())),
                      p.n_nodes());
}

std::vector<algebra::BlockMatrix::Slot> pairing_slots(const ContactPoints& points, Index n_owned,
                                                      const algebra::BlockMatrix& matrix) {
  std::vector<algebra::BlockMatrix::Slot> slots;
  for (const Pairing& p : points.pairings) {
    const auto nodes = std::span(points.nodes).subspan(p.first_node, static_cast<std::size_t>(p.n_nodes()));
    for (Index row : nodes)
      for (Index column : nodes)
        slots.push_back(row < n_owned ? matrix.slot(row, column) : algebra::BlockMatrix::k_no_slot);
  }
  return slots;
}

MechanicsTerm::MechanicsTerm(const mesh::Mesh& mesh, int components, const ContactPoints& points,
                             const NormalPenalty& law, double stabilisation)
    : n_owned_(mesh.n_owned_nodes),
      components_(components),
      points_(points),
      law_(law),
      stabilisation_(stabilisation) {}

void MechanicsTerm::add_to_graph(algebra::NodeGraph& graph) const {
  add_pairings_to_graph(points_, graph);
}

void MechanicsTerm::bind(const algebra::BlockMatrix& matrix) {
  slots_ = pairing_slots(points_, n_owned_, matrix);
}

double MechanicsTerm::penetration(const Pairing& pairing, Index p, std::span<const double> u) const {
  const double* b = shape_at(points_, pairing, p);
  const Index* nodes = points_.nodes.data() + pairing.first_node;
  const Point& n = points_.normal[static_cast<std::size_t>(p)];
  double g = points_.initial_penetration[static_cast<std::size_t>(p)];
  for (int a = 0; a < pairing.n_nodes(); ++a) {
    const double* ua = u.data() + static_cast<std::ptrdiff_t>(nodes[a]) * components_;
    double along = 0;
    for (int i = 0; i < components_; ++i) along += ua[i] * n[static_cast<std::size_t>(i)];
    g += b[a] * along;
  }
  return g;
}

void MechanicsTerm::add_residual(std::span<const double> x, std::span<double> r) {
  if (!active_) return;
  for (const Pairing& pairing : points_.pairings) {
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      const double pressure = law_.update(penetration(pairing, p, x)).pressure;
      if (pressure == 0) continue;
      const double* b = shape_at(points_, pairing, p);
      const Point& n = points_.normal[static_cast<std::size_t>(p)];
      const double force = points_.weight[static_cast<std::size_t>(p)] * pressure;
      for (int a = 0; a < pairing.n_nodes(); ++a) {
        if (nodes[a] >= n_owned_) continue;
        double* ra = r.data() + static_cast<std::ptrdiff_t>(nodes[a]) * components_;
        for (int i = 0; i < components_; ++i) ra[i] += force * b[a] * n[static_cast<std::size_t>(i)];
      }
    }
  }
}

template <int dim>
void MechanicsTerm::add_pairing_tangent(const Pairing& pairing, std::span<const double> x,
                                        const algebra::BlockMatrix::Slot* slots,
                                        algebra::BlockMatrix& matrix) const {
  const auto n = static_cast<std::size_t>(pairing.n_nodes());
  std::array<double, k_max_nodes * k_max_nodes * dim * dim> k;
  std::fill_n(k.begin(), n * n * dim * dim, 0.0);
  for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
    const auto response = law_.update(penetration(pairing, p, x));
    const double w = points_.weight[static_cast<std::size_t>(p)];
    const double* b = shape_at(points_, pairing, p);
    const Point& normal = points_.normal[static_cast<std::size_t>(p)];
    std::array<double, dim * dim> point;  // w (ε_N n⊗n + stabilisation)
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j)
        point[i * dim + j] =
            w * (response.tangent * normal[i] * normal[j] + (i == j ? stabilisation_ * law_.penalty : 0.0));
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t c = 0; c < n; ++c) {
        double* block = k.data() + (a * n + c) * dim * dim;
        for (std::size_t i = 0; i < dim * dim; ++i) block[i] += b[a] * b[c] * point[i];
      }
  }
  for (std::size_t e = 0; e < n * n; ++e) {
    double* target = matrix.block(slots[e]);
    const double* block = k.data() + e * dim * dim;
    for (std::size_t i = 0; i < dim * dim; ++i) target[i] += block[i];
  }
}

void MechanicsTerm::add_tangent(std::span<const double> x, algebra::BlockMatrix& matrix) {
  if (!active_) return;
  const algebra::BlockMatrix::Slot* slots = slots_.data();
  for (const Pairing& pairing : points_.pairings) {
    if (components_ == 2)
      add_pairing_tangent<2>(pairing, x, slots, matrix);
    else
      add_pairing_tangent<3>(pairing, x, slots, matrix);
    slots += static_cast<std::ptrdiff_t>(pairing.n_nodes()) * pairing.n_nodes();
  }
}

}  // namespace solidus::contact
