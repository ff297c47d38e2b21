#include "linear/saddle_matrix.hpp"

#include <algorithm>

namespace solidus::linear {

namespace {

/// Sizes of a border that are known at compile time, or, where they are zero, at run time.
template <int n_components, int n_fields>
struct Sizes {
  int any_components, any_fields;
  constexpr int components() const { return n_components > 0 ? n_components : any_components; }
  constexpr int fields() const { return n_fields > 0 ? n_fields : any_fields; }
};

/// Adds the borders' part of a product to y_u unless p is null, and to y_p unless that is null. Without p it
/// is Bᵀ u alone.
/// @param half  whether the borders above the diagonal also stand for those below
template <class AnySizes>
void add_borders(const BlockMatrix& pattern, const double* border, bool half, AnySizes sizes, const double* u,
                 const double* p, double* y_u, double* y_p) {
  const int dim = sizes.components(), fields = sizes.fields();
  const std::ptrdiff_t of_u = dim, of_p = fields, size = 2 * dim * fields + fields * fields;
  const std::span<const std::int64_t> start = pattern.row_start();
  const Index* const columns = pattern.columns().data();
  const auto n_rows = static_cast<Index>(start.size()) - 1;
  for (Index row = 0; row < n_rows; ++row) {
    const double* e = border + start[static_cast<std::size_t>(row)] * size;
    for (std::int64_t s = start[static_cast<std::size_t>(row)]; s < start[static_cast<std::size_t>(row) + 1];
         ++s, e += size) {
      const Index column = columns[s];
      const bool mirrored = half && column != row && column < n_rows;
      const double *const gradient = e, *const divergence = e + dim * fields,
                          *const compliance = e + 2 * dim * fields;
      for (int f = 0; f < fields; ++f) {
        if (p != nullptr) {
          const double p_column = p[column * of_p + f], p_row = p[row * of_p + f];
          for (int i = 0; i < dim; ++i) {
            y_u[row * of_u + i] += gradient[i * fields + f] * p_column;
            if (mirrored) y_u[column * of_u + i] += divergence[f * dim + i] * p_row;
          }
        }
        if (y_p == nullptr) continue;
        double at_row = 0, at_column = 0;
        for (int i = 0; i < dim; ++i) {
          at_row += divergence[f * dim + i] * u[column * of_u + i];
          at_column += gradient[i * fields + f] * u[row * of_u + i];
        }
        for (int g = 0; p != nullptr && g < fields; ++g) {
          at_row += compliance[f * fields + g] * p[column * of_p + g];
          at_column += compliance[g * fields + f] * p[row * of_p + g];
        }
        y_p[row * of_p + f] += at_row;
        if (mirrored) y_p[column * of_p + f] += at_column;
      }
    }
  }
}

void add_borders_of(const BlockMatrix& pattern, const double* border, int components, int fields,
                    const double* u, const double* p, double* y_u, double* y_p) {
  const bool half = pattern.storage() == BlockMatrix::Storage::upper;
  const auto with = [&](auto sizes) { add_borders(pattern, border, half, sizes, u, p, y_u, y_p); };
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
  const std::size_t size = (displacement_.columns().size() + 1) * static_cast<std::size_t>(border_size());
  const bool other = pattern_ != displacement_.pattern();
  pattern_ = displacement_.pattern();
  border_.assign(size, 0.0);
  return other;
}

void SaddleMatrix::multiply(std::span<const double> u, std::span<const double> p, std::span<double> y_u,
                            std::span<double> y_p) const {
  displacement_.multiply(u, y_u);
  std::fill(y_p.begin(), y_p.end(), 0.0);
  add_borders_of(displacement_, border(0), components(), fields_, u.data(), p.data(), y_u.data(), y_p.data());
}

void SaddleMatrix::multiply_gradient(std::span<const double> p, std::span<double> y_u) const {
  std::fill(y_u.begin(), y_u.end(), 0.0);
  add_borders_of(displacement_, border(0), components(), fields_, nullptr, p.data(), y_u.data(), nullptr);
}

void SaddleMatrix::multiply_divergence(std::span<const double> u, std::span<double> y_p) const {
  std::fill(y_p.begin(), y_p.end(), 0.0);
  add_borders_of(displacement_, border(0), components(), fields_, u.data(), nullptr, nullptr, y_p.data());
}

}  // namespace solidus::linear
