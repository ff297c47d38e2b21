/// Two balances of the interface: with the slip held, which Newton's method solves from the isentropic
/// temperature, and with slip and temperature together (5.40), where the slip is found for each trial
/// temperature.
#include "contact/interface/interface_thermodynamics.hpp"

#include <cmath>
#include <limits>

namespace solidus::contact {
namespace {

/// Rounding error of a sum, in parts of its largest terms.
constexpr double k_rounding = 8 * std::numeric_limits<double>::epsilon();
constexpr int k_max_iterations = 200;
/// A relative correction after which Newton's method on a smooth function has reached rounding.
constexpr double k_last_correction = 1e-8;
constexpr int k_doublings = 60;

double sum(const std::array<double, 2>& a) {
  return a[0] + a[1];
}
double supply(const InterfaceSides& s) {  ///< Σ h_i Θ_i
  return s.conductance[0] * s.temperature[0] + s.conductance[1] * s.temperature[1];
}

/// Nothing conducts and nothing stores.
bool isolated(double heat_capacity, const InterfaceSides& sides) {
  return heat_capacity == 0 && sum(sides.conductance) == 0;
}

/// Heat shared by InterfaceSides::slave_share.
InterfaceResponse shared_heat(const InterfaceStep& step, const InterfaceSides& sides) {
  auto r = interface_response(sides, resting_temperature(sides), std::numeric_limits<double>::infinity());
  r.by_side = {sides.slave_share, 1 - sides.slave_share};
  const double heat = step.dissipation - step.temperature * step.structural_entropy;
  for (std::size_t i = 0; i < 2; ++i) r.flux[i] = -r.by_side[i] * heat / step.time_step;
  return r;
}

/// Derivatives of the slip, and with it of dissipation and entropy, with respect to trial traction and
/// pressure at Θ_c = `theta`.
void add_slopes(const FrictionLaw& law, const FrictionInput& in, double theta, double rate,
                InterfaceReturn& r) {
  const FrictionResponse& f = r.friction;
  if (f.sticks) return;
  const double spring = law.tangential_penalty(in);
  const double slip_trial = (1 - f.trial_slope) / spring, slip_pressure = -f.pressure_slope / spring;
  if (!law.stores()) {  // D = γ ‖T‖
    const double by_slip = in.trial - 2 * spring * f.slip;
    r.source_by_trial = rate * (by_slip * slip_trial + f.slip);
    r.source_by_pressure = rate * by_slip * slip_pressure;
    return;
  }
  // D = γ μ_0(Θ_c) t_N; the entropy −K_Θ along the lines of the tables at Θ_n, ζ = ζ_n + γ t_N.
  const double initial = law.coefficient().point(0, theta).initial;
  const double by_work = initial + theta * law.coefficient().point(f.internal_variable, in.temperature).theta;
  r.source_by_trial = rate * by_work * in.pressure * slip_trial;
  r.source_by_pressure = rate * by_work * (f.slip + in.pressure * slip_pressure);
}

}  // namespace

InterfaceResponse interface_response(const InterfaceSides& sides, double temperature, double stiffness) {
  InterfaceResponse r;
  r.temperature = temperature;
  r.stiffness = stiffness;
  const auto& h = sides.conductance;
  // Fluxes from both sides and their slopes: a side changes the temperature of the interface by its
  // conductance over the stiffness of the balance.
  for (std::size_t i = 0; i < 2; ++i) {
    r.flux[i] = h[i] * (sides.temperature[i] - temperature);
    r.by_side[i] = h[i] / stiffness;
  }
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) r.flux_slope[i][j] = h[i] * ((i == j ? 1 : 0) - r.by_side[j]);
  return r;
}

double interface_entropy(const FrictionLaw& law, double temperature, double internal_variable) {
  const double thermal = interface_entropy(law.heat_capacity(), temperature);
  return law.stores() ? thermal - law.coefficient().point(internal_variable, temperature).stored_theta
                      : thermal;
}

double interface_entropy(double heat_capacity, double temperature) {
  return heat_capacity * std::log(temperature / k_interface_reference);
}
double interface_energy(double heat_capacity, double temperature) {
  return heat_capacity * (temperature - k_interface_reference);
}

