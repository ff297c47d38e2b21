/// The return mapping is one scalar equation in the slip γ. It is solved by Newton's method inside a
/// bracket; the three entry points differ in what follows from the slip: nothing (held temperature), the
/// temperature by entropy, or heat.
#include "contact/interface/friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace solidus::contact {
namespace {

/// Rounding error of a sum, in parts of its largest terms.
constexpr double k_rounding = 8 * std::numeric_limits<double>::epsilon();
/// Bisection alone needs 53, and a step is halved every other time.
constexpr int k_max_iterations = 200;
/// Largest ratio of the temperatures after and before the isentropic phase: far beyond the validity of the
/// lines of tables.
constexpr double k_largest_ratio = 2;
/// The range of ζ_c is cut into up to 2^k parts to prove that the solution is the only one.
constexpr int k_halvings = 8;

}  // namespace

const char* reason(FrictionStatus status) {
  // Each text says what happened and which of the user's inputs changes it.
  switch (status) {
    case FrictionStatus::coefficient_vanishes:
      return "the coefficient of friction falls to zero within the step: the internal variable has left the "
             "range that its data are good for (check internal_variable_unit), or the step is too long";
    case FrictionStatus::temperature_runs_off:
      return "friction at fixed entropy changes the temperature of the interface by a factor of two: its "
             "heat "
             "capacity is too small for a hardening that depends on temperature, or the step is too long";
    case FrictionStatus::not_unique:
      return "friction changes so fast with slip that the step has no unique solution: a larger tangential "
             "penalty (softening) or a shorter step (hardening) is needed";
    case FrictionStatus::not_converged:
      return "the return mapping of friction did not converge";
    case FrictionStatus::converged:
      break;
  }
  return "friction has converged";
}

FrictionLaw::FrictionLaw(const FrictionParameters& spec, double tangential_penalty, double heat_capacity)
    : coefficient_(spec.coefficient),
      kind_(spec.internal_variable),
      penalty_(tangential_penalty),
      heat_capacity_(heat_capacity) {
  if (!(penalty_ > 0))
    throw InputError(spec.where, "the tangential penalty is not positive", "a penalty above zero");
  if (!(heat_capacity_ >= 0))
    throw InputError(spec.where, "the heat capacity of the interface is negative", "a heat capacity >= 0");
  entropy_changes_ = stores() && coefficient_.hardening_depends_on_temperature();
}

/// Φ > 0 and μ > 0 at `low`; Φ < 0 or μ <= 0 at `high`: what is found between is the end of slip, or the slip
/// at which the coefficient vanishes.
template <class Radius>
FrictionLaw::Slip FrictionLaw::find_slip(const FrictionInput& in, Radius radius, double first) const {
  const double penalty = tangential_penalty(in);
  // Slip ends at the latest where the trial traction is used up: γ = ‖T^trial‖/ε_T.
  double low = 0, high = in.trial / penalty, step = high, older_step = high;
  bool vanishes = false;
  Slip s{FrictionStatus::not_converged, first, {}, {}};
  for (int i = 0; i < k_max_iterations; ++i) {
    s.at = growth(in, s.gamma);
    s.mu = radius(s.at.zeta);
    // Φ_c = ‖T^trial‖ − ε_T γ − μ(ζ) t_N, the yield function of friction after slip γ.
    const double value = in.trial - penalty * s.gamma - s.mu.value * in.pressure;
    // Rounding is measured against the terms that Φ_c is the difference of, not against Φ_c.
    const double reach = s.at.zeta + s.at.trial * in.trial;  // what ζ is made of
    const double terms = in.trial + in.pressure * (std::abs(s.mu.value) + std::abs(s.mu.zeta) * reach);
    if (s.mu.value > 0 && std::isfinite(value) && std::abs(value) <= k_rounding * terms) {
      s.status = FrictionStatus::converged;
      return s;
    }
    // Φ_c > 0 with a coefficient above zero says that more slip is needed; anything else that there
    // is too much.
    if (value > 0 && s.mu.value > 0) {
      low = s.gamma;
    } else {
      high = s.gamma;
      vanishes = !(s.mu.value > 0);
    }
    // A bracket without width is the root, unless its upper end is where the coefficient falls to
    // zero.
    if (high - low <= std::numeric_limits<double>::epsilon() * high) {
      s.status = vanishes ? FrictionStatus::coefficient_vanishes : FrictionStatus::converged;
      return s;
    }
    // Newton's method, unless it leaves the bracket or does not halve its step in two iterations.
    double next = s.gamma + value / (penalty + s.mu.zeta * in.pressure * s.at.gamma);
    if (!(next > low && next < high) || std::abs(next - s.gamma) > 0.5 * older_step)
      next = 0.5 * (low + high);
    older_step = step;
    step = std::abs(next - s.gamma);
    s.gamma = next;
  }
  return s;
}

