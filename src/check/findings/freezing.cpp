// Findings on the freezing of the casting: conditions that prevent it, and whether the run is long and fine
// enough.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

// Of the estimated time to freeze, which is good to a factor of two.
constexpr double k_early = 0.25, k_liquid = 0.4;   // the run ends, a casting leaves
constexpr double k_fine = 4, k_least_steps = 20;   // steps, least steps: so many at least
constexpr double k_many = 5e4;                     // steps that are too many
constexpr double k_day = 86400, k_most_days = 15;  // [s], [days]
constexpr double k_of_run = 0.5;                   // a largest step that limits nothing
constexpr double k_hottest_air = 1900;             // hotter surroundings: findings/conditions.cpp [K]

double celsius(double kelvin) {
  return kelvin - k_zero_celsius;
}

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
  if (seconds < 172800) return fmt::format("{:.3g} h", seconds / 3600);
  return fmt::format("{:.3g} days", seconds / 86400);
}

double solidus_of(const setup::Assembly& a, const Pour& pour) {
  return a.materials[pour.body].solidification()->fraction.solidus();
}

/// The longest step that a run with fixed steps takes.
double fixed_step(const cases::CaseSpec& spec, const setup::Assembly& a) {
  if (spec.time.adaptive || spec.time.steady) return 0;
  if (a.stages.empty()) return spec.time.step.value_or(0);
  return cases::first_step(*a.stages.front().stage, spec.time);
}

/// How long a body that is poured is there at first [s], and whether it leaves then or the run ends.
std::pair<double, bool> time_there(const cases::CaseSpec& spec, const setup::Assembly& a, std::size_t body) {
  double pour = 0;
  bool there = false;
  for (const cases::StageRun& stage : a.stages) {
    const bool now = cases::holds(spec.bodies[body].stages, &stage);
    if (now && !there) pour = stage.start;
    if (there && !now) return {stage.start - pour, true};
    there = now;
  }
  return {*spec.time.end - pour, false};
}

/// Over all processes the same.
void nothing_to_wait_for(const cases::CaseSpec& spec, const setup::Assembly& a,
                         const std::vector<Pour>& pours, Findings& findings) {
  if (spec.time.until != cases::TimeSpec::Until::solid || !pours.empty()) return;
  std::string what = "the run lasts until all is solid, but nothing is poured";
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (const material::PhaseChange* freezing = a.materials[b].solidification()) {
      what += fmt::format(": '{}' starts at {:.0f} degC, and '{}' is liquid from {:.0f} degC on",
                          spec.bodies[b].name, celsius(a.start[b].high), spec.bodies[b].material,
                          celsius(freezing->fraction.liquidus()));
      break;
    }
  findings.push_back(
      {true, spec.time.where, what,
       "until = \"end\", or a body that starts above its solidus; is the initial temperature in its unit?"});
}

/// Steps against the time in which a body freezes, from too long to too many.
void length_of_steps(const cases::CaseSpec& spec, const setup::Assembly& a, const std::string& name,
                     double time, Findings& findings) {
  if (const double step = fixed_step(spec, a); k_fine * step > time && step < 0.99 * *spec.time.end)
    findings.push_back(
        {false, spec.time.where,
         fmt::format("steps of {}, but '{}' freezes within some {}", duration(step), name, duration(time)),
         "twenty steps and more while it freezes; time.adaptive chooses them"});
  if (const double first = spec.time.adaptive && a.stages.empty() ? spec.time.step.value_or(0) : 0;
      k_fine * first > time)
    findings.push_back({false, spec.time.where,
                        fmt::format("the first step is {}, but '{}' freezes within some {}", duration(first),
                                    name, duration(time)),
                        "time.step of a thousandth to a hundredth of that; is its unit right?"});
  if (const double least = spec.time.adaptive ? spec.time.min_step.value_or(0) : 0;
      k_least_steps * least > time)
    findings.push_back({false, spec.time.where,
                        fmt::format("steps of {} at least, but '{}' freezes within some {}", duration(least),
                                    name, duration(time)),
                        "a smaller time.min_step, or none"});
  if (const double step = spec.time.adaptive ? spec.time.max_step.value_or(0) : fixed_step(spec, a);
      step > 0 && time > k_many * step && a.stages.empty())
    findings.push_back(
        {false, spec.time.where,
         fmt::format("steps of {:g} s: '{}' freezes in some {:.0f} of them", step, name, time / step),
         "some hundred steps while it freezes; time.adaptive chooses them"});
}

