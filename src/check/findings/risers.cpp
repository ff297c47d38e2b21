// Findings on what belongs together in a casting: risers and what they feed, and groups that are swapped.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_early = 0.4;                                   // time of a riser, of that of its casting
constexpr double k_large = 2;                                     // volume of risers, of that of castings
constexpr double k_outside = 0.01, k_within = 0.5;                // of the box of a core, of a chill
constexpr double k_hottest_sand = 673.15;                         // [K]
constexpr double k_sand = 3, k_stands = 2e6, k_on_riser = 0.6e6;  // [W/(m K)], pressures [Pa]

double celsius(double kelvin) {
  return units::to_display(kelvin, "K", "degC");
}

bool is_riser(const cases::CaseSpec& spec, const Pour& pour) {
  return spec.bodies[pour.body].role == cases::Role::riser;
}

/// A riser that freezes long before its casting feeds nothing. Compared are the times that both would take
/// alone: where they meet they freeze together.
void risers_that_freeze_first(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (const Pour& riser : m.pours) {
    if (!is_riser(spec, riser) || !riser.alone_time) continue;
    for (const Pour& fed : m.pours) {
      if (is_riser(spec, fed) || !fed.alone_time || m.bodies[riser.body].shared_nodes[fed.body] == 0 ||
          *riser.alone_time > k_early * *fed.alone_time)
        continue;
      findings.push_back(
          {false, spec.bodies[riser.body].where,
           fmt::format("the riser '{}' freezes in some {:.2g} min, '{}', which it feeds, in some {:.2g} min",
                       spec.bodies[riser.body].name, *riser.alone_time / 60, spec.bodies[fed.body].name,
                       *fed.alone_time / 60),
           "a riser freezes last: a larger one, a sleeve or a cover"});
    }
  }
}

/// A riser that touches no other melt feeds nothing.
void risers_apart(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  // Metal passes by shared nodes; a contact at least shows that it was meant to.
  const auto touches = [&](std::size_t one, std::size_t other) {
    return m.bodies[one].shared_nodes[other] > 0 ||
           std::ranges::any_of(m.contacts, [&](const setup::ContactMeasures& contact) {
             const auto a = static_cast<int>(one), b = static_cast<int>(other);
             return (contact.slave_body == a && contact.master_body == b) ||
                    (contact.slave_body == b && contact.master_body == a);
           });
  };
  for (const Pour& riser : m.pours) {
    // A riser counts as apart where a casting is there and nothing that is poured touches it.
    bool castings = false, apart = true;
    for (const Pour& other : m.pours) {
      if (other.body == riser.body) continue;
      castings = castings || !is_riser(spec, other);
      apart = apart && !touches(riser.body, other.body);
    }
    if (is_riser(spec, riser) && castings && apart)
      findings.push_back({false, spec.bodies[riser.body].where,
                          fmt::format("the riser '{}' touches no other body that is poured: it feeds nothing",
                                      spec.bodies[riser.body].name),
                          "nodes that it shares with its casting; is its foot on it?"});
  }
}

void risers_larger_than_castings(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  double castings = 0, risers = 0;
  const Pour* largest = nullptr;
  // Volumes of castings and of risers; a riser much larger than its casting is hardly meant.
  for (const Pour& pour : m.pours) {
    const double volume = m.bodies[pour.body].volume;
    (is_riser(spec, pour) ? risers : castings) += volume;
    if (is_riser(spec, pour) && (!largest || volume > m.bodies[largest->body].volume)) largest = &pour;
  }
  if (!largest || !(castings > 0) || risers < k_large * castings) return;
  findings.push_back({false, spec.bodies[largest->body].where,
                      fmt::format("what is poured as riser ('{}') is {:.2g} times as large as what it feeds",
                                  spec.bodies[largest->body].name, risers / castings),
                      "a tenth of the casting's volume to all of it; are the groups swapped?"});
}

