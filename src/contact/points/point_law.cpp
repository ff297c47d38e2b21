/// Normal law first, then friction within its limit, then the derivatives of both by motion and
/// temperature; next() turns the forces of a solution into the history of the point.
#include "contact/points/point_law.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::contact {

/// A point that slipped stands on the slip cone at the start of the next step, up to rounding. There the
/// derivative has two sides; the one of slip that goes on keeps Newton's first step from taking the whole way
/// for elastic.
constexpr double k_on_the_cone = 1e-6;

FrictionResponse PointLaw::respond(const FrictionInput& in, const std::optional<Surroundings>& around,
                                   double conductance, std::optional<JointSlopes>& joint) const {
  // Without surroundings the temperature of the interface is known; else it follows from the balance of heat
  // along with the return mapping.
  if (!around || !(in.temperature > 0)) return isentropic ? friction->isentropic(in) : friction->update(in);
  const InterfaceSides sides = around->sides(conductance, in.pressure);
  const InterfaceReturn r = interface_return_mapping(*friction, in, around->time_step, sides);
  FrictionResponse f = r.friction;
  if (!r.heat.balanced) {
    f.status = FrictionStatus::temperature_runs_off;
    return f;
  }
  f.temperature = r.heat.temperature;
  // Slopes by trial traction and pressure run over the temperature too, which the balance moves by source
  // over stiffness.
  f.trial_slope += r.traction_by_temperature * r.source_by_trial / r.heat.stiffness;
  f.pressure_slope += r.traction_by_temperature * r.source_by_pressure / r.heat.stiffness;
  joint = JointSlopes{r.heat.stiffness, r.source_by_trial, r.source_by_pressure, 0, {}};
  const OneSided part = HeatTransferLaw::one_sided(
      1.0, around->law->slave_resistance(in.pressure, 0.5 * (sides.temperature[0] + sides.temperature[1])));
  double moved = part.slave * (sides.temperature[0] - f.temperature);
  if (around->master_takes_heat) moved += part.master * (sides.temperature[1] - f.temperature);
  joint->traction_by_conductance = r.traction_by_temperature * moved / r.heat.stiffness;
  for (std::size_t i = 0; i < 2; ++i)
    joint->traction_by_side[i] = r.traction_by_temperature * r.heat.by_side[i];
  return f;
}

PointForces PointLaw::forces(const PointMotion& motion, const ContactPointState& from,
                             const std::optional<Surroundings>& around,
                             const std::optional<FrictionInput::Iterate>& iterate) const {
  PointForces f;
  // The normal law comes first: without a partner or with an open gap there is no force.
  if (!motion.partnered) return f;
  f.normal = normal_at(from).update(
      motion.penetration + from.offset,
      {from.anchored, from.penetration, from.balance_pressure, from.multiplier, from.suction}, share);
  if (!f.normal.closed) return f;
  f.status = friction ? PointStatus::sticks : PointStatus::slips;
  if (!friction) return f;

  // The trial traction carries the one of the last step along and adds the tangential penalty times the slip.
  const Point trial = add_scaled(motion.carried, tangential_penalty(from), motion.slip);
  f.trial = norm(trial);
  // What presses is the pressure without suction; the penalty of a skin that gets solid stiffens the
  // tangential spring, too.
  const double pressing = rubbing_pressure(f.normal.pressure, from.molten);
  const FrictionInput in{.trial = f.trial,
                         .pressure = pressing,
                         .internal_variable = from.internal_variable,
                         .temperature = from.temperature,
                         .iterate = iterate,
                         .stiffening = friction_stiffens ? from.stiffening : 1.0};
  // In coupled steps friction may depend on the temperature, which depends on the conductance of the pressure
  // reached here.
  if (around)
    f.conductance = around->conductance(
        seen_by_heat(motion.penetration + from.offset, f.normal.pressure, from.suction), f.normal.pressure);
  f.friction = respond(in, around, f.conductance.value, f.joint);
  if (from.molten) {  // whatever presses
    f.friction.pressure_slope = 0;
    if (f.joint) f.joint->source_by_pressure = 0;
  }
  if (!f.friction.sticks) f.status = PointStatus::slips;
  // A point that slipped and now lies exactly on the cone sticks by rounding: it gets the slope of slip,
  // since it will slip again.
  if (f.friction.sticks && from.status == PointStatus::slips &&
      f.trial >= (1 - k_on_the_cone) * f.friction.coefficient * pressing && f.trial > 0) {
    FrictionInput beyond = in;
    beyond.trial = (1 + 2 * k_on_the_cone) * in.trial;
    const FrictionResponse slipping = respond(beyond, around, f.conductance.value, f.joint);
    f.friction.trial_slope = slipping.trial_slope;
    f.friction.pressure_slope = from.molten ? 0.0 : slipping.pressure_slope;
  }
  // The traction is the trial scaled radially; its derivative has a radial part and one across.
  const double radial = f.trial > 0 ? f.friction.traction / f.trial : 1.0;
  f.traction = scale(radial, trial);
  const Point m = f.trial > 0 ? scale(1 / f.trial, trial) : Point{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      f.traction_by_trial[i][j] = (f.friction.trial_slope - radial) * m[i] * m[j];
    f.traction_by_trial[i][i] += radial;
  }
  f.traction_by_pressure = scale(f.normal.pressure >= 0 ? f.friction.pressure_slope : 0.0, m);
  if (f.joint) f.traction_by_conductance = scale(f.joint->traction_by_conductance, m);
  return f;
}