void length_of_run(const cases::CaseSpec& spec, const setup::Assembly& a, const Pour& pour,
                   Findings& findings) {
  const std::string& name = spec.bodies[pour.body].name;
  if (spec.time.steady) {
    findings.push_back({false, spec.time.where,
                        fmt::format("a steady analysis has no time in which '{}' freezes: it gives the "
                                    "temperatures that conditions hold for ever, whatever was poured",
                                    name),
                        "time.end and time.step in place of time.steady"});
    return;
  }
  // Without cooling, or with too little, no estimate says how long it takes.
  if (pour.no_estimate == "nothing cools it") {
    findings.push_back({false, spec.bodies[pour.body].where, fmt::format("nothing cools the body '{}'", name),
                        "a contact with [contact.heat], a film, radiation or a temperature on its skin"});
    return;
  }
  if (!pour.no_estimate.empty() || spec.time.steady) return;
  if (!pour.freezing.time) {
    findings.push_back(
        {false, spec.bodies[pour.body].where,
         fmt::format(
             "the body '{}' does not freeze: with what is around it, it stays near {:.0f} degC, above its "
             "solidus of {:.0f} degC",
             name, celsius(pour.freezing.rest), celsius(solidus_of(a, pour))),
         "moulds and surroundings that are colder, and have room for its heat"});
    return;
  }
  // An estimate is good to a factor of two.
  const double time = *pour.freezing.time;
  // The run, or the stay of the casting in it, against the estimate; then the steps against it.
  if (*spec.time.end < k_early * time)
    findings.push_back({false, spec.time.where,
                        fmt::format("the run ends after {}, but '{}' takes some {} to freeze",
                                    duration(*spec.time.end), name, duration(time)),
                        "a later time.end; is its unit right?"});
  else if (const auto [there, leaves] = time_there(spec, a, pour.body);
           there < (leaves ? k_liquid : k_early) * time)
    findings.push_back(
        {false, spec.bodies[pour.body].where,
         leaves ? fmt::format("'{}' leaves {} after its pour, but takes some {} to freeze", name,
                              duration(there), duration(time))
                : fmt::format("the run ends {} after the pour of '{}', but it takes some {} to freeze",
                              duration(there), name, duration(time)),
         leaves ? "longer stages before it leaves" : "longer stages after its pour"});
  length_of_steps(spec, a, name, time, findings);
  if (time > k_most_days * k_day)
    findings.push_back({false, spec.mesh.where,
                        fmt::format("'{}' takes some {} to freeze", name, duration(time)),
                        "seconds to hours; are mesh.unit, the conductances and conductivities right?"});
}

/// Over all pours the same: a largest step that no step comes to.
void largest_step(const cases::CaseSpec& spec, Findings& findings) {
  const double most = spec.time.adaptive ? spec.time.max_step.value_or(0) : 0;
  if (spec.time.steady || most <= k_of_run * *spec.time.end) return;
  findings.push_back({false, spec.time.where,
                      fmt::format("time.max_step of {} limits nothing: the whole run takes {}",
                                  duration(most), duration(*spec.time.end)),
                      "a tenth of the run and less, or none; is its unit right?"});
}

