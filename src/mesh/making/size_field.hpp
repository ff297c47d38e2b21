/// Sizes of elements over a box: as small as samples ask near them, larger by a growth for each length away.
#pragma once

#include <array>
#include <vector>

#include "mesh/making/meshing_outlook.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// A triangle of a surface, and the element size that is wanted there.
struct SizeSample {
  std::array<Point, 3> corners;
  double size = 0;
};

/// h(x) = min over samples of (size + growth × distance), on a grid of cells.
class SizeField {
 public:
  /// @param growth  at least 0
  /// @param cells   along the longest side of the box
  SizeField(const Point& low, const Point& high, const std::vector<SizeSample>& samples, double growth,
            int cells = 72);
  /// Very large where there are no samples at all.
  double at(const Point& x) const;

 private:
  std::size_t index(int i, int j, int k) const {
    return (as_size(k) * as_size(n_[1]) + as_size(j)) * as_size(n_[0]) + as_size(i);
  }
  int cell(double x, std::size_t axis) const;
  void spread(double growth);

  Point low_;
  double size_ = 1;
  std::array<int, 3> n_{1, 1, 1};
  std::vector<double> h_;
};

/// The area of a triangle of a skin and the size in its middle, `largest` at most.
SkinPiece skin_piece(const std::array<Point, 3>& triangle, const SizeField& field, double largest);

/// Whether the normal of a triangle, by the order of its corners, looks into the closed body that the
/// triangles bound: a ray along it meets an odd number of them.
bool looks_inward(const std::vector<std::array<Point, 3>>& skin, std::size_t triangle);

/// The thickness of a closed body behind each triangle of its skin: how far a ray goes inward from the
/// triangle's centre until it meets the skin again; 0 where it meets none.
/// @param skin  triangles, outward
/// @param most  of so many triangles, evenly spread, the others 0
std::vector<double> wall_thickness(const std::vector<std::array<Point, 3>>& skin, std::size_t most = 3000);

}  // namespace solidus::mesh
