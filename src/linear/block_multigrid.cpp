/// Rows without unknowns are taken out before the hierarchy is made, and put back into its result.
#include "linear/block_multigrid.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::linear {

namespace {

/// The near-null space on the rows that are left.
multigrid::NearNullSpace on_rows(const multigrid::NearNullSpace& whole, std::span<const Index> rows,
                                 int size) {
  const auto of_row = static_cast<std::ptrdiff_t>(size) * whole.modes;
  multigrid::NearNullSpace result{whole.modes, {}};
  result.values.reserve(rows.size() * as_size(of_row));
  for (const Index row : rows) {
    const auto from = whole.values.begin() + row * of_row;
    result.values.insert(result.values.end(), from, from + of_row);
  }
  return result;
}

}  // namespace

BlockMultigrid::BlockMultigrid(const mesh::Mesh& mesh, int components, Modes modes, bool symmetric,
                               GlobalIndex coarsest)
    : Multigrid(symmetric, coarsest), mesh_(mesh), components_(components), modes_(modes) {}

void BlockMultigrid::set_up(BlockMatrix& a) {
  // The near null space has to be made before the matrix is constrained, because it follows from the mesh
  // alone. Within constrained() the rows of fixed unknowns are those of the identity; afterwards the matrix
  // is as it was.
  multigrid::NearNullSpace modes = modes_(mesh_, components_);
  a.constrained([&] {
    // Rows are numbered as the mesh numbers its nodes: owned ones first, ghosts behind them.
    const int size = a.block_size();
    multigrid::Numbering numbering{mesh_.n_owned_nodes, mesh_.first_owned, {}};
    numbering.ghosts.assign(mesh_.global_node.begin() + mesh_.n_owned_nodes, mesh_.global_node.end());
    const std::span<const char> fixed =
        std::span(a.fixed()).first(as_size(mesh_.n_owned_nodes) * as_size(size));
    // Where the matrix keeps its upper half alone, the mirror images of its blocks are found by an index.
    const bool upper = a.storage() == BlockMatrix::Storage::upper;
    std::optional<multigrid::LowerPart> lower;
    const auto view = [&](std::span<const std::int64_t> start, std::span<const Index> column,
                          const double* blocks) {
      if (upper) lower.emplace(start, column);
      return multigrid::MatrixView{size, start, column, blocks, lower ? &*lower : nullptr};
    };
    // Rows without any unknown (bodies that are absent) are left out of the hierarchy only where they are
    // many enough to pay for the copy of the others; otherwise the hierarchy is made on the blocks as they
    // lie.
    compact_.reset();
    if (!multigrid::worth_compacting(size, fixed)) {
      Multigrid::set_up(view(a.row_start(), a.columns(), a.block(0)), std::move(numbering), fixed,
                        std::move(modes));
      return;
    }
    // With rows left out the modes are restricted to those that remain. Values and marks of the compact
    // matrix have served once the levels are made, and go; its numbers stay, because apply() gathers and
    // scatters by them.
    compact_ = multigrid::compact({size, a.row_start(), a.columns(), a.block(0), nullptr}, numbering, fixed);
    modes = on_rows(modes, compact_->rows, size);
    Multigrid::set_up(view(compact_->start, compact_->column, compact_->value.data()), compact_->numbering,
                      compact_->fixed, std::move(modes));
    compact_->value = {};
    compact_->fixed = {};
    right_.resize(compact_->rows.size() * as_size(size));
    solution_.resize(right_.size());
  });
}

void BlockMultigrid::apply(std::span<const double> r, std::span<double> z) {
  if (!compact_) return Multigrid::apply(r, z);
  const std::vector<Index>& rows = compact_->rows;
  const auto size = static_cast<std::ptrdiff_t>(components_);
  // Rows without neighbours are left out of the hierarchy and divided by their diagonal.
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::copy_n(r.begin() + rows[i] * size, size, right_.begin() + static_cast<std::ptrdiff_t>(i) * size);
  Multigrid::apply(right_, solution_);
  for (std::size_t i = 0; i < compact_->inverse_diagonal.size(); ++i)
    z[i] = compact_->inverse_diagonal[i] * r[i];
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::copy_n(solution_.begin() + static_cast<std::ptrdiff_t>(i) * size, size, z.begin() + rows[i] * size);
}

std::size_t BlockMultigrid::bytes() const {
  std::size_t total = Multigrid::bytes() + (right_.capacity() + solution_.capacity()) * sizeof(double);
  if (compact_)
    total += compact_->start.capacity() * sizeof(std::int64_t) +
             (compact_->column.capacity() + compact_->rows.capacity()) * sizeof(Index) +
             compact_->inverse_diagonal.capacity() * sizeof(double);
  return total;
}

}  // namespace solidus::linear
