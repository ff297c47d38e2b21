/// Free entries are numbered process by process; expanding and restricting move between them and whole
/// vectors.
#include "linear/saddle_unknowns.hpp"

#include <petscmat.h>

#include <algorithm>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::linear {

namespace {

/// Marks entries of the whole before they are numbered: unknowns, and degrees of freedom that are none.
constexpr double k_unknown = 1, k_none = -1;

std::vector<PetscInt> rounded(std::span<const double> numbers) {
  std::vector<PetscInt> result(numbers.size());
  std::transform(numbers.begin(), numbers.end(), result.begin(),
                 [](double number) { return static_cast<PetscInt>(number); });
  return result;
}

}  // namespace

SaddleUnknowns::SaddleUnknowns(const mesh::Mesh& mesh, const SaddleMatrix& matrix,
                               std::span<const char> no_pressure, const parallel::GhostExchange& ghosts)
    : components_(matrix.components()),
      fields_(matrix.fields()),
      constraints_(matrix.displacement().constraints()) {
  // Each displacement and each pressure of a node gets a mark: no unknown, or an unknown. Fixed entries,
  // followers of ties and nodes without a pressure are none.
  n_displacements_ = as_size(mesh.n_owned_nodes) * as_size(components_);
  const std::size_t n_pressures = as_size(mesh.n_owned_nodes) * as_size(fields_);
  std::vector<double> u(mesh.x.size() * as_size(components_), k_none),
      p(mesh.x.size() * as_size(fields_), k_none);
  const std::vector<char>& fixed = matrix.displacement().fixed();
  for (std::size_t i = 0; i < n_displacements_; ++i)
    if (!fixed[i]) u[i] = k_unknown;
  for (const Index follower : constraints_.followers()) u[as_size(follower)] = k_none;
  for (std::size_t i = 0; i < n_pressures; ++i)
    if (!no_pressure[i]) p[i] = k_unknown;

  // Unknowns of this process are numbered in the order of their entries, displacements before pressures.
  for (std::size_t i = 0; i < n_displacements_; ++i)
    if (u[i] == k_unknown) entries_.push_back(i);
  for (std::size_t i = 0; i < n_pressures; ++i)
    if (p[i] == k_unknown) entries_.push_back(n_displacements_ + i);
  n_global_ = std::ssize(entries_);
  // The numbers go on from process to process, so that each owns a contiguous range of rows.
  auto number = static_cast<double>(processes::sum_before(n_global_));
  processes::sum(std::span(&n_global_, 1));
  for (const std::size_t entry : entries_)
    (entry < n_displacements_ ? u[entry] : p[entry - n_displacements_]) = number++;
  // Followers get the numbers of what they follow, and ghosts those that their owners have given.
  constraints_.share(std::span(u).first(n_displacements_));
  ghosts.update(u, components_);
  ghosts.update(p, fields_);
  displacements_ = rounded(u);
  pressures_ = rounded(p);
}

void SaddleUnknowns::expand(std::span<const double> unknowns, std::span<double> whole) const {
  std::fill(whole.begin(), whole.end(), 0.0);
  for (std::size_t k = 0; k < entries_.size(); ++k) whole[entries_[k]] = unknowns[k];
  constraints_.share(whole.first(n_displacements_));
}

void SaddleUnknowns::restrict_to(std::span<const double> whole, std::span<double> unknowns) const {
  if (constraints_.empty()) {
    for (std::size_t k = 0; k < entries_.size(); ++k) unknowns[k] = whole[entries_[k]];
    return;
  }
  std::vector<double> summed(whole.begin(), whole.end());
  constraints_.sum(std::span(summed).first(n_displacements_));
  for (std::size_t k = 0; k < entries_.size(); ++k) unknowns[k] = summed[entries_[k]];
}

void SaddleCopy::create(const mesh::Mesh& mesh, const SaddleMatrix& matrix, const SaddleUnknowns& unknowns) {
  // One walk over all entries fixes rows and columns; values follow in the same order.
  std::vector<PetscInt> rows, columns;
  each_saddle_entry(mesh.n_owned_nodes, matrix, unknowns, [&](PetscInt i, PetscInt j, double) {
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

Mat SaddleCopy::copy(const mesh::Mesh& mesh, const SaddleMatrix& matrix, const SaddleUnknowns& unknowns) {
  if (!matrix_) create(mesh, matrix, unknowns);
  auto to = values_.begin();
  each_saddle_entry(mesh.n_owned_nodes, matrix, unknowns,
                    [&](PetscInt, PetscInt, double value) { *to++ = value; });
  petsc::check(MatSetValuesCOO(matrix_, values_.data(), INSERT_VALUES), "MatSetValuesCOO");
  return matrix_;
}

}  // namespace solidus::linear