ContactPointState PointLaw::next(const PointMotion& motion, const ContactPointState& from,
                                 const PointForces& f) const {
  ContactPointState to = from;
  to.status = f.status;
  to.pressure = f.normal.pressure;
  to.balance_pressure = f.normal.balance_pressure;
  // A point that opens loses its multiplier down to the least one; without friction or pressure nothing else
  // changes.
  if (!f.normal.closed)
    to.multiplier = normal.kind == NormalKind::augmented_lagrangian ? least_multiplier(from) : 0.0;
  // The anchor is where the point now meets the master: the next step's slip is counted from there.
  to.traction = f.traction;
  to.anchored = motion.partnered;
  if (motion.partnered) {
    to.penetration = motion.penetration + from.offset;
    to.anchor = motion.anchor;
    to.master_normal = motion.master_normal;
  }
  // Open points and points without friction keep temperature, slip and wear as they are.
  if (!friction || f.status == PointStatus::open) return to;
  to.temperature = f.friction.temperature;
  to.covered = motion.covered;
  take_slip(f.friction, from, to);
  // The slave's own part of the wear; the master's is added by MasterWear at the nodes of the
  // master.
  if (wear)
    to.wear_depth += motion.covered * (1 - wear->master_share) *
                     wear->depth_increment(rubbing_pressure(f.normal.pressure, from.molten), f.friction.slip,
                                           to.temperature);
  return to;
}

void take_slip(const FrictionResponse& friction, const ContactPointState& from, ContactPointState& to) {
  to.internal_variable = std::lerp(from.internal_variable, friction.internal_variable, to.covered);
  to.slip = from.slip + to.covered * friction.slip;
  to.dissipation = from.dissipation + to.covered * friction.dissipation;
  to.work = from.work + to.covered * friction.slip * friction.traction;
}

void PointLaw::stiffen(double strength, ContactPointState& state) const {
  const double before = state.stiffening;
  state.stiffening = std::pow(stiffening, strength);
  if (state.stiffening < before && friction_stiffens)
    state.traction = scale(state.stiffening / before, state.traction);
  if (state.stiffening <= before || !(state.penetration > 0) || !(state.pressure > 0)) return;
  const double sunk = (1 - before / state.stiffening) * state.penetration;
  state.offset -= sunk;
  state.sunk += sunk;
  state.penetration -= sunk;
}

double PointLaw::stored(const ContactPointState& state) const {
  if (!state.anchored) return 0;
  double energy = normal_at(state).energy(state.penetration, state.suction);
  if (friction && normal.kind != NormalKind::augmented_lagrangian)
    energy += 0.5 * dot(state.traction, state.traction) / tangential_penalty(state);
  return energy;
}

}  // namespace solidus::contact
