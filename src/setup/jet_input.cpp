#include "setup/jet_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "heat/loads/impinging_jet.hpp"
#include "heat/loads/shot_sleeve.hpp"
#include "setup/section_names.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

constexpr double k_zero_celsius = 273.15;

/// Throws InputError where a number of a jet is beyond the range of the correlation.
void check_range(const cases::JetSpec& jet, const char* what, double value, double least, double largest) {
  if (value >= least && value <= largest) return;
  throw InputError(jet.where, fmt::format("the jet '{}' has {} of {:.4g}", jet.name, what, value),
                   fmt::format("{:g} to {:g}, the range of Martin's correlation", least, largest));
}

Function constant(double value, const SourceLocation& where) {
  Function f;
  f.table = Table(value);
  f.where = where;
  return f;
}

const cases::ShotSleeveSpec* sleeve_of(const cases::CaseSpec& spec, const cases::BodySpec& body) {
  const auto found = std::ranges::find(spec.shot_sleeves, body.name, &cases::ShotSleeveSpec::body);
  return found == spec.shot_sleeves.end() ? nullptr : &*found;
}

}  // namespace

void add_jets(cases::CaseSpec& spec) {
  check_names(spec.jets, "[[jet]]");
  const heat::ChannelFluid& water = heat::water();
  for (const cases::JetSpec& j : spec.jets) {
    if (!spec.has_heat())
      throw InputError(j.where,
                       fmt::format("the jet '{}' cools, and there is no heat in this analysis", j.name),
                       "physics = \"heat\" or \"thermomechanical\"");
    check_range(j, "an inlet temperature in degC", j.inlet - k_zero_celsius, 0, 250);
    // The correlation holds for a range of flows, distances and radii.
    const heat::ImpingingJet jet{j.nozzle, j.distance, j.radius, j.flow, j.inlet};
    const double reynolds = heat::reynolds(jet, water);
    check_range(j, "a Reynolds number", reynolds, heat::k_jet_least_reynolds, heat::k_jet_largest_reynolds);
    check_range(j, "a distance over the nozzle's diameter", j.distance / j.nozzle, heat::k_jet_least_distance,
                heat::k_jet_largest_distance);
    check_range(j, "(nozzle/(2 radius))^2", heat::area_ratio(jet), heat::k_jet_least_area,
                heat::k_jet_largest_area);
    const double coefficient = heat::film_coefficient(jet, water);
    logging::info("jet '{}': Re = {:.0f}, {:.0f} W/(m2 K) within {:.3g} mm by Martin's correlation", j.name,
                  reynolds, coefficient, 1e3 * j.radius);
    // From here on it is a film like others.
    cases::ThermalConditionSpec film;
    film.name = j.name;
    film.group = j.group;
    film.kind = cases::ThermalConditionSpec::Kind::film;
    film.coefficient = constant(coefficient, j.where);
    film.ambient = constant(j.inlet, j.where);
    film.factor = constant(1, j.where);
    film.stages = j.stages;
    film.where = j.where;
    spec.thermal_conditions.push_back(std::move(film));
  }
}

void check_shot_sleeves(const cases::CaseSpec& spec) {
  for (const cases::ShotSleeveSpec& s : spec.shot_sleeves) {
    const auto refuse = [&](const std::string& what, const std::string& allowed) {
      throw InputError(s.where, fmt::format("[[shot_sleeve]] of '{}': {}", s.body, what), allowed);
    };
    const auto body = std::ranges::find(spec.bodies, s.body, &cases::BodySpec::name);
    if (body == spec.bodies.end()) refuse("there is no such body", "the name of a [[body]]");
    if (std::ranges::count(spec.shot_sleeves, s.body, &cases::ShotSleeveSpec::body) > 1)
      refuse("it is given twice", "one for each body");
    if (!spec.has_heat())
      refuse("there is no heat in this analysis", "physics = \"heat\" or \"thermomechanical\"");
    if (body->initial_temperature.place != nullptr)
      refuse("the body has temperatures by place", "initial_temperature = \"680 degC\", one number");
    if (spec.filling) refuse("not along with [filling], which begins at the gate", "filling.temperature");
    if (s.temperature >= body->initial_temperature.table.value(0))
      refuse("its wall is hotter than the metal", "a temperature below initial_temperature");
  }
}

double temperature_in_die(const cases::CaseSpec& spec, const cases::BodySpec& body,
                          const material::Material& material) {
  // Without a sleeve the metal is in the die as it was poured.
  const double poured = body.initial_temperature.table.value(0);
  const cases::ShotSleeveSpec* s = sleeve_of(spec, body);
  if (s == nullptr) return poured;
  const heat::ShotSleeve sleeve{s->diameter, s->length, s->filling, s->time, s->temperature, s->coefficient};
  const double after = heat::temperature_after(sleeve, material.enthalpy(), poured);
  logging::info("body '{}': {:.1f} degC when it is poured into the shot sleeve, {:.1f} degC in the die",
                body.name, poured - k_zero_celsius, after - k_zero_celsius);
  // Metal that froze in the sleeve could not fill the die; a little solid is worth a warning.
  const material::PhaseChange* freezing = material.solidification();
  if (freezing == nullptr) return after;
  if (after <= freezing->fraction.solidus())
    throw InputError(
        s->where,
        fmt::format("'{}' is solid before it is in the die, {:.1f} degC", body.name, after - k_zero_celsius),
        "less time, a lower coefficient or a hotter sleeve");
  if (after < freezing->fraction.liquidus())
    logging::warn("body '{}' begins to freeze in its shot sleeve: it is below its liquidus of {:.1f} degC",
                  body.name, freezing->fraction.liquidus() - k_zero_celsius);
  return after;
}

}  // namespace solidus::setup
