/// The line search of the truncated Newton method for the least E along a step.
#include <algorithm>
#include <cmath>

#include "heat/iteration/truncated_newton.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

constexpr double k_accept_rise = 0.5;   ///< the full step is kept if E rises behind it by at most this share
constexpr double k_accept_slope = 0.1;  ///< a shortened step ends where the slope of E is this share
constexpr int k_search_trials = 20;

}  // namespace

/// Takes the nodes to v + α δ from where the search begins.
void TruncatedNewton::move(double alpha) {
  for (std::size_t i = 0; i < work_.r.size(); ++i) {
    if (work_.step[i] == 0) continue;
    const StorageCurve::AtPotential at = curves_.at_potential(
        as_index(i), work_.potential[i] + alpha * work_.step[i], of_step_.temperature[i]);
    of_step_.temperature[i] = at.temperature;
    of_step_.heat[i] = work_.step[i] < 0 ? at.upper : at.lower;
    work_.curve_slope[i] = at.slope;
  }
}

/// Ends the search where move() has taken the nodes.
void TruncatedNewton::take(double alpha) {
  for (std::size_t i = 0; i < work_.r.size(); ++i) {
    if (work_.step[i] == 0) continue;
    if (const auto node = as_index(i); work_.curve_slope[i] > 0)
      work_.potential[i] += alpha * work_.step[i];
    else
      look_up(node);
  }
}

/// The same, and dE/dα there for the A of now.
double TruncatedNewton::linear_slope(double alpha) {
  move(alpha);
  double sum = 0;
  for (std::size_t i = 0; i < work_.r.size(); ++i)
    if (work_.step[i] != 0)
      sum += work_.step[i] *
             (work_.r[i] + (of_step_.heat[i] - work_.from_heat[i]) / of_step_.dt + alpha * work_.product[i]);
  return parallel::global_sum(sum);
}

/// The same for F itself, which is evaluated.
double TruncatedNewton::true_slope(double alpha) {
  move(alpha);
  return true_slope_here();
}

/// dE/dα for F itself where move() has taken the nodes.
double TruncatedNewton::true_slope_here() {
  ghosts_.update(of_step_.temperature, 1);
  evaluate();
  return slope_along_step();
}

double TruncatedNewton::slope_along_step() const {
  double sum = 0;
  for (std::size_t i = 0; i < work_.r.size(); ++i) sum += work_.step[i] * work_.r[i];
  return parallel::global_sum(sum);
}

/// Goes to the least E along δ, to a tenth of its slope at the start; leaves F there.
/// @param least  a shorter step is not taken; nothing has changed then but what the next step writes
/// @return whether the step was taken
bool TruncatedNewton::search(double least) {
  const profile::Part part("line search");
  work_.from_heat.assign(of_step_.heat.begin(),
                         of_step_.heat.begin() + static_cast<std::ptrdiff_t>(work_.r.size()));
  const bool taken = find_length(least);
  std::vector<double>().swap(work_.from_heat);
  return taken;
}

bool TruncatedNewton::find_length(double least) {
  const double start = slope_along_step();
  double alpha = minimise(start, 1.0, &TruncatedNewton::linear_slope);
  if (alpha < least) {
    for (std::size_t i = 0; i < work_.r.size(); ++i) {
      if (work_.step[i] == 0) continue;
      of_step_.heat[i] = work_.from_heat[i];
      of_step_.temperature[i] = look_up(as_index(i));
    }
    return false;
  }
  // A holds the terms that are not linear in v by their derivatives only: the step must be checked with F
  // itself.
  const double slope = true_slope_here();
  if (start < 0 && !(slope <= -k_accept_rise * start))
    alpha = minimise(start, alpha, &TruncatedNewton::true_slope);
  take(alpha);
  return true;
}

/// Returns the length α that it ends with, to which move() has taken the nodes last.
/// @param start   dE/dα at zero
/// @param longest  α that is tried first
double TruncatedNewton::minimise(double start, double longest, double (TruncatedNewton::*slope_at)(double)) {
  double low = 0, low_slope = start, high = longest, high_slope = (this->*slope_at)(longest), alpha = longest;
  if (!(start < 0) || high_slope <= -k_accept_rise * start) return longest;
  int side = 0;
  for (int trial = 0; trial < k_search_trials; ++trial) {
    // The Illinois rule, kept inside the bracket.
    alpha = std::isfinite(high_slope) ? (low * high_slope - high * low_slope) / (high_slope - low_slope)
                                      : 0.5 * (low + high);
    alpha = std::clamp(alpha, low + 0.05 * (high - low), high - 0.05 * (high - low));
    const double slope = (this->*slope_at)(alpha);
    if (std::abs(slope) <= -k_accept_slope * start) break;
    if (slope < 0) {
      low = alpha;
      low_slope = slope;
      if (side == 1) high_slope *= 0.5;
      side = 1;
    } else {
      high = alpha;
      high_slope = slope;
      if (side == -1) low_slope *= 0.5;
      side = -1;
    }
  }
  return alpha;
}

}  // namespace solidus::heat
