/// Levels are added until the coarsest is small enough to be factorised; a cycle then smooths, restricts,
/// recurs, interpolates and smooths again.
#include "multigrid/multigrid.hpp"

#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "parallel/petsc_handles.hpp"
#include "parallel/petsc_options.hpp"
#include "system/log.hpp"

namespace solidus::multigrid {

namespace {

constexpr int k_sweeps = 2;         ///< of Chebyshev's iteration, before and after
constexpr double k_interval = 0.1;  ///< its lower end over the largest eigenvalue
constexpr double k_margin = 1.1;    ///< the largest eigenvalue over its estimate
constexpr int k_lanczos_steps = 10;
constexpr double k_slow = 0.7;  ///< rows left by a coarsening that is not worth a level
// A coarsest level that is too large to be factorised is relaxed: 40 steps over eigenvalues from 1/400 of the
// largest leave 4 % of an error, as does a V-cycle.
constexpr int k_long_sweeps = 40;
constexpr double k_long_interval = 1.0 / 400;
constexpr int k_most_levels = 20;

/// The largest eigenvalue of a symmetric tridiagonal matrix, by bisection on Sturm's sequence.
double largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  // Gershgorin's circles bound the eigenvalues from above, the largest diagonal entry from below.
  double low = -1e300, high = -1e300;
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    const double radius =
        (i > 0 ? std::abs(beside[i - 1]) : 0.0) + (i < beside.size() ? std::abs(beside[i]) : 0.0);
    low = std::max(low, diagonal[i]);
    high = std::max(high, diagonal[i] + radius);
  }
  // All eigenvalues are below x if and only if the pivots of T − x I are all negative.
  const auto above_all = [&](double x) {
    double d = 1;
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
      d = diagonal[i] - x - (i > 0 ? beside[i - 1] * beside[i - 1] / d : 0.0);
      if (d >= 0) return false;
    }
    return true;
  };
  // Forty halvings reach single precision from any start.
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (above_all(middle) ? high : low) = middle;
  }
  return high;
}

/// Between −1 and 1, the same for a degree of freedom whatever process owns it.
float scattered(GlobalIndex number) {
  const double golden = static_cast<double>(number + 1) / std::numbers::phi;
  return static_cast<float>(2 * (golden - std::floor(golden)) - 1);
}

}  // namespace

struct Multigrid::Level {
  PackedRows matrix, interpolation;  ///< the latter to the next level
  int size = 1;
  Numbering numbering;
  std::optional<parallel::GhostExchange> ghosts;
  std::optional<parallel::RowExchange> rows;
  std::vector<float> inverse_diagonal;
  double largest = 1;          ///< eigenvalue of D⁻¹ A
  std::vector<float> x, b, r;  ///< [local row × size]
  std::vector<float> d;        ///< [owned row × size]

  std::size_t n_owned() const { return as_size(numbering.n_owned) * as_size(size); }
  void estimate_largest();
  /// @param sweeps, interval  of Chebyshev's iteration
  void smooth(bool from_zero, int sweeps = k_sweeps, double interval = k_interval);
  /// r = b − A x on owned rows.
  void residual();
  std::size_t bytes() const {
    return matrix.bytes() + interpolation.bytes() +
           (inverse_diagonal.capacity() + x.capacity() + b.capacity() + r.capacity() + d.capacity()) *
               sizeof(float);
  }
};

