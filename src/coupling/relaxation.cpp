/// Fixed factors and Aitken's; both return the factor alone and leave the update to the caller.
#include "coupling/relaxation.hpp"

#include <algorithm>

#include "parallel/parallel.hpp"

namespace solidus::coupling {

void Relaxation::begin() {
  first_ = true;
  last_.clear();
}

double Relaxation::factor(std::span<const double> change) {
  using Kind = RelaxationOptions::Kind;
  if (options_.kind == Kind::none) return 1;
  if (options_.kind == Kind::fixed) return options_.factor;

  // Aitken's factor follows from the last two changes: it is that which would have brought the second one to
  // zero.
  double sums[2] = {0, 0};  // r_old · Δr, |Δr|²
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const double difference = change[i] - last_[i];
    sums[0] += last_[i] * difference;
    sums[1] += difference * difference;
  }
  const double along = parallel::global_sum(sums[0]), square = parallel::global_sum(sums[1]);
  // The first change of a step has nothing to compare with: it takes the user's factor.
  if (first_)
    factor_ = options_.factor;
  else if (square > 0)
    factor_ = std::clamp(-factor_ * along / square, k_least, k_largest);
  first_ = false;
  // The change is kept for the next factor.
  last_.assign(change.begin(), change.end());
  return factor_;
}

}  // namespace solidus::coupling