/// Ends of the box of a body against gravity [m].
struct Heights {
  double low = 0, high = 0;
};

Heights heights(const BodyMeasures& body, const std::array<double, 3>& gravity) {
  const double size = std::hypot(gravity[0], gravity[1], gravity[2]);
  Heights ends;
  for (std::size_t d = 0; d < 3; ++d) {
    const double first = -gravity[d] / size * body.low[d], second = -gravity[d] / size * body.high[d];
    ends.low += std::min(first, second), ends.high += std::max(first, second);
  }
  return ends;
}

/// Melt flows down out of a riser: one whose top is below the middle of all castings that it touches feeds
/// nothing. Feeders that [criteria] names: findings/feeders.cpp.
void risers_below_castings(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  const std::array<double, 3> g = setup::gravity(spec.analysis);
  if (!(std::hypot(g[0], g[1], g[2]) > 0)) return;
  for (const Pour& riser : m.pours) {
    // Risers that the criteria name as feeders are judged with those.
    const std::vector<std::string>& named = spec.criteria.feeders;
    if (!is_riser(spec, riser) ||
        std::ranges::find(named, spec.bodies[riser.body].mesh_group()) != named.end())
      continue;
    // Heights are counted against gravity, from the box of the body.
    const double top = heights(m.bodies[riser.body], g).high;
    const Pour* fed = nullptr;
    bool above = false;
    // One casting whose middle is below its top is enough: it feeds that one.
    for (const Pour& casting : m.pours) {
      if (is_riser(spec, casting) || m.bodies[riser.body].shared_nodes[casting.body] == 0) continue;
      const Heights of_casting = heights(m.bodies[casting.body], g);
      fed = &casting;
      above = above || top > 0.5 * (of_casting.low + of_casting.high);
    }
    if (fed == nullptr || above) continue;
    findings.push_back({false, spec.bodies[riser.body].where,
                        fmt::format("the riser '{}' ends below the middle of '{}', as gravity acts",
                                    spec.bodies[riser.body].name, spec.bodies[fed->body].name),
                        "risers are above what they feed or next to its top; is gravity_direction right?"});
  }
}

/// The box of a body in space; round an axis it reaches as far on the other side.
struct Box {
  mesh::Point low, high;
};

Box box_of(const cases::CaseSpec& spec, const BodyMeasures& body) {
  Box box{body.low, body.high};
  if (spec.analysis.kind == AnalysisKind::axisymmetric) box.low[0] = -box.high[0];
  return box;
}

/// Share of the first box, in each direction, that the second one covers; of the direction with the least.
double covered(const Box& box, const Box& by, int dimension) {
  double least = 1;
  for (std::size_t d = 0; d < as_size(dimension); ++d) {
    const double length = box.high[d] - box.low[d];
    const double common = std::min(box.high[d], by.high[d]) - std::max(box.low[d], by.low[d]);
    least = std::min(least, length > 0 ? common / length : 1.0);
  }
  return least;
}

/// A core that lies outside all castings, and a chill that lies within one.
void swapped_cores_and_chills(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                              Findings& findings) {
  // The share of the body's box that lies within the box of a casting, for the casting that covers
  // it most.
  const auto most_covered = [&](std::size_t body) {
    double most = 0;
    for (const Pour& pour : m.pours)
      most = std::max(
          most, covered(box_of(spec, m.bodies[body]), box_of(spec, m.bodies[pour.body]), a.mesh.dimension));
    return most;
  };
  // Cores mostly lie within the casting, chills on its outside: a pair that is the other way round
  // is swapped.
  for (std::size_t core = 0; core < spec.bodies.size(); ++core) {
    if (m.is_poured(core) || cases::role_of(spec.bodies[core], a.materials[core]) != cases::Role::core ||
        most_covered(core) > k_outside)
      continue;
    for (std::size_t chill = 0; chill < spec.bodies.size(); ++chill)
      if (!m.is_poured(chill) &&
          cases::role_of(spec.bodies[chill], a.materials[chill]) == cases::Role::chill &&
          most_covered(chill) > k_within)
        findings.push_back(
            {false, spec.bodies[core].where,
             fmt::format("the core '{}' lies outside what is poured, and the chill '{}' within it",
                         spec.bodies[core].name, spec.bodies[chill].name),
             "are their groups swapped?"});
  }
}

