/// The case's choices become options of the criteria, with what bodies and gravity add to them.
#include "setup/criteria_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "cases/case_materials.hpp"
#include "cases/roles.hpp"
#include "contact/nodal_wear.hpp"
#include "contact/pair.hpp"
#include "criteria/criteria.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/die_nodes.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/cast_bodies.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/rotation_input.hpp"
#include "setup/skin_measures.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

/// The direction against gravity, also where its magnitude is zero, as it is with heat alone.
std::array<double, 3> upward(const cases::AnalysisSpec& analysis) {
  cases::AnalysisSpec unit = analysis;
  unit.gravity = 1;
  std::array<double, 3> up = gravity(unit);
  for (double& component : up) component = -component;
  return up;
}

/// The axis of what turns so fast that its weight does not matter: at its rim it weighs twice and more what
/// it does at rest. Collective.
std::optional<criteria::AxisOfTurning> axis_of_turning(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  constexpr double k_weight = 9.81, k_fast = 2;
  const mechanics::Turning about = turning(spec);
  double squared_radius = 0;
  for (const mesh::Point& x : mesh.x) squared_radius = std::max(squared_radius, about.squared_radius(x));
  const double at_rim = about.omega * about.omega * std::sqrt(parallel::global_max(squared_radius));
  if (at_rim < k_fast * (spec.analysis.gravity > 0 ? spec.analysis.gravity : k_weight)) return std::nullopt;
  return criteria::AxisOfTurning{about.axis, about.point};
}

/// That of the case, else of the mould that gives way most.
double mould_rigidity(const cases::CaseSpec& spec, const std::vector<material::Material>& materials) {
  if (spec.feeding.mould_rigidity) return *spec.feeding.mould_rigidity;
  double least = 1;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (spec.bodies[b].role == cases::Role::mould) least = std::min(least, materials[b].casting.rigidity);
  return least;
}

/// The skin that each followed body has against bodies that are not cast, by contacts [body] [m²]. Throws
/// InputError where there is no iron, and for an iron without such a skin. Collective.
std::vector<double> walled_skins(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                 const std::vector<material::Material>& materials,
                                 const std::vector<char>& followed) {
  const auto cast = [&](int body) { return body >= 0 && followed[as_size(body)] != 0; };
  const auto iron = [&](std::size_t b) { return followed[b] != 0 && materials[b].graphite; };
  // Without an iron the key would do nothing.
  std::vector<double> skins(spec.bodies.size(), 0.0);
  bool any_iron = false;
  for (std::size_t b = 0; b < skins.size(); ++b) any_iron = any_iron || iron(b);
  if (!any_iron)
    throw InputError(spec.feeding.where, "feeding.wall_movement: nothing that is cast has graphite",
                     "an iron whose card has [graphite], or no wall_movement");
  for (const cases::ContactSpec& contact : spec.contacts) {
    // The side of the casting counts where the other side of the contact is a wall.
    std::array<SurfaceMeasures, 2> sides;
    for (std::size_t side = 0; side < 2; ++side)
      sides[side] = measure_surface(mesh, contact.sides()[side], spec.analysis.kind);
    for (std::size_t side = 0; side < 2; ++side)
      if (cast(sides[side].body) && !cast(sides[1 - side].body))
        skins[as_size(sides[side].body)] += sides[side].area;
  }
  // An iron that no contact surrounds has no modulus.
  for (std::size_t b = 0; b < skins.size(); ++b)
    if (iron(b) && !(skins[b] > 0))
      throw InputError(
          spec.feeding.where,
          fmt::format("feeding.wall_movement: no mould touches '{}', whose graphite could move it",
                      spec.bodies[b].name),
          "a contact or an [[interface]] of it with a mould, or no wall_movement");
  return skins;
}

