/// The matrix is built in steps: graph, compressed rows, slots; then values are summed by slots and copied
/// to PETSc's own arrays when it asks for them.
#include "linear/block_matrix.hpp"

#include <petscmat.h>

#include <algorithm>
#include <cassert>

#include "multigrid/matrix_view.hpp"
#include "multigrid/symmetric_product.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"
#include "parallel/parallel.hpp"
#include "parallel/petsc_handles.hpp"
#include "system/large_pages.hpp"
#include "system/processes.hpp"

namespace solidus::linear {

namespace {

/// Numbers behind the last block, which products of half a matrix read.
constexpr std::size_t k_overhang = 8;
/// Columns of a row, in any order, through which a further one is looked for.
constexpr std::size_t k_searched = 64;

/// Adds a column once to a row of few. A long row, of contact say, may have it several times over between two
/// growths: then it is freed of repetitions first, so that its memory follows from its columns, not from the
/// number of cliques.
void add_column(Index column, std::vector<Index>& row) {
  if (row.size() <= k_searched) {
    if (std::find(row.begin(), row.end(), column) != row.end()) return;
  } else if (row.size() == row.capacity()) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    if (2 * row.size() > row.capacity()) row.reserve(2 * row.capacity());
  }
  row.push_back(column);
}

}  // namespace

NodeGraph::NodeGraph(const mesh::Mesh& mesh) : mesh_(mesh), rows_(as_size(mesh.n_owned_nodes)) {}

void NodeGraph::add_cliques(std::span<const Index> nodes, int n) {
  const auto count = as_size(n);
  assert(nodes.size() % count == 0);
  // Every pair of nodes of an element, in the rows of this process.
  for (std::size_t start = 0; start < nodes.size(); start += count) {
    // Rows of other processes are theirs; nodes without an equation have neither row nor column.
    const auto clique = nodes.subspan(start, count);
    for (Index row : clique) {
      if (row >= mesh_.n_owned_nodes) continue;
      if (!left_out_.empty() && left_out_[as_size(row)]) continue;
      for (const Index column : clique)
        if (left_out_.empty() || !left_out_[as_size(column)]) add_column(column, rows_[as_size(row)]);
    }
  }
}

void NodeGraph::compress(std::vector<std::int64_t>& row_start, std::vector<Index>& columns, bool upper) {
  // Each row gets its diagonal, and its columns in rising order without doubles; of a symmetric matrix those
  // from the diagonal on.
  std::size_t n_columns = 0;
  for (Index row = 0; row < mesh_.n_owned_nodes; ++row) {
    auto& list = rows_[as_size(row)];
    add_column(row, list);  // the diagonal always exists
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    if (upper) list.erase(list.begin(), std::lower_bound(list.begin(), list.end(), row));
    n_columns += list.size();
  }
  // The rows are then laid end to end, and the lists of the graph are given up.
  row_start.assign(1, 0);
  row_start.reserve(rows_.size() + 1);
  std::vector<Index>().swap(columns);
  columns.reserve(n_columns);
  for (auto& list : rows_) {
    columns.insert(columns.end(), list.begin(), list.end());
    row_start.push_back(static_cast<std::int64_t>(columns.size()));
    std::vector<Index>().swap(list);
  }
}

struct BlockMatrix::Petsc {
  petsc::MatHandle matrix;
  std::unique_ptr<multigrid::LowerPart> lower;  ///< of half a matrix: PETSc's copy is whole
};

BlockMatrix::BlockMatrix(const mesh::Mesh& mesh, int block_size, NodeGraph graph, Storage storage)
    : mesh_(mesh),
      block_size_(block_size),
      storage_(storage),
      fixed_(as_size(mesh.n_nodes()) * as_size(block_size), 0),
      petsc_(std::make_unique<Petsc>()) {
  set_graph(std::move(graph));
}

