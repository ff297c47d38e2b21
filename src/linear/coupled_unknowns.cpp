/// Numbers of displacements and pressures are those of the saddle; temperatures follow behind them on every
/// process.
#include "linear/coupled_unknowns.hpp"

#include <petscmat.h>

#include <algorithm>
#include <cassert>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::linear {

namespace {

/// From numbers of each process to the sums of those before it.
std::vector<std::int64_t> sums_before(const std::vector<std::int64_t>& counts) {
  std::vector<std::int64_t> before(counts.size(), 0);
  for (std::size_t i = 1; i < counts.size(); ++i) before[i] = before[i - 1] + counts[i - 1];
  return before;
}

/// Calls f(i, j, value, of_heat) for all entries of the tangent of the unknowns, with their numbers over all
/// processes, −1 where a degree of freedom is no unknown; always in the same order.
template <class F>
void each_entry(const mesh::Mesh& mesh, CoupledMatrix& matrix, const CoupledUnknowns& unknowns, const F& f) {
  // First the saddle of displacements and pressures, then what couples it with temperature, row by
  // row.
  each_saddle_entry(mesh.n_owned_nodes, *matrix.saddle(), unknowns,
                    [&](PetscInt i, PetscInt j, double value) { f(i, j, value, false); });
  const BlockMatrix &u = matrix.displacement(), &t = matrix.temperature();
  for (Index row = 0; row < mesh.n_owned_nodes; ++row) {
    for (std::int64_t s = u.row_start()[as_size(row)]; s < u.row_start()[as_size(row) + 1]; ++s) {
      const Index column = u.columns()[as_size(s)];
      const double *const force = matrix.force_by_temperature(s), *const heat =
                                                                      matrix.heat_by_displacement(s);
      for (int i = 0; i < matrix.components(); ++i) {
        f(unknowns.of_displacement(row, i), unknowns.of_temperature(column), force[i], false);
        f(unknowns.of_temperature(row), unknowns.of_displacement(column, i), heat[i], true);
      }
      for (int field = 0; field < matrix.pressures(); ++field) {
        f(unknowns.of_pressure(row, field), unknowns.of_temperature(column),
          matrix.volume_by_temperature(s)[field], false);
        f(unknowns.of_temperature(row), unknowns.of_pressure(column, field),
          matrix.heat_by_pressure(s)[field], true);
      }
    }
    // At last conduction and storage of the temperatures themselves.
    for (std::int64_t s = t.row_start()[as_size(row)]; s < t.row_start()[as_size(row) + 1]; ++s)
      f(unknowns.of_temperature(row), unknowns.of_temperature(t.columns()[as_size(s)]), *t.block(s), true);
  }
}

}  // namespace

CoupledUnknowns::CoupledUnknowns(const mesh::Mesh& mesh, CoupledMatrix& matrix,
                                 std::span<const char> no_pressure, const parallel::GhostExchange& ghosts)
    : saddle_(mesh, *matrix.saddle(), no_pressure, ghosts),
      n_saddle_(as_size(mesh.n_owned_nodes) * as_size(matrix.components() + matrix.pressures())) {
  assert(matrix.fields() == 1 && matrix.temperature().constraints().empty());
  // Free temperatures of this process are counted besides the unknowns of the saddle point.
  const std::vector<char>& fixed = matrix.temperature().fixed();
  for (Index node = 0; node < mesh.n_owned_nodes; ++node)
    if (!fixed[as_size(node)]) temperatures_of_process_.push_back(node);
  // Unknowns are numbered process by process: displacements and pressures first, temperatures behind them, so
  // that each process owns one range of rows.
  const std::vector<std::int64_t> n_saddle = processes::gather(static_cast<std::int64_t>(saddle_.size())),
                                  n_temperatures = processes::gather(std::ssize(temperatures_of_process_));
  first_of_saddle_ = sums_before(n_saddle);
  temperatures_before_ = sums_before(n_temperatures);
  n_global_ = saddle_.n_global() + temperatures_before_.back() + n_temperatures.back();

  // Ghosts get the numbers of their owners.
  const int rank = processes::rank();
  auto number = static_cast<double>(first_of_saddle_[as_size(rank)] + n_saddle[as_size(rank)] +
                                    temperatures_before_[as_size(rank)]);
  std::vector<double> numbers(mesh.x.size(), -1.0);
  for (const Index node : temperatures_of_process_) numbers[as_size(node)] = number++;
  ghosts.update(numbers, 1);
  temperatures_.resize(numbers.size());
  std::transform(numbers.begin(), numbers.end(), temperatures_.begin(),
                 [](double value) { return static_cast<PetscInt>(value); });
}

/// The unknowns of a process are those of its saddle point and then its temperatures.
PetscInt CoupledUnknowns::number(PetscInt of_saddle) const {
  if (of_saddle < 0) return -1;
  const auto after = std::upper_bound(first_of_saddle_.begin(), first_of_saddle_.end(), of_saddle);
  const auto process = as_size(after - first_of_saddle_.begin()) - 1;
  return static_cast<PetscInt>(of_saddle + temperatures_before_[process]);
}

void CoupledUnknowns::expand(std::span<const double> unknowns, std::span<double> whole) const {
  saddle_.expand(unknowns.first(saddle_.size()), whole.first(n_saddle_));
  const std::span<double> temperature = whole.subspan(n_saddle_);
  std::fill(temperature.begin(), temperature.end(), 0.0);
  for (std::size_t k = 0; k < temperatures_of_process_.size(); ++k)
    temperature[as_size(temperatures_of_process_[k])] = unknowns[saddle_.size() + k];
}

void CoupledUnknowns::restrict_to(std::span<const double> whole, std::span<double> unknowns) const {
  saddle_.restrict_to(whole.first(n_saddle_), unknowns.first(saddle_.size()));
  for (std::size_t k = 0; k < temperatures_of_process_.size(); ++k)
    unknowns[saddle_.size() + k] = whole[n_saddle_ + as_size(temperatures_of_process_[k])];
}

void CoupledCopy::create(const mesh::Mesh& mesh, CoupledMatrix& matrix, const CoupledUnknowns& unknowns) {
  std::vector<PetscInt> rows, columns;
  each_entry(mesh, matrix, unknowns, [&](PetscInt i, PetscInt j, double, bool) {
    rows.push_back(i);
    columns.push_back(j);
  });
  values_.resize(rows.size());
  const auto n = static_cast<PetscInt>(unknowns.size());
  petsc::check(MatCreate(PETSC_COMM_WORLD, matrix_.out()), "MatCreate");
  petsc::check(MatSetSizes(matrix_, n, n, PETSC_DETERMINE, PETSC_DETERMINE), "MatSetSizes");
  petsc::check(MatSetType(matrix_, MATAIJ), "MatSetType");
  // Entries with a negative number are left out, those of the same place are added up.
  petsc::check(
      MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()),
      "MatSetPreallocationCOO");
}

Mat CoupledCopy::copy(const mesh::Mesh& mesh, CoupledMatrix& matrix, const CoupledUnknowns& unknowns,
                      double force_scale, double heat_scale) {
  if (!matrix_) create(mesh, matrix, unknowns);
  auto to = values_.begin();
  each_entry(mesh, matrix, unknowns, [&](PetscInt, PetscInt, double value, bool of_heat) {
    *to++ = (of_heat ? heat_scale : force_scale) * value;
  });
  petsc::check(MatSetValuesCOO(matrix_, values_.data(), INSERT_VALUES), "MatSetValuesCOO");
  return matrix_;
}

}  // namespace solidus::linear