criteria::FeedingOptions feeding_options(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                         const std::vector<material::Material>& materials,
                                         const std::vector<InitialTemperatureRange>& start) {
  // Which bodies are followed, what is up, and which surfaces air can enter by.
  criteria::FeedingOptions options{.bodies = followed_bodies(spec, materials, start),
                                   .risers = std::vector<char>(spec.bodies.size(), 0),
                                   .up = upward(spec.analysis),
                                   .turning = axis_of_turning(spec, mesh),
                                   .vented = spec.feeding.vented,
                                   .covered = spec.feeding.covered,
                                   .mould_rigidity = mould_rigidity(spec, materials),
                                   .gas = {.follow = spec.gas.follow && spec.depositions.empty(),
                                           .content = spec.gas.content,
                                           .ambient_pressure = spec.gas.ambient_pressure}};
  if (spec.feeding.wall_movement) {
    options.wall_movement = *spec.feeding.wall_movement;
    options.walled = walled_skins(spec, mesh, materials, options.bodies);
  }
  // A surface that feeds is an open one.
  if (options.vented.empty())
    for (const std::string& feeder : spec.criteria.feeders)
      if (mesh.surfaces.contains(feeder)) options.vented.push_back(feeder);
  // Risers by role or by name, as everywhere else.
  for (const results::CastBody& cast : cast_bodies(spec, materials, start))
    if (cast.feeds) options.risers[as_size(cast.body)] = 1;
  // Skins that something touches or cools are no free surfaces.
  for (const cases::ContactSpec& contact : spec.contacts)
    for (const std::string& side : contact.sides()) options.touched.insert(side);
  for (const cases::ThermalConditionSpec& condition : spec.thermal_conditions)
    options.cooled.insert(condition.group);
  return options;
}

/// Criteria follow transient runs in which something melts.
bool follows(const cases::CaseSpec& spec, const std::vector<material::Material>& materials) {
  return spec.criteria.follow && !spec.time.steady &&
         std::ranges::any_of(materials,
                             [](const material::Material& m) { return m.solidification() != nullptr; });
}

/// Metal that moves has one mean heat, which has no meaning for two alloys.
void check_one_alloy(const cases::CaseSpec& spec, const std::vector<char>& followed) {
  const cases::BodySpec* first = nullptr;
  for (std::size_t b = 0; b < followed.size(); ++b) {
    if (followed[b] == 0) continue;
    if (first != nullptr && spec.bodies[b].material != first->material)
      throw InputError(
          spec.feeding.where,
          fmt::format("feeding.moves_heat: '{}' and '{}' are of two materials, '{}' and '{}'", first->name,
                      spec.bodies[b].name, first->material, spec.bodies[b].material),
          "one alloy in all that is cast, or moves_heat = false");
    if (first == nullptr) first = &spec.bodies[b];
  }
}

/// The names of bodies, by which findings of one body are told.
std::vector<std::string> names_of_bodies(const cases::CaseSpec& spec) {
  std::vector<std::string> names;
  for (const auto& body : spec.bodies) names.push_back(body.name);
  return names;
}

criteria::FatigueLaw fatigue_law(const cases::CaseSpec& spec, const cases::DieLifeSpec& d,
                                 const cases::BodySpec& body) {
  criteria::FatigueLaw law{.strength = d.strength,
                           .modulus = d.modulus,
                           .strength_exponent = d.strength_exponent,
                           .ductility = d.ductility,
                           .ductility_exponent = d.ductility_exponent,
                           .mean_stress = d.mean_stress};
  if (d.law == cases::DieLifeSpec::Law::table) {
    law.strain.assign(d.cycles.table.x().begin(), d.cycles.table.x().end());
    law.cycles.assign(d.cycles.table.y().begin(), d.cycles.table.y().end());
  }
  law.deforms = spec.has_mechanics() && !cases::only_conducts(body);
  logging::info("life of '{}': thermal fatigue by {}{}; range of strain {}", body.name,
                d.law == cases::DieLifeSpec::Law::table ? "a table" : "Coffin, Manson and Basquin",
                d.source.empty() ? ", constants without a source" : ", constants of " + d.source,
                law.deforms
                    ? "of its deformation, between its hottest and its coldest moment"
                    : "of a fully restrained surface, an upper bound: the computed life is too short");
  return law;
}

