/// Eisenstat and Walker's second choice, with the safeguards that keep a tolerance from falling faster than
/// the residual.
#include "linear/forcing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace solidus::linear {

namespace {

constexpr double k_first = 1e-2;
constexpr double k_gamma = 0.9;
constexpr double k_alpha = std::numbers::phi;  ///< order of convergence
constexpr double k_share_of_goal = 0.1;

}  // namespace

double Forcing::next(double norm, double goal) {
  if (!inexact_) return 0;
  const double eta = norm_ > 0 ? k_gamma * std::pow(norm / norm_, k_alpha) : k_first;
  norm_ = norm;
  return std::min(std::max(eta, k_share_of_goal * goal), loosest_);
}

}  // namespace solidus::linear
