/// The state of a pair between steps: where it begins, what of it stays when bodies are renewed, and what a
/// step reads of it (skins, temperatures of the interface).
#include "contact/forces/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {}  // namespace

ContactHistory::ContactHistory(const ContactGeometry& geometry, AnalysisKind kind,
                               const ContactParameters& spec, const PairSurfaces& surfaces,
                               const PointLaw& law)
    : geometry_(geometry), spec_(spec), law_(law) {
  if (!spec.wear || !(spec.wear->master_share > 0)) return;
  if (!surfaces.master)
    throw InputError(spec.wear->where, fmt::format("contact '{}': a rigid surface does not wear", spec.name),
                     "master_share = 0");
  worn_ = std::make_unique<MasterWear>(geometry.mesh(), kind, *surfaces.master);
}

ContactPointState ContactHistory::as_drawn(Index p, const ContactKinematics& kinematics) const {
  // A point with a partner is anchored where it projects; those that overlap or touch start closed, sticking
  // where there is friction, with the pressure of their penetration.
  ContactPointState point;
  const ContactKinematics::Particle particle = kinematics.particle(p);
  point.number = particle.number;
  point.counted = particle.counted;
  point.stiffening = law_.stiffening;  // an overlap of the drawing is that of solid bodies
  const PointMotion motion = kinematics.motion(p, {}, ContactKinematics::Asked::motion);
  if (!motion.partnered) return point;
  point.anchored = true;
  point.anchor = motion.anchor;
  point.master_normal = motion.master_normal;
  point.offset = geometry_.initial_offset(p, motion.penetration);
  point.penetration = motion.penetration + point.offset;
  if (point.penetration < 0) return point;
  point.status = law_.friction ? PointStatus::sticks : PointStatus::slips;
  point.pressure = point.balance_pressure = law_.normal_at(point).penalty * point.penetration;
  return point;
}

void ContactHistory::keep_gap(Index p, const ContactKinematics& now, ContactPointState& point) {
  if (!point.anchored) return;  // without a partner in the drawing
  const PointMotion motion = now.motion(p, point, ContactKinematics::Asked::motion);
  if (!motion.partnered) return;
  point.offset = point.penetration - motion.penetration;
  point.anchor = motion.anchor;
  point.master_normal = motion.master_normal;
}

ContactState ContactHistory::initial() const {
  const ContactKinematics& kinematics = geometry_.at(0, geometry_.no_displacement());
  ContactState state;
  for (Index p = 0; p < kinematics.n_points(); ++p) state.points.push_back(as_drawn(p, kinematics));
  if (worn_) state.master = worn_->initial_state();
  return state;
}

ContactState ContactHistory::renewed(const ContactState& old, bool new_slave, bool new_master,
                                     std::span<const double> displacement, double time) const {
  ContactState state = initial();
  if (!spec_.rigid_master) {
    const ContactKinematics& kinematics = geometry_.at(time, displacement);
    // In the present geometry the gap of the drawing is kept: the offset makes up for how far the sides have
    // moved.
    for (Index p = 0; p < kinematics.n_points(); ++p) keep_gap(p, kinematics, state.points[as_size(p)]);
  }
  if (old.points.empty()) return state;
  // Quantities that belong to the surface stay with a side that is not new.
  if (!new_slave)
    for (std::size_t p = 0; p < state.points.size(); ++p)
      for (auto field : {&ContactPointState::internal_variable, &ContactPointState::slip,
                         &ContactPointState::work, &ContactPointState::dissipation,
                         &ContactPointState::wear_depth, &ContactPointState::plastic_entropy})
        state.points[p].*field = old.points[p].*field;
  if (!new_master) state.master = old.master;
  return state;
}

void ContactHistory::follow_elements(std::span<const char> before, std::span<const double> displacement,
                                     double time, ContactState& state) const {
  const auto changed = [&](Index p) { return geometry_.kinematics().there(p) != (before[as_size(p)] != 0); };
  // As drawn first, at the present place of a rigid surface; then the offset makes up for how far the sides
  // have moved since.
  const ContactKinematics& drawn = geometry_.at(time, geometry_.no_displacement());
  for (Index p = 0; p < drawn.n_points(); ++p)
    if (changed(p)) state.points[as_size(p)] = as_drawn(p, drawn);
  const ContactKinematics& now = geometry_.at(time, displacement);
  for (Index p = 0; p < now.n_points(); ++p)
    if (changed(p)) keep_gap(p, now, state.points[as_size(p)]);
}

