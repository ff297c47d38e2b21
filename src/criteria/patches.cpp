/// Elements around chosen nodes as compressed rows, and gradients at element centres.
#include "criteria/patches.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

namespace {

constexpr std::uint32_t k_not_gathered = std::numeric_limits<std::uint32_t>::max();

using Matrix = std::array<std::array<double, 3>, 3>;

// The centre of the reference shape; its volume is the sum of any rule's weights.
mesh::Point centre_of(mesh::Shape shape) {
  const int dimension = mesh::dimension(shape);
  if (mesh::vertex_count(shape) != dimension + 1) return {0, 0, 0};
  const double x = 1.0 / (dimension + 1);
  return {x, x, dimension == 3 ? x : 0};
}

}  // namespace

Patches::Patches(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<char> chosen)
    : mesh_(mesh), kind_(kind), chosen_(std::move(chosen)) {
  // Shape functions and gradients at the centre of each kind of element.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    Centre& centre = centres_.emplace_back();
    const auto n = as_size(mesh::node_count(block.shape));
    centre.values.resize(n);
    centre.gradients.resize(n * as_size(mesh::dimension(block.shape)));
    mesh::basis_values(block.shape, centre_of(block.shape), centre.values);
    mesh::basis_gradients(block.shape, centre_of(block.shape), centre.gradients);
    for (const mesh::QuadraturePoint& point : mesh::gauss_rule(block.shape, 1)) centre.weight += point.weight;
  }
  // Elements are numbered through all blocks.
  first_.push_back(0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    first_.push_back(first_.back() + static_cast<std::uint32_t>(block.size()));
}

void Patches::gather(std::span<const Index> owned) {
  position_.assign(as_size(mesh_.n_owned_nodes), k_not_gathered);
  for (std::size_t k = 0; k < owned.size(); ++k) position_[as_size(owned[k])] = static_cast<std::uint32_t>(k);
  // Each pair of a gathered node and an element around it.
  const auto each = [&](const auto& visit) {
    for_elements([&](const Element& e) {
      const std::uint32_t number = first_[as_size(e.block)] + static_cast<std::uint32_t>(e.number);
      for (const Index node : nodes(e)) {
        if (node >= mesh_.n_owned_nodes) continue;
        const std::uint32_t position = position_[as_size(node)];
        if (position != k_not_gathered) visit(position, number);
      }
    });
  };
  // A compressed row for each node: counted first, then filled.
  start_.assign(owned.size() + 1, 0);
  std::size_t places = 0;
  each([&](std::uint32_t position, std::uint32_t) {
    ++start_[position + 1];
    ++places;
  });
  if (places > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("more than 4e9 pairs of a node and an element on one process");
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  elements_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  each([&](std::uint32_t position, std::uint32_t number) { elements_[next[position]++] = number; });
}

void Patches::clear() {
  for (auto* list : {&position_, &start_, &elements_}) std::vector<std::uint32_t>().swap(*list);
}

Patches::Around Patches::around(Index node) const {
  const std::uint32_t k = position_[as_size(node)];
  assert(k != k_not_gathered);
  return {*this, elements_.data() + start_[k], elements_.data() + start_[k + 1]};
}

Patches::Gradient Patches::gradient(const Element& e, std::span<const double> values) const {
  const Centre& centre = centres_[as_size(e.block)];
  const bool solid = centre.gradients.size() == 3 * centre.values.size();
  return solid ? gradient_in<3>(centre, nodes(e), values) : gradient_in<2>(centre, nodes(e), values);
}

template <std::size_t dim>
Patches::Gradient Patches::gradient_in(const Centre& centre, std::span<const Index> element,
                                       std::span<const double> values) const {
  Matrix j{};                     // J_ij = ∂x_i/∂ξ_j
  std::array<double, 3> slope{};  // ∂v/∂ξ_j
  // At the centre of the element: Jacobian, slope in reference coordinates and, in axisymmetry, the radius.
  double radius = 0;
  for (std::size_t a = 0; a < element.size(); ++a) {
    const mesh::Point& x = mesh_.x[as_size(element[a])];
    radius += centre.values[a] * x[0];
    for (std::size_t k = 0; k < dim; ++k) {
      const double dn = centre.gradients[a * dim + k];
      slope[k] += values[a] * dn;
      for (std::size_t i = 0; i < dim; ++i) j[i][k] += x[i] * dn;
    }
  }
  // In the plane the third direction is perpendicular and of unit length.
  if constexpr (dim == 2) j[2][2] = 1;
  // With the cofactors c of J: J⁻¹_ki = c_ik/det J, so ∂v/∂x_i = Σ_k c_ik ∂v/∂ξ_k / det J.
  const auto cofactor = [&j](std::size_t a, std::size_t b) {
    const std::size_t a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
    return j[a1][b1] * j[a2][b2] - j[a1][b2] * j[a2][b1];
  };
  // The determinant times the weight of the centre is the element's volume.
  const double determinant = j[0][0] * cofactor(0, 0) + j[0][1] * cofactor(0, 1) + j[0][2] * cofactor(0, 2);
  const double inverse = 1 / determinant;
  Gradient gradient;
  for (std::size_t i = 0; i < dim; ++i) {
    for (std::size_t k = 0; k < dim; ++k) gradient.value[i] += cofactor(i, k) * slope[k];
    gradient.value[i] *= inverse;
  }
  gradient.volume = centre.weight * determinant;
  if (kind_ == AnalysisKind::axisymmetric) gradient.volume *= 2 * std::numbers::pi * radius;
  return gradient;
}

std::size_t Patches::bytes() const {
  return (first_.capacity() + position_.capacity() + start_.capacity() + elements_.capacity()) *
         sizeof(std::uint32_t);
}

}  // namespace solidus::criteria