void BlockMatrix::set_graph(NodeGraph graph) {
  ++pattern_;
  // Slots and the compressed rows follow from the graph; values are zero until the next assembly.
  left_out_ = graph.left_out();
  const bool upper = storage_ == Storage::upper;
  graph.compress(row_start_, columns_, upper);
  const auto bs = as_size(block_size_);
  assign_in_large_pages(values_, (columns_.size() + 1) * bs * bs + (upper ? k_overhang : 0), 0.0);
  // An upper half begins each row with its diagonal, so that only whole rows need a table of it.
  if (!upper) {
    diagonal_.resize(as_size(mesh_.n_owned_nodes));
    for (Index row = 0; row < mesh_.n_owned_nodes; ++row) diagonal_[as_size(row)] = slot(row, row);
  }
  order_ghost_columns();
  // The lists of fixed entries belong to the old pattern.
  set_fixed(std::move(fixed_));
  petsc_->matrix.reset();
  petsc_->lower.reset();
}

/// With the mirror images once PETSc has a copy.
multigrid::MatrixView BlockMatrix::view() const {
  return {block_size_, row_start_, columns_, block(0), petsc_->lower.get()};
}

/// PETSc keeps the columns of a row in global order, owned ones and ghosts apart; ours are in local order.
void BlockMatrix::order_ghost_columns() {
  const auto global = [&](Slot s) { return mesh_.global_node[as_size(columns_[as_size(s)])]; };
  ghost_start_.clear();
  ghost_slots_.clear();
  // With one process there are no ghosts.
  if (mesh_.n_nodes() == mesh_.n_owned_nodes) return;
  ghost_start_.reserve(as_size(mesh_.n_owned_nodes) + 1);
  ghost_start_.push_back(0);
  // Each row lists the slots of its ghost columns, sorted as PETSc has them.
  for (Index row = 0; row < mesh_.n_owned_nodes; ++row) {
    const auto begin = ghost_slots_.size();
    for (Slot s = row_start_[as_size(row)]; s < row_start_[as_size(row) + 1]; ++s)
      if (columns_[as_size(s)] >= mesh_.n_owned_nodes) ghost_slots_.push_back(s);
    std::sort(ghost_slots_.begin() + static_cast<std::ptrdiff_t>(begin), ghost_slots_.end(),
              [&](Slot p, Slot q) { return global(p) < global(q); });
    ghost_start_.push_back(static_cast<std::int64_t>(ghost_slots_.size()));
  }
}

void BlockMatrix::create_petsc_matrix() {
  // Any order of columns will do for the pattern as long as it is sorted: ghosts below, owned, ghosts above.
  if (storage_ == Storage::upper)
    petsc_->lower = std::make_unique<multigrid::LowerPart>(row_start_, columns_);
  // Rows of scalar unknowns, each with the sorted columns of its blocks, in PETSc's format of
  // compressed rows.
  std::vector<PetscInt> i(1, 0), j, columns;
  i.reserve(as_size(mesh_.n_owned_nodes) * as_size(block_size_) + 1);
  j.reserve(values_.size() * (storage_ == Storage::upper ? 2 : 1));
  for (Index row = 0; row < mesh_.n_owned_nodes; ++row) {
    columns.clear();
    view().each(row, [&](Index column, Slot, bool) {
      for (int b = 0; b < block_size_; ++b)
        columns.push_back(static_cast<PetscInt>(mesh_.global_node[as_size(column)] * block_size_ + b));
    });
    std::sort(columns.begin(), columns.end());
    for (int a = 0; a < block_size_; ++a) {
      j.insert(j.end(), columns.begin(), columns.end());
      i.push_back(static_cast<PetscInt>(j.size()));
    }
  }
  create_matrix_of_size();
  petsc::MatHandle& a = petsc_->matrix;
  // One of the two applies, the other does nothing.
  petsc::check(MatSeqAIJSetPreallocationCSR(a, i.data(), j.data(), nullptr), "MatSeqAIJSetPreallocationCSR");
  petsc::check(MatMPIAIJSetPreallocationCSR(a, i.data(), j.data(), nullptr), "MatMPIAIJSetPreallocationCSR");
}

void BlockMatrix::create_matrix_of_size() {
  const auto n = static_cast<PetscInt>(mesh_.n_owned_nodes * block_size_);
  petsc::MatHandle& a = petsc_->matrix;
  petsc::check(MatCreate(PETSC_COMM_WORLD, a.out()), "MatCreate");
  petsc::check(MatSetSizes(a, n, n, PETSC_DETERMINE, PETSC_DETERMINE), "MatSetSizes");
  petsc::check(MatSetBlockSize(a, block_size_), "MatSetBlockSize");
  petsc::check(MatSetType(a, MATAIJ), "MatSetType");
}

