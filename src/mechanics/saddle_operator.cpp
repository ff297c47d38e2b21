#include "mechanics/saddle_operator.hpp"

#include <algorithm>
#include <cassert>

namespace solidus::mechanics {

SaddleOperator::SaddleOperator(const mesh::Mesh& mesh, algebra::CoupledMatrix& matrix,
                               PressureEquation& pressure, const algebra::GhostExchange& ghosts)
    : mesh_(mesh), matrix_(matrix), pressure_(pressure), ghosts_(ghosts) {
  assert(matrix.displacement().ties().empty());
  const std::size_t n_u = n_displacements();
  const std::vector<char>&held = matrix.displacement().fixed(), &no_pressure = pressure.fixed();
  for (std::size_t i = 0; i < n_u; ++i)
    if (!held[i]) free_.push_back(i);
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.n_owned_nodes * pressure.fields()); ++i)
    if (!no_pressure[i]) free_.push_back(n_u + i);
}

std::size_t SaddleOperator::n_displacements() const {
  return static_cast<std::size_t>(mesh_.n_owned_nodes * matrix_.components());
}

void SaddleOperator::expand(std::span<const double> free, std::span<double> whole) const {
  std::fill(whole.begin(), whole.end(), 0.0);
  for (std::size_t k = 0; k < free_.size(); ++k) whole[free_[k]] = free[k];
}

void SaddleOperator::restrict_to_free(std::span<const double> whole, std::span<double> free) const {
  for (std::size_t k = 0; k < free_.size(); ++k) free[k] = whole[free_[k]];
}

void SaddleOperator::multiply(std::span<const double> x, std::span<double> y) {
  const std::size_t n_u = n_displacements();
  const std::span<double> y_u = y.first(n_u), y_p = y.subspan(n_u);
  u_.resize(mesh_.x.size() * static_cast<std::size_t>(matrix_.components()));
  std::copy_n(x.begin(), n_u, u_.begin());
  ghosts_.update(u_, matrix_.components());
  multiply_pressure(x.subspan(n_u), y_u);
  part_.resize(n_u);
  matrix_.displacement().multiply(u_, part_);
  pull_.assign(u_.size(), 0.0);
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_divergence(-1.0, u_, pull_);
  for (std::size_t i = 0; i < n_u; ++i) y_u[i] += part_[i] + pull_[i];

  matrix_.multiply_heat(u_, y_p);
  part_.resize(y_p.size());
  matrix_.temperature().multiply(p_, part_);
  for (std::size_t i = 0; i < y_p.size(); ++i) y_p[i] += part_[i];
  pressure_.add_projection_to(x.subspan(n_u), 1.0, y_p);
}

void SaddleOperator::multiply_pressure(std::span<const double> p, std::span<double> pull) {
  p_.resize(mesh_.x.size() * static_cast<std::size_t>(pressure_.fields()));
  std::copy(p.begin(), p.end(), p_.begin());
  ghosts_.update(p_, pressure_.fields());
  matrix_.multiply_force(p_, pull);
}

}  // namespace solidus::mechanics
