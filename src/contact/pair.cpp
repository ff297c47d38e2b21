#include "contact/pair.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "contact/fixed_kinematics.hpp"
#include "contact/heat_term.hpp"
#include "contact/master_mesh.hpp"
#include "contact/penalty.hpp"
#include "contact/sliding_kinematics.hpp"
#include "contact/surface_curvature.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

/// A mean of coherencies below it is that of melt: shape functions add up to one but for rounding.
constexpr double k_coherent = 1 - 1e-9;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// The metal at a point that has a partner.
struct Skin {
  bool wet = false;     ///< on either side it is below coherency in the mean of the nodes
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
    skin.wet = true;
    skin.liquid = skin.liquid || molten[of];
  }
  return skin;
}

ContactPoints find_points(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSpec& spec, double reach,
                          const ContactSurface& slave, const ContactSurface& master) {
  IntegrationOptions options;
  options.rule = spec.integration;
  options.gauss_degree = spec.gauss_degree;
  options.search_distance = reach;
  ContactPoints points = integrate(mesh, kind, slave, master, options);
  if (points.paired_measure <= 0)
    throw InputError(spec.where,
                     fmt::format("contact '{}': no part of surface '{}' faces surface '{}' within {:.3g} m",
                                 spec.name, spec.slave, spec.master, options.search_distance),
                     "two surfaces that look at each other; or a larger search distance");
  return points;
}

bool has_linear_faces(const ContactSurface& surface) {
  for (Index face = 0; face < surface.n_faces(); ++face)
    if (mesh::order(surface.shape(face)) > 1) return false;
  return true;
}

double find_penalty(const mesh::Mesh& mesh, const ContactSpec& spec, const ContactSurface& slave,
                    const ContactSurface* master, std::span<const double> modulus) {
  if (!(spec.penalty > 0))
    throw InputError(spec.where, fmt::format("contact '{}': the penalty is not positive", spec.name));
  if (!spec.penalty_is_factor) return spec.penalty;
  double stiffness = 0;
  if (modulus.size() == mesh.bodies.size())
    stiffness = std::max(local_stiffness(mesh, slave, modulus),
                         master != nullptr ? local_stiffness(mesh, *master, modulus) : 0.0);
  if (!(stiffness > 0))
    throw InputError(
        spec.where,
        fmt::format("contact '{}': a penalty factor needs the stiffness of the bodies", spec.name),
        "a penalty in Pa/m");
  return std::min(spec.penalty * stiffness, spec.largest_penalty);
}

/// The curvature of the slave's face at every point; empty where the surface is plane.
std::vector<SurfaceCurvature> curvature_of_points(const ContactSurface& slave, AnalysisKind kind,
                                                  const ContactKinematics& kinematics) {
  const std::vector<SurfaceCurvature> of_face =
      surface_curvatures(slave, kind, MeshMasterOptions{}.feature_angle);
  if (std::ranges::all_of(of_face, [](const auto& c) { return c.first == 0 && c.second == 0; })) return {};
  std::vector<SurfaceCurvature> of_point(at(kinematics.n_points()));
  for (Index p = 0; p < kinematics.n_points(); ++p)
    of_point[at(p)] = of_face[static_cast<std::size_t>(kinematics.particle(p).number / k_points_of_a_face)];
  return of_point;
}

void choose_roles(const mesh::Mesh& mesh, std::span<const double> modulus, ContactSpec& spec) {
  constexpr double k_alike = 0.05;  // sizes of faces
  const ContactSurface first(mesh, spec.slave), second(mesh, spec.master);
  const double ratio = first.mean_face_size() / second.mean_face_size();
  bool swap = ratio > 1 + k_alike;
  if (std::abs(ratio - 1) <= k_alike && modulus.size() == mesh.bodies.size())
    swap = local_stiffness(mesh, first, modulus) > (1 + k_alike) * local_stiffness(mesh, second, modulus);
  if (!swap) return;
  std::swap(spec.slave, spec.master);
  if (spec.heat) spec.heat->slave_resistance = 1 - spec.heat->slave_resistance;
}

}  // namespace