BlockMatrix::~BlockMatrix() = default;

BlockMatrix::Slot BlockMatrix::slot(Index row, Index column) const {
  if (row >= mesh_.n_owned_nodes) return k_no_slot;
  if (storage_ == Storage::upper && column < row) return k_no_slot;
  const auto begin = columns_.begin() + row_start_[as_size(row)],
             end = columns_.begin() + row_start_[as_size(row) + 1];
  const auto found = std::lower_bound(begin, end, column);
  if (!left_out_.empty() && (left_out_[as_size(row)] || left_out_[as_size(column)]) && row != column)
    return k_no_slot;
  assert(found != end && *found == column && "this pair of nodes was not announced to the graph");
  return found - columns_.begin();
}

std::vector<BlockMatrix::Slot> BlockMatrix::clique_slots(std::span<const Index> nodes, int n) const {
  std::vector<Slot> slots;
  slots.reserve(nodes.size() * as_size(n));
  for (std::size_t start = 0; start < nodes.size(); start += as_size(n)) {
    const auto clique = nodes.subspan(start, as_size(n));
    for (Index a : clique)
      for (Index b : clique) slots.push_back(slot(a, b));
  }
  return slots;
}

void BlockMatrix::set_zero() {
  std::fill(values_.begin(), values_.end(), 0.0);
}

void BlockMatrix::set_fixed(std::vector<char> fixed) {
  assert(fixed.size() == as_size(mesh_.n_nodes()) * as_size(block_size_));
  // The entries of fixed rows and columns are listed once, so that masking them costs nothing else later.
  // Those on the diagonal are listed apart, since they become one (or the mean of the diagonal).
  fixed_ = std::move(fixed);
  masked_.clear();
  fixed_diagonal_.clear();
  const auto bs = as_size(block_size_);
  for (Index row = 0; row < mesh_.n_owned_nodes; ++row)
    for (std::int64_t s = row_start_[as_size(row)]; s < row_start_[as_size(row) + 1]; ++s) {
      const std::size_t column = as_size(columns_[as_size(s)]);
      const std::size_t first = as_size(s + 1) * bs * bs;
      for (std::size_t a = 0; a < bs; ++a)
        for (std::size_t b = 0; b < bs; ++b) {
          const bool row_fixed = fixed_[as_size(row) * bs + a] != 0;
          if (!row_fixed && !fixed_[column * bs + b]) continue;
          masked_.push_back(first + a * bs + b);
          if (column == as_size(row) && a == b) fixed_diagonal_.push_back(first + a * bs + b);
        }
    }
  saved_.resize(masked_.size());
  any_fixed_ = parallel::any_process(!masked_.empty());
}

Mat BlockMatrix::matrix() {
  // PETSc's matrix is made at the first call. Tied unknowns need one whose rows are summed by PETSc; without
  // them the blocks are copied in place.
  if (!petsc_->matrix) {
    if (constraints_.empty())
      create_petsc_matrix();
    else
      create_tied_matrix();
  }
  // Fixed rows get the mean of the diagonal, so that they do not disturb the scale of the matrix.
  const double mean = any_fixed_ || !constraints_.empty() ? mean_diagonal() : 1.0;
  mask(mean);  // PETSc copies the values
  if (constraints_.empty()) {
    copy_to_petsc();
  } else {
    // Followers of ties have a row of their own with that number alone.
    std::fill(values_.end() - static_cast<std::ptrdiff_t>(constraints_.followers().size()), values_.end(),
              mean);
    petsc::check(MatSetValuesCOO(petsc_->matrix, block(0), INSERT_VALUES), "MatSetValuesCOO");
  }
  unmask();
  return petsc_->matrix;
}

void BlockMatrix::constrained(const std::function<void()>& read) {
  assert(constraints_.empty());
  mask(any_fixed_ ? mean_diagonal() : 1.0);
  read();
  unmask();
}

void BlockMatrix::mask(double diagonal) {
  for (std::size_t k = 0; k < masked_.size(); ++k) {
    saved_[k] = values_[masked_[k]];
    values_[masked_[k]] = 0;
  }
  for (std::size_t entry : fixed_diagonal_) values_[entry] = diagonal;
}