/// Lanczos' method on D^{-1/2} A D^{-1/2}.
void Multigrid::Level::estimate_largest() {
  const std::size_t n = n_owned();
  std::vector<float> root(n), v(n), before(n, 0.0F);
  const auto norm = [&](const std::vector<float>& a) {
    double sum = 0;
    for (const float value : a) sum += static_cast<double>(value) * static_cast<double>(value);
    return std::sqrt(parallel::global_sum(sum));
  };
  const auto scale = [](std::vector<float>& a, double factor) {
    for (float& value : a) value *= static_cast<float>(factor);
  };
  // The start is a fixed scattered vector, so that every run is the same.
  for (std::size_t i = 0; i < n; ++i) {
    root[i] = std::sqrt(std::abs(inverse_diagonal[i]));
    v[i] = scattered(numbering.first * size + static_cast<GlobalIndex>(i));
  }
  // Lanczos works on vectors of length one.
  const double length = norm(v);
  if (!(length > 0)) return;
  scale(v, 1 / length);
  std::vector<double> diagonal, beside;
  // Each step adds a row to the tridiagonal matrix whose largest eigenvalue is asked for.
  for (int k = 0; k < k_lanczos_steps; ++k) {
    for (std::size_t i = 0; i < n; ++i) x[i] = root[i] * v[i];
    ghosts->update(x, size);
    matrix.multiply(x.data(), r.data());
    double along = 0;
    for (std::size_t i = 0; i < n; ++i) {
      r[i] *= root[i];
      along += static_cast<double>(r[i]) * static_cast<double>(v[i]);
    }
    diagonal.push_back(parallel::global_sum(along));
    // The three-term recurrence, with the last two vectors.
    const auto back = static_cast<float>(beside.empty() ? 0.0 : beside.back()),
               here = static_cast<float>(diagonal.back());
    for (std::size_t i = 0; i < n; ++i) {
      const float next = r[i] - here * v[i] - back * before[i];
      before[i] = v[i];
      v[i] = next;
    }
    const double left = norm(v);
    // A vector of length zero ends the sequence: the space is exhausted.
    if (k + 1 == k_lanczos_steps || !(left > 1e-6 * std::abs(diagonal.front()))) break;
    beside.push_back(left);
    scale(v, 1 / left);
  }
  largest = largest_eigenvalue(diagonal, beside);
}

void Multigrid::Level::residual() {
  ghosts->update(x, size);
  matrix.multiply(x.data(), r.data());
  for (std::size_t i = 0; i < n_owned(); ++i) r[i] = b[i] - r[i];
}

void Multigrid::Level::smooth(bool from_zero, int sweeps, double interval) {
  // Chebyshev's iteration with Jacobi's preconditioner on the interval from `low` to `high`: it damps the
  // upper part of the spectrum, and leaves the rest to the coarser level.
  const double high = k_margin * largest, low = interval * largest;
  const double centre = 0.5 * (high + low), radius = 0.5 * (high - low), sigma = centre / radius;
  const std::size_t n = n_owned();
  if (!from_zero) residual();
  const float* const defect = from_zero ? b.data() : r.data();
  const auto first = static_cast<float>(1 / centre);
  for (std::size_t i = 0; i < n; ++i) {
    d[i] = first * inverse_diagonal[i] * defect[i];
    x[i] = from_zero ? d[i] : x[i] + d[i];
  }
  // The three-term recurrence keeps a share of the last step d and adds the new defect.
  double rho = 1 / sigma;
  for (int k = 1; k < sweeps; ++k) {
    residual();
    const double next = 1 / (2 * sigma - rho);
    const auto keep = static_cast<float>(next * rho), gain = static_cast<float>(2 * next / radius);
    for (std::size_t i = 0; i < n; ++i) {
      d[i] = keep * d[i] + gain * inverse_diagonal[i] * r[i];
      x[i] += d[i];
    }
    rho = next;
  }
}

/// The coarsest level, factorised on every process.
struct Multigrid::Coarsest {
  petsc::MatHandle matrix;
  petsc::KspHandle ksp;
  petsc::VecHandle b, x;

  Coarsest(const BlockRows<double>& a, const Numbering& numbering);
  void solve(const std::vector<float>& right, std::vector<float>& solution);
};