/// A mould or core as hot as melt draws no heat from it.
void moulds_as_hot_as_melt(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                           Findings& findings) {
  double liquidus = 0;
  for (const Pour& pour : m.pours)
    liquidus = std::max(liquidus, a.materials[pour.body].solidification()->fraction.liquidus());
  for (std::size_t b = 0; b < spec.bodies.size() && liquidus > 0; ++b)
    if (!m.is_poured(b) && a.materials[b].solidification() == nullptr && a.start[b].low > liquidus)
      findings.push_back(
          {false, spec.bodies[b].where,
           fmt::format("the body '{}' starts at {:.0f} degC, above the liquidus of what is poured, {:.0f} "
                       "degC: it takes no heat up",
                       spec.bodies[b].name, celsius(a.start[b].low), celsius(liquidus)),
           "moulds and cores at 20 to 400 degC, shells for precision casting up to 1100 degC"});
}

/// The binder of sand burns or breaks long before it is as hot as a ceramic shell may be.
void hot_sand(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
              Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const std::string file = std::filesystem::path(spec.bodies[b].material).stem().string();
    const bool sand = file.find("sand") != std::string::npos;
    if (m.pours.empty() || m.is_poured(b) || !sand || a.start[b].low < k_hottest_sand) continue;
    findings.push_back({false, spec.bodies[b].where,
                        fmt::format("the body '{}' of '{}' starts at {:.0f} degC", spec.bodies[b].name,
                                    spec.bodies[b].material, celsius(a.start[b].low)),
                        "sand starts at 10 to 200 degC; ceramic shells at up to 1100 degC"});
  }
}

/// 373, 473 and 573 degC are 100, 200 and 300 degC in kelvins.
void moulds_in_kelvins(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                       Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (m.pours.empty() || m.is_poured(b) || a.start[b].low != a.start[b].high) continue;
    const double read = celsius(a.start[b].low);
    for (const double meant : {100.0, 200.0, 300.0})
      for (const double zero : {k_zero_celsius, 273.0})
        if (std::abs(read - zero - meant) < 0.01)
          findings.push_back({false, spec.bodies[b].where,
                              fmt::format("the body '{}' starts at {:g} degC", spec.bodies[b].name, read),
                              fmt::format("is it in K? {:g} K are {:.0f} degC", read, meant)});
  }
}

/// Melt that only conducts, next to melt that deforms: neither draws on the other.
void castings_that_only_conduct(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_mechanics()) return;
  for (const Pour& still : m.pours) {
    if (!cases::only_conducts(spec.bodies[still.body])) continue;
    for (const Pour& moving : m.pours)
      if (!cases::only_conducts(spec.bodies[moving.body]) &&
          m.bodies[still.body].shared_nodes[moving.body] > 0)
        findings.push_back(
            {false, spec.bodies[still.body].where,
             fmt::format("'{}' only conducts heat, but '{}', with which it is poured, deforms: it holds the "
                         "nodes that they share",
                         spec.bodies[still.body].name, spec.bodies[moving.body].name),
             "the same `physics` for both, or none"});
  }
}