void BlockMatrix::unmask() {
  for (std::size_t k = 0; k < masked_.size(); ++k) values_[masked_[k]] = saved_[k];
}

double BlockMatrix::mean_diagonal() const {
  const auto bs = as_size(block_size_);
  double sums[2] = {0, 0};
  const auto n_rows = as_size(mesh_.n_owned_nodes);
  for (std::size_t row = 0; row < n_rows; ++row)
    for (std::size_t a = 0; a < bs; ++a) {
      if (fixed_[row * bs + a]) continue;
      sums[0] += block(diagonal_slot(as_index(row)))[a * bs + a];
      sums[1] += 1;
    }
  processes::sum(sums);
  return sums[1] > 0 && sums[0] > 0 ? sums[0] / sums[1] : 1.0;
}

/// PETSc adds up entries of the same place, also those for rows of other processes: the list of our entries
/// with the numbers of their unknowns is all it needs.
void BlockMatrix::constrain(std::vector<std::vector<Index>> groups) {
  assert(storage_ == Storage::whole || !parallel::any_process(!groups.empty()));
  constraints_ = MultiPointConstraints(mesh_, block_size_, std::move(groups));
  petsc_->matrix.reset();
}

void BlockMatrix::create_tied_matrix() {
  // Each entry of a block goes to the row and column of its unknown, which several members of a group share;
  // PETSc adds what comes to one place.
  const auto bs = as_size(block_size_);
  values_.resize((columns_.size() + 1) * bs * bs + constraints_.followers().size(), 0.0);
  std::vector<PetscInt> rows, columns;
  rows.reserve(values_.size());
  columns.reserve(values_.size());
  for (Index row = 0; row < mesh_.n_owned_nodes; ++row)
    for (Slot s = row_start_[as_size(row)]; s < row_start_[as_size(row) + 1]; ++s)
      for (int a = 0; a < block_size_; ++a)
        for (int b = 0; b < block_size_; ++b) {
          const Index column = columns_[as_size(s)] * block_size_ + b;
          rows.push_back(static_cast<PetscInt>(constraints_.unknown(row * block_size_ + a)));
          columns.push_back(static_cast<PetscInt>(constraints_.unknown(column)));
        }
  // Rows of followers, which no entry belongs to, get one on the diagonal behind the blocks.
  for (const Index follower : constraints_.followers()) {
    rows.push_back(static_cast<PetscInt>(mesh_.first_owned * block_size_ + follower));
    columns.push_back(rows.back());
  }
  create_matrix_of_size();
  petsc::check(MatSetPreallocationCOO(petsc_->matrix, static_cast<PetscCount>(rows.size()), rows.data(),
                                      columns.data()),
               "MatSetPreallocationCOO");
}