Multigrid::Coarsest::Coarsest(const BlockRows<double>& a, const Numbering& numbering) {
  // PETSc wants to know beforehand how many blocks a row has among the columns of this process and among
  // those of others.
  const auto n = static_cast<PetscInt>(a.n_rows() * a.rows);
  std::vector<PetscInt> owned(as_size(a.n_rows()), 0), ghosts(as_size(a.n_rows()), 0);  // [block row], blocks
  for (Index row = 0; row < a.n_rows(); ++row)
    for (std::int64_t s = a.start[as_size(row)]; s < a.start[as_size(row) + 1]; ++s)
      ++(a.column[as_size(s)] < numbering.n_owned ? owned : ghosts)[as_size(row)];
  petsc::check(MatCreate(PETSC_COMM_WORLD, matrix.out()), "MatCreate");
  petsc::check(MatSetSizes(matrix, n, n, PETSC_DETERMINE, PETSC_DETERMINE), "MatSetSizes");
  petsc::check(MatSetType(matrix, MATAIJ), "MatSetType");
  petsc::check(MatXAIJSetPreallocation(matrix, a.rows, owned.data(), ghosts.data(), nullptr, nullptr),
               "MatXAIJSetPreallocation");
  // Blocks are entered by global numbers: owned rows from the first of this process on, ghosts by the list of
  // their owners.
  for (Index row = 0; row < a.n_rows(); ++row)
    for (std::int64_t s = a.start[as_size(row)]; s < a.start[as_size(row) + 1]; ++s) {
      const Index column = a.column[as_size(s)];
      const auto i = static_cast<PetscInt>(numbering.first + row);
      const auto j = static_cast<PetscInt>(column < numbering.n_owned
                                               ? numbering.first + column
                                               : numbering.ghosts[as_size(column - numbering.n_owned)]);
      petsc::check(MatSetValuesBlocked(matrix, 1, &i, 1, &j, a.block(s), INSERT_VALUES),
                   "MatSetValuesBlocked");
    }
  petsc::check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
  petsc::make_scalar_products_reproducible();
  // The coarsest system is solved directly. Each process gathers the whole of it and factorises by itself
  // (PCREDUNDANT), so that no process waits for another one's share.
  petsc::check(KSPCreate(PETSC_COMM_WORLD, ksp.out()), "KSPCreate");
  petsc::check(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
  petsc::check(KSPSetOperators(ksp, matrix, matrix), "KSPSetOperators");
  PC pc = nullptr, inner = nullptr;
  petsc::check(KSPGetPC(ksp, &pc), "KSPGetPC");
  petsc::check(PCSetType(pc, PCREDUNDANT), "PCSetType");
  KSP of_process = nullptr;
  petsc::check(PCRedundantGetKSP(pc, &of_process), "PCRedundantGetKSP");
  petsc::check(KSPGetPC(of_process, &inner), "KSPGetPC");
  // A pivot that rounding makes zero or negative, in a body that nothing holds, is shifted instead of ending
  // the run.
  petsc::check(PCFactorSetShiftType(inner, MAT_SHIFT_INBLOCKS), "PCFactorSetShiftType");
  petsc::check(KSPSetUp(ksp), "KSPSetUp");
  petsc::check(MatCreateVecs(matrix, x.out(), b.out()), "MatCreateVecs");
}

void Multigrid::Coarsest::solve(const std::vector<float>& right, std::vector<float>& solution) {
  PetscInt n = 0;
  petsc::check(VecGetLocalSize(b, &n), "VecGetLocalSize");
  double* to = nullptr;
  petsc::check(VecGetArrayWrite(b, &to), "VecGetArrayWrite");
  std::copy_n(right.begin(), n, to);
  petsc::check(VecRestoreArrayWrite(b, &to), "VecRestoreArrayWrite");
  petsc::check(KSPSolve(ksp, b, x), "KSPSolve");
  const double* from = nullptr;
  petsc::check(VecGetArrayRead(x, &from), "VecGetArrayRead");
  std::transform(from, from + n, solution.begin(), [](double v) { return static_cast<float>(v); });
  petsc::check(VecRestoreArrayRead(x, &from), "VecRestoreArrayRead");
}

Multigrid::Multigrid(bool symmetric, GlobalIndex coarsest)
    : symmetric_(symmetric), coarsest_limit_(coarsest) {}
Multigrid::~Multigrid() = default;

bool Multigrid::supports(int block_size, int modes) {
  const int sizes[] = {11, 22, 23, 33, 36};
  return std::find(std::begin(sizes), std::end(sizes), 10 * block_size + modes) != std::end(sizes);
}

void Multigrid::set_up(const MatrixView& a, Numbering numbering, std::span<const char> fixed,
                       NearNullSpace near_null) {
  levels_.clear();
  coarsest_.reset();
  add_level(a, std::move(numbering), fixed, near_null.modes, std::move(near_null.values));
}

void Multigrid::add_level(const MatrixView& a, Numbering numbering, std::span<const char> fixed, int modes,
                          std::vector<double> near_null) {
  // The level packs its matrix and works on vectors of single precision.
  const std::size_t n_local = as_size(numbering.n_local()) * as_size(a.size),
                    n_owned = as_size(numbering.n_owned) * as_size(a.size);
  parallel::GhostExchange ghosts(numbering.n_owned, numbering.first, numbering.ghosts);
  parallel::RowExchange rows(numbering.n_owned, numbering.first, numbering.ghosts);
  const std::size_t index = levels_.size();
  const Index columns = numbering.n_local();
  // Afterwards only the packed form is needed.
  const auto packed = [&] {
    return PackedRows(a, columns, symmetric_,
                      index == 0 ? PackedRows::Pattern::referred_to  // it stays
                                 : PackedRows::Pattern::copied);
  };
  levels_.push_back({packed(),
                     {},
                     a.size,
                     std::move(numbering),
                     std::move(ghosts),
                     std::move(rows),
                     inverse_diagonal(a),
                     1,
                     std::vector<float>(n_local),
                     std::vector<float>(n_local),
                     std::vector<float>(n_local),
                     std::vector<float>(n_owned)});
  levels_.back().estimate_largest();
  // While the coarser ones are made memory is shortest: it is read again in a fraction of their time.
  levels_.back().matrix = {};
  add_coarser(a, fixed, modes, std::move(near_null));
  levels_[index].matrix = packed();
}

/// The levels below the last one. Where one row is left of nearly each there is none: a level that is too
/// large to be factorised by every process stays the coarsest.
void Multigrid::add_coarser(const MatrixView& a, std::span<const char> fixed, int modes,
                            std::vector<double> near_null) {
  const auto n_rows = [](const Numbering& n) {
    return static_cast<GlobalIndex>(parallel::global_sum(static_cast<double>(n.n_owned)));
  };
  Level& level = levels_.back();
  // The number of rows before and after says whether coarsening has stalled.
  const GlobalIndex before = n_rows(level.numbering);
  Coarsening next = coarsen(a, level.numbering, *level.rows, std::move(near_null), modes, fixed,
                            level.inverse_diagonal, level.largest);
  const GlobalIndex after = n_rows(next.numbering);
  const bool stalls =
      static_cast<double>(after) > k_slow * static_cast<double>(before) || levels_.size() >= k_most_levels;
  if (stalls && after > std::max(coarsest_limit_, k_most_factorised)) {
    coarsest_rows_ = before;
    logging::warn(
        "multigrid: coarsening stalls above {} block rows (many small bodies, or couplings of very unequal "
        "strength); they are smoothed, not factorised, and linear solves may take many iterations",
        k_most_factorised);
    return;
  }
  // Interpolation belongs to the finer level.
  level.interpolation = PackedRows(std::move(next.interpolation), level.numbering.n_owned);
  if (after > coarsest_limit_ && !stalls) {
    const MatrixView view{next.modes, next.matrix.start, next.matrix.column, next.matrix.value.data()};
    add_level(view, std::move(next.numbering), {}, modes, std::move(next.near_null));
    return;
  }
  // The coarsest level is factorised by every process alike.
  coarsest_rows_ = after;
  if (after > 0) coarsest_ = std::make_unique<Coarsest>(next.matrix, next.numbering);
  const std::size_t n = as_size(next.numbering.n_local()) * as_size(next.modes);
  Level last;
  last.size = next.modes;
  last.numbering = std::move(next.numbering);
  last.ghosts.emplace(last.numbering.n_owned, last.numbering.first, last.numbering.ghosts);
  last.rows.emplace(last.numbering.n_owned, last.numbering.first, last.numbering.ghosts);
  last.x.resize(n);
  last.b.resize(n);
  levels_.push_back(std::move(last));
}

void Multigrid::cycle(std::size_t index) {
  Level& level = levels_[index];
  if (index + 1 == levels_.size()) {
    if (coarsest_) return coarsest_->solve(level.b, level.x);
    if (coarsest_rows_ > 0) level.smooth(true, k_long_sweeps, k_long_interval);
    return;
  }
  Level& next = levels_[index + 1];
  // Smoothing, restriction of the residual, the coarser level, interpolation, smoothing again: a
  // V-cycle.
  level.smooth(true);
  level.residual();
  // Rows of this process interpolate from coarse rows of others too.
  std::fill(next.b.begin(), next.b.end(), 0.0F);
  level.interpolation.multiply_transposed_add(level.r.data(), next.b.data());
  next.rows->add_to_owners(next.b, next.size);
  cycle(index + 1);
  next.ghosts->update(next.x, next.size);
  level.interpolation.multiply_add(next.x.data(), level.x.data());
  level.smooth(false);
}

void Multigrid::apply(std::span<const double> r, std::span<double> z) {
  Level& level = levels_.front();
  std::transform(r.begin(), r.end(), level.b.begin(), [](double v) { return static_cast<float>(v); });
  cycle(0);
  std::copy_n(level.x.begin(), z.size(), z.begin());
}

int Multigrid::levels() const {
  return static_cast<int>(levels_.size());
}

std::size_t Multigrid::bytes() const {
  std::size_t total = 0;
  for (const Level& level : levels_) total += level.bytes();
  return total;
}

}  // namespace solidus::multigrid