double interface_energy(const FrictionLaw& law, double temperature, double internal_variable) {
  const double thermal = interface_energy(law.heat_capacity(), temperature);
  if (!law.stores()) return thermal;
  const auto at = law.coefficient().point(internal_variable, temperature);
  return thermal + at.stored - temperature * at.stored_theta;
}

double plastic_entropy_increment(const FrictionLaw& law, double slip, double pressure, double temperature) {
  return -slip * pressure * law.coefficient().point(0, temperature).initial_theta;
}

double resting_temperature(const InterfaceSides& sides) {
  const double h = sum(sides.conductance);
  return h > 0 ? supply(sides) / h : std::lerp(sides.temperature[1], sides.temperature[0], sides.slave_share);
}

InterfaceResponse interface_balance(const InterfaceStep& step, const InterfaceSides& sides) {
  if (isolated(step.heat_capacity, sides)) return shared_heat(step, sides);
  // The balance of the interface (5.33, 5.34, 5.42), divided by the time step.
  const double rate = 1 / step.time_step, conductance = sum(sides.conductance);
  const double heat = supply(sides) + step.dissipation * rate;
  // Without capacity the balance is linear in Θ_c, with the structural entropy as an additional
  // conductance.
  if (step.heat_capacity == 0) {
    const double stiffness = step.structural_entropy * rate + conductance;
    auto r = interface_response(sides, heat / stiffness, stiffness);
    r.balanced = stiffness > 0;
    return r;
  }
  // From S^e_c = S^e_c,n on the balance rises and is convex: the first iterate at or beyond the root, if not
  // the start, and all that follow come down to it.
  const double capacity = step.heat_capacity * rate;
  const double start = step.temperature * std::exp(-step.structural_entropy / step.heat_capacity);
  const auto slope = [&](double theta) { return capacity * (std::log(theta / start) + 1) + conductance; };
  double theta = start;
  for (int i = 0; i < k_max_iterations; ++i) {
    const double value = theta * (capacity * std::log(theta / start) + conductance) - heat;
    const double change = value / slope(theta);
    theta -= change;
    if (std::abs(change) <= k_last_correction * theta) break;
  }
  return interface_response(sides, theta, slope(theta));
}

namespace {

/// The balance of an interface whose slip follows its temperature: γ(Θ) from Φ_c = 0 at the temperature Θ
/// (5.41), then the balance in Θ alone (5.42); dγ/dΘ = −t_N μ_Θ/Φ_γ.
class SlipBalance {
 public:
  SlipBalance(const FrictionLaw& law, const FrictionInput& in, double time_step, const InterfaceSides& sides,
              const InterfaceStage& from)
      : law_(law),
        in_(in),
        rate_(1 / time_step),
        conductance_(sum(sides.conductance)),
        source_(supply(sides)),
        capacity_(law.heat_capacity() / from.time_step),
        start_(from.temperature) {
    if (law.stores()) stored_ = law.coefficient().point(in.internal_variable, in.temperature).stored_theta;
  }
  /// The slip of a temperature and what is left of the balance, positive above the solution [W/m²].
  double left_at(double theta);
  /// From the trial state on; nothing where there is no temperature of balance.
  std::optional<double> solve(double theta);
  const FrictionResponse& friction() const { return friction_; }
  /// The derivative of the balance by Θ, at γ(Θ) of the last left_at().
  double slope() const { return slope_; }

