#include "heat/iteration/heat_contributions.hpp"

#include <algorithm>
#include <cmath>

#include "heat/loads/temperature_range.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

HeatContributions::HeatContributions(std::vector<linear::Contribution*> contributions, Index n_owned)
    : contributions_(std::move(contributions)) {
  // Contributions that bring heat of their own make bounds of temperature impossible; those that only store
  // do not.
  heat_ = std::ranges::any_of(contributions_, [](const linear::Contribution* c) { return !c->stores(); });
  if (!contributions_.empty()) contributed_.resize(as_size(n_owned));
  powers_.resize(contributions_.size());
}

void HeatContributions::add_residual(std::span<const double> temperature, bool exchanges, std::span<double> r,
                                     double& moved) {
  stored_.clear();
  for (std::size_t c = 0; c < contributions_.size(); ++c) {
    powers_[c] = 0;
    if (!exchanges && !contributions_[c]->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contributions_[c]->add_residual(temperature, contributed_);
    if (contributions_[c]->stores()) {
      stored_.resize(r.size(), 0.0);
      for (std::size_t i = 0; i < r.size(); ++i) stored_[i] += contributed_[i];
    }
    for (std::size_t i = 0; i < r.size(); ++i) {
      r[i] += contributed_[i];
      powers_[c] -= contributed_[i];
      moved += std::abs(contributed_[i]);
    }
  }
}

void HeatContributions::add_tangent(std::span<const double> temperature, bool exchanges,
                                    linear::BlockMatrix& matrix) const {
  for (linear::Contribution* contribution : contributions_)
    if (exchanges || contribution->stores()) contribution->add_tangent(temperature, matrix);
}

std::vector<double> HeatContributions::powers() const {
  std::vector<double> all;
  for (double power : powers_) all.push_back(parallel::global_sum(power));
  return all;
}

void HeatContributions::add_supply(std::span<const double> temperature, std::span<double> gain,
                                   std::span<double> loss) {
  // A contribution whose sum over all nodes is not zero brings heat of its own instead of passing it on.
  heat_ = false;  // all are looked at
  for (linear::Contribution* contribution : contributions_) {
    if (contribution->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contribution->add_residual(temperature, contributed_);
    double net = 0, magnitude = 0;
    for (std::size_t i = 0; i < gain.size(); ++i) {
      (contributed_[i] < 0 ? gain : loss)[i] += std::abs(contributed_[i]);
      net += contributed_[i];
      magnitude += std::abs(contributed_[i]);
    }
    constexpr double k_passed_on = 1e-9;  // net heat over the heat exchanged
    if (std::abs(parallel::global_sum(net)) > k_passed_on * parallel::global_sum(magnitude)) heat_ = true;
  }
}

TemperatureRange HeatContributions::range(std::span<const double> temperature) {
  TemperatureRange range;
  // Contributions that only exchange heat can lead no farther than the temperatures of the nodes that they
  // touch.
  for (linear::Contribution* contribution : contributions_) {
    if (contribution->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contribution->add_residual(temperature, contributed_);
    for (std::size_t i = 0; i < contributed_.size(); ++i)
      if (contributed_[i] != 0) range = united(range, {temperature[i], temperature[i]});
  }
  return over_processes(range);
}

void HeatContributions::limit_exchange(std::span<const char> nodes) const {
  for (linear::Contribution* contribution : contributions_) contribution->limit_exchange(nodes);
}

}  // namespace solidus::heat