/// Rounds of a cycle in which no casting leaves go on with the one that was poured before. Where everything
/// stays, nothing is poured again.
void rounds_without_a_shot(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                           Findings& findings) {
  for (const cases::CycleSpec& cycle : spec.cycles) {
    const auto is_of_it = [&](const cases::StageRun& stage) {
      return std::find(cycle.stages.begin(), cycle.stages.end(), stage.stage->name) != cycle.stages.end();
    };
    const bool leaves = std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& pour) {
      return std::any_of(a.stages.begin(), a.stages.end(), [&](const cases::StageRun& stage) {
        return is_of_it(stage) && !cases::holds(spec.bodies[pour.body].stages, &stage);
      });
    });
    if (m.pours.empty() || cycle.repeat < 2 || leaves) continue;
    const std::string& name = spec.bodies[m.pours.front().body].name;
    findings.push_back(
        {false, cycle.where,
         fmt::format("the cycle '{}' comes round {} times, but '{}' is poured once: it is there in all "
                     "stages of the cycle",
                     cycle.name, cycle.repeat, name),
         "'stages' of its [[body]] without the last one of the cycle: then every round is a shot"});
  }
}

/// Conditions on the skin of the body that keep it hot.
void heating(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, const Pour& pour,
             Findings& findings) {
  using Kind = cases::ThermalConditionSpec::Kind;
  const std::string& name = spec.bodies[pour.body].name;
  const double solidus = solidus_of(a, pour);
  for (std::size_t i = 0; i < spec.thermal_conditions.size(); ++i) {
    const cases::ThermalConditionSpec& c = spec.thermal_conditions[i];
    if (m.surfaces[i].body != static_cast<int>(pour.body)) continue;
    // A temperature above the solidus that lasts, heat that flows in, and surroundings above the solidus.
    if (c.kind == Kind::temperature && is_number(c.temperature) && c.temperature.table.value(0) > solidus &&
        pour.freezing.time.value_or(1e300) > spec.time.end.value_or(0))
      findings.push_back(
          {false, c.where,
           fmt::format(
               "'{}' holds the skin '{}' of '{}' at {:.0f} degC, above its solidus of {:.0f} degC: it "
               "does not freeze there",
               c.name, c.group, name, celsius(c.temperature.table.value(0)), celsius(solidus)),
           "a film or contact; the pouring temperature is initial_temperature"});
    if (c.kind == Kind::flux && is_number(c.flux) && c.flux.table.value(0) > 0)
      findings.push_back(
          {false, c.where,
           fmt::format("the flux '{}' of {:g} W/m2 heats '{}'", c.name, c.flux.table.value(0), name),
           "a flux is positive into the body: cooling is negative"});
    if ((c.kind == Kind::film || c.kind == Kind::radiation) && is_number(c.ambient) &&
        c.ambient.table.value(0) > solidus && c.ambient.table.value(0) < k_hottest_air &&
        is_number(c.coefficient) && is_number(c.factor))
      findings.push_back(
          {false, c.where,
           fmt::format("the surroundings of '{}' have {:.0f} degC, above the solidus of '{}' at "
                       "{:.0f} degC: it does not freeze there",
                       c.name, celsius(c.ambient.table.value(0)), name, celsius(solidus)),
           "room temperature, or that of the cooling water"});
  }
}

