#include "check/plate_estimate.hpp"

#include <algorithm>

namespace solidus::check {

criteria::PlateTimes plate_times(const FreezingProblem& casting) {
  constexpr double k_from = 1.0 / 8, k_growth = 2;
  constexpr int k_sizes = 7;
  constexpr double k_deep = 20;  // thickness of a mould without end over the modulus of its plate
  criteria::PlateTimes plates;
  double size = k_from;
  for (int i = 0; i < k_sizes; ++i, size *= k_growth) {
    // Metal that is poured with the casting is no neighbour of a plate of its own.
    FreezingProblem plate;
    plate.metal = casting.metal;
    plate.start = casting.start;
    plate.open = casting.open;
    plate.modulus = plate.depth = size * casting.modulus;
    // Behind a skin lies the same thickness of mould, of which a thicker plate has less for its volume. What
    // lies deeper than a thin plate's heat reaches would only make the cells at its skin coarse.
    plate.moulds = casting.moulds;
    for (MouldSide& mould : plate.moulds)
      mould.volume_ratio = std::min(mould.volume_ratio / size, k_deep * mould.share);
    const FreezingEstimate estimate = estimate_freezing(plate);
    if (!estimate.time || (!plates.time.empty() && *estimate.time <= plates.time.back())) continue;
    plates.thickness.push_back(2 * plate.modulus);
    plates.time.push_back(*estimate.time);
  }
  return plates;
}

}  // namespace solidus::check
