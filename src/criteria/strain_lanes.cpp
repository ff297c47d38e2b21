/// Tensors in columns of a record, loaded and stored in lanes.
#include "criteria/strain_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numbers/index_casts.hpp"

namespace solidus::criteria {

Sym<Lane> load_tensors(const std::vector<double>& column, std::size_t width, std::size_t first, int count,
                       std::size_t at) {
  Sym<Lane> a;
  for (int lane = 0; lane < count; ++lane)
    for (std::size_t i = 0; i < k_tensor; ++i)
      a.c[i].set(lane, column[(first + as_size(lane)) * width + at + i]);
  return a;
}

void store_tensors(const Sym<Lane>& a, std::size_t width, std::size_t first, int count,
                   std::vector<double>& column, std::size_t at) {
  for (int lane = 0; lane < count; ++lane)
    for (std::size_t i = 0; i < k_tensor; ++i)
      column[(first + as_size(lane)) * width + at + i] = a.c[i][lane];
}

Sym<double> tensor_at(const double* numbers) {
  Sym<double> a;
  std::copy_n(numbers, k_tensor, a.c.begin());
  return a;
}

Lane share_within(const Lane& from, const Lane& to, double low, double high) {
  const Lane least = min(from, to), most = max(from, to), path = most - least;
  const Lane inside = max(min(most, Lane(high)) - max(least, Lane(low)), Lane(0.0));
  const Lane resting = select((least >= Lane(low)) & (least < Lane(high)), Lane(1.0), Lane(0.0));
  const LaneMask moves = path > Lane(0.0);
  return select(moves, inside / select(moves, path, Lane(1.0)), resting);
}

double largest_principal(const Sym<double>& e) {
  const double j2 = 0.5 * dot(e, e);
  if (j2 == 0) return 0;
  const double j3 = e[0] * (e[1] * e[2] - e[4] * e[4]) - e[3] * (e[3] * e[2] - e[4] * e[5]) +
                    e[5] * (e[3] * e[4] - e[1] * e[5]);
  const double cosine = std::clamp(1.5 * std::numbers::sqrt3 * j3 / (j2 * std::sqrt(j2)), -1.0, 1.0);
  return 2 * std::sqrt(j2 / 3) * std::cos(std::acos(cosine) / 3);
}

}  // namespace solidus::criteria
