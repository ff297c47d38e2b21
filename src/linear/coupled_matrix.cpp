/// Two square matrices that belong to the phases and two rectangles of our own, which share the graph of
/// the displacements.
#include "linear/coupled_matrix.hpp"

#include <petsc/private/petscimpl.h>
#include <petscmat.h>

#include <algorithm>
#include <cassert>

#include "numbers/index_casts.hpp"
#include "parallel/petsc_handles.hpp"

namespace solidus::linear {

namespace {}  // namespace

struct CoupledMatrix::Petsc {
  petsc::MatHandle force, heat, nest;
};

CoupledMatrix::CoupledMatrix(const mesh::Mesh& mesh, BlockMatrix& displacement, BlockMatrix& temperature,
                             SaddleMatrix* saddle)
    : mesh_(mesh),
      displacement_(displacement),
      temperature_(temperature),
      saddle_(saddle),
      petsc_(std::make_unique<Petsc>()) {
  assert(saddle == nullptr || &saddle->displacement() == &displacement);
  assert(displacement.storage() == BlockMatrix::Storage::whole &&
         temperature.storage() == BlockMatrix::Storage::whole);
  set_zero();
}

CoupledMatrix::~CoupledMatrix() = default;

void CoupledMatrix::create_rectangles() {
  pattern_u_ = displacement_.pattern();
  pattern_t_ = temperature_.pattern();
  petsc_->nest.reset();
  petsc_->force.reset();
  petsc_->heat.reset();
  force_.assign((displacement_.columns().size() + 1) * as_size(components() * fields()), 0.0);
  heat_.assign(force_.size(), 0.0);
  volume_.assign((displacement_.columns().size() + 1) * as_size(pressures() * fields()), 0.0);
  heat_of_pressure_.assign(volume_.size(), 0.0);
}

/// PETSc leaves out entries with a negative number and adds up those of the same place: prescribed and
/// constrained degrees of freedom need nothing else.
void CoupledMatrix::create_petsc_rectangles() {
  const int n_components = components(), n_fields = fields();
  const std::vector<char>&fixed_u = displacement_.fixed(), &fixed_t = temperature_.fixed();
  // A prescribed displacement has no number; one that is tied has the number of its leader.
  const auto displacement_number = [&](Index node, int i) -> PetscInt {
    const std::int64_t entry = std::int64_t{node} * n_components + i;
    if (fixed_u[as_size(entry)]) return -1;
    const MultiPointConstraints& constraints = displacement_.constraints();
    return static_cast<PetscInt>(constraints.empty() ? mesh_.global_node[as_size(node)] * n_components + i
                                                     : constraints.unknown(as_index(entry)));
  };
  // Temperatures are not tied to others.
  const auto temperature_number = [&](Index node, int field) -> PetscInt {
    return fixed_t[as_size(std::int64_t{node} * n_fields + field)]
               ? -1
               : static_cast<PetscInt>(mesh_.global_node[as_size(node)] * n_fields + field);
  };
  // The rows and columns of both rectangles are listed in the order in which their values are stored.
  std::vector<PetscInt> force_rows, force_columns, heat_rows, heat_columns;
  for (auto* list : {&force_rows, &force_columns, &heat_rows, &heat_columns}) list->reserve(force_.size());
  for (Index row = 0; row < mesh_.n_owned_nodes; ++row)
    for (Slot s = displacement_.row_start()[as_size(row)]; s < displacement_.row_start()[as_size(row) + 1];
         ++s) {
      const Index column = displacement_.columns()[as_size(s)];
      for (int i = 0; i < n_components; ++i)
        for (int t = 0; t < n_fields; ++t) {
          force_rows.push_back(displacement_number(row, i));
          force_columns.push_back(temperature_number(column, t));
        }
      for (int t = 0; t < n_fields; ++t)
        for (int i = 0; i < n_components; ++i) {
          heat_rows.push_back(temperature_number(row, t));
          heat_columns.push_back(displacement_number(column, i));
        }
    }
  const auto n_nodes = static_cast<PetscInt>(mesh_.n_owned_nodes);
  const PetscInt n_t = n_nodes * n_fields, n_u = n_nodes * n_components;
  // The pattern is given once as pairs; values follow in the same order at every assembly.
  const auto create = [](petsc::MatHandle& a, PetscInt rows, PetscInt columns, std::vector<PetscInt>& i,
                         std::vector<PetscInt>& j) {
    petsc::check(MatCreate(PETSC_COMM_WORLD, a.out()), "MatCreate");
    petsc::check(MatSetSizes(a, rows, columns, PETSC_DETERMINE, PETSC_DETERMINE), "MatSetSizes");
    petsc::check(MatSetType(a, MATAIJ), "MatSetType");
    petsc::check(MatSetPreallocationCOO(a, static_cast<PetscCount>(i.size()), i.data(), j.data()),
                 "MatSetPreallocationCOO");
  };
  create(petsc_->force, n_u, n_t, force_rows, force_columns);
  create(petsc_->heat, n_t, n_u, heat_rows, heat_columns);
}

bool CoupledMatrix::set_zero() {
  if (pattern_u_ != displacement_.pattern() || pattern_t_ != temperature_.pattern()) {
    create_rectangles();
    return true;
  }
  for (std::vector<double>* values : {&force_, &heat_, &volume_, &heat_of_pressure_})
    std::fill(values->begin(), values->end(), 0.0);
  return false;
}

namespace {

/// y = A x for rows of blocks [rows][columns]; zero: of a size that is known when it runs.
template <int rows, int columns>
void multiply_rectangles_of(const BlockMatrix& graph, const double* blocks, int any_rows, int any_columns,
                            const double* x, double* y) {
  // As in BlockMatrix: sums in registers where the sizes are known.
  const int m = rows > 0 ? rows : any_rows, n = columns > 0 ? columns : any_columns;
  const std::span<const std::int64_t> start = graph.row_start();
  const Index* const column = graph.columns().data();
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    double* const to = y + row * as_size(m);
    double sum[rows > 0 ? rows : 1] = {};
    if constexpr (rows == 0) std::fill_n(to, m, 0.0);
    const double* a = blocks + (start[row] + 1) * m * n;
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s, a += m * n) {
      const double* const from = x + std::int64_t{column[s]} * n;
      for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) (rows > 0 ? sum : to)[i] += a[i * n + j] * from[j];
    }
    if constexpr (rows > 0) std::copy_n(sum, rows, to);
  }
}

