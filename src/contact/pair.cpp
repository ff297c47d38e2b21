/// The pair calls its parts in the order of the data: geometry, motion of each point, forces, history,
/// heat. An update leaves the state at t_{n+1} next to that at t_n, and nothing of it is read by a later
/// step.
#include "contact/pair.hpp"

#include <algorithm>
#include <array>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::contact {

namespace {

/// The state of a point of a contact that is off.
void open_up(ContactPointState& point) {
  point.status = PointStatus::open;
  point.pressure = point.balance_pressure = point.multiplier = 0;
  point.suction = 0;
  point.molten = false;
  point.traction = {};
  point.anchored = false;
}

}  // namespace

std::optional<double> tool_temperature(const ContactParameters& spec, double time) {
  if (!spec.rigid_master || !spec.rigid_master->temperature) return {};
  return spec.rigid_master->temperature->value(time);
}

PairParts::PairParts(const mesh::Mesh& mesh, AnalysisKind kind, const ContactParameters& chosen,
                     const PairSurfaces& surfaces, std::span<const double> body_modulus)
    : spec(chosen),
      geometry(mesh, kind, spec, surfaces),
      forces(geometry, spec, surfaces, body_modulus, step),
      history(geometry, kind, spec, surfaces, forces.law()),
      heat(spec.heat ? std::make_unique<ContactHeat>(geometry, kind, spec, surfaces, forces.law(), partners)
                     : nullptr,
           geometry, forces, step, end),
      gaps(heat.of_points(), geometry, forces, step, end),
      augmentations(forces, step, end, geometry) {}

ContactPair::ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactParameters spec,
                         std::span<const double> body_modulus) {
  const ContactParameters chosen = with_roles(mesh, std::move(spec), body_modulus);
  const PairSurfaces surfaces(mesh, chosen);
  parts_ = std::make_unique<PairParts>(mesh, kind, chosen, surfaces, body_modulus);
  restore({}, parts_->geometry.no_displacement(), 0);
}

void ContactPair::activate(bool on) {
  parts_->forces.activate(on);
  if (ContactHeat* const heat = parts_->heat.of_points()) heat->points().interface().active = on;
}

ContactView ContactPair::view() const {
  const PairParts& p = *parts_;
  return {p.spec, p.geometry, p.forces.law(),     p.history,
          p.step, p.end,      p.heat.of_points(), p.forces.active()};
}

void ContactPair::set_temperature(std::span<const double> temperature) {
  ContactStep& step = parts_->step;
  if (step.coupled.law != nullptr) step.coupled.temperature.assign(temperature.begin(), temperature.end());
}

void ContactPair::begin(const ContactState& old, const ContactPass& pass) {
  PairParts& parts = *parts_;
  ContactStep& step = parts.step;
  const ContactHeat* const heat = parts.heat.of_points();
  // What the pass is made of: history at the start of the step, kind of split, time, displacements and skins
  // of that moment.
  parts.history.set_out_from(old, step);
  parts.forces.begin(pass.isentropic, pass.share, pass.further);
  step.dt = pass.dt;
  step.time = pass.time;
  step.displacement.assign(pass.displacement.begin(), pass.displacement.end());
  step.begun = pass.time - pass.dt;
  parts.history.find_skins(parts.forces.active() ? pass.solidity : Solidity{}, step);
  const bool rubs = parts.forces.law().friction.has_value();
  step.coupled = {};
  // When both phases are solved at once, temperatures enter the return mapping of friction.
  if (pass.simultaneous && heat != nullptr && rubs)
    step.coupled = {.law = &heat->points().interface().law,
                    .time_step = pass.dt,
                    .temperature = {pass.temperature.begin(), pass.temperature.end()},
                    .tool_temperature = tool_temperature(parts.spec, pass.time)};
  if ((rubs || parts.heat.has_temperature()) && !pass.temperature.empty())
    parts.history.find_temperatures(
        pass.temperature,
        heat != nullptr ? HeatTransferLaw::slave_share(heat->points().interface().law.slave_resistance())
                        : 0.5,
        parts.heat.has_temperature(), tool_temperature(parts.spec, step.begun), step);
  // Of an earlier pass of the same step temperatures, internal variables and multipliers go on.
  step.iterate.clear();
  if (pass.iterate == nullptr || pass.iterate->points.size() != step.from.size()) return;
  for (std::size_t p = 0; p < step.from.size(); ++p) {
    const ContactPointState &before = pass.iterate->points[p], &from = step.from[p];
    step.iterate.push_back(
        {before.temperature > 0 ? before.temperature : from.temperature, rubbed_variable(from, before)});
    step.from[p].multiplier = std::max(before.multiplier, least_multiplier(from));
  }
}