ContactPair::ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactSpec spec,
                         std::span<const double> body_modulus)
    : mesh_(mesh), spec_(std::move(spec)), components_(displacement_components(kind)) {
  if (spec_.choose_roles) choose_roles(mesh, body_modulus, spec_);
  const ContactSurface slave(mesh, spec_.slave);
  std::optional<ContactSurface> master;
  if (!spec_.rigid_master) master.emplace(mesh, spec_.master);
  if (master) require_apart(slave, *master);
  make_kinematics(kind, slave, master ? &*master : nullptr);
  make_laws(slave, find_penalty(mesh, spec_, slave, master ? &*master : nullptr, body_modulus));
  if (spec_.wear && spec_.wear->master_share > 0) {
    if (!master)
      throw InputError(spec_.wear->where,
                       fmt::format("contact '{}': a rigid surface does not wear", spec_.name),
                       "master_share = 0");
    worn_ = std::make_unique<MasterWear>(mesh, kind, *master);
  }
  surface_nodes_ = slave.all_nodes();
  if (master)
    surface_nodes_.insert(surface_nodes_.end(), master->all_nodes().begin(), master->all_nodes().end());
  std::sort(surface_nodes_.begin(), surface_nodes_.end());
  surface_nodes_.erase(std::unique(surface_nodes_.begin(), surface_nodes_.end()), surface_nodes_.end());
  std::erase_if(surface_nodes_, [&](Index node) { return node >= mesh.n_owned_nodes; });
  configuration_ = std::make_unique<CurrentConfiguration>(*kinematics_);
  graph_ = std::make_unique<ContactGraph>(*kinematics_);
  mechanics_ =
      std::make_unique<MechanicsTerm>(spec_.name, mesh, components_, *configuration_, *graph_, law_, step_,
                                      spec_.stabilisation, spec_.friction && spec_.friction->symmetric);
  if (spec_.heat) {
    heat_law_.emplace(*spec_.heat);
    // The nodal form needs shape functions that are nowhere below zero.
    const bool nodal = spec_.nodal_heat && has_linear_faces(slave) && (!master || has_linear_faces(*master));
    heat_ = std::make_unique<HeatTerm>(mesh, partners_, *graph_, *heat_law_, nodal);
    heat_->set_curvature(curvature_of_points(slave, kind, *kinematics_));
  }
  restore({}, std::vector<double>(mesh.x.size() * static_cast<std::size_t>(components_), 0.0), 0);
}

ContactPair::~ContactPair() = default;

/// A surface that folds on itself is no pair: a point would find its own face as its partner.
void ContactPair::require_apart(const ContactSurface& slave, const ContactSurface& master) const {
  const auto refuse = [this](const std::string& what) {
    throw InputError(spec_.where, fmt::format("contact '{}': {}", spec_.name, what),
                     "two surfaces that have no node in common: contact of a surface with itself is not "
                     "computed, and bodies that touch have nodes of their own ([[interface]] splits them)");
  };
  if (spec_.slave == spec_.master)
    refuse(fmt::format("slave and master are the same surface '{}'", spec_.slave));
  const std::vector<Index>&of_slave = slave.all_nodes(), &of_master = master.all_nodes();
  std::vector<Index> both;
  std::set_intersection(of_slave.begin(), of_slave.end(), of_master.begin(), of_master.end(),
                        std::back_inserter(both));
  const double shared = parallel::global_sum(static_cast<double>(
      std::ranges::count_if(both, [this](Index node) { return node < mesh_.n_owned_nodes; })));
  if (shared > 0)
    refuse(fmt::format("the surfaces '{}' and '{}' share {:.0f} node{}", spec_.slave, spec_.master, shared,
                       shared > 1 ? "s" : ""));
}

void ContactPair::make_kinematics(AnalysisKind kind, const ContactSurface& slave,
                                  const ContactSurface* master) {
  const bool slides = spec_.formulation == Formulation::large_sliding;
  if (master == nullptr && !slides)
    throw InputError(spec_.where, fmt::format("contact '{}': a rigid surface with small sliding", spec_.name),
                     "formulation = \"large_sliding\"");
  if (slides && spec_.integration == IntegrationRule::mortar)
    throw InputError(spec_.where,
                     fmt::format("contact '{}': integration = \"mortar\" with large sliding", spec_.name),
                     "formulation = \"small_sliding\", or integration = \"gauss\" or \"nodal\"");
  touching_ = spec_.touching.value_or(1e-6 * slave.mean_face_size());
  const double reach = spec_.search_distance.value_or(0.1 * slave.extent());
  if (!slides) {
    kinematics_ = std::make_unique<FixedKinematics>(find_points(mesh_, kind, spec_, reach, slave, *master),
                                                    components_);
    return;
  }
  std::unique_ptr<Master> met;
  if (master != nullptr)
    met = std::make_unique<MeshMaster>(
        components_, *master, MeshMasterOptions{.search_distance = reach, .smoothing = spec_.smoothing});
  else
    met = std::make_unique<AnalyticMaster>(components_, *spec_.rigid_master, reach);
  const bool nodal = spec_.integration == IntegrationRule::nodal;
  kinematics_ = std::make_unique<SlidingKinematics>(
      mesh_, kind, slave, std::move(met),
      SlidingOptions{.rule = nodal ? IntegrationRule::nodal : IntegrationRule::gauss,
                     .gauss_degree = spec_.gauss_degree});
}

