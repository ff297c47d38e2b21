/// Residual and tangent of the heat balance as Newton's method (linear/newton.hpp) asks for them; storage
/// at points is added where the step has any.
#include "heat/iteration/temperature_system.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

/// Divides the solution of another solver by the slopes of the unknown: δΘ = δv/c.
class SlopeSolver final : public linear::TangentSolver {
 public:
  SlopeSolver(linear::TangentSolver& solver, const std::vector<double>& slope)
      : solver_(solver), slope_(slope) {}
  linear::LinearReport solve(linear::BlockMatrix& a, std::span<const double> b, std::span<double> x,
                             double forcing) override {
    return divided(solver_.solve(a, b, x, forcing), x);
  }
  linear::LinearReport solve_again(std::span<const double> b, std::span<double> x, double forcing) override {
    return divided(solver_.solve_again(b, x, forcing), x);
  }
  void forget() override { solver_.forget(); }
  void reset() override { solver_.reset(); }
  linear::SolverSeconds seconds() const override { return solver_.seconds(); }

 private:
  linear::LinearReport divided(linear::LinearReport report, std::span<double> x) const {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] /= slope_[i];
    return report;
  }
  linear::TangentSolver& solver_;
  const std::vector<double>& slope_;
};

}  // namespace

TemperatureSystem::TemperatureSystem(const mesh::Mesh& mesh, HeatSystem& system,
                                     const parallel::GhostExchange& ghosts,
                                     std::span<const std::unique_ptr<PointStorage>> points)
    : mesh_(mesh), system_(system), points_(points), ghosts_(ghosts) {}

double TemperatureSystem::residual(std::span<const double> x, std::span<double> r) {
  // Flows and storage; reactions at prescribed temperatures count as heat moved.
  double moved = system_.residual(x, r);
  // Storage at points is added where the step stores heat; a steady solution has none.
  if (storing_) {
    local_.assign(mesh_.x.size(), 0.0);
    for (const auto& block : points_) block->add_residual(x, local_);
    for (std::size_t i = 0; i < r.size(); ++i) {
      r[i] += local_[i];
      moved += std::abs(local_[i]);
    }
  }
  // The reaction is what the condition brings or takes: it is heat moved, too.
  for (std::size_t i = 0; i < r.size(); ++i)
    if (system_.parts().prescribed.fixed()[i]) moved += std::abs(r[i]);
  moved_ = 0.5 * parallel::global_sum(moved);
  return moved_ / std::sqrt(static_cast<double>(mesh_.n_global_nodes));
}

linear::BlockMatrix& TemperatureSystem::tangent(std::span<const double> x) {
  const NodalPotential& potential = system_.parts().elements.nodal();
  slope_.resize(mesh_.x.size(), 1.0);
  // Slopes of the potential make the matrix symmetric in it.
  if (!potential.identity()) {
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) slope_[as_size(i)] = potential.slope(i, x[as_size(i)]);
    ghosts_.update(slope_, 1);
  }
  const auto add_storage = [this, x](linear::BlockMatrix& matrix) {
    if (!storing_) return;
    for (const auto& block : points_) block->add_tangent(x, matrix);
  };
  system_.assemble_symmetric(x, slope_, add_storage, SharedNodes::plain);
  return system_.matrix();
}

linear::BlockMatrix& TemperatureSystem::exact_tangent(std::span<const double> x) {
  system_.assemble(x);
  if (storing_)
    for (const auto& block : points_) block->add_tangent(x, system_.matrix());
  return system_.matrix();
}

std::unique_ptr<linear::TangentSolver> TemperatureSystem::solver(linear::TangentSolver& solver) {
  return std::make_unique<SlopeSolver>(solver, slope_);
}

double TemperatureSystem::round_off(std::span<const double> x) const {
  double sum = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const double part = *system_.matrix().diagonal_block(i) * x[as_size(i)];
    sum += part * part;
  }
  constexpr double rounding = 2e-15;
  return rounding * std::sqrt(parallel::global_sum(sum));
}

}  // namespace solidus::heat
