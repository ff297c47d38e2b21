/// Displacement blocks with borders for gradient, divergence and compliance of the pressure; products read
/// every border once.
#include "linear/saddle_matrix.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "numbers/index_casts.hpp"

namespace solidus::linear {

namespace {

/// Sizes of a border that are known at compile time, or, where they are zero, at run time.
template <int n_components, int n_fields>
struct Sizes {
  int any_components, any_fields;
  constexpr int components() const { return n_components > 0 ? n_components : any_components; }
  constexpr int fields() const { return n_fields > 0 ? n_fields : any_fields; }
};

/// The part of the matrix that a product is with.
enum class Part {
  all,         ///< y_u += B p, y_p += Bᵀ u − C p
  gradient,    ///< y_u += B p
  divergence,  ///< y_p += Bᵀ u
};

/// Adds the borders' part of a product. A row's own results are summed on the spot and stored once; those of
/// the mirror images go to memory one by one.
/// @param half  whether the borders above the diagonal are also those below
template <Part part, class AnySizes>
void add_borders(const BlockMatrix& pattern, const double* border, bool half, AnySizes sizes, const double* u,
                 const double* p, double* y_u, double* y_p) {
  constexpr bool of_gradient = part != Part::divergence, of_divergence = part != Part::gradient,
                 of_compliance = part == Part::all;
  constexpr int most_components = 3, most_fields = 8;
  // Sizes known to the compiler make the loops below straight code.
  const int dim = sizes.components(), fields = sizes.fields();
  assert(dim <= most_components && fields <= most_fields);
  const std::ptrdiff_t of_u = dim, of_p = fields, size = 2 * dim * fields + fields * fields;
  const std::span<const std::int64_t> start = pattern.row_start();
  const Index* const columns = pattern.columns().data();
  const auto n_rows = as_index(start.size()) - 1;
  for (Index row = 0; row < n_rows; ++row) {
    const std::int64_t first = start[as_size(row)], end = start[as_size(row) + 1];
    if (first == end) continue;
    // Results of the row are summed here; its own values of u and p are read once.
    double sum_u[most_components] = {}, u_row[most_components] = {};
    double sum_p[most_fields] = {}, p_row[most_fields] = {};
    if constexpr (of_divergence) std::copy_n(u + row * of_u, dim, u_row);
    if constexpr (of_gradient) std::copy_n(p + row * of_p, fields, p_row);
    const double* e = border + first * size;
    for (std::int64_t s = first; s < end; ++s, e += size) {
      const Index column = columns[s];
      const bool mirrored = half && column != row && column < n_rows;
      // A border holds the gradient, the divergence and the compliance of the pressure, one behind
      // the other.
      const double *const gradient = e, *const divergence = e + dim * fields,
                          *const compliance = e + 2 * dim * fields;
      for (int f = 0; f < fields; ++f) {
        if constexpr (of_gradient) {
          const double p_column = p[column * of_p + f];
          for (int i = 0; i < dim; ++i) sum_u[i] += gradient[i * fields + f] * p_column;
          if (mirrored)
            for (int i = 0; i < dim; ++i) y_u[column * of_u + i] += divergence[f * dim + i] * p_row[f];
        }
        if constexpr (of_divergence) {
          double at_row = 0, at_column = 0;
          for (int i = 0; i < dim; ++i) {
            at_row += divergence[f * dim + i] * u[column * of_u + i];
            at_column += gradient[i * fields + f] * u_row[i];
          }
          if constexpr (of_compliance)
            for (int g = 0; g < fields; ++g) {
              at_row += compliance[f * fields + g] * p[column * of_p + g];
              at_column += compliance[g * fields + f] * p_row[g];
            }
          sum_p[f] += at_row;
          if (mirrored) y_p[column * of_p + f] += at_column;
        }
      }
    }
    // One store for each result of the row.
    if constexpr (of_gradient)
      for (int i = 0; i < dim; ++i) y_u[row * of_u + i] += sum_u[i];
    if constexpr (of_divergence)
      for (int f = 0; f < fields; ++f) y_p[row * of_p + f] += sum_p[f];
  }
}

template <Part part>
void add_borders_of(const BlockMatrix& pattern, const double* border, int components, int fields,
                    const double* u, const double* p, double* y_u, double* y_p) {
  const bool half = pattern.storage() == BlockMatrix::Storage::upper;
  const auto with = [&](auto sizes) { add_borders<part>(pattern, border, half, sizes, u, p, y_u, y_p); };
  if (fields == 1 && components == 3)
    with(Sizes<3, 1>{3, 1});
  else if (fields == 1 && components == 2)
    with(Sizes<2, 1>{2, 1});
  else
    with(Sizes<0, 0>{components, fields});
}

}  // namespace

SaddleMatrix::SaddleMatrix(BlockMatrix& displacement, int fields)
    : displacement_(displacement), fields_(fields) {
  set_zero();
}

bool SaddleMatrix::set_zero() {
  const std::size_t size = (displacement_.columns().size() + 1) * as_size(border_size());
  const bool other = pattern_ != displacement_.pattern();
  pattern_ = displacement_.pattern();
  border_.assign(size, 0.0);
  return other;
}

void SaddleMatrix::multiply(std::span<const double> u, std::span<const double> p, std::span<double> y_u,
                            std::span<double> y_p) const {
  displacement_.multiply(u, y_u);
  std::fill(y_p.begin(), y_p.end(), 0.0);
  add_borders_of<Part::all>(displacement_, border(0), components(), fields_, u.data(), p.data(), y_u.data(),
                            y_p.data());
}

void SaddleMatrix::multiply_gradient(std::span<const double> p, std::span<double> y_u) const {
  std::fill(y_u.begin(), y_u.end(), 0.0);
  add_borders_of<Part::gradient>(displacement_, border(0), components(), fields_, nullptr, p.data(),
                                 y_u.data(), nullptr);
}

void SaddleMatrix::multiply_divergence(std::span<const double> u, std::span<double> y_p) const {
  std::fill(y_p.begin(), y_p.end(), 0.0);
  add_borders_of<Part::divergence>(displacement_, border(0), components(), fields_, u.data(), nullptr,
                                   nullptr, y_p.data());
}

}  // namespace solidus::linear
