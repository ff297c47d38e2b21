// Findings on the freezing of the casting: conditions that prevent it, and whether the run is long and fine
// enough.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "case/roles.hpp"
#include "check/findings.hpp"
#include "input/units.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::model {

namespace {

double celsius(double kelvin) {
  return kelvin - k_zero_celsius;
}

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
  if (seconds < 172800) return fmt::format("{:.3g} h", seconds / 3600);
  return fmt::format("{:.3g} days", seconds / 86400);
}

double solidus_of(const Assembly& a, const Pour& pour) {
  return a.materials[pour.body].solidification()->fraction.solidus();
}

/// The longest step that a run with fixed steps takes.
double fixed_step(const CaseSpec& spec, const Assembly& a) {
  if (spec.time.adaptive || spec.time.steady) return 0;
  if (a.stages.empty()) return spec.time.step.value_or(0);
  return first_step(*a.stages.front().stage, spec.time);
}

/// How long a body that is poured is there at first [s], and whether it leaves then or the run ends.
std::pair<double, bool> time_there(const CaseSpec& spec, const Assembly& a, std::size_t body) {
  double pour = 0;
  bool there = false;
  for (const StageRun& stage : a.stages) {
    const bool now = holds(spec.bodies[body].stages, &stage);
    if (now && !there) pour = stage.start;
    if (there && !now) return {stage.start - pour, true};
    there = now;
  }
  return {*spec.time.end - pour, false};
}

