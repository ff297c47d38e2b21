/// The pair calls its parts in the order of the data: geometry, motion of each point, forces, history,
/// heat. An update leaves the state at t_{n+1} next to that at t_n, and nothing of it is read by a later
/// step.
#include "contact/pair.hpp"

#include <algorithm>
#include <array>

#include "system/processes.hpp"

namespace solidus::contact {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

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

ContactPair::ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactParameters spec,
                         std::span<const double> body_modulus)
    : spec_(with_roles(mesh, std::move(spec), body_modulus)) {
  const PairSurfaces surfaces(mesh, spec_);
  geometry_ = std::make_unique<ContactGeometry>(mesh, kind, spec_, surfaces);
  forces_ = std::make_unique<ContactForces>(*geometry_, spec_, surfaces, body_modulus, step_);
  history_ = std::make_unique<ContactHistory>(*geometry_, kind, spec_, surfaces, forces_->law());
  if (spec_.heat)
    heat_ = std::make_unique<ContactHeat>(*geometry_, kind, spec_, surfaces, forces_->law(), partners_);
  restore({}, geometry_->no_displacement(), 0);
}

void ContactPair::activate(bool on) {
  active_ = on;
  forces_->activate(on);
  if (heat_) heat_->term().activate(on);
}

ContactView ContactPair::view() const {
  return {spec_, *geometry_, forces_->law(), *history_, step_, end_, heat_.get(), active_};
}

std::optional<double> ContactPair::tool_temperature_at(double time) const {
  if (!spec_.rigid_master || !spec_.rigid_master->temperature) return {};
  return spec_.rigid_master->temperature->value(time);
}

void ContactPair::set_temperature(std::span<const double> temperature) {
  if (step_.coupled.law != nullptr) step_.coupled.temperature.assign(temperature.begin(), temperature.end());
}

void ContactPair::begin(const ContactState& old, const ContactPass& pass) {
  // What the pass is made of: history at the start of the step, kind of split, time, displacements and skins
  // of that moment.
  history_->set_out_from(old, step_);
  forces_->begin(pass.isentropic, pass.share, pass.further);
  step_.dt = pass.dt;
  step_.time = pass.time;
  step_.displacement.assign(pass.displacement.begin(), pass.displacement.end());
  step_.begun = pass.time - pass.dt;
  history_->find_skins(active_ ? pass.solidity : Solidity{}, step_);
  const bool rubs = forces_->law().friction.has_value();
  step_.coupled = {};
  // When both phases are solved at once, temperatures enter the return mapping of friction.
  if (pass.simultaneous && heat_ && rubs)
    step_.coupled = {.law = &heat_->law(),
                     .time_step = pass.dt,
                     .temperature = {pass.temperature.begin(), pass.temperature.end()},
                     .tool_temperature = tool_temperature_at(pass.time)};
  if ((rubs || has_temperature()) && !pass.temperature.empty())
    history_->find_temperatures(pass.temperature,
                                heat_ ? HeatTransferLaw::slave_share(heat_->law().slave_resistance()) : 0.5,
                                has_temperature(), tool_temperature_at(step_.begun), step_);
  // Of an earlier pass of the same step temperatures, internal variables and multipliers go on.
  step_.iterate.clear();
  if (pass.iterate == nullptr || pass.iterate->points.size() != step_.from.size()) return;
  for (std::size_t p = 0; p < step_.from.size(); ++p) {
    const ContactPointState &before = pass.iterate->points[p], &from = step_.from[p];
    step_.iterate.push_back(
        {before.temperature > 0 ? before.temperature : from.temperature, rubbed_variable(from, before)});
    step_.from[p].multiplier = std::max(before.multiplier, least_multiplier(from));
  }
}

void ContactPair::hold(const ContactState& old, double time, double dt, std::span<const double> temperature) {
  const std::vector<double> displacement = geometry_->no_displacement();
  begin(old, {.time = time, .dt = dt, .displacement = displacement, .temperature = temperature});
  update(displacement);
}

const ContactState& ContactPair::update(std::span<const double> displacement) {
  // The end of the step is copied first: wear and heat below refer to it.
  end_.displacement.assign(displacement.begin(), displacement.end());
  end_.time = step_.time;
  const ContactKinematics& kinematics = geometry_->at(end_.time, end_.displacement);
  std::vector<ContactPointState>& points = end_.state.points;
  points.resize(step_.from.size());
  end_.state.master = step_.worn_from;
  // Partners that cannot change are stored once.
  const bool fixed = !kinematics.partners_change() && partners_.n_points() > 0;
  if (!fixed) partners_.clear();
  if (heat_) {
    // The heat term is filled point by point along with the forces: what it needs of the motion is
    // then at hand.
    heat_->term().set_tool_temperature(tool_temperature());
    heat_->clear(points.size());
  }
  // At each point the motion gives forces, these the next history, wear and heat.
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactPointState& from = step_.from[at(p)];
    ContactPointState& now = points[at(p)];
    const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::motion);
    // Forces depend on the state at the start of the step alone, so that a call at another
    // displacement begins from the same state.
    const PointForces forces = forces_->at(motion, p);
    now = forces_->law().next(motion, from, forces);
    // A pair that is not active keeps no anchors: it starts without slip when it becomes active.
    if (!active_) now.anchored = false;
    history_->wear_master(motion, now, forces, end_.state.master);
    if (!fixed) partners_.add(motion, kinematics.particle(p).counted);
    if (heat_) heat_->add(step_, from, now, forces);
  }
  if (heat_) heat_->place();
  return end_.state;
}

