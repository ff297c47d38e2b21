/// Anderson's acceleration over shots, with the temperatures of the die as unknowns and its volume as
/// weights.
#include "coupling/shot_map.hpp"

#include <algorithm>
#include <cmath>

#include "heat/storage/nodal_enthalpy.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

namespace {

constexpr double k_worse = 2;  ///< change of a shot over that of the one before: begin again
constexpr double k_independent =
    1e-6;                           ///< what is left of a difference of changes in addition to the newer ones
constexpr double k_farthest = 0.5;  ///< of the range of temperatures, by which a node may be moved

double dot(const std::vector<double>& weight, const std::vector<double>& a, const std::vector<double>& b,
           Index n_owned) {
  double sum = 0;
  for (std::size_t i = 0; i < as_size(n_owned); ++i) sum += weight[i] * a[i] * b[i];
  return parallel::global_sum(sum);
}

}  // namespace

ShotMap::ShotMap(const heat::ThermalPhase& heat, const std::vector<char>& stays, PeriodicOptions options)
    : heat_(heat), options_(options), ghosts_(heat.mesh()), volume_(heat.mesh().x.size(), 0.0) {
  for (Index i = 0; i < heat.mesh().n_owned_nodes; ++i)
    for (std::size_t b = 0; b < stays.size(); ++b)
      if (stays[b] != 0) volume_[as_size(i)] += heat.storage().volume(i, static_cast<int>(b));
  ghosts_.update(volume_, 1);
}

DieTemperature ShotMap::die_temperature(const State& state) const {
  DieTemperature die{0, HUGE_VAL, -HUGE_VAL};
  double sum = 0, volume = 0;
  // Only nodes that stay from shot to shot, by their volume.
  for (std::size_t i = 0; i < as_size(heat_.mesh().n_owned_nodes); ++i) {
    if (!stays(i)) continue;
    const double t = state.heat.temperature[i];
    sum += volume_[i] * t;
    volume += volume_[i];
    die.lowest = std::min(die.lowest, t);
    die.highest = std::max(die.highest, t);
  }
  // Over processes: the mean by volume, and the extremes.
  volume = parallel::global_sum(volume);
  return {parallel::global_sum(sum) / volume, parallel::global_min(die.lowest),
          parallel::global_max(die.highest)};
}

double ShotMap::begin(State& state, ShotHistory& history) const {
  const bool search = options_.tolerance > 0 && options_.accelerate && history.iterates.size() > 1;
  history.heat = {};
  history.heat.corrected = search ? combine(state, history) : 0.0;
  history.start = state.heat.temperature;
  history.at_pour = die_temperature(state);
  return history.heat.corrected;
}

ShotRecord ShotMap::end(const State& state, ShotHistory& history) const {
  // The change of a shot is that of the temperatures of what stays, from its start to its end.
  ShotIterate iterate;
  iterate.change.assign(volume_.size(), 0.0);
  double change = 0;
  for (std::size_t i = 0; i < volume_.size(); ++i) {
    if (!stays(i)) continue;
    iterate.change[i] = state.heat.temperature[i] - history.start[i];
    change = std::max(change, std::abs(iterate.change[i]));
  }
  // If it has become much larger than that of the shot before, the iterates of Anderson's method mislead, and
  // are dropped.
  change = parallel::global_max(change);
  if (change > k_worse * history.change) history.iterates.clear();
  history.change = change;
  ++history.shots;
  // With acceleration the iterate is kept with its heat and displacement, the oldest one beyond the depth is
  // dropped.
  if (options_.tolerance > 0 && options_.accelerate) {
    iterate.heat = state.heat.enthalpy.empty() ? state.heat.temperature : state.heat.enthalpy;
    iterate.displacement = state.mechanics.displacement;
    history.iterates.push_back(std::move(iterate));
    const auto most = as_size(options_.depth) + 1;
    if (history.iterates.size() > most) history.iterates.erase(history.iterates.begin());
  }
  return {state.shot, state.poured, state.time,       history.at_pour, die_temperature(state),
          change,     history.heat, periodic(history)};
}

