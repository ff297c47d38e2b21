/// The conditions of a bound on the functional are checked one group after the other; the first that fails
/// is the answer.
#include "setup/admissible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/stage_input.hpp"
#include "input/units.hpp"
#include "setup/dynamics_input.hpp"

namespace solidus::setup {

namespace {

bool steady(const Function& f) {
  return f.place == nullptr && f.table.min_value() == f.table.max_value();
}
bool zero(const Function& f) {
  return steady(f) && f.table.min_value() == 0;
}
bool moves(const std::optional<Function>& f) {
  return f && !zero(*f);
}

/// The temperature that a condition surrounds its surface with; none for fluxes and sources.
const Function* surroundings(const cases::ThermalConditionSpec& c) {
  using Kind = cases::ThermalConditionSpec::Kind;
  switch (c.kind) {
    case Kind::temperature:
      return &c.temperature;
    case Kind::film:
    case Kind::radiation:
      return &c.ambient;
    case Kind::flux:
    case Kind::source:
    case Kind::exothermic:
      break;
  }
  return nullptr;
}

/// Returns all temperatures at which conditions and tools exchange heat, with their names.
std::vector<std::pair<std::string, const Function*>> all_surroundings(const cases::CaseSpec& spec) {
  std::vector<std::pair<std::string, const Function*>> all;
  for (const auto& c : spec.thermal_conditions)
    if (const Function* around = surroundings(c)) all.emplace_back(c.name, around);
  for (const auto& s : spec.rigid_surfaces)
    if (s.temperature) all.emplace_back(s.name, &*s.temperature);
  return all;
}

constexpr double k_same = 1e-6;  // [K]: rounding of units

std::optional<double> common_ambient(const cases::CaseSpec& spec) {
  std::optional<double> common;
  for (const auto& [name, around] : all_surroundings(spec)) {
    const double here = around->table.min_value();
    if (!steady(*around) || std::abs(here - common.value_or(here)) > k_same) return {};
    common = here;
  }
  return common;
}

double coldest_body(const cases::CaseSpec& spec, double low) {
  for (const cases::BodySpec& body : spec.bodies)
    if (body.initial_temperature.place == nullptr)
      low = std::min(low, body.initial_temperature.table.value(0));
  return low;
}

void check_heat(const cases::CaseSpec& spec, Admissibility& a) {
  using Kind = cases::ThermalConditionSpec::Kind;
  // No heat may come from outside but through surroundings, and these must all have the one ambient
  // temperature, which does not change.
  for (const auto& c : spec.thermal_conditions) {
    if (c.kind == Kind::flux && !zero(c.flux))
      a.violations.push_back(fmt::format("'{}' is a flux", c.name));
    else if (c.kind == Kind::source && !zero(c.power))
      a.violations.push_back(fmt::format("'{}' is a source", c.name));
    else if (c.kind == Kind::exothermic)
      a.violations.push_back(fmt::format("'{}' burns", c.name));
  }
  for (const cases::ChannelSpec& channel : spec.channels)
    a.violations.push_back(fmt::format("'{}' is a channel", channel.name));
  for (const cases::SourceSpec& source : spec.sources)
    a.violations.push_back(fmt::format("'{}' is a source", source.name));
  for (const auto& [name, around] : all_surroundings(spec)) {
    if (!steady(*around))
      a.violations.push_back(fmt::format("the temperature of '{}' varies", name));
    else if (std::abs(around->table.min_value() - a.ambient_temperature) > k_same)
      a.violations.push_back(fmt::format("the temperature of '{}' is not the ambient one, {:.6g} degC", name,
                                         a.ambient_temperature - k_zero_celsius));
  }
}

/// A support at a given place that is put on in a later stage pulls the body there.
bool begins_later(const cases::CaseSpec& spec, const cases::MechanicalConditionSpec& c) {
  if (c.kind != cases::MechanicalConditionSpec::Kind::displacement || c.relative) return false;
  bool before = true;
  for (const cases::StageRun& run : cases::stage_runs(spec)) {
    const bool now = cases::holds(c.stages, &run);
    if (now && !before) return true;
    before = now;
  }
  return false;
}

void check_mechanics(const cases::CaseSpec& spec, Admissibility& a) {
  using Kind = cases::MechanicalConditionSpec::Kind;
  // Supports must not move and loads must not vary, so that the work of the loads has a potential.
  for (const auto& c : spec.mechanical_conditions) {
    if (c.kind == Kind::displacement && (moves(c.ux) || moves(c.uy) || moves(c.uz) || moves(c.ur)))
      a.violations.push_back(fmt::format("the support '{}' moves", c.name));
    else if (begins_later(spec, c))
      a.violations.push_back(fmt::format("the support '{}' is put on in a later stage", c.name));
    // A load of one number that holds at all times has a potential, and its work is counted there.
    const auto all_steady = [](const std::vector<Function>& of) { return std::ranges::all_of(of, steady); };
    const bool varies = (c.kind == Kind::pressure && !steady(c.pressure)) ||
                        (c.kind == Kind::traction && !all_steady(c.traction)) ||
                        (c.kind == Kind::body_force && !all_steady(c.force)) ||
                        (c.kind == Kind::metallostatic && !(steady(c.level) && steady(c.squeeze)));
    if (varies) a.violations.push_back(fmt::format("the load '{}' varies", c.name));
  }
  if (spec.rotation && !steady(spec.rotation->omega))
    a.violations.emplace_back("the speed of rotation varies");
  for (const auto& s : spec.rigid_surfaces)
    if (moves(s.ux) || moves(s.uy) || moves(s.uz) || moves(s.rotation))
      a.violations.push_back(fmt::format("the rigid surface '{}' moves", s.name));
}

void check_integration(const cases::CaseSpec& spec, Admissibility& a) {
  const bool second_order = spec.coupling.scheme->traits().second_order ||
                            spec.mechanics.integration == mechanics::TimeIntegration::two_step;
  if (second_order) a.violations.push_back("nothing is proved for a time integration of second order");
  if (spec.dynamics && spec.dynamics->method != cases::DynamicsSpec::Method::backward_euler)
    a.violations.push_back(
        fmt::format("nothing is proved for the integration of inertia by {}", method_name(*spec.dynamics)));
}

}  // namespace

Admissibility admissibility(const cases::CaseSpec& spec, double coldest) {
  Admissibility a;
  if (spec.coupling.ambient_temperature)
    a.ambient_temperature = *spec.coupling.ambient_temperature;
  else
    a.ambient_temperature = common_ambient(spec).value_or(coldest_body(spec, coldest));
  check_heat(spec, a);
  check_mechanics(spec, a);
  check_integration(spec, a);
  return a;
}

}  // namespace solidus::setup