template <class Radius>
FrictionResponse FrictionLaw::solve(const FrictionInput& in, Radius radius) const {
  // The trial state: the point sticks, and its internal variable and temperature are those it is
  // held at.
  FrictionResponse r;
  r.traction = in.trial;
  r.internal_variable = in.internal_variable;
  r.temperature = in.held().temperature;
  r.coefficient = radius(in.internal_variable).value;
  if (!(r.coefficient > 0)) {
    r.status = FrictionStatus::coefficient_vanishes;
    return r;
  }
  // Inside the cone (or on it) the trial state is the solution.
  const double overstress = in.trial - r.coefficient * in.pressure;
  if (overstress <= 0) return r;
  const double penalty = tangential_penalty(in);

  const Slip s = find_slip(in, radius, overstress / penalty);
  // Beyond it slip is found; the slopes follow from dΦ_c = 0 there.
  const double hardening = s.mu.zeta * in.pressure;
  r.status = s.status;
  r.sticks = false;
  r.slip = s.gamma;
  r.internal_variable = s.at.zeta;
  r.stiffness = penalty + hardening * s.at.gamma;
  // ‖T‖ from the side that rounding of γ changes less.
  r.traction = hardening * s.at.gamma > penalty ? in.trial - penalty * s.gamma : s.mu.value * in.pressure;
  r.coefficient = in.pressure > 0 ? r.traction / in.pressure : s.mu.value;
  r.trial_slope = hardening * (s.at.gamma + penalty * s.at.trial) / r.stiffness;
  r.pressure_slope = penalty * (s.mu.value + hardening * s.at.pressure) / r.stiffness;
  return r;
}

/// The solution is found on a path that begins at γ = 0 when Φ falls all along it. That needs, for every ζ on
/// the way, ε_T + t_N ∂μ/∂ζ dζ/dγ > 0; of frictional work dζ/dγ = μ t_N/(1 − γ t_N ∂μ/∂ζ).
bool FrictionLaw::unique(const FrictionInput& in, const FrictionResponse& r) const {
  if (coefficient_.constant() || in.pressure == 0) return true;
  return unique_between(in, r, in.internal_variable, r.internal_variable, k_halvings);
}

bool FrictionLaw::unique_between(const FrictionInput& in, const FrictionResponse& r, double from, double to,
                                 int halvings) const {
  const double held = in.held().temperature;
  // Bounds on the slope of the coefficient over the range of slip, at both temperatures that the return
  // mapping may have.
  auto slope = coefficient_.slopes(from, to, held);
  if (r.temperature != held) {
    const auto other = coefficient_.slopes(from, to, r.temperature);
    slope = {std::min(slope.low, other.low), std::max(slope.high, other.high)};
  }
  const double p = in.pressure;
  // The residual is strictly monotonic if the tangential penalty outweighs the softening; where the bounds
  // are too coarse to show it, each half is asked for itself.
  double growth = 1;  // the largest dζ/dγ
  if (kind_ == InternalVariable::normal_work) growth = p;
  if (kind_ == InternalVariable::frictional_work)
    growth = p * (coefficient_.value(from, held).value + std::max(0.0, slope.high) * (to - from));
  const bool follows = kind_ != InternalVariable::frictional_work || r.slip * p * slope.high < 1;
  if (follows && tangential_penalty(in) + std::min(0.0, slope.low) * p * growth > 0) return true;
  if (halvings == 0) return false;
  const double middle = 0.5 * (from + to);
  return unique_between(in, r, from, middle, halvings - 1) && unique_between(in, r, middle, to, halvings - 1);
}

/// Adds to the response the dissipation by slip and its contribution to the entropy.
FrictionResponse FrictionLaw::with_heat(const FrictionInput& in, FrictionResponse r) const {
  if (r.sticks) return r;
  if (r.status == FrictionStatus::converged && !unique(in, r)) r.status = FrictionStatus::not_unique;
  const double mu = stores() ? coefficient_.value(0, in.held().temperature).value : r.coefficient;
  r.dissipation = r.slip * mu * in.pressure;
  if (entropy_changes_)
    r.structural_entropy = coefficient_.point(in.internal_variable, in.temperature).stored_theta -
                           coefficient_.point(r.internal_variable, in.temperature).stored_theta;
  return r;
}

FrictionResponse FrictionLaw::update(const FrictionInput& in) const {
  const double held = in.held().temperature;
  return with_heat(in, solve(in, [&](double zeta) { return coefficient_.value(zeta, held); }));
}

FrictionResponse FrictionLaw::isentropic(const FrictionInput& in) const {
  if (!entropy_changes_ || heat_capacity_ == 0) return update(in);
  const FrictionInput::Iterate held = in.held();
  // Where nothing depends on temperature, or no capacity keeps an entropy, the phase at fixed
  // entropy is the plain one.
  const double start = coefficient_.point(held.internal_variable, held.temperature).stored_theta;
  // C_co ln(Θ/Θ_n) = K_Θ(ζ) − K_Θ(ζ_n): 5.24, second row, with 3.42c; with an iterate from that one.
  const auto temperature = [&](double stored_theta) {
    return held.temperature * std::exp((stored_theta - start) / heat_capacity_);
  };
  auto r = solve(in, [&](double zeta) {
    const auto at = coefficient_.point(zeta, held.temperature);
    const double theta = temperature(at.stored_theta), change = theta - held.temperature;
    // dΘ/dζ = Θ K_Θζ/C_co and K_Θζ = ∂(μ − μ_0)/∂Θ: at fixed entropy slip always hardens more.
    return FrictionCoefficient::Value{
        at.value + at.theta * change,
        at.zeta + at.zeta_theta * change + at.theta * at.theta * theta / heat_capacity_};
  });
  r.temperature = temperature(coefficient_.point(r.internal_variable, held.temperature).stored_theta);
  // A factor of two in one step is beyond what the linearisation by Θ is good for: the step is
  // rejected.
  const double ratio = r.temperature / held.temperature;
  if (r.status == FrictionStatus::converged && !(ratio < k_largest_ratio && ratio * k_largest_ratio > 1))
    r.status = FrictionStatus::temperature_runs_off;
  return with_heat(in, r);
}

}  // namespace solidus::contact