void ContactPair::make_laws(const ContactSurface& slave, double penalty) {
  law_.normal = {spec_.normal, penalty};
  allowed_penetration_ = spec_.penetration_tolerance * slave.mean_face_size();
  if (!spec_.friction) return;
  const FrictionSpec& friction = *spec_.friction;
  law_.friction.emplace(friction,
                        friction.tangential_penalty.value_or(friction.tangential_penalty_factor * penalty),
                        spec_.interface_heat_capacity);
  law_.wear = spec_.wear;
}

void ContactPair::activate(bool on) {
  active_ = on;
  mechanics_->activate(on);
  if (heat_) heat_->activate(on);
}

linear::Contribution* ContactPair::heat() {
  return heat_.get();
}

std::optional<double> ContactPair::tool_temperature() const {
  return tool_temperature_at(time_);
}

std::optional<double> ContactPair::tool_temperature_at(double time) const {
  if (!spec_.rigid_master || !spec_.rigid_master->temperature) return {};
  return spec_.rigid_master->temperature->value(time);
}

void ContactPair::set_temperature(std::span<const double> temperature) {
  if (step_.coupled.law != nullptr) step_.coupled.temperature.assign(temperature.begin(), temperature.end());
}

void ContactPair::hold_deformation() {
  predicted_.clear();
  if (!has_temperature()) return;
  step_.from = now_.points;
  step_.dt = 0;
  std::vector<HeatPoint> heat;
  for (const PointState& now : now_.points) {
    heat.push_back(heat_point(now, now, {}));
    heat.back().has_temperature = now.temperature > 0;  // it may store what the bodies give
  }
  heat_->place(std::move(heat));
}

bool ContactPair::symmetric() const {
  return spec_.friction ? spec_.friction->symmetric : kinematics_->symmetric();
}

ContactState ContactPair::initial_state() const {
  CurrentConfiguration start(*kinematics_);
  const std::vector<double> rest(mesh_.x.size() * static_cast<std::size_t>(components_), 0.0);
  start.place(0, rest);
  configuration_->forget();
  ContactState state;
  state.points.resize(at(kinematics_->n_points()));
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    PointState& point = state.points[at(p)];
    const ContactKinematics::Particle particle = kinematics_->particle(p);
    point.number = particle.number;
    point.counted = particle.counted;
    const PointMotion motion = kinematics_->motion(p, {}, ContactKinematics::Asked::motion);
    if (!motion.partnered) continue;
    point.anchored = true;
    point.anchor = motion.anchor;
    point.master_normal = motion.master_normal;
    if (std::abs(motion.penetration) <= touching_) point.offset = -motion.penetration;
    point.penetration = motion.penetration + point.offset;
    if (point.penetration < 0) continue;
    point.status = law_.friction ? PointStatus::sticks : PointStatus::slips;
    point.pressure = point.balance_pressure = law_.normal.penalty * point.penetration;
  }
  if (worn_) state.master = worn_->initial_state();
  return state;
}

ContactState ContactPair::renewed_state(const ContactState& old, bool new_slave, bool new_master,
                                        std::span<const double> displacement, double time) const {
  ContactState state = initial_state();
  if (!spec_.rigid_master) {
    configuration_->place(time, displacement);
    for (Index p = 0; p < kinematics_->n_points(); ++p) {
      PointState& point = state.points[at(p)];
      if (!point.anchored) continue;  // without a partner in the drawing
      const PointMotion motion = kinematics_->motion(p, point, ContactKinematics::Asked::motion);
      if (!motion.partnered) continue;
      point.offset = point.penetration - motion.penetration;
      point.anchor = motion.anchor;
      point.master_normal = motion.master_normal;
    }
    configuration_->forget();
  }
  if (old.points.empty()) return state;
  if (!new_slave)
    for (std::size_t p = 0; p < state.points.size(); ++p)
      for (auto field : {&PointState::internal_variable, &PointState::slip, &PointState::work,
                         &PointState::dissipation, &PointState::wear_depth, &PointState::plastic_entropy})
        state.points[p].*field = old.points[p].*field;
  if (!new_master) state.master = old.master;
  return state;
}