/// A body that can melt, but starts cold next to one that is poured.
void cold_castings(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                   Findings& findings) {
  if (m.pours.empty() || !spec.criteria.follow) return;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const material::PhaseChange* freezing = a.materials[b].solidification();
    if (freezing == nullptr || a.start[b].high >= freezing->fraction.liquidus()) continue;
    const cases::Role role = cases::role_of(spec.bodies[b], a.materials[b]);
    if (!cases::is_poured(role)) continue;  // the case says that it is a chill
    // Between solidus and liquidus it was poured too cold; below, it is no casting, or a riser that cannot
    // feed.
    if (a.start[b].high >= freezing->fraction.solidus()) {
      const bool hottest = std::none_of(a.start.begin(), a.start.end(),
                                        [&](const auto& s) { return s.high > a.start[b].high; });
      if (!hottest)  // else find_in_pour says it
        findings.push_back(
            {false, spec.bodies[b].where,
             fmt::format(
                 "the body '{}' starts at {:.0f} degC, partly solid: the liquidus of '{}' is {:.0f} degC",
                 spec.bodies[b].name, celsius(a.start[b].high), spec.bodies[b].material,
                 celsius(freezing->fraction.liquidus())),
             "what is poured together is poured at one temperature, 20 to 150 K above the liquidus"});
      continue;
    }
    if (spec.bodies[b].role == cases::Role::riser) {
      findings.push_back({false, spec.bodies[b].where,
                          fmt::format("the riser '{}' starts solid at {:.0f} degC: it feeds nothing",
                                      spec.bodies[b].name, celsius(a.start[b].high)),
                          "the temperature of what is poured with it"});
      continue;
    }
    // A body that a travelling source melts again, or on which metal is deposited, starts solid on purpose.
    if (!spec.sources.empty() || !spec.depositions.empty()) continue;
    findings.push_back(
        {false, spec.bodies[b].where,
         fmt::format(
             "the body '{}' starts solid at {:.0f} degC, but its material '{}' freezes: it counts as a "
             "casting in the solid fraction, the steps and the criteria",
             spec.bodies[b].name, celsius(a.start[b].high), spec.bodies[b].material),
         "a material without solidification for chills and moulds, such as 'iron_chill', 'copper_chill' or "
         "'steel_mould'"});
  }
}

/// The temperature to which all bodies come that heat joins and nothing else cools or heats [K].
double common_temperature(const setup::Assembly& a, const CaseMeasures& m) {
  std::vector<material::EnthalpyCurve> curves;
  double heat = 0, low = std::numeric_limits<double>::max(), high = 0;
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    curves.push_back(a.materials[b].enthalpy());
    heat += m.bodies[b].volume * (curves[b].upper(a.start[b].low) + curves[b].upper(a.start[b].high)) / 2;
    low = std::min(low, a.start[b].low);
    high = std::max(high, a.start[b].high);
  }
  constexpr int k_halvings = 40;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = (low + high) / 2;
    double there = 0;
    for (std::size_t b = 0; b < curves.size(); ++b) there += m.bodies[b].volume * curves[b].lower(middle);
    (there < heat ? low : high) = middle;
  }
  return low;
}

/// Where nothing is poured: a body that the others heat above its solidus.
void bodies_that_melt(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                      Findings& findings) {
  if (!m.pours.empty() || !spec.criteria.follow || spec.time.steady) return;
  const double common = common_temperature(a, m);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const material::PhaseChange* freezing = a.materials[b].solidification();
    if (freezing == nullptr || common <= freezing->fraction.solidus()) continue;
    findings.push_back(
        {false, spec.bodies[b].where,
         fmt::format("the bodies come to {:.0f} degC together, where nothing else cools them: '{}' of '{}' "
                     "melts from {:.0f} degC on",
                     celsius(common), spec.bodies[b].name, spec.bodies[b].material,
                     celsius(freezing->fraction.solidus())),
         "a mould that withstands the heat of what lies in it, or a colder start"});
  }
}