/// Sand gives way to pressures that dies withstand; a riser under pressure has less than a die has.
void pressed_sand(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                  Findings& findings) {
  if (!spec.has_mechanics()) return;
  // Sand is told from metal by its conductivity, at the coldest start of the body.
  const auto sand_around = [&](int body) {
    return std::ranges::any_of(m.contacts, [&](const setup::ContactMeasures& contact) {
      const int other = contact.slave_body == body    ? contact.master_body
                        : contact.master_body == body ? contact.slave_body
                                                      : -1;
      if (other < 0) return false;
      const auto o = as_size(other);
      return !m.is_poured(o) && a.materials[o].conductivity.value(a.start[o].low) < k_sand;
    });
  };
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (c.kind != cases::MechanicalConditionSpec::Kind::pressure || c.pressure.place != nullptr) continue;
    // Pressures of tables count by their largest value.
    const double pressure = c.pressure.table.max_value();
    if (!(pressure > k_on_riser)) continue;
    const int body = setup::measure_surface(a.mesh, c.group, spec.analysis.kind).body;
    if (body < 0 || !m.is_poured(as_size(body)) || !sand_around(body)) continue;
    // On a riser the limit is lower, as gas presses there and no piston.
    const bool on_riser = spec.bodies[as_size(body)].role == cases::Role::riser;
    if (!on_riser && !(pressure > k_stands)) continue;
    findings.push_back({false, c.where,
                        fmt::format("'{}' presses '{}' with {:.3g} MPa, and its mould conducts as sand does",
                                    c.name, spec.bodies[as_size(body)].name, 1e-6 * pressure),
                        on_riser ? "risers under gas have 0.02 to 0.5 MPa; is the unit of the pressure right?"
                                 : "sand withstands 0.1 to 1 MPa; is the unit of the pressure right?"});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat()) return;
  risers_that_freeze_first(spec, m, findings);
  risers_apart(spec, m, findings);
  risers_larger_than_castings(spec, m, findings);
  risers_below_castings(spec, m, findings);
  swapped_cores_and_chills(spec, a, m, findings);
  moulds_as_hot_as_melt(spec, a, m, findings);
  hot_sand(spec, a, m, findings);
  moulds_in_kelvins(spec, a, m, findings);
  castings_that_only_conduct(spec, m, findings);
  pressed_sand(spec, a, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_risers() {
  return {
      .name = "risers",
      .place = 260,
      .find = &find,
      .rows = {
          {Topic::pour, "a riser that freezes first",
           fmt::format("by itself, without heat from the casting, it takes less than {} of the time of a "
                       "casting with which it shares nodes",
                       percent(k_early))},
          {Topic::pour, "a riser that stands apart",
           "it neither shares a node nor has a contact with another poured body, although there is a "
           "casting"},
          {Topic::pour, "risers larger than castings",
           fmt::format("{} times as large as the rest of the poured metal: perhaps groups are swapped",
                       number(k_large))},
          {Topic::pour, "a riser below its casting",
           "its top is below the middle of every casting with which it shares nodes, in the direction of "
           "gravity, and `criteria.feeders` does not name it"},
          {Topic::pour, "core and chill swapped",
           fmt::format("the bounding box of a core lies outside that of the poured metal, and {} of that of "
                       "a chill within it",
                       percent(k_within))},
          {Topic::pour, "a core or mould as hot as melt", "it starts above the liquidus of the poured metal"},
          {Topic::pour, "sand as hot as a shell",
           fmt::format("a body whose material has `sand` in its name starts above {:.0f} °C, where something "
                       "is poured",
                       k_hottest_sand - k_zero_celsius)},
          {Topic::pour, "a mould, core or chill in K",
           "it starts at 373, 473 or 573 °C (or .15 more): 100, 200 or 300 °C in kelvins"},
          {Topic::pour, "melt that only conducts next to melt that deforms", "they share nodes"},
          {Topic::mechanics, "a pressure of die casting on melt in sand",
           fmt::format(
               "above {} MPa, on a riser above {} MPa, where a body in contact conducts less than {} W/m/K",
               number(1e-6 * k_stands), number(1e-6 * k_on_riser), number(k_sand))}}};
}

}  // namespace solidus::check
