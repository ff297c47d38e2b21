// Findings on surroundings, gravity, steps and the size of everything.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::check {

namespace {

constexpr double k_coldest_argument = 150;                 // of a table of the surface's temperature [K]
constexpr double k_coldest = 70, k_hottest = 1900;         // liquid nitrogen to furnaces [K]
constexpr double k_coldest_body = 260;                     // [K]
constexpr double k_most_source = 1e11, k_most_flux = 2e7;  // [W/m³], [W/m²]
constexpr double k_least_emissivity = 0.02;
constexpr double k_least_film = 0.5, k_most_film = 1e6, k_most_possible_film = 1e8;  // [W/(m² K)]
constexpr double k_radiation = 4;                            // what radiation alone takes [W/(m² K)]
constexpr double k_rise = 3000, k_rate = 20;                 // of induction [K], [K/s]
constexpr double k_loose = 2e-3;                             // tolerances of iterations
constexpr double k_least_period = 1e-3, k_most_period = 50;  // difference of rounds [K]
constexpr double k_least_gravity = 1, k_most_gravity = 30;   // [m/s²]
constexpr double k_second_point = 5, k_last_point = 20, k_over = 0.01;  // of tables of time, times the end
constexpr double k_least_error = 1e-3;                                  // [K]
constexpr double k_most_error = 0.1;                                    // of what the bodies start apart
constexpr double k_most_of_step = 0.5;  // of a casting that freezes, of a skin that lets go
constexpr double k_least_motion = 1e-8, k_most_motion = 5e-3;  // [m]
constexpr double k_largest_mesh = 30, k_smallest_mesh = 1e-4;  // [m]

/// A table that begins near 20 K was meant in degrees Celsius: surfaces are not so cold.
void cold_arguments(const cases::ThermalConditionSpec& t, const char* key, const Table& table,
                    Findings& findings) {
  if (const double first = table.x().front(); first < k_coldest_argument)
    findings.push_back({false, t.where,
                        fmt::format("the table of '{}' of '{}' begins at {:g} K ({:.0f} degC)", key, t.name,
                                    first, units::to_display(first, "K", "degC")),
                        "are its temperatures in degC? argument_unit = \"degC\""});
}

/// Too small a film is mostly one in kW, too large a one in W/mm²; both are compared with air and water.
void film(const cases::ThermalConditionSpec& t, Findings& findings) {
  if (is_number(t.coefficient) && is_number(t.factor) && t.coefficient.table.value(0) < k_least_film)
    findings.push_back({false, t.where,
                        fmt::format("the film '{}' has {:g} W/m2/K", t.name, t.coefficient.table.value(0)),
                        "usual are 5 to 100 W/m2/K in air, up to 50000 in water"});
  if (t.coefficient.place == nullptr && !is_number(t.coefficient) &&
      t.coefficient.table.max_value() > k_most_possible_film)
    findings.push_back(
        {true, t.where,
         fmt::format("the film '{}' comes to {:g} W/m2/K", t.name, t.coefficient.table.max_value()),
         "usual are 5 to 100 W/m2/K in air, up to 50000 in water"});
  // A film far beyond the usual holds the surface at the temperature of its surroundings.
  if (is_number(t.coefficient) && is_number(t.factor))
    if (const double h = t.coefficient.table.value(0); h > k_most_film)
      findings.push_back({h > k_most_possible_film, t.where,
                          fmt::format("the film '{}' has {:g} W/m2/K", t.name, h),
                          "usual are 5 to 100 W/m2/K in air, up to 50000 in water"});
}

void surroundings(const cases::CaseSpec& spec, Findings& findings) {
  // Values that are possible and far from usual, condition by condition. Constants alone are judged, since a
  // table may pass such values for a moment. Each finding says what is usual.
  using Kind = cases::ThermalConditionSpec::Kind;
  for (const cases::ThermalConditionSpec& t : spec.thermal_conditions) {
    const bool surrounded = t.kind == Kind::film || t.kind == Kind::radiation;
    // Near zero kelvins a value was meant in another unit; above the hottest flame likewise.
    if (surrounded && is_number(t.ambient))
      if (const double ambient = t.ambient.table.value(0); ambient < k_coldest || ambient > k_hottest)
        findings.push_back({false, t.where,
                            fmt::format("'{}' has surroundings of {:.0f} degC ({:.0f} K)", t.name,
                                        units::to_display(ambient, "K", "degC"), ambient),
                            "room temperature is 20 degC, 293 K"});
    if (t.kind == Kind::temperature && is_number(t.temperature))
      if (const double held = t.temperature.table.value(0); held < k_coldest)
        findings.push_back({false, t.where,
                            fmt::format("'{}' holds '{}' at {:.0f} degC ({:.0f} K)", t.name, t.group,
                                        units::to_display(held, "K", "degC"), held),
                            "room temperature is 20 degC, 293 K"});
    // Sources and fluxes have no natural limit, so that only the far end is told.
    if (t.kind == Kind::source && is_number(t.power) && std::abs(t.power.table.value(0)) > k_most_source)
      findings.push_back({false, t.where,
                          fmt::format("the source '{}' has {:g} W/m3", t.name, t.power.table.value(0)),
                          "usual are 1e3 to 1e9 W/m3, under a laser 1e11"});
    // A number below polished metal is almost always meant in percent or as a reflectivity.
    if (t.kind == Kind::radiation && is_number(t.emissivity) && is_number(t.factor) &&
        t.emissivity.table.value(0) < k_least_emissivity)
      findings.push_back({false, t.where,
                          fmt::format("the emissivity of '{}' is {:g}", t.name, t.emissivity.table.value(0)),
                          "polished metal has 0.03 to 0.1, oxidised metal, sand and coatings 0.3 to 0.95"});
    // Tables of temperature that are used below their first argument are another mistake of units.
    for (const auto& [function, key] :
         {std::pair(&t.coefficient, "coefficient"), std::pair(&t.emissivity, "emissivity")})
      if (surrounded && function->place == nullptr && function->of == Argument::temperature)
        cold_arguments(t, key, function->table, findings);
    if (t.kind == Kind::flux && is_number(t.flux) && std::abs(t.flux.table.value(0)) > k_most_flux)
      findings.push_back({false, t.where,
                          fmt::format("the flux '{}' has {:g} W/m2", t.name, t.flux.table.value(0)),
                          "usual are 1e2 to 1e7 W/m2"});
    if (t.kind == Kind::film) film(t, findings);
  }
}

/// Less than what radiation alone takes from any mould: 5 W/m²K of an emissivity of 0.85 at room temperature.
void films_below_radiation(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  using Kind = cases::ThermalConditionSpec::Kind;
  if (m.pours.empty()) return;
  // Only films of one number on a body that is not poured: the others may be small for good reason.
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const cases::ThermalConditionSpec& film = spec.thermal_conditions[t];
    if (film.kind != Kind::film || !is_number(film.coefficient) || !is_number(film.factor)) continue;
    const double h = film.coefficient.table.value(0) * film.factor.table.value(0);
    // Radiation on the same surface makes up for what the film lacks.
    const bool radiates =
        std::ranges::any_of(spec.thermal_conditions, [&](const cases::ThermalConditionSpec& c) {
          return c.kind == Kind::radiation && c.group == film.group;
        });
    const int body = m.surfaces[t].body;
    // A cover on a riser may let as little pass.
    if (h < k_least_film || h >= k_radiation || radiates || body < 0 || m.is_poured(as_size(body))) continue;
    findings.push_back(
        {false, film.where,
         fmt::format("the film '{}' has {:g} W/m2/K, and nothing radiates there", film.name, h),
         "radiation alone takes 5 W/m2/K from a cold mould, still air and radiation 10 to 20; is it in "
         "kW/m2/K?"});
  }
}