void ContactHistory::set_out_from(const ContactState& state, ContactStep& step) const {
  step.start_traction.clear();
  if (!state.points.empty()) {
    step.from = state.points;
    step.worn_from = state.master;
    return;
  }
  ContactState start = initial();
  step.from = std::move(start.points);
  step.worn_from = std::move(start.master);
}

void ContactHistory::find_skins(const Solidity& of_nodes, ContactStep& step) const {
  // A search for partners costs more than all the rest here, so it is left out where no skin can be
  // molten, mushy or wetting.
  const auto molten = [](double c) { return c < k_coherent; };
  const bool wets = spec_.atmosphere > 0, rubs = law_.friction.has_value(), stiffens = law_.stiffening > 1;
  const bool any = (wets || rubs) && std::ranges::any_of(of_nodes.coherency, molten);
  const bool mushy = stiffens && !std::ranges::equal(of_nodes.coherency, of_nodes.of_solid);
  if (any || mushy) geometry_.at(step.begun, step.displacement);
  const ContactKinematics& kinematics = geometry_.kinematics();
  step.liquid.assign(step.from.size(), 0);
  // A molten skin may be held by the pressure of the atmosphere and rubs as a liquid; a mushy one has a share
  // of the penalty.
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    // The point has touched if it was closed at the start of the step, or is held by the atmosphere
    // that pressed it there before.
    ContactPointState& from = step.from[as_size(p)];
    const bool touched = from.status != PointStatus::open || from.suction > 0;
    from.suction = 0;
    from.molten = false;
    Skin skin;
    if (mushy || (any && (touched || rubs))) {
      const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::motion);
      const ContactKinematics::Particle slave = kinematics.particle(p);
      // With a partner the skin is that of both sides together, since either may be the one that
      // melts; without one it is the slave's.
      skin = motion.partnered ? skin_at(motion.nodes, motion.share, as_size(motion.n_slave), of_nodes)
                              : skin_at(slave.nodes, slave.share, slave.nodes.size(), of_nodes);
      from.molten = motion.partnered && skin.molten;
      if (wets && touched && from.molten) from.suction = spec_.atmosphere;
      step.liquid[as_size(p)] = from.suction > 0 && skin.liquid;
    }
    from.multiplier = std::max(from.multiplier, least_multiplier(from));
    if (stiffens) law_.stiffen(skin.strength, from);
  }
}

void ContactHistory::find_temperatures(std::span<const double> temperature, double slave_share, bool balances,
                                       std::optional<double> tool, ContactStep& step) const {
  const auto known = [&](const ContactPointState& from) { return balances && from.temperature > 0; };
  if (std::ranges::all_of(step.from, known)) return;
  const ContactKinematics& kinematics = geometry_.at(step.begun, step.displacement);
  // The mean of both sides with the share of the slave in the resistance; a tool without nodes has the
  // temperature given.
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    ContactPointState& from = step.from[as_size(p)];
    if (known(from)) continue;
    const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::motion);
    if (!motion.partnered) continue;
    const auto n_slave = as_size(motion.n_slave);
    double side[2] = {0, 0};
    for (std::size_t b = 0; b < motion.nodes.size(); ++b)
      side[b < n_slave ? 0 : 1] += motion.share[b] * temperature[as_size(motion.nodes[b])];
    const bool meshed = motion.nodes.size() > n_slave;
    from.temperature = std::lerp(meshed ? -side[1] : tool.value_or(side[0]), side[0], slave_share);
  }
}

void ContactHistory::wear_master(const PointMotion& motion, const ContactPointState& now,
                                 const PointForces& forces, std::vector<WornNode>& master) const {
  if (!worn_ || forces.status != PointStatus::slips) return;
  const WearParameters& wear = *law_.wear;
  const double depth = wear.depth_increment(forces.normal.pressure, forces.friction.slip, now.temperature);
  worn_->add(motion, wear.master_share * depth, forces.friction.dissipation, master);
}

std::vector<MasterWear::Depth> ContactHistory::depths(const ContactState& state) const {
  return worn_ ? worn_->depths(state.master) : std::vector<MasterWear::Depth>{};
}

}  // namespace solidus::contact
