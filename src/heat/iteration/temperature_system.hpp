/// The thermal equations with the temperature as unknown: the open rule and the steady state.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "heat/iteration/heat_system.hpp"
#include "heat/storage/point_storage.hpp"
#include "linear/newton.hpp"

namespace solidus::heat {

class TemperatureSystem final : public linear::NonlinearSystem {
 public:
  /// @param points storage of every mesh block (open rule); empty for the steady state only
  TemperatureSystem(const mesh::Mesh& mesh, HeatSystem& system, const parallel::GhostExchange& ghosts,
                    std::span<const std::unique_ptr<PointStorage>> points);

  /// With or without storage from now on.
  void use_storage(bool on) { storing_ = on; }
  /// The sum of the nodal residuals' magnitudes is at most √N times their norm, so ‖r‖ is measured against
  /// the heat moved over √N: the balance then closes to the tolerance.
  double residual(std::span<const double> x, std::span<double> r) override;
  /// In the unknown of nodal_potential.hpp, symmetric: for the solver of solver().
  linear::BlockMatrix& tangent(std::span<const double> x) override;
  /// ∂r/∂Θ, unsymmetric where a conductivity varies.
  linear::BlockMatrix& exact_tangent(std::span<const double> x);
  /// Solves with tangent() by `solver` and returns steps of the temperature, which both must outlive.
  std::unique_ptr<linear::TangentSolver> solver(linear::TangentSolver& solver);
  double moved() const { return moved_; }  ///< of the last residual, all processes [W]
  /// Residuals that rounding alone leaves at x, by the last tangent.
  double round_off(std::span<const double> x) const;

 private:
  const mesh::Mesh& mesh_;
  HeatSystem& system_;
  std::span<const std::unique_ptr<PointStorage>> points_;
  const parallel::GhostExchange& ghosts_;
  bool storing_ = false;
  double moved_ = 0;
  std::vector<double> local_;
  std::vector<double> slope_;  ///< dv/dΘ at the last tangent(), [local node]
};

}  // namespace solidus::heat