/// Writes the blocks' rows into PETSc's arrays: owned columns into the diagonal part, ghosts into the other.
void BlockMatrix::copy_to_petsc() {
  Mat a = petsc_->matrix, diagonal = a, off_diagonal = nullptr;
  PetscBool parallel = PETSC_FALSE;
  petsc::check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(a), MATMPIAIJ, &parallel),
               "PetscObjectTypeCompare");
  // On several processes PETSc keeps two matrices, one for owned columns and one for ghosts.
  if (parallel) petsc::check(MatMPIAIJGetSeqAIJ(a, &diagonal, &off_diagonal, nullptr), "MatMPIAIJGetSeqAIJ");
  double *owned = nullptr, *ghosts = nullptr;
  petsc::check(MatSeqAIJGetArrayWrite(diagonal, &owned), "MatSeqAIJGetArrayWrite");
  if (off_diagonal) petsc::check(MatSeqAIJGetArrayWrite(off_diagonal, &ghosts), "MatSeqAIJGetArrayWrite");

  // Scalar rows are written one after the other, a component of a block row each.
  double *to = owned, *to_ghosts = ghosts;
  const int bs = block_size_;
  const multigrid::MatrixView blocks = view();
  for (Index row = 0; row < mesh_.n_owned_nodes; ++row)
    for (int p = 0; p < bs; ++p) {
      // Owned columns are before ghosts in local order.
      blocks.each(row, [&](Index column, Slot s, bool mirrored) {
        if (column >= mesh_.n_owned_nodes) return;
        const double* const from = block(s);
        if (!mirrored)
          to = std::copy_n(from + p * bs, bs, to);
        else
          for (int q = 0; q < bs; ++q) *to++ = from[q * bs + p];
      });
      if (ghost_start_.empty()) continue;
      for (std::int64_t g = ghost_start_[as_size(row)]; g < ghost_start_[as_size(row) + 1]; ++g)
        to_ghosts = std::copy_n(block(ghost_slots_[as_size(g)]) + p * bs, bs, to_ghosts);
    }

  petsc::check(MatSeqAIJRestoreArrayWrite(diagonal, &owned), "MatSeqAIJRestoreArrayWrite");
  if (off_diagonal)
    petsc::check(MatSeqAIJRestoreArrayWrite(off_diagonal, &ghosts), "MatSeqAIJRestoreArrayWrite");
  petsc::check(MatAssemblyBegin(a, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(a, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
}

namespace {

/// y = A x by block rows; a constant size lets the compiler keep the row in registers.
template <int size>
void multiply_rows(std::span<const std::int64_t> row_start, std::span<const Index> columns,
                   const double* blocks, const double* x, double* y, int any_size = size) {
  const int bs = size > 0 ? size : any_size;
  for (std::size_t row = 0; row + 1 < row_start.size(); ++row) {
    double* const to = y + row * as_size(bs);
    // Sums of a row stay in registers where the size is known to the compiler.
    double sum[size > 0 ? size : 1] = {};
    if constexpr (size == 0) std::fill_n(to, bs, 0.0);
    for (std::int64_t s = row_start[row]; s < row_start[row + 1]; ++s) {
      const double* const a = blocks + s * bs * bs;
      const double* const from = x + static_cast<std::ptrdiff_t>(columns[as_size(s)]) * bs;
      for (int p = 0; p < bs; ++p)
        for (int q = 0; q < bs; ++q) (size > 0 ? sum : to)[p] += a[p * bs + q] * from[q];
    }
    if constexpr (size > 0) std::copy_n(sum, size, to);
  }
}

}  // namespace

void BlockMatrix::multiply(std::span<const double> x, std::span<double> y) const {
  // A stored upper half is multiplied both ways.
  if (storage_ == Storage::upper)
    return multigrid::multiply_symmetric(block_size_, row_start_, columns_.data(), block(0), x.data(),
                                         y.data(), scratch_, mesh_.n_nodes());
  const auto with = [&](auto rows) { rows(row_start_, columns_, block(0), x.data(), y.data(), block_size_); };
  // Sizes that occur have an instance of their own.
  switch (block_size_) {
    case 1:
      return with(multiply_rows<1>);
    case 2:
      return with(multiply_rows<2>);
    case 3:
      return with(multiply_rows<3>);
    default:
      return with(multiply_rows<0>);
  }
}

void BlockMatrix::multiply_free(std::span<double> x, std::span<double> y) const {
  assert(constraints_.empty());
  if (!any_fixed_) return multiply(x, y);
  // [owned entry] what a fixed row leaves as it is
  std::vector<double> held;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!fixed_[i]) continue;
    if (i < y.size()) held.push_back(x[i]);
    x[i] = 0;
  }
  multiply(x, y);
  std::size_t k = 0;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (fixed_[i]) y[i] = held[k++];
}

std::size_t BlockMatrix::bytes() const {
  MatInfo info{};
  if (petsc_->matrix) petsc::check(MatGetInfo(petsc_->matrix, MAT_LOCAL, &info), "MatGetInfo");
  return row_start_.capacity() * sizeof row_start_[0] + columns_.capacity() * sizeof columns_[0] +
         diagonal_.capacity() * sizeof diagonal_[0] + values_.capacity() * sizeof values_[0] +
         scratch_.capacity() * sizeof scratch_[0] + fixed_.capacity() +
         (masked_.capacity() + fixed_diagonal_.capacity()) * sizeof masked_[0] +
         saved_.capacity() * sizeof saved_[0] + static_cast<std::size_t>(info.memory);
}

}  // namespace solidus::linear