/// Room temperature in K is a slip where it is read in degrees Celsius.
bool looks_like_kelvins(double temperature) {
  const double celsius = temperature - k_zero_celsius;
  return std::abs(celsius - 293.1) < 0.2 || std::abs(celsius - 298.1) < 0.2;
}

void rooms_in_kelvins(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  const auto compare = [&](const SourceLocation& where, const std::string& what, double temperature) {
    if (looks_like_kelvins(temperature))
      findings.push_back({false, where, fmt::format("{} of {:g} degC", what, temperature - k_zero_celsius),
                          "is it in K? 293 K are 20 degC"});
  };
  // Surroundings and initial temperatures that would be plausible as kelvins.
  for (const cases::ThermalConditionSpec& t : spec.thermal_conditions) {
    using Kind = cases::ThermalConditionSpec::Kind;
    if ((t.kind == Kind::film || t.kind == Kind::radiation) && t.ambient.place == nullptr)
      compare(t.where, fmt::format("'{}' has surroundings", t.name), t.ambient.table.min_value());
  }
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const std::string body = fmt::format("the body '{}' has an initial temperature", spec.bodies[b].name);
    // The coldest place of the body counts, as that is the one a wrong unit makes absurd.
    compare(spec.bodies[b].where, body, a.start[b].low);
    if (a.start[b].low < k_coldest_body)
      findings.push_back({false, spec.bodies[b].where,
                          fmt::format("{} of {:.0f} degC", body, a.start[b].low - k_zero_celsius),
                          "moulds start at 0 to 400 degC"});
  }
}