void ContactPair::hold(const ContactState& old, double time, double dt, std::span<const double> temperature) {
  const std::vector<double> displacement = parts_->geometry.no_displacement();
  begin(old, {.time = time, .dt = dt, .displacement = displacement, .temperature = temperature});
  update(displacement);
}

const ContactState& ContactPair::update(std::span<const double> displacement) {
  PairParts& parts = *parts_;
  const ContactStep& step = parts.step;
  ContactEnd& end = parts.end;
  ContactHeat* const heat = parts.heat.of_points();
  // The end of the step is copied first: wear and heat below refer to it.
  end.displacement.assign(displacement.begin(), displacement.end());
  end.time = step.time;
  const ContactKinematics& kinematics = parts.geometry.at(end.time, end.displacement);
  std::vector<ContactPointState>& points = end.state.points;
  points.resize(step.from.size());
  end.state.master = step.worn_from;
  // Partners that cannot change are stored once.
  const bool fixed = !kinematics.partners_change() && parts.partners.n_points() > 0;
  if (!fixed) parts.partners.clear();
  if (heat != nullptr) {
    // The heat term is filled point by point along with the forces: what it needs of the motion is
    // then at hand.
    heat->points().interface().tool_temperature = tool_temperature(parts.spec, end.time);
    heat->clear(points.size());
  }
  // At each point the motion gives forces, these the next history, wear and heat.
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactPointState& from = step.from[as_size(p)];
    ContactPointState& now = points[as_size(p)];
    const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::motion);
    // Forces depend on the state at the start of the step alone, so that a call at another
    // displacement begins from the same state.
    const PointForces forces = parts.forces.at(motion, p);
    now = parts.forces.law().next(motion, from, forces);
    // A pair that is not active keeps no anchors: it starts without slip when it becomes active.
    if (!parts.forces.active()) now.anchored = false;
    parts.history.wear_master(motion, now, forces, end.state.master);
    if (!fixed) parts.partners.add(motion, kinematics.particle(p).counted);
    if (heat != nullptr) heat->add(step, from, now, forces);
  }
  if (heat != nullptr) heat->place();
  return end.state;
}

void ContactPair::restore(const ContactState& state, std::span<const double> displacement, double time) {
  PairParts& parts = *parts_;
  ContactStep& step = parts.step;
  ContactHeat* const heat = parts.heat.of_points();
  parts.history.set_out_from(state, step);
  step.time = step.begun = time;
  step.dt = 0;
  step.coupled = {};
  // All that belongs to a step under way is dropped: its coupling, its iterates and its heat.
  step.iterate.clear();
  if (heat != nullptr) heat->reset();
  step.displacement.assign(displacement.begin(), displacement.end());
  update(displacement);
  // Gaps and the points of the heat term follow from the motion alone: what the last step did is in the
  // state.
  std::vector<ContactPointState>& points = parts.end.state.points;
  // The points are as the checkpoint has them, so that a restart has the same bits; only the
  // penetration is that of the motion.
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double penetration = points[p].penetration;
    points[p] = step.from[p];
    points[p].penetration = penetration;
  }
  parts.end.state.master = step.worn_from;
  if (heat != nullptr) heat->restore(step, points);
  if (!parts.forces.active()) std::ranges::for_each(points, open_up);
}

void ContactPair::follow_elements(const FacesThere& faces, const ContactPass& pass, ContactState* state) {
  PairParts& parts = *parts_;
  const std::vector<double> still = parts.geometry.no_displacement();
  const std::span<const double> displacement = pass.displacement.empty() ? still : pass.displacement;
  const std::vector<char> before = parts.geometry.there();
  parts.geometry.set_there(faces);
  parts.partners.clear();  // of points that were there
  if (state != nullptr) {
    parts.history.follow_elements(before, displacement, pass.time, *state);
    // A new interface stores heat at once, which is counted with the energy of the elements that come.
    if (parts.heat.has_temperature()) {
      begin(*state, {.time = pass.time, .displacement = displacement, .temperature = pass.temperature});
      for (std::size_t p = 0; p < state->points.size(); ++p)
        state->points[p].temperature = parts.step.from[p].temperature;
    }
  }
  restore(state != nullptr ? *state : ContactState{}, displacement, pass.time);
}

std::size_t ContactPair::bytes() const {
  const PairParts& p = *parts_;
  ContactHeat* const heat = p.heat.of_points();
  return p.partners.bytes() + p.step.start_traction.capacity() * sizeof(Point) +
         (p.end.state.points.capacity() + p.step.from.capacity()) * sizeof(ContactPointState) +
         p.forces.term().bytes() +
         (heat != nullptr ? contact::bytes(heat->points()) + heat->term().bytes() : 0);
}

}  // namespace solidus::contact
