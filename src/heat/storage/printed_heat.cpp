/// The excess of a printed form is evaluated at every node with the curve of its bodies and added to the
/// residual and to the diagonal.
#include "heat/storage/printed_heat.hpp"

#include <cassert>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

double PrintedHeat::sum(Index node, double temperature, double PrintedExcess::*part) const {
  const double from = old_temperature_[as_size(node)];
  return storage_.sum(node, [&](const material::Material& material) {
    return printed_excess(material, form_, from, temperature).*part;
  });
}

void PrintedHeat::add_residual(std::span<const double> temperature, std::span<double> r) {
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] += sum(as_index(i), temperature[i], &PrintedExcess::heat) / dt_;
}

void PrintedHeat::add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) {
  for (Index i = 0; i < storage_.n_nodes(); ++i)
    *matrix.diagonal_block(i) += sum(i, temperature[as_size(i)], &PrintedExcess::slope) / dt_;
}

void PrintedHeat::begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> old_temperature) {
  assert(stage.carried == 0 && "printed forms have a single stage");
  dt_ = stage.dt;
  old_temperature_.assign(old_temperature.begin(), old_temperature.begin() + storage_.n_nodes());
}

}  // namespace solidus::heat