/// Heat that a body does not have.
void sinks(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  // Needs a time in which the heat is taken.
  if (spec.time.steady || !spec.time.end) return;
  for (const cases::ThermalConditionSpec& t : spec.thermal_conditions) {
    if (t.kind != cases::ThermalConditionSpec::Kind::source || !is_number(t.power) || !is_number(t.factor))
      continue;
    const double power = t.power.table.value(0) * t.factor.table.value(0);
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      if (spec.bodies[b].mesh_group() != t.group || power >= 0) continue;
      // All the heat down to zero temperature, which no sink can exceed.
      const material::EnthalpyCurve enthalpy = a.materials[b].enthalpy();
      const double lasts = (enthalpy.upper(a.start[b].high) - enthalpy.lower(1.0)) / -power;
      if (lasts < *spec.time.end && t.stages.empty())
        findings.push_back(
            {false, t.where,
             fmt::format("the source '{}' of {:g} W/m3 takes all the heat that '{}' has within {:.3g} s",
                         t.name, power, spec.bodies[b].name, lasts),
             "a source is positive into the body; films and contacts cool"});
    }
  }
}

/// Heat that no body survives.
void heaters(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  if (spec.time.steady || !spec.time.end) return;
  for (const cases::ThermalConditionSpec& t : spec.thermal_conditions) {
    if (t.kind != cases::ThermalConditionSpec::Kind::source || !is_number(t.power) || !is_number(t.factor) ||
        !t.stages.empty())
      continue;
    const double power = t.power.table.value(0) * t.factor.table.value(0);
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      if (spec.bodies[b].mesh_group() != t.group) continue;
      const material::Material& m = a.materials[b];
      // How fast it would heat if nothing cooled it, from the properties at the start: an estimate
      // from above.
      const double rate = power / (m.density * m.specific_heat.value(a.start[b].high));
      if (rate < k_rate || rate * *spec.time.end < k_rise) continue;
      findings.push_back(
          {false, t.where,
           fmt::format("the source '{}' of {:g} W/m3 heats '{}' by {:.3g} K in each second of the "
                       "run, if nothing cools it",
                       t.name, power, spec.bodies[b].name, rate),
           "induction heats by 1 to 20 K/s; what freezes gives its latent heat by itself"});
    }
  }
}

/// Residuals that are left in every step.
void residuals(const cases::CaseSpec& spec, Findings& findings) {
  const auto compare = [&](const char* key, double tolerance, const char* of) {
    if (tolerance > k_loose)
      findings.push_back({false, spec.time.where,
                          fmt::format("{} = {:g}: each step may leave {:.3g} % of its {} unaccounted for",
                                      key, tolerance, 100 * tolerance, of),
                          "1e-4 and less, or without the key"});
  };
  if (spec.has_heat()) compare("heat.tolerance", spec.heat.tolerance, "heat");
  if (spec.has_mechanics()) compare("mechanics.tolerance", spec.mechanics.tolerance, "forces");
}