 private:
  const FrictionLaw& law_;
  const FrictionInput& in_;
  double rate_, conductance_, source_, capacity_;
  double start_;  ///< Θ that the interface stores from
  /// K_Θ at the start, from which the structural entropy of hardening is counted.
  double stored_ = 0;
  FrictionResponse friction_;
  double slope_ = 0;
};

double SlipBalance::left_at(double theta) {
  // First the slip at this temperature is found with its traction on the cone (5.41).
  friction_ =
      law_.update({in_.trial, in_.pressure, in_.internal_variable, theta, /*iterate=*/{}, in_.stiffening});
  FrictionResponse& f = friction_;
  double entropy = 0, entropy_slip = 0, heat_theta = 0, slip_theta = 0, heat_slip = 0;
  // A point that slips changes its slip with temperature, and by it entropy and heat; one that
  // sticks does not.
  if (!f.sticks) {
    const auto now = law_.coefficient().point(f.internal_variable, theta);
    slip_theta = -in_.pressure * (now.theta + now.initial_theta) / f.stiffness;
    // A law that stores energy of hardening splits the work into what is stored and what is heat;
    // without storage all of T γ is heat.
    if (law_.stores()) {
      const auto along = law_.coefficient().point(f.internal_variable, in_.temperature);
      entropy = stored_ - along.stored_theta;
      entropy_slip = -along.theta * in_.pressure;
      heat_theta = f.slip * now.initial_theta * in_.pressure;
      heat_slip = now.initial * in_.pressure;
    } else {
      heat_slip = in_.trial - 2 * law_.tangential_penalty(in_) * f.slip;
    }
  }
  f.structural_entropy = entropy;
  const double gained = capacity_ * std::log(theta / start_) + entropy * rate_;
  // At last the balance of heat is returned, and its derivative by Θ along γ(Θ) is stored.
  slope_ = gained + capacity_ + conductance_ - heat_theta * rate_ +
           (theta * entropy_slip - heat_slip) * slip_theta * rate_;
  return theta * (gained + conductance_) - source_ - f.dissipation * rate_;
}

std::optional<double> SlipBalance::solve(double theta) {
  // The balance rises with temperature: an upper bound by doubling, then Newton's method, with bisection
  // whenever it leaves the bounds or gains too little.
  double low = 0, high = theta, value = left_at(theta);
  for (int i = 0; value < 0 && i < k_doublings; ++i) {
    low = high;
    high *= 2;
    value = left_at(high);
  }
  if (value < 0) {
    return std::nullopt;
  }
  double step = high, older_step = high;
  value = left_at(theta);
  for (int i = 0; i < k_max_iterations; ++i) {
    double next = theta - value / slope_;
    if (std::abs(next - theta) <= k_rounding * theta || high - low <= k_rounding * high) break;
    if (!(next > low && next < high) || std::abs(next - theta) > 0.5 * older_step) next = 0.5 * (low + high);
    older_step = step;
    step = std::abs(next - theta);
    theta = next;
    value = left_at(theta);
    (value > 0 ? high : low) = theta;
  }
  return theta;
}

}  // namespace

InterfaceReturn interface_return_mapping(const FrictionLaw& law, const FrictionInput& in, double time_step,
                                         const InterfaceSides& sides,
                                         const std::optional<InterfaceStage>& stage) {
  // A stage of a Runge-Kutta step stores over its own length, while slip makes its heat over the
  // whole step.
  const double rate = 1 / time_step;
  const InterfaceStage from = stage.value_or(InterfaceStage{time_step, in.temperature});
  const InterfaceStep still{from.time_step, law.heat_capacity(), from.temperature, 0, 0};
  const auto& coefficient = law.coefficient();
  InterfaceReturn r;
  // Without capacity and without exchange there is nothing to balance: its heat is that of friction at the
  // temperature that it has.
  if (isolated(law.heat_capacity(), sides)) {
    r.friction = law.update(in);
    r.heat = shared_heat(
        {time_step, 0, in.temperature, r.friction.structural_entropy, r.friction.dissipation}, sides);
    add_slopes(law, in, in.temperature, rate, r);
    return r;
  }

  SlipBalance balance(law, in, time_step, sides, from);
  const std::optional<double> found =
      balance.solve(interface_balance(still, sides).temperature);  // from (5.33)
  r.friction = balance.friction();
  if (!found) {
    r.heat.balanced = false;
    return r;
  }
  const double theta = *found;
  // At the solution: fluxes and their slopes, and the traction by temperature.
  r.heat = interface_response(sides, theta, balance.slope());
  if (!r.friction.sticks) {
    const auto now = coefficient.point(r.friction.internal_variable, theta);
    r.traction_by_temperature =
        law.tangential_penalty(in) * in.pressure * (now.theta + now.initial_theta) / r.friction.stiffness;
  }
  add_slopes(law, in, theta, rate, r);
  return r;
}

}  // namespace solidus::contact