void ContactPair::set_out_from(const ContactState& state) {
  start_traction_.clear();
  last_penetration_.clear();
  if (!state.points.empty()) {
    step_.from = state.points;
    worn_from_ = state.master;
    return;
  }
  ContactState initial = initial_state();
  step_.from = std::move(initial.points);
  worn_from_ = std::move(initial.master);
}

void ContactPair::begin(const ContactState& old, const ContactPass& pass) {
  set_out_from(old);
  step_.dt = pass.dt;
  step_.time = pass.time;
  step_.displacement.assign(pass.displacement.begin(), pass.displacement.end());
  step_.begun = pass.time - pass.dt;
  find_wet_points(pass.coherency);
  law_.isentropic = pass.isentropic;
  law_.share = pass.share;
  step_.coupled = {};
  if (pass.simultaneous && heat_law_ && law_.friction)
    step_.coupled = {.law = &*heat_law_,
                     .time_step = pass.dt,
                     .temperature = {pass.temperature.begin(), pass.temperature.end()},
                     .tool_temperature = tool_temperature_at(pass.time)};
  if ((law_.friction || has_temperature()) && !pass.temperature.empty())
    find_interface_temperatures(pass.temperature);
  step_.iterate.clear();
  if (pass.iterate == nullptr || pass.iterate->points.size() != step_.from.size()) return;
  for (std::size_t p = 0; p < step_.from.size(); ++p) {
    const PointState &before = pass.iterate->points[p], &from = step_.from[p];
    step_.iterate.push_back(
        {before.temperature > 0 ? before.temperature : from.temperature, before.internal_variable});
    step_.from[p].multiplier = std::max(before.multiplier, least_multiplier(from));
  }
}

void ContactPair::rest(const ContactState& old, double time, double dt, std::span<const double> temperature) {
  const std::vector<double> displacement(mesh_.x.size() * static_cast<std::size_t>(components_), 0.0);
  begin(old, {.time = time, .dt = dt, .displacement = displacement, .temperature = temperature});
  update(displacement);
}

/// Liquid metal that touches its wall wets it; it stays wet while the metal there is below coherency,
/// whatever gap opens. A gap that was there before, or that a coherent skin has left, holds air until it
/// closes.
void ContactPair::find_wet_points(std::span<const double> coherency) {
  const auto molten = [](double c) { return c < k_coherent; };
  const bool any = active_ && spec_.atmosphere > 0 && std::ranges::any_of(coherency, molten);
  if (any) configuration_->place(step_.begun, step_.displacement);
  step_.liquid.assign(step_.from.size(), 0);
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    PointState& from = step_.from[at(p)];
    const bool touched = from.status != PointStatus::open || from.suction > 0;
    from.suction = 0;
    if (any && touched) {
      const PointMotion motion = kinematics_->motion(p, from, ContactKinematics::Asked::motion);
      const Skin skin = motion.partnered ? skin_at(motion, coherency) : Skin{};
      if (skin.wet) from.suction = spec_.atmosphere;
      step_.liquid[at(p)] = skin.wet && skin.liquid;
    }
    from.multiplier = std::max(from.multiplier, least_multiplier(from));
  }
}

void ContactPair::update(std::span<const double> displacement) {
  displacement_.assign(displacement.begin(), displacement.end());
  time_ = step_.time;
  configuration_->place(time_, displacement_);
  if (heat_) heat_->set_tool_temperature(tool_temperature());
  const bool fixed = !kinematics_->partners_change() && partners_.n_points() > 0;
  if (!fixed) partners_.clear();
  now_.points.resize(step_.from.size());
  now_.master = worn_from_;
  std::vector<HeatPoint> heat;
  if (heat_) heat.reserve(now_.points.size());
  before_heat_.resize(now_.points.size());
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    const PointState& from = step_.from[at(p)];
    const PointMotion motion = kinematics_->motion(p, from, ContactKinematics::Asked::motion);
    const PointForces forces =
        active_ ? law_.forces(motion, from, step_.coupled.around(motion), step_.iterate_of(p))
                : PointForces{};
    now_.points[at(p)] = law_.next(motion, from, forces);
    if (!active_) now_.points[at(p)].anchored = false;
    if (worn_ && forces.status == PointStatus::slips) wear_master(motion, now_.points[at(p)], forces);
    if (!fixed) partners_.add(motion, kinematics_->particle(p).counted);
    before_heat_[at(p)] = now_.points[at(p)].temperature;
    if (heat_) heat.push_back(heat_point(from, now_.points[at(p)], forces));
    if (predicted_.empty() || !heat_) continue;
    heat.back().step.dissipation -= predicted_[at(p)][0];
    heat.back().step.structural_entropy -= predicted_[at(p)][1];
  }
  if (heat_) heat_->place(std::move(heat));
}