void periodic_states(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::CycleSpec& cycle : spec.cycles)
    if (cycle.periodic && (*cycle.periodic < k_least_period || *cycle.periodic > k_most_period))
      findings.push_back({false, cycle.where,
                          fmt::format("the cycle '{}' counts as periodic where its rounds differ by {:g} K",
                                      cycle.name, *cycle.periodic),
                          "0.1 to 5 K: below are errors of steps and mesh, above dies that still warm up"});
}

void outputs(const cases::CaseSpec& spec, Findings& findings) {
  if (spec.time.steady || !spec.time.end) return;
  const double end = *spec.time.end;
  double last = spec.output.every.value_or(0);
  for (const double time : spec.output.times) last = std::max(last, time);
  if (last > end * (1 + 1e-9))
    findings.push_back(
        {false, spec.time.where,
         fmt::format("an output is asked for at {:g} s, but the run ends at {:g} s", last, end),
         "output.every and output.times up to the end"});
}

void gravity(const cases::CaseSpec& spec, Findings& findings) {
  const double g = spec.analysis.gravity;
  if (g != 0 && (g < k_least_gravity || g > k_most_gravity))
    findings.push_back(
        {false, spec.analysis.where, fmt::format("gravity is {:g} m/s2", g), "9.81 m/s2 on earth"});
}

void steps(const cases::CaseSpec& spec, Findings& findings) {
  if (spec.time.steady || spec.time.adaptive || !spec.stages.empty() || !spec.time.end || !spec.time.step)
    return;
  if (spec.output.every && *spec.output.every < 0.51 * *spec.time.step)
    findings.push_back(
        {false, spec.time.where,
         fmt::format("outputs every {:g} s cut the steps of {:g} s, {:.0f} for each", *spec.output.every,
                     *spec.time.step, *spec.time.step / *spec.output.every),
         "output.every of one step or more; probes and history.csv have every step"});
  if (*spec.time.step > 0.99 * *spec.time.end)
    findings.push_back({false, spec.time.where,
                        fmt::format("one step of {:g} s is the whole run", *spec.time.step),
                        "some hundred steps; time.adaptive chooses them"});
}

/// A table of time that begins when the run has ended is a number in it, of one that goes on for long after
/// it the run sees next to nothing, and one that ends when the run has hardly begun is a number from then on.
/// Two points are a ramp, and tables of motion often end early: a tool moves and stays.
void tables_of_other_times(const cases::CaseSpec& spec, Findings& findings) {
  if (spec.time.steady || !spec.time.end) return;
  const auto compare = [&](const std::string& what, const Function& f, const SourceLocation& where,
                           bool may_end) {
    if (f.place != nullptr || f.of != Argument::time || f.table.constant()) return;
    // Two points are a ramp that holds its last value on purpose: three and more are asked for below.
    constexpr std::size_t k_ramp = 2;  // points
    const double end = *spec.time.end;
    const auto say = [&](const char* what_it_does, double at) {
      findings.push_back(
          {false, where,
           fmt::format("the table of {} {} {:g} s, but the run ends at {:g} s", what, what_it_does, at, end),
           "is its argument_unit right?"});
    };
    // One message a table, the most certain first.
    const auto x = f.table.x();
    if (x[0] >= end)
      say("begins at", x[0]);
    else if (x[1] > k_second_point * end)
      say("has its second point at", x[1]);
    else if (x[x.size() - 1] > k_last_point * end)
      say("goes on to", x[x.size() - 1]);
    else if (!may_end && x.size() > k_ramp && x[x.size() - 1] < k_over * end)
      say("ends at", x[x.size() - 1]);
  };
  // A clock of the stage begins with it: its table is compared with the length of the stage elsewhere.
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    if (c.clock == cases::TimeOrigin::stage) continue;  // find_in_stage_times
    for (const Function* f : {&c.coefficient, &c.ambient, &c.temperature, &c.flux, &c.emissivity, &c.power})
      compare("'" + c.name + "'", *f, c.where, !c.stages.empty());
  }
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (c.clock == cases::TimeOrigin::stage) continue;
    const auto tell = [&](const Function& f) { compare("'" + c.name + "'", f, c.where, true); };
    for (const Function* f : {&c.pressure, &c.level, &c.squeeze}) tell(*f);
    for (const auto* all : {&c.traction, &c.force}) std::for_each(all->begin(), all->end(), tell);
    for (const auto* u : {&c.ux, &c.uy, &c.uz, &c.ur})
      if (*u) tell(**u);
  }
}