/// The fatigue of each body, in the order of the case's bodies. Throws InputError.
std::vector<std::optional<criteria::FatigueLaw>> fatigue_laws(const cases::CaseSpec& spec) {
  std::vector<std::optional<criteria::FatigueLaw>> laws(spec.die_lives.empty() ? 0 : spec.bodies.size());
  for (const cases::DieLifeSpec& d : spec.die_lives)
    for (std::size_t b = 0; b < laws.size(); ++b)
      if (spec.bodies[b].mesh_group() == d.body && d.law != cases::DieLifeSpec::Law::none)
        laws[b] = fatigue_law(spec, d, spec.bodies[b]);
  return laws;
}

/// Whether a surface that wears has nodes of a body. Collective.
bool wears(const cases::CaseSpec& spec, const mesh::Mesh& mesh, std::size_t body) {
  std::vector<char> followed(spec.bodies.size(), 0);
  followed[body] = 1;
  // A side of a contact counts where its surface has a node of the body.
  const std::vector<int> of_body = criteria::die_nodes(mesh, followed);
  bool here = false;
  for (const cases::ContactSpec& c : spec.contacts) {
    if (!c.wear) continue;
    // The slave loses what the master does not; of two surfaces without roles either may be the slave.
    std::vector<std::string> sides;
    if (!c.surfaces.empty() || c.wear->master_share < 1) sides.push_back(c.sides()[0]);
    if (!c.surfaces.empty() || c.wear->master_share > 0) sides.push_back(c.sides()[1]);
    for (const std::string& side : sides)
      if (const auto found = mesh.surfaces.find(side); found != mesh.surfaces.end())
        here = here || std::ranges::any_of(found->second.nodes,
                                           [&](Index node) { return of_body[as_size(node)] >= 0; });
  }
  return parallel::any_process(here);
}

/// The limits of each body, in the order of the case's bodies. Throws InputError. Collective.
std::vector<criteria::DieLimits> die_limits(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  std::vector<criteria::DieLimits> limits(spec.die_lives.empty() ? 0 : spec.bodies.size());
  for (const cases::DieLifeSpec& d : spec.die_lives)
    for (std::size_t b = 0; b < limits.size(); ++b) {
      if (spec.bodies[b].mesh_group() != d.body) continue;
      limits[b] = {d.worn_depth, d.soldering_temperature};
      if (d.worn_depth && !wears(spec, mesh, b))
        throw InputError(d.where, fmt::format("[[die_life]] of '{}': no contact wears this body", d.body),
                         "[contact.wear] on a [[contact]] with a surface of the body: master_share of the "
                         "master, the rest of the slave");
    }
  return limits;
}

/// The depth of wear of all pairs at the end of their step, [local node].
std::vector<double> wear_of(const mesh::Mesh& mesh, const std::vector<contact::ContactPair*>& pairs) {
  std::vector<double> depth(mesh.x.size(), 0.0);
  for (const contact::ContactPair* pair : pairs) contact::take_wear(pair->view(), depth);
  return depth;
}

/// A [[die_life]] asks for something, which the analysis has.
void check_limits(const cases::CaseSpec& spec, const cases::DieLifeSpec& d) {
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    throw InputError(d.where, fmt::format("[[die_life]] of '{}': {}", d.body, what), allowed);
  };
  if (d.law == cases::DieLifeSpec::Law::none && !d.worn_depth && !d.soldering_temperature)
    refuse("it asks for nothing", "a law of fatigue, worn_depth or soldering_temperature");
  if (d.worn_depth && !spec.has_mechanics())
    refuse("wear in an analysis of heat alone", "physics = \"thermomechanical\", or no worn_depth");
}

}  // namespace

LocalLaws local_laws(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                     const std::vector<InitialTemperatureRange>& start) {
  LocalLaws laws(spec.bodies.size());
  if (!follows(spec, materials)) return laws;
  const std::vector<char> followed = followed_bodies(spec, materials, start);
  const std::vector<std::filesystem::path> folders = cases::material_folders();
  for (std::size_t b = 0; b < laws.size(); ++b)
    if (followed[b] != 0)
      laws[b] = material::find_local_laws(spec.bodies[b].material, folders, spec.bodies[b].where);
  return laws;
}