/// Least squares by Gram and Schmidt, the newest differences first; those that the newer ones span are left
/// out.
std::vector<double> ShotMap::coefficients(const ShotHistory& history) const {
  const Index n_owned = heat_.mesh().n_owned_nodes;
  const std::size_t last = history.iterates.size() - 1;
  // Anderson's acceleration: α with Σ α = 1 minimises the change that the iterates would have
  // together.
  const std::vector<double>& newest = history.iterates[last].change;
  struct Direction {
    std::vector<double> change;  ///< of unit length
    std::vector<double> alpha;   ///< that makes it of the iterates
  };
  std::vector<Direction> directions;
  std::vector<double> alpha(last + 1, 0.0), left = newest;
  alpha[last] = 1;
  // Each difference to the newest iterate is a direction; its α says how it is made of iterates.
  for (std::size_t j = last; j-- > 0;) {
    Direction d{history.iterates[j].change, std::vector<double>(last + 1, 0.0)};
    for (std::size_t i = 0; i < d.change.size(); ++i) d.change[i] -= newest[i];
    d.alpha[j] = 1;
    d.alpha[last] = -1;
    const double length = std::sqrt(dot(volume_, d.change, d.change, n_owned));
    for (const Direction& other : directions) {
      const double along = dot(volume_, d.change, other.change, n_owned);
      for (std::size_t i = 0; i < d.change.size(); ++i) d.change[i] -= along * other.change[i];
      for (std::size_t i = 0; i <= last; ++i) d.alpha[i] -= along * other.alpha[i];
    }
    // A direction that the newer ones span already would only amplify rounding.
    const double rest = std::sqrt(dot(volume_, d.change, d.change, n_owned));
    if (!(rest > k_independent * length)) continue;
    for (double& c : d.change) c /= rest;
    for (double& a : d.alpha) a /= rest;
    // The projection of the change that is left.
    const double along = dot(volume_, left, d.change, n_owned);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= along * d.change[i];
    for (std::size_t i = 0; i <= last; ++i) alpha[i] -= along * d.alpha[i];
    directions.push_back(std::move(d));
  }
  return alpha;
}

/// Moves the state, which is the end of the last shot, toward the combination of the ends.
double ShotMap::combine(State& state, const ShotHistory& history) const {
  const std::vector<double> alpha = coefficients(history);
  const heat::NodalEnthalpy& storage = heat_.storage();
  const bool by_heat = !state.heat.enthalpy.empty();
  const auto n_owned = as_size(heat_.mesh().n_owned_nodes);
  // The combination is taken in enthalpy, where there is one, so that latent heat counts.
  const auto combined = [&](const std::vector<double> ShotIterate::*field, std::size_t i) {
    double sum = 0;
    for (std::size_t j = 0; j < alpha.size(); ++j) sum += alpha[j] * (history.iterates[j].*field)[i];
    return sum;
  };
  const auto temperature_at = [&](std::size_t i, double share) {
    const double now = by_heat ? state.heat.enthalpy[i] : state.heat.temperature[i];
    const double moved = now + share * (combined(&ShotIterate::heat, i) - now);
    return by_heat ? storage.temperature(as_index(i), moved) : moved;
  };
  // The move is as long as no node goes farther than allowed or above the highest temperature of the shot.
  double share = 1;
  const double farthest = k_farthest * (history.highest - history.lowest);
  for (std::size_t i = 0; i < n_owned; ++i) {
    if (!stays(i)) continue;
    const double now = state.heat.temperature[i], moved = temperature_at(i, 1) - now;
    if (std::abs(moved) > farthest) share = std::min(share, farthest / std::abs(moved));
    if (now + moved > history.highest) share = std::min(share, std::max(history.highest - now, 0.0) / moved);
  }
  share = parallel::global_min(share);
  // The heat that the move puts in is reported, since no shot has brought it.
  double put_in = 0;
  for (std::size_t i = 0; i < n_owned; ++i) {
    if (!stays(i)) continue;
    const auto node = as_index(i);
    const double t = temperature_at(i, share);
    const double before = by_heat ? state.heat.enthalpy[i] : storage.upper(node, state.heat.temperature[i]);
    if (by_heat) state.heat.enthalpy[i] += share * (combined(&ShotIterate::heat, i) - before);
    state.heat.temperature[i] = t;
    put_in += (by_heat ? state.heat.enthalpy[i] : storage.upper(node, t)) - before;
  }
  ghosts_.update(state.heat.temperature, 1);
  if (by_heat) ghosts_.update(state.heat.enthalpy, 1);
  // Displacements move along by the same share.
  std::vector<double>& u = state.mechanics.displacement;
  const std::size_t components = u.size() / volume_.size();
  for (std::size_t i = 0; i < u.size(); ++i)
    if (stays(i / components)) u[i] += share * (combined(&ShotIterate::displacement, i) - u[i]);
  return parallel::global_sum(put_in);
}

}  // namespace solidus::coupling