/// Over all processes the same.
void nothing_to_wait_for(const CaseSpec& spec, const Assembly& a, const std::vector<Pour>& pours,
                         Findings& findings) {
  if (spec.time.until != TimeSpec::Until::solid || !pours.empty()) return;
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

void length_of_run(const CaseSpec& spec, const Assembly& a, const Pour& pour, Findings& findings) {
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
  constexpr double k_early = 0.25, k_liquid = 0.4, k_fine = 4, k_least_steps = 20, k_days = 15 * 86400.0;
  const double time = *pour.freezing.time;
  // The run, or the stay of the casting in it, against the estimate; then the steps against it, from too long
  // to too many.
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
  constexpr double k_many = 5e4;
  if (const double step = spec.time.adaptive ? spec.time.max_step.value_or(0) : fixed_step(spec, a);
      step > 0 && time > k_many * step && a.stages.empty())
    findings.push_back(
        {false, spec.time.where,
         fmt::format("steps of {:g} s: '{}' freezes in some {:.0f} of them", step, name, time / step),
         "some hundred steps while it freezes; time.adaptive chooses them"});
  if (time > k_days)
    findings.push_back({false, spec.mesh.where,
                        fmt::format("'{}' takes some {} to freeze", name, duration(time)),
                        "seconds to hours; are mesh.unit, the conductances and conductivities right?"});
}

/// Over all pours the same: a largest step that no step comes to.
void largest_step(const CaseSpec& spec, Findings& findings) {
  constexpr double k_half = 0.5;
  const double most = spec.time.adaptive ? spec.time.max_step.value_or(0) : 0;
  if (spec.time.steady || most <= k_half * *spec.time.end) return;
  findings.push_back({false, spec.time.where,
                      fmt::format("time.max_step of {} limits nothing: the whole run takes {}",
                                  duration(most), duration(*spec.time.end)),
                      "a tenth of the run and less, or none; is its unit right?"});
}

/// Rounds of a cycle in which no casting leaves go on with the one that was poured before. Where everything
/// stays, nothing is poured again.
void rounds_without_a_shot(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m,
                           Findings& findings) {
  for (const CycleSpec& cycle : spec.cycles) {
    const auto is_of_it = [&](const StageRun& stage) {
      return std::find(cycle.stages.begin(), cycle.stages.end(), stage.stage->name) != cycle.stages.end();
    };
    const bool leaves = std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& pour) {
      return std::any_of(a.stages.begin(), a.stages.end(), [&](const StageRun& stage) {
        return is_of_it(stage) && !holds(spec.bodies[pour.body].stages, &stage);
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
void heating(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, const Pour& pour,
             Findings& findings) {
  using Kind = ThermalConditionSpec::Kind;
  const std::string& name = spec.bodies[pour.body].name;
  const double solidus = solidus_of(a, pour);
  for (std::size_t i = 0; i < spec.thermal_conditions.size(); ++i) {
    const ThermalConditionSpec& c = spec.thermal_conditions[i];
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
        c.ambient.table.value(0) > solidus && c.ambient.table.value(0) < 1900 && is_number(c.coefficient) &&
        is_number(c.factor))
      findings.push_back(
          {false, c.where,
           fmt::format("the surroundings of '{}' have {:.0f} degC, above the solidus of '{}' at "
                       "{:.0f} degC: it does not freeze there",
                       c.name, celsius(c.ambient.table.value(0)), name, celsius(solidus)),
           "room temperature, or that of the cooling water"});
  }
}

/// A body that can melt, but starts cold beside one that is poured.
void cold_castings(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (m.pours.empty() || !spec.criteria.follow) return;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const material::PhaseChange* freezing = a.materials[b].solidification();
    if (freezing == nullptr || a.start[b].high >= freezing->fraction.liquidus()) continue;
    const Role role = role_of(spec.bodies[b], a.materials[b]);
    if (!is_poured(role)) continue;  // the case says that it is a chill
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
    if (spec.bodies[b].role == Role::riser) {
      findings.push_back({false, spec.bodies[b].where,
                          fmt::format("the riser '{}' starts solid at {:.0f} degC: it feeds nothing",
                                      spec.bodies[b].name, celsius(a.start[b].high)),
                          "the temperature of what is poured with it"});
      continue;
    }
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
double common_temperature(const Assembly& a, const CaseMeasures& m) {
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
void bodies_that_melt(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
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
         "a mould that stands the heat of what lies in it, or a colder start"});
  }
}

/// Melt beside melt: a contact parts them, and common nodes make two alloys one liquid.
void melts_side_by_side(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  const auto poured = [&](int body) {
    return std::any_of(m.pours.begin(), m.pours.end(),
                       [&](const Pour& p) { return static_cast<int>(p.body) == body; });
  };
  // Contacts between poured bodies, then common nodes of different alloys.
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const ContactMeasures& contact = m.contacts[c];
    if (!poured(contact.slave_body) || !poured(contact.master_body) ||
        contact.slave_body == contact.master_body || !holds(spec, spec.contacts[c], a.mesh, a.first_stage()))
      continue;
    findings.push_back(
        {false, spec.contacts[c].where,
         fmt::format("the contact '{}' joins '{}' and '{}', which are both poured: melt does not flow across "
                     "it, and one does not feed the other",
                     spec.contacts[c].name, spec.bodies[static_cast<std::size_t>(contact.slave_body)].name,
                     spec.bodies[static_cast<std::size_t>(contact.master_body)].name),
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

/// Feeders that touch no melt, or that lie where melt does not flow down from. Collective.
void feeders(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (m.pours.empty()) return;
  std::vector<int> poured(a.mesh.x.size(), -1);
  for (const mesh::ElementBlock& block : a.mesh.blocks)
    for (const Pour& pour : m.pours)
      if (static_cast<int>(pour.body) == block.body)
        for (const Index node : block.nodes) poured[static_cast<std::size_t>(node)] = block.body;
  const std::array<double, 3> g = gravity(spec.analysis);
  double all = 0;                             // nodes of all that is poured
  double all_low = 1e300, all_high = -1e300;  // its ends, against gravity
  const auto ends = [&](std::size_t body) {
    double low = 0, high = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double first = -g[d] * m.bodies[body].low[d], second = -g[d] * m.bodies[body].high[d];
      low += std::min(first, second), high += std::max(first, second);
    }
    return std::pair(low, high);
  };
  for (const Pour& pour : m.pours) {
    all += static_cast<double>(m.bodies[pour.body].nodes);
    const auto [low, high] = ends(pour.body);
    all_low = std::min(all_low, low), all_high = std::max(all_high, high);
  }
  for (const std::string& group : spec.criteria.feeders) {
    double height = 0;                                  // sum over its nodes
    std::vector<double> of_body(m.bodies.size(), 0.0);  // its nodes
    if (const auto nodes = a.mesh.node_sets.find(group); nodes != a.mesh.node_sets.end())
      for (const Index node : nodes->second) {
        const auto i = static_cast<std::size_t>(node);
        if (node >= a.mesh.n_owned_nodes || poured[i] < 0) continue;
        of_body[static_cast<std::size_t>(poured[i])] += 1;
        for (std::size_t d = 0; d < 3; ++d) height -= g[d] * a.mesh.x[i][d];
      }
    height = parallel::global_sum(height);
    double n = 0, lowest = 0, highest = 0;
    for (std::size_t body = 0; body < of_body.size(); ++body) {
      const double nodes = parallel::global_sum(of_body[body]);
      // A riser that is a body of its own is above or below what is poured with it, a part of a body within
      // it.
      const bool whole = nodes > 0.9 * static_cast<double>(m.bodies[body].nodes);
      const auto [low, high] = whole ? std::pair(all_low, all_high) : ends(body);
      n += nodes, lowest += nodes * low, highest += nodes * high;
    }
    if (n == 0)
      findings.push_back({true, spec.criteria.where,
                          fmt::format("the feeder '{}' has no node of a body that is poured", group),
                          "a surface or volume of the casting: melt that it touches is fed"});
    else if (n > 0.9 * all)
      findings.push_back({false, spec.criteria.where,
                          fmt::format("the feeder '{}' is all that is poured: no pore is looked for", group),
                          "the riser, or the surface through which the casting is fed"});
    else if (height < lowest + 0.25 * (highest - lowest))
      findings.push_back(
          {false, spec.criteria.where,
           fmt::format("the feeder '{}' lies in the lowest quarter of its casting, by the direction "
                       "of gravity",
                       group),
           "feeders above what they feed; is gravity_direction right?"});
  }
}

}  // namespace

void find_in_freezing(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
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
  feeders(spec, a, m, findings);
}

}  // namespace solidus::model