void check_die_lives(const cases::CaseSpec& spec) {
  std::vector<std::string> seen;
  for (const cases::DieLifeSpec& d : spec.die_lives) {
    const auto refuse = [&](const std::string& what, const std::string& allowed) {
      throw InputError(d.where, fmt::format("[[die_life]] of '{}': {}", d.body, what), allowed);
    };
    if (std::ranges::none_of(spec.bodies, [&](const auto& b) { return b.mesh_group() == d.body; }))
      refuse("there is no such body", "the group of a [[body]]");
    if (std::ranges::find(seen, d.body) != seen.end()) refuse("it is given twice", "one for each body");
    seen.push_back(d.body);
    if (!spec.has_heat() || !spec.criteria.follow || spec.time.steady)
      refuse("no criteria of heat are followed",
             "a transient run with heat, and follow = true in [criteria]");
    if (!spec.depositions.empty()) refuse("not with bodies that grow yet", "a case without [[deposition]]");
    check_limits(spec, d);
    if (d.law == cases::DieLifeSpec::Law::none) continue;
    if (d.law == cases::DieLifeSpec::Law::coffin_manson) {
      if (d.mean_stress >= d.strength) refuse("its mean stress breaks it", "below fatigue_strength");
      continue;
    }
    const std::span<const double> x = d.cycles.table.x(), y = d.cycles.table.y();
    if (x.size() < 2 || x.front() <= 0)
      refuse("its table has no two ranges of strain above zero", "points = [[0.004, 20000], [0.01, 800]]");
    for (std::size_t i = 1; i < y.size(); ++i)
      if (y[i] >= y[i - 1])
        refuse(fmt::format("its cycles do not fall from {:g} to {:g} with the strain", y[i - 1], y[i]),
               "fewer cycles for more strain");
  }
}

std::unique_ptr<criteria::Criteria> make_criteria(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                                  const std::vector<material::Material>& materials,
                                                  const std::vector<InitialTemperatureRange>& start,
                                                  const LocalLaws& laws, const coupling::Phases& phases,
                                                  const mesh::Mesh* all_elements) {
  if (!follows(spec, materials)) return nullptr;
  // What every criterion may ask for, gathered once: mesh, materials, phases and the options of the
  // case.
  const std::vector<char> followed = followed_bodies(spec, materials, start);
  if (spec.feeding.moves_heat) check_one_alloy(spec, followed);
  // The melt that can feed a growing body changes with it, which feeding and gas do not follow.
  const bool whole = spec.depositions.empty();
  const criteria::CriterionContext context{
      .mesh = mesh,
      .kind = spec.analysis.kind,
      .materials = materials,
      .heat = phases.heat,
      .mechanics = phases.mechanics != nullptr,
      .temperature = phases.heat != nullptr ? std::vector<double>{} : phases.temperature,
      .followed = followed,
      .evaluation = spec.criteria.evaluation,
      .feeding_limit = spec.criteria.feeding_limit,
      .feeders = spec.criteria.feeders,
      .feeding = spec.feeding.follow && whole,
      .feeding_options = feeding_options(spec, mesh, materials, start),
      .local_laws = laws,
      .names = names_of_bodies(spec),
      .fatigue = fatigue_laws(spec),
      .die_limits = die_limits(spec, mesh),
      .all_elements = all_elements};
  auto all = std::make_unique<criteria::Criteria>(phases.heat);
  if (std::ranges::any_of(spec.die_lives, [](const auto& d) { return d.worn_depth.has_value(); }))
    all->follow_wear([&mesh, pairs = phases.contacts] { return wear_of(mesh, pairs); });
  // A mistake in a criterion's options is told with the place of the section that it belongs to.
  for (const auto& kind : criteria::criterion_kinds()) {
    try {
      if (std::unique_ptr<criteria::Criterion> criterion = kind->make(context))
        all->add(std::move(criterion));
    } catch (const InputError& error) {
      const bool of_feeding = std::string_view(error.what()).starts_with("feeding.");
      throw InputError(of_feeding ? spec.feeding.where : spec.criteria.where, error.what(),
                       "groups of the mesh: `solidus mesh-info` lists them");
    }
  }
  return all;
}

}  // namespace solidus::setup
