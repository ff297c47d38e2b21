#include "criteria/plate_times.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::criteria {

double PlateTimes::thickness_of(double seconds) const {
  if (time.size() < 2 || !(seconds > 0)) return 0;
  // The exponent of t = C D^n goes from one, where the interface governs, to two, where mould or metal do;
  // between two plates of the table it is as good as constant.
  const auto above = std::ranges::upper_bound(time, seconds);
  const auto right = as_size(
      std::clamp<std::ptrdiff_t>(above - time.begin(), 1, static_cast<std::ptrdiff_t>(time.size()) - 1));
  const std::size_t left = right - 1;
  const double exponent = std::log(thickness[right] / thickness[left]) / std::log(time[right] / time[left]);
  return thickness[left] * std::pow(seconds / time[left], exponent);
}

}  // namespace solidus::criteria
