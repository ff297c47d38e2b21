/// Heat of a contact pair: temperatures of the interface, what a thermal phase has passed, and the parts of
/// the coupled tangent.
#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/fixed_kinematics.hpp"
#include "contact/heat_term.hpp"
#include "contact/mechanics_term.hpp"
#include "contact/pair.hpp"
#include "contact/sliding_kinematics.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void ContactPair::predict_heat() {
  if (!has_temperature()) return;
  std::vector<HeatPoint> heat = heat_->points();
  predicted_.clear();
  for (HeatPoint& point : heat) {
    predicted_.push_back({point.step.dissipation, point.step.structural_entropy});
    point.step.dissipation *= 2;
    point.step.structural_entropy *= 2;
  }
  heat_->place(std::move(heat));
}

void ContactPair::begin_heat(double dt, bool adiabatic) {
  if (has_temperature()) heat_->begin_phase({dt, adiabatic});
}

/// Sets the temperature of interface points that have none yet to that at rest between the two sides at t_n,
/// whatever the other iterates of the step; where no heat passes Θ_c has no balance and is the sides' mean
/// in every step. A point without a partner at t_n counts no slip in the step in which it finds one, so
/// friction does not need its temperature.
void ContactPair::find_interface_temperatures(std::span<const double> temperature) {
  const bool balances = has_temperature();
  const double of_slave = heat_law_ ? heat_law_->slave_share() : 0.5;
  const auto known = [&](const PointState& from) { return balances && from.temperature > 0; };
  if (std::ranges::all_of(step_.from, known)) return;
  configuration_->place(step_.begun, step_.displacement);
  const std::optional<double> tool = tool_temperature_at(step_.begun);
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    PointState& from = step_.from[at(p)];
    if (known(from)) continue;
    const PointMotion motion = kinematics_->motion(p, from, ContactKinematics::Asked::motion);
    if (!motion.partnered) continue;
    const auto n_slave = static_cast<std::size_t>(motion.n_slave);
    double side[2] = {0, 0};
    for (std::size_t b = 0; b < motion.nodes.size(); ++b)
      side[b < n_slave ? 0 : 1] += motion.share[b] * temperature[at(motion.nodes[b])];
    const bool meshed = motion.nodes.size() > n_slave;
    from.temperature = std::lerp(meshed ? -side[1] : tool.value_or(side[0]), side[0], of_slave);
  }
}

InterfaceSums ContactPair::commit_heat(std::span<const double> temperature) {
  InterfaceSums sums;
  if (!has_temperature()) return sums;
  const std::vector<double> found = heat_->interface_temperatures(temperature);
  const InterfaceHeat heat = heat_->interface_heat(temperature);
  const auto hardening = [&](std::size_t p) {
    const PointState &from = step_.from[p], &now = now_.points[p];
    return now.work - from.work - now.dissipation + from.dissipation;
  };
  for (std::size_t p = 0; p < found.size(); ++p)
    if (const auto particle = kinematics_->particle(static_cast<Index>(p));
        particle.counted && step_.from[p].temperature > 0)
      sums.hardening += particle.weight * hardening(p);
  take_slip(temperature);
  if (heat_->stores() && !predicted_.empty()) show_whole_step();
  heat_->end_phase();
  sums.dissipated = heat.dissipated;
  sums.stored = heat.stored;
  const double capacity = spec_.interface_heat_capacity;
  const auto energy = [&](double t, double internal_variable) {
    return law_.friction ? interface_energy(*law_.friction, t, internal_variable)
                         : interface_energy(capacity, t);
  };
  const auto entropy = [&](double t, double internal_variable) {
    return law_.friction ? interface_entropy(*law_.friction, t, internal_variable)
                         : interface_entropy(capacity, t);
  };
  for (std::size_t p = 0; p < found.size(); ++p) {
    const PointState& from = step_.from[p];
    PointState& now = now_.points[p];
    if (!(from.temperature > 0)) continue;
    now.temperature = found[p];
    double made = 0;
    if (law_.friction)
      made = plastic_entropy_increment(*law_.friction, now.slip - from.slip, now.pressure, now.temperature);
    now.plastic_entropy = from.plastic_entropy + made;
    const ContactKinematics::Particle particle = kinematics_->particle(static_cast<Index>(p));
    if (!particle.counted) continue;
    const double w = particle.weight, between = before_heat_[p];
    const double old_energy = energy(from.temperature, from.internal_variable);
    const double old_entropy = entropy(from.temperature, from.internal_variable);
    sums.energy += w * (energy(now.temperature, now.internal_variable) - old_energy);
    sums.entropy += w * (entropy(now.temperature, now.internal_variable) - old_entropy);
    sums.mechanical_energy += w * (energy(between, now.internal_variable) - old_energy);
    sums.mechanical_entropy += w * (entropy(between, now.internal_variable) - old_entropy);
    sums.plastic_entropy += w * made;
  }
  MPI_Allreduce(MPI_IN_PLACE, &sums, sizeof(sums) / sizeof(double), MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sums;
}

void ContactPair::take_slip(std::span<const double> temperature) {
  const std::vector<std::optional<FrictionResponse>> found = heat_->keep_slip(temperature);
  for (std::size_t p = 0; p < found.size(); ++p) {
    if (!found[p]) continue;
    const FrictionResponse& slip = *found[p];
    const PointState& from = step_.from[p];
    PointState& now = now_.points[p];
    now.status = slip.sticks ? PointStatus::sticks : PointStatus::slips;
    if (const double size = norm(now.traction); size > 0)
      now.traction = scale(slip.traction / size, now.traction);
    now.internal_variable = slip.internal_variable;
    now.slip = from.slip + slip.slip;
    now.dissipation = from.dissipation + slip.dissipation;
    now.work = from.work + slip.slip * slip.traction;
  }
}

bool ContactPair::symmetric_heat() const {
  return !heat_ || heat_->symmetric();
}

void ContactPair::add_coupling(std::span<const double> temperature, linear::CoupledMatrix& matrix) const {
  if (!heat_ || !active_) return;
  std::vector<Point> trial, share;
  const auto rates_of = [&](Index p) -> HeatRates {
    const PointState& from = step_.from[at(p)];
    const PointMotion motion = kinematics_->motion(p, from, ContactKinematics::Asked::rates);
    if (!motion.partnered) return {};  // of no node of this process
    const std::size_t n = motion.nodes.size();
    share.assign(n * n, Point{});
    kinematics_->add_share_rates(share);
    trial.clear();
    if (law_.friction && now_.points[at(p)].status != PointStatus::open) {
      const double spring = law_.friction->tangential_penalty();
      const Point whole = add_scaled(motion.carried, spring, motion.slip);
      const double size = norm(whole);
      for (std::size_t b = 0; b < n && size > 0; ++b) {
        trial.push_back(scale(spring / size, transposed_times(motion.slip_rate[b], whole)));
        if (!motion.carried_rate.empty())
          trial.back() = add_scaled(trial.back(), 1 / size, transposed_times(motion.carried_rate[b], whole));
      }
    }
    return {motion.penetration_rate, trial, share};
  };
  heat_->add_displacement_tangent(rates_of, temperature, matrix);
  mechanics_->add_temperature_tangent(matrix);
}

std::vector<double> ContactPair::nodal_heat(std::span<const double> temperature) const {
  std::vector<double> heat(static_cast<std::size_t>(mesh_.n_owned_nodes), 0.0);
  if (heat_) heat_->add_residual(temperature, heat);
  return heat;
}

}  // namespace solidus::contact