void ContactPair::wear_master(const PointMotion& motion, const PointState& now, const PointForces& forces) {
  const WearSpec& wear = *law_.wear;
  const double depth = wear.depth_increment(forces.normal.pressure, forces.friction.slip, now.temperature);
  worn_->add(motion, wear.master_share * depth, forces.friction.dissipation, now_.master);
}

HeatPoint ContactPair::heat_point(const PointState& from, const PointState& now,
                                  const PointForces& forces) const {
  // A point with a pressure is closed, whatever its penetration: a multiplier may carry the pressure where
  // penetration and gap are of the size of the tolerance.
  const double penetration = now.pressure > 0 ? std::max(now.penetration, 0.0) : now.penetration;
  HeatPoint point{.penetration = seen_by_heat(penetration, now.suction),
                  .pressure = now.pressure,
                  .pressure_slope = now.pressure >= 0 ? forces.normal.tangent : 0.0,
                  .has_temperature = has_temperature() && step_.dt > 0 && from.temperature > 0,
                  .step = {},
                  .joint = forces.joint};
  // 5.40 anew in the thermal phase; the other schemes have solved it, or iterate to it.
  if (law_.friction && spec_.friction->thermal_return_mapping && step_.coupled.law == nullptr &&
      step_.iterate.empty() && forces.status != PointStatus::open) {
    point.friction = &*law_.friction;
    point.slip = {forces.trial, std::max(now.pressure, 0.0), from.internal_variable, from.temperature};
  }
  point.step = {step_.dt, spec_.interface_heat_capacity, from.temperature, forces.friction.structural_entropy,
                forces.friction.dissipation};
  return point;
}

/// Sets the heat for results to that of both passes, over the time of both.
void ContactPair::show_whole_step() {
  std::vector<HeatPoint> heat = heat_->points();
  for (std::size_t p = 0; p < heat.size(); ++p) {
    heat[p].step.time_step *= 2;
    heat[p].step.dissipation += 2 * predicted_[p][0];
    heat[p].step.structural_entropy += 2 * predicted_[p][1];
  }
  heat_->place(std::move(heat));
  predicted_.clear();
}

void ContactPair::restore(const ContactState& state, std::span<const double> displacement, double time) {
  set_out_from(state);
  step_.time = step_.begun = time;
  step_.dt = 0;
  step_.coupled = {};
  step_.iterate.clear();
  predicted_.clear();
  if (heat_) heat_->end_phase();
  step_.displacement.assign(displacement.begin(), displacement.end());
  const ContactState stands{step_.from, worn_from_};
  update(displacement);
  now_.master = worn_from_;
  // The heat points follow from the motion alone: the effect of the last step is in the state.
  std::vector<HeatPoint> heat;
  for (std::size_t p = 0; p < now_.points.size(); ++p) {
    const double penetration = now_.points[p].penetration;
    now_.points[p] = stands.points[p];
    now_.points[p].penetration = penetration;
    heat.push_back(heat_point(step_.from[p], now_.points[p], {}));
    if (active_) continue;
    now_.points[p].status = PointStatus::open;
    now_.points[p].pressure = now_.points[p].balance_pressure = now_.points[p].multiplier = 0;
    now_.points[p].suction = 0;
    now_.points[p].traction = {};
    now_.points[p].anchored = false;
  }
  if (heat_) heat_->place(std::move(heat));
}

std::string ContactPair::failure_text() const {
  const FrictionStatus failure = mechanics_->failure();
  if (parallel::any_process(failure != FrictionStatus::converged)) {
    const double worst = parallel::global_max(static_cast<double>(failure));
    return fmt::format("contact '{}': {}", spec_.name,
                       reason(static_cast<FrictionStatus>(std::lround(worst))));
  }
  const GlobalIndex n = changes();
  if (n == 0) return {};
  return fmt::format("contact '{}': {} points still change between open, sticking and slipping", spec_.name,
                     n);
}

GlobalIndex ContactPair::changes() const {
  return std::llround(parallel::global_sum(static_cast<double>(mechanics_->changes())));
}

std::size_t ContactPair::bytes() const {
  return partners_.bytes() + start_traction_.capacity() * sizeof(Point) +
         (now_.points.capacity() + step_.from.capacity()) * sizeof(PointState) + mechanics_->bytes() +
         (heat_ ? heat_->bytes() : 0);
}

}  // namespace solidus::contact