/// Melt next to melt: a contact parts them, and common nodes make two alloys one liquid.
void melts_side_by_side(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                        Findings& findings) {
  const auto poured = [&](int body) {
    return std::any_of(m.pours.begin(), m.pours.end(),
                       [&](const Pour& p) { return static_cast<int>(p.body) == body; });
  };
  // Contacts between poured bodies, then common nodes of different alloys.
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const setup::ContactMeasures& contact = m.contacts[c];
    if (!poured(contact.slave_body) || !poured(contact.master_body) ||
        contact.slave_body == contact.master_body ||
        !setup::holds(spec, spec.contacts[c], a.mesh, a.first_stage()))
      continue;
    findings.push_back(
        {false, spec.contacts[c].where,
         fmt::format("the contact '{}' joins '{}' and '{}', which are both poured: melt does not flow across "
                     "it, and one does not feed the other",
                     spec.contacts[c].name, spec.bodies[as_size(contact.slave_body)].name,
                     spec.bodies[as_size(contact.master_body)].name),
         "a riser shares the nodes of its casting: mesh.conforming, or one geometry"});
  }
  for (const Pour& one : m.pours)
    for (const Pour& other : m.pours)
      if (other.body < one.body && m.bodies[one.body].shared_nodes[other.body] > 0 &&
          spec.bodies[one.body].material != spec.bodies[other.body].material)
        findings.push_back(
            {false, spec.bodies[one.body].where,
             fmt::format(
                 "'{}' of '{}' and '{}' of '{}' are both poured and share nodes: two alloys as one melt",
                 spec.bodies[other.body].name, spec.bodies[other.body].material, spec.bodies[one.body].name,
                 spec.bodies[one.body].material),
             "one alloy for a casting and its risers"});
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat()) return;
  for (const Pour& pour : m.pours) {
    heating(spec, a, m, pour, findings);
    length_of_run(spec, a, pour, findings);
  }
  rounds_without_a_shot(spec, a, m, findings);
  nothing_to_wait_for(spec, a, m.pours, findings);
  if (!m.pours.empty()) largest_step(spec, findings);
  cold_castings(spec, a, m, findings);
  bodies_that_melt(spec, a, m, findings);
  melts_side_by_side(spec, a, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_freezing() {
  return {.name = "freezing",
          .place = 90,
          .find = &find,
          .rows = {
              {Topic::materials, "a second casting starts partly solid",
               "between solidus and liquidus, where another body is hotter"},
              {Topic::materials, "melt next to melt",
               "a contact joins two bodies that are poured; two alloys that are poured share nodes"},
              {Topic::materials, "a body melts",
               "nothing is poured, and the common temperature that all bodies would reach, insulated from "
               "the surroundings, is above the solidus of one"},
              {Topic::materials, "a chill counts as a casting",
               "its material can freeze, and it starts solid next to a body that is poured; with sources "
               "that travel and "
               "bodies that grow nothing is said"},
              {Topic::pour, "nothing cools a casting; it does not freeze", "by the estimate"},
              {Topic::pour,
               "its surface is held above the solidus; its surroundings are hotter than that, in any stage",
               "conditions that are constants"},
              {Topic::pour, "a flux heats it", "a flux is positive into the body"},
              {Topic::pour, "a run until all is solid, in which nothing is poured", "`until = \"solid\"`",
               "error"},
              {Topic::pour,
               "the run ends before a casting is solid, or the casting is removed before; castings poured in "
               "a later stage too",
               fmt::format("the run lasts less than {} of the estimated time to freeze, the casting stays "
                           "for less than {} of it",
                           percent(k_early), percent(k_liquid))},
              {Topic::pour, "steps too long, too short",
               fmt::format("fixed ones, or the first of adaptive ones, above 1/{} of the estimated time to "
                           "freeze, `min_step` above 1/{} of it; `max_step` above {} of the run; more than "
                           "{} fixed steps, or steps of `max_step`, in the estimated time",
                           number(k_fine), number(k_least_steps), percent(k_of_run), number(k_many))},
              {Topic::pour,
               fmt::format("the estimated time to freeze is more than {} days", number(k_most_days))},
              {Topic::pour, "a steady analysis of a body that is poured"},
              {Topic::pour, "a cold riser", "a body with that role starts below its solidus"},
              {Topic::pour, "a cycle without shots", "it is repeated, and no poured body is removed in it"}}};
}

}  // namespace solidus::check