void ContactPair::restore(const ContactState& state, std::span<const double> displacement, double time) {
  history_->set_out_from(state, step_);
  step_.time = step_.begun = time;
  step_.dt = 0;
  step_.coupled = {};
  // All that belongs to a step under way is dropped: its coupling, its iterates and its heat.
  step_.iterate.clear();
  if (heat_) heat_->reset();
  step_.displacement.assign(displacement.begin(), displacement.end());
  update(displacement);
  // Gaps and the points of the heat term follow from the motion alone: what the last step did is in the
  // state.
  std::vector<ContactPointState>& points = end_.state.points;
  // The points are as the checkpoint has them, so that a restart has the same bits; only the
  // penetration is that of the motion.
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double penetration = points[p].penetration;
    points[p] = step_.from[p];
    points[p].penetration = penetration;
  }
  end_.state.master = step_.worn_from;
  if (heat_) heat_->restore(step_, points);
  if (!active_) std::ranges::for_each(points, open_up);
}

double ContactPair::left_penetration() const {
  if (!forces_->multiplies() || !forces_->multipliers().ended_early()) return 0;
  return forces_->multipliers().largest_penetration(end_.state) / geometry_->face_size();
}

void ContactPair::begin_heat(double dt, bool adiabatic) {
  if (heat_) heat_->begin_phase(dt, adiabatic);
}

std::vector<double> ContactPair::conducted_temperatures(std::span<const double> temperature) const {
  return has_temperature() ? heat_->term().interface_temperatures(temperature) : std::vector<double>{};
}

void ContactPair::hold_deformation() {
  if (!has_temperature()) return;
  step_.from = end_.state.points;
  step_.dt = 0;
  heat_->hold(step_, end_.state.points);
}

std::vector<HeatGap> ContactPair::heat_gaps() const {
  return heat_ ? heat_->term().gaps() : std::vector<HeatGap>{};
}

std::vector<HeatGap> ContactPair::heat_gaps_ahead(std::span<const double> displacement, double time) const {
  std::vector<HeatGap> gaps = heat_gaps();
  if (gaps.empty() || !active_) return gaps;
  const ContactKinematics& kinematics = geometry_->at(time, displacement);
  // Only open points may change: the gap at the displacements that are to come.
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    HeatGap& gap = gaps[at(p)];
    if (!gap.partnered || !(gap.penetration < 0)) continue;
    // Points with a partner are taken by the motion at that place; they can come back to touching
    // but not be pressed.
    const PointMotion motion =
        kinematics.motion(p, end_.state.points[at(p)], ContactKinematics::Asked::motion);
    gap.partnered = motion.partnered;
    if (motion.partnered) gap.penetration = std::min(motion.penetration + step_.from[at(p)].offset, 0.0);
  }
  // The geometry is put back to the end of the step, which others refer to.
  geometry_->at(end_.time, end_.displacement);
  return gaps;
}

void ContactPair::conduct_through(std::span<const HeatGap> gaps) {
  if (heat_) heat_->term().set_gaps(gaps);
}

GapHeat ContactPair::gap_heat(std::span<const HeatGap> used, std::span<const HeatGap> right,
                              std::span<const double> temperature) const {
  if (!heat_) return {};
  const GapHeat heat = heat_->term().gap_heat(used, right, temperature);
  std::array<double, 2> sums = {heat.passed, heat.misplaced};
  processes::sum(sums);
  return {sums[0], sums[1]};
}

void ContactPair::predict_heat() {
  if (heat_) heat_->predict();
}

InterfaceSums ContactPair::commit_heat(std::span<const double> temperature) {
  return heat_ ? heat_->commit(temperature, step_, end_.state.points) : InterfaceSums{};
}

void ContactPair::add_coupling(std::span<const double> temperature, linear::CoupledMatrix& matrix) const {
  if (!heat_ || !active_) return;
  const ContactKinematics& kinematics = geometry_->at(end_.time, end_.displacement);
  heat_->add_displacement_tangent(kinematics, step_, end_.state.points, temperature, matrix);
  forces_->term().add_temperature_tangent(matrix);
}

std::vector<double> ContactPair::nodal_heat(std::span<const double> temperature) const {
  std::vector<double> heat(static_cast<std::size_t>(geometry_->mesh().n_owned_nodes), 0.0);
  if (heat_) heat_->term().add_residual(temperature, heat);
  return heat;
}

std::size_t ContactPair::bytes() const {
  return partners_.bytes() + step_.start_traction.capacity() * sizeof(Point) +
         (end_.state.points.capacity() + step_.from.capacity()) * sizeof(ContactPointState) +
         forces_->term().bytes() + (heat_ ? heat_->term().bytes() : 0);
}

}  // namespace solidus::contact
