#include "contact/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace solidus::contact {

namespace {

/// A mean of coherencies below it is that of melt: shape functions add up to one but for rounding.
constexpr double k_coherent = 1 - 1e-9;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// The metal at a point that has a partner.
struct Skin {
  bool molten = false;  ///< on either side it is below coherency in the mean of the nodes
  bool liquid = false;  ///< there no node of the face is coherent
};

Skin skin_at(const PointMotion& motion, std::span<const double> coherency) {
  const auto n_slave = static_cast<std::size_t>(motion.n_slave);
  std::array<double, 2> side{};
  std::array<bool, 2> molten{true, true};
  for (std::size_t b = 0; b < motion.nodes.size(); ++b) {
    const std::size_t of = b < n_slave ? 0 : 1;
    const double at_node = coherency[at(motion.nodes[b])];
    side[of] += (of == 0 ? motion.share[b] : -motion.share[b]) * at_node;
    molten[of] = molten[of] && at_node < k_coherent;
  }
  Skin skin;
  for (std::size_t of = 0; of < (motion.nodes.size() > n_slave ? 2 : 1); ++of) {
    if (side[of] >= k_coherent) continue;
    skin.molten = true;
    skin.liquid = skin.liquid || molten[of];
  }
  return skin;
}

}  // namespace

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

ContactState ContactHistory::initial() const {
  const ContactKinematics& kinematics = geometry_.at(0, geometry_.no_displacement());
  ContactState state;
  state.points.resize(at(kinematics.n_points()));
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    ContactPointState& point = state.points[at(p)];
    const ContactKinematics::Particle particle = kinematics.particle(p);
    point.number = particle.number;
    point.counted = particle.counted;
    const PointMotion motion = kinematics.motion(p, {}, ContactKinematics::Asked::motion);
    if (!motion.partnered) continue;
    point.anchored = true;
    point.anchor = motion.anchor;
    point.master_normal = motion.master_normal;
    if (std::abs(motion.penetration) <= geometry_.touching()) point.offset = -motion.penetration;
    point.penetration = motion.penetration + point.offset;
    if (point.penetration < 0) continue;
    point.status = law_.friction ? PointStatus::sticks : PointStatus::slips;
    point.pressure = point.balance_pressure = law_.normal.penalty * point.penetration;
  }
  if (worn_) state.master = worn_->initial_state();
  return state;
}

ContactState ContactHistory::renewed(const ContactState& old, bool new_slave, bool new_master,
                                     std::span<const double> displacement, double time) const {
  ContactState state = initial();
  if (!spec_.rigid_master) {
    const ContactKinematics& kinematics = geometry_.at(time, displacement);
    for (Index p = 0; p < kinematics.n_points(); ++p) {
      ContactPointState& point = state.points[at(p)];
      if (!point.anchored) continue;  // without a partner in the drawing
      const PointMotion motion = kinematics.motion(p, point, ContactKinematics::Asked::motion);
      if (!motion.partnered) continue;
      point.offset = point.penetration - motion.penetration;
      point.anchor = motion.anchor;
      point.master_normal = motion.master_normal;
    }
  }
  if (old.points.empty()) return state;
  if (!new_slave)
    for (std::size_t p = 0; p < state.points.size(); ++p)
      for (auto field : {&ContactPointState::internal_variable, &ContactPointState::slip,
                         &ContactPointState::work, &ContactPointState::dissipation,
                         &ContactPointState::wear_depth, &ContactPointState::plastic_entropy})
        state.points[p].*field = old.points[p].*field;
  if (!new_master) state.master = old.master;
  return state;
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

void ContactHistory::find_wet_points(std::span<const double> coherency, ContactStep& step) const {
  const auto molten = [](double c) { return c < k_coherent; };
  const bool wets = spec_.atmosphere > 0, rubs = law_.friction.has_value();
  const bool any = (wets || rubs) && std::ranges::any_of(coherency, molten);
  if (any) geometry_.at(step.begun, step.displacement);
  const ContactKinematics& kinematics = geometry_.kinematics();
  step.liquid.assign(step.from.size(), 0);
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    ContactPointState& from = step.from[at(p)];
    const bool touched = from.status != PointStatus::open || from.suction > 0;
    from.suction = 0;
    from.molten = false;
    if (any && (touched || rubs)) {
      const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::motion);
      const Skin skin = motion.partnered ? skin_at(motion, coherency) : Skin{};
      from.molten = skin.molten;
      if (wets && touched && skin.molten) from.suction = spec_.atmosphere;
      step.liquid[at(p)] = from.suction > 0 && skin.liquid;
    }
    from.multiplier = std::max(from.multiplier, least_multiplier(from));
  }
}

void ContactHistory::find_temperatures(std::span<const double> temperature, double slave_share, bool balances,
                                       std::optional<double> tool, ContactStep& step) const {
  const auto known = [&](const ContactPointState& from) { return balances && from.temperature > 0; };
  if (std::ranges::all_of(step.from, known)) return;
  const ContactKinematics& kinematics = geometry_.at(step.begun, step.displacement);
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    ContactPointState& from = step.from[at(p)];
    if (known(from)) continue;
    const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::motion);
    if (!motion.partnered) continue;
    const auto n_slave = static_cast<std::size_t>(motion.n_slave);
    double side[2] = {0, 0};
    for (std::size_t b = 0; b < motion.nodes.size(); ++b)
      side[b < n_slave ? 0 : 1] += motion.share[b] * temperature[at(motion.nodes[b])];
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