/// Compares the error allowed per step with the range of temperatures of the run.
void tolerance(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  // The bodies' starts span the range of the run; an allowed error is judged as a share of it.
  double high = 0, low = std::numeric_limits<double>::max();
  for (const setup::InitialTemperatureRange& r : a.start)
    high = std::max(high, r.high), low = std::min(low, r.low);
  if (const double allowed = spec.time.temperature_error.value_or(0);
      high - low > 100 && allowed > k_most_error * (high - low))
    findings.push_back({false, spec.time.where,
                        fmt::format("each step may be wrong by {:g} K, where bodies start {:.0f} K apart",
                                    allowed, high - low),
                        "time.temperature_error of 0.5 to 10 K"});
  if (const double change = spec.time.solid_fraction_change.value_or(0);
      spec.time.adaptive && change > k_most_of_step)
    findings.push_back({false, spec.time.where,
                        fmt::format("{:.0f} % of the casting may freeze in one step", 100 * change),
                        "time.solid_fraction_change of 0.02 to 0.2"});
  // The skin that lets go in one step is bounded likewise, since gaps that open at once change the
  // cooling at once.
  if (const double change = spec.time.skin_change.value_or(0); spec.time.adaptive && change > k_most_of_step)
    findings.push_back({false, spec.time.where,
                        fmt::format("{:.0f} % of a skin may let go of its wall in one step", 100 * change),
                        "time.skin_change of 0.02 to 0.2"});
  // Motion and temperature are judged apart: either tolerance may be the one that sets the steps.
  if (const double allowed = spec.time.displacement_error.value_or(k_most_motion);
      allowed < k_least_motion || allowed > k_most_motion)
    findings.push_back({false, spec.time.where,
                        fmt::format("each step may be wrong by {:g} um of motion", 1e6 * allowed),
                        "time.displacement_error of 0.1 um to 1 mm"});
  if (const double allowed = spec.time.temperature_error.value_or(1); allowed < k_least_error)
    findings.push_back({false, spec.time.where,
                        fmt::format("each step may be wrong by {:g} K alone", allowed),
                        "time.temperature_error of 0.5 to 10 K"});
}

void size(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const mesh::Point& x : a.mesh.x) low = std::min(low, x[i]), high = std::max(high, x[i]);
    largest = std::max(largest, parallel::global_max(high) - parallel::global_min(low));
  }
  if (largest > k_largest_mesh || largest < k_smallest_mesh)
    findings.push_back({false, spec.mesh.where, fmt::format("the mesh is {:.3g} m large", largest),
                        "is mesh.unit right? It is \"m\" unless the case says \"mm\""});
}

