/// The case's choices become options of the criteria, with what bodies and gravity add to them.
#include "setup/criteria_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "cases/case_materials.hpp"
#include "criteria/criteria.hpp"
#include "criteria/criterion_kind.hpp"
#include "parallel/parallel.hpp"
#include "setup/cast_bodies.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/rotation_input.hpp"

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
  // A surface that feeds is an open one.
  if (options.vented.empty())
    for (const std::string& feeder : spec.criteria.feeders)
      if (mesh.surfaces.contains(feeder)) options.vented.push_back(feeder);
  // Risers by role or by name, as everywhere else.
  for (const results::CastBody& cast : cast_bodies(spec, materials, start))
    if (cast.feeds) options.risers[static_cast<std::size_t>(cast.body)] = 1;
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

std::unique_ptr<criteria::Criteria> make_criteria(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                                  const std::vector<material::Material>& materials,
                                                  const std::vector<InitialTemperatureRange>& start,
                                                  const LocalLaws& laws, const coupling::Phases& phases) {
  if (!follows(spec, materials)) return nullptr;
  // What every criterion may ask for, gathered once: mesh, materials, phases and the options of the
  // case.
  const std::vector<char> followed = followed_bodies(spec, materials, start);
  if (spec.feeding.moves_heat) check_one_alloy(spec, followed);
  // What a body that grows is fed from changes with it, which feeding and gas do not follow.
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
      .names = names_of_bodies(spec)};
  auto all = std::make_unique<criteria::Criteria>(phases.heat);
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
