// Findings on what burns: sleeves and powders that never ignite, that burn too much or in the wrong body.
#include <fmt/format.h>

#include <algorithm>

#include "check/finding_family.hpp"
#include "input/units.hpp"

namespace solidus::check {

namespace {

double celsius(double kelvin) {
  return units::to_display(kelvin, "K", "degC");
}

struct Burning {
  const cases::ThermalConditionSpec& condition;
  Findings& findings;
  void warn(const std::string& what, const char* usual) const {
    findings.push_back({false, condition.where, fmt::format("'{}' {}", condition.name, what), usual});
  }
};

constexpr double k_least_heat = 1e7, k_most_heat = 2e10;  // [J/m³]
constexpr double k_shortest = 1, k_longest = 3600;        // [s]

/// Heat and duration of sleeves and of covers on risers.
void amounts(const Burning& burning) {
  const cases::ThermalConditionSpec& c = burning.condition;
  if (c.heat < k_least_heat || c.heat > k_most_heat)
    burning.warn(fmt::format("releases {:g} J/m3", c.heat),
                 "exothermic sleeves release 2e8 to 3e9 J/m3: heat per mass times density, per volume");
  if (c.duration < k_shortest || c.duration > k_longest)
    burning.warn(fmt::format("burns for {:g} s at each place", c.duration),
                 "sleeves burn for half a minute to some minutes");
}

/// Above it nothing ignites: what is there was switched off [K].
constexpr double k_switched_off = 3000;

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  // A sleeve is judged by its amounts of heat, by the body it is in, and by whether anything there gets hot
  // enough to ignite it.
  if (!spec.has_heat()) return;
  // What starts hottest is what could ignite the sleeve.
  double hottest = 0;
  for (const auto& start : a.start) hottest = std::max(hottest, start.high);
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    if (c.kind != cases::ThermalConditionSpec::Kind::exothermic) continue;
    const Burning burning{c, findings};
    amounts(burning);
    // The body is the one whose group the sleeve names; more than one body may share a group.
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      const cases::BodySpec& body = spec.bodies[b];
      if (body.mesh_group() != c.group) continue;
      // Heat within the casting itself would be latent heat counted twice.
      const bool poured =
          std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& p) { return p.body == b; });
      if (poured)
        burning.warn(fmt::format("burns in '{}', which is poured", body.name),
                     "the group of the sleeve, or of the cover, that burns");
      // Ignition above all starts is never reached, below the start of its own body it is reached
      // at once: both are mistakes of a unit or of a column.
      if (c.ignition > hottest && c.ignition < k_switched_off)
        burning.warn(fmt::format("ignites at {:.0f} degC, but nothing starts hotter than {:.0f} degC: it "
                                 "does not burn",
                                 celsius(c.ignition), celsius(hottest)),
                     "sleeves ignite at 200 to 900 degC");
      else if (!poured && c.ignition <= a.start[b].high)
        burning.warn(
            fmt::format("ignites at {:.0f} degC, and '{}' starts at {:.0f} degC: all of it burns from "
                        "the start",
                        celsius(c.ignition), body.name, celsius(a.start[b].high)),
            "sleeves ignite at 200 to 900 degC");
    }
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_exothermic() {
  return {.name = "what burns",
          .place = 280,
          .find = &find,
          .rows = {{Topic::pour, "what burns",
                    fmt::format("a poured body that burns; an ignition temperature above all initial "
                                "temperatures (above {} K counts as switched off), or below that of its own "
                                "body; a heat below {} or above {} J/m³; a duration below {} s or above {} s",
                                number(k_switched_off), number(k_least_heat), number(k_most_heat),
                                number(k_shortest), number(k_longest))}}};
}

}  // namespace solidus::check