/// Round an axis the surface x = 0 has no area: nothing passes through it.
void surfaces_on_the_axis(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  using Kind = cases::ThermalConditionSpec::Kind;
  if (spec.analysis.kind != AnalysisKind::axisymmetric) return;
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const cases::ThermalConditionSpec& c = spec.thermal_conditions[t];
    const bool through = c.kind == Kind::film || c.kind == Kind::radiation || c.kind == Kind::flux;
    if (!through || m.surfaces[t].body == -1 || m.surfaces[t].area > 0) continue;
    findings.push_back(
        {false, c.where,
         fmt::format("'{}' lies on the axis: the surface '{}' has no area in axisymmetry", c.name, c.group),
         "kind = \"plane_strain\" where x = 0 is a face of the casting; else no condition there"});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (spec.has_heat()) surfaces_on_the_axis(spec, m, findings);
  if (spec.has_heat()) surroundings(spec, findings);
  if (spec.has_heat()) films_below_radiation(spec, m, findings);
  if (spec.has_heat()) sinks(spec, a, findings);
  if (spec.has_heat()) heaters(spec, a, findings);
  residuals(spec, findings);
  periodic_states(spec, findings);
  gravity(spec, findings);
  steps(spec, findings);
  if (spec.has_heat()) tolerance(spec, a, findings);
  if (spec.has_heat()) rooms_in_kelvins(spec, a, findings);
  outputs(spec, findings);
  tables_of_other_times(spec, findings);
  size(spec, a, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_conditions() {
  return {
      .name = "conditions",
      .place = 60,
      .find = &find,
      .rows = {
          {Topic::conditions, "surroundings",
           fmt::format("below {} K or above {} K", number(k_coldest), number(k_hottest))},
          {Topic::conditions, "a held temperature near zero", fmt::format("below {} K", number(k_coldest))},
          {Topic::conditions, "rooms in K", "surroundings or bodies of 293 or 298 °C"},
          {Topic::conditions, fmt::format("bodies that start below {} K", number(k_coldest_body))},
          {Topic::conditions, "a film below the heat loss by radiation",
           fmt::format("a constant of {} to {} W/m²K on a body that is not poured, where nothing radiates",
                       number(k_least_film), number(k_radiation))},
          {Topic::conditions, "film, flux, source",
           fmt::format(
               "below {} or above {} W/m²K (above {}, also in a table: error), above {} W/m², above {} W/m³",
               number(k_least_film), number(k_most_film), number(k_most_possible_film), number(k_most_flux),
               number(k_most_source)),
           "warning, error"},
          {Topic::conditions, "a source takes more heat than the body has", "within the run"},
          {Topic::conditions, fmt::format("a source heats a body by more than {} K/s", number(k_rate)),
           fmt::format("and by {} K in the run", number(k_rise))},
          {Topic::conditions, "emissivity", fmt::format("below {}", number(k_least_emissivity))},
          {Topic::conditions,
           fmt::format("a table of the surface's temperature begins below {} K", number(k_coldest_argument)),
           "of a film's coefficient or an emissivity"},
          {Topic::conditions, "tolerances of the iterations",
           fmt::format("`heat.tolerance` or `mechanics.tolerance` above {}", number(k_loose))},
          {Topic::conditions, "outputs after the end of the run; tables of time that begin after it"},
          {Topic::conditions, "tables of time of which the run uses next to nothing",
           fmt::format(
               "the second point lies beyond {} times the end, or the last one beyond {} times; the last of "
               "three or more within {} of the run (thermal conditions that are on at all times)",
               number(k_second_point), number(k_last_point), percent(k_over))},
          {Topic::conditions, "a film, radiation or flux on the axis",
           "its surface has no area in axisymmetry"},
          {Topic::conditions, "outputs that cut fixed steps", "more than one a step"},
          {Topic::conditions, "gravity",
           fmt::format("not zero, below {} or above {} m/s²", number(k_least_gravity),
                       number(k_most_gravity))},
          {Topic::pour, "one step is the whole run", "of fixed steps, without stages"},
          {Topic::pour, "a periodic state",
           fmt::format("its tolerance is less than {} mK or more than {} K", number(1e3 * k_least_period),
                       number(k_most_period))},
          {Topic::mesh, "size of the mesh",
           fmt::format("above {} m or below {} mm", number(k_largest_mesh), number(1e3 * k_smallest_mesh))},
          {Topic::effort, "the tolerances of steps",
           fmt::format("of temperature below {} mK; of displacement below {} nm or above {} mm; of "
                       "temperature above {} of the differences of initial temperatures; more than {} of the "
                       "casting may freeze in a step, or of a surface be released from its wall",
                       number(1e3 * k_least_error), number(1e9 * k_least_motion), number(1e3 * k_most_motion),
                       percent(k_most_error), percent(k_most_of_step))}}};
}

}  // namespace solidus::check