void multiply_rectangles(const BlockMatrix& graph, const double* blocks, int m, int n,
                         std::span<const double> x, std::span<double> y) {
  // Every size of the blocks has an instance of its own, whose inner loops the compiler unrolls.
  const auto with = [&](auto product) { product(graph, blocks, m, n, x.data(), y.data()); };
  switch (10 * m + n) {
    case 11:
      return with(multiply_rectangles_of<1, 1>);
    case 12:
      return with(multiply_rectangles_of<1, 2>);
    case 13:
      return with(multiply_rectangles_of<1, 3>);
    case 21:
      return with(multiply_rectangles_of<2, 1>);
    case 31:
      return with(multiply_rectangles_of<3, 1>);
    default:
      return with(multiply_rectangles_of<0, 0>);
  }
}

}  // namespace

void CoupledMatrix::multiply_heat(std::span<const double> x, std::span<double> y) const {
  multiply_rectangles(displacement_, heat_.data(), fields(), components(), x, y);
}

void CoupledMatrix::multiply_force(std::span<const double> x, std::span<double> y) const {
  multiply_rectangles(displacement_, force_.data(), components(), fields(), x, y);
}

void CoupledMatrix::multiply_heat_of_pressure(std::span<const double> x, std::span<double> y) const {
  multiply_rectangles(displacement_, heat_of_pressure_.data(), fields(), pressures(), x, y);
}

void CoupledMatrix::multiply_volume(std::span<const double> x, std::span<double> y) const {
  multiply_rectangles(displacement_, volume_.data(), pressures(), fields(), x, y);
}

Mat CoupledMatrix::matrix(double force_scale, double heat_scale) {
  assert(saddle_ == nullptr);
  if (!petsc_->force) create_petsc_rectangles();
  const std::ptrdiff_t scrap = components() * fields();
  petsc::check(MatSetValuesCOO(petsc_->force, force_.data() + scrap, INSERT_VALUES), "MatSetValuesCOO");
  petsc::check(MatSetValuesCOO(petsc_->heat, heat_.data() + scrap, INSERT_VALUES), "MatSetValuesCOO");
  // The values are copies: scaling them leaves those of the phases alone.
  Mat blocks[4] = {displacement_.matrix(), petsc_->force, petsc_->heat, temperature_.matrix()};
  for (int i = 0; i < 4; ++i) petsc::check(MatScale(blocks[i], i < 2 ? force_scale : heat_scale), "MatScale");
  if (!petsc_->nest)
    petsc::check(MatCreateNest(PETSC_COMM_WORLD, 2, nullptr, 2, nullptr, blocks, petsc_->nest.out()),
                 "MatCreateNest");
  petsc::check(MatAssemblyBegin(petsc_->nest, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(petsc_->nest, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
  // PETSc does not see that the blocks have changed, and would keep an old factorisation.
  petsc::check(PetscObjectStateIncrease(reinterpret_cast<PetscObject>(static_cast<Mat>(petsc_->nest))),
               "PetscObjectStateIncrease");
  return petsc_->nest;
}

std::size_t CoupledMatrix::bytes() const {
  std::size_t total =
      (force_.capacity() + heat_.capacity() + volume_.capacity() + heat_of_pressure_.capacity()) *
      sizeof(double);
  for (const petsc::MatHandle* a : {&petsc_->force, &petsc_->heat}) {
    if (!*a) continue;
    MatInfo info;
    petsc::check(MatGetInfo(*a, MAT_LOCAL, &info), "MatGetInfo");
    total += static_cast<std::size_t>(info.memory);
  }
  return total;
}

}  // namespace solidus::linear
