/// A divided difference of the flows at the start and in the stages, times the error constant of the
/// method.
#include "heat/loads/time_error.hpp"

#include "material/time_integration.hpp"

namespace solidus::heat {

namespace {

/// With f = z y/Δt the divided difference is γ z³ + O(z⁴), and the step commits (1/6 − (√2 − 1)/2) z³.
constexpr double k_sdirk_error = (0.20710678118654752 - 1.0 / 6.0) / material::k_sdirk_share;

}  // namespace

std::vector<double> time_error(const StageFlows& flows, std::span<const double> before) {
  std::vector<double> error(flows.last.size());
  const double first = flows.share, second = 1 - flows.share;
  // With one stage the error is that of backward Euler, by the rate before; with two it is the difference of
  // both rates.
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double last = flows.last[i];
    if (flows.first.empty()) {
      error[i] = 0.5 * flows.dt * (last - before[i]);
      continue;
    }
    const double rise = flows.first[i] - before[i], next_rise = last - flows.first[i];
    error[i] = flows.second_order ? k_sdirk_error * flows.dt * (next_rise / second - rise / first)
                                  : 0.5 * flows.dt * (first * rise + second * next_rise);
  }
  return error;
}

}  // namespace solidus::heat
