// Findings on bodies whose place, start or cooling does not fit what they are to the foundry.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_hot_chill = 673.15, k_conducts = 8;  // [K]; less than any metal, more than sand [W/(m K)]
constexpr double k_insulates = 450;  // √(kρc), less than plaster and loose sand, 570 and 600 [W √s/(m² K)]
constexpr double k_sand = 3, k_on_sand = 500, k_on_riser = 300;  // [W/(m K)], films [W/(m² K)]
constexpr double k_hottest_air = 1900;                     // hotter surroundings: findings/conditions.cpp [K]
constexpr double k_air = 0.99e5, k_air_at_most = 1.016e5;  // pressures of the air [Pa]
constexpr double k_least_feeding = 0.3, k_most_evaluation = 0.5;  // criteria

using Kind = cases::ThermalConditionSpec::Kind;

double celsius(double kelvin) {
  return units::to_display(kelvin, "K", "degC");
}

/// A chill takes heat up because it is cold and conducts.
void chills(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
            Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    if (m.is_poured(b) || cases::role_of(body, a.materials[b]) != cases::Role::chill) continue;
    if (a.start[b].high > k_hot_chill)
      findings.push_back(
          {false, body.where,
           fmt::format("the chill '{}' starts at {:.0f} degC", body.name, celsius(a.start[b].high)),
           "chills start at 20 to 200 degC"});
    if (const double k = a.materials[b].conductivity.value(a.start[b].high); k < k_conducts)
      findings.push_back(
          {false, body.where,
           fmt::format("the chill '{}' of '{}' conducts {:.3g} W/m/K", body.name, body.material, k),
           "chills are of iron, copper or graphite: 30 to 400 W/m/K"});
  }
}

/// A mould takes up what the metal gives off; insulation on the metal is a sleeve.
void insulating_moulds(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                       Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    if (body.role != cases::Role::mould || m.is_poured(b)) continue;
    // In contact with something poured, from either side.
    const bool on_metal = std::ranges::any_of(m.contacts, [&](const setup::ContactMeasures& c) {
      const int self = static_cast<int>(b), other = c.slave_body == self ? c.master_body : c.slave_body;
      return (c.slave_body == self || c.master_body == self) && other >= 0 && m.is_poured(as_size(other));
    });
    const material::Material& of = a.materials[b];
    // The heat that a half space takes up in a given time goes as the root of the product of
    // conductivity, density and specific heat.
    const double start = a.start[b].high;
    const double takes_up =
        std::sqrt(of.conductivity.value(start) * of.density * of.specific_heat.value(start));
    if (!on_metal || takes_up >= k_insulates) continue;
    findings.push_back(
        {false, body.where,
         fmt::format("the mould '{}' of '{}' takes up heat as insulation does: the root of k rho c is {:.0f} "
                     "W s^(1/2)/(m2 K)",
                     body.name, body.material, takes_up),
         "moulds of plaster and sand have 500 to 1600, ceramic shells 1000 to 1500; the role of insulation "
         "on metal is \"sleeve\""});
  }
}

/// Where every mould lies within the casting's box, groups or roles are swapped. A core may.
void swapped(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
             Findings& findings) {
  // Box within box, and the smaller volume: a mould around a casting has the larger one, or at
  // least reaches farther.
  const auto within = [&](std::size_t inner, std::size_t outer) {
    bool inside = true;
    for (std::size_t d = 0; d < as_size(a.mesh.dimension); ++d)
      inside = inside && m.bodies[inner].low[d] >= m.bodies[outer].low[d] &&
               m.bodies[inner].high[d] <= m.bodies[outer].high[d];
    return inside && m.bodies[inner].volume < m.bodies[outer].volume;
  };
  for (const Pour& pour : m.pours) {
    std::size_t moulds = 0, inside = 0, last = 0;
    // Cores are not counted, for they do lie within.
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      const cases::Role role = cases::role_of(spec.bodies[b], a.materials[b]);
      if (m.is_poured(b) || (role != cases::Role::mould && role != cases::Role::die)) continue;
      ++moulds;
      if (within(b, pour.body)) ++inside, last = b;
    }
    if (moulds > 0 && inside == moulds)
      findings.push_back({false, spec.bodies[pour.body].where,
                          fmt::format("the mould '{}' lies within the casting '{}'", spec.bodies[last].name,
                                      spec.bodies[pour.body].name),
                          "are their groups swapped? What lies within a casting is a core"});
  }
}

/// Films that water makes, on sand and on risers.
void strong_films(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                  Findings& findings) {
  for (std::size_t i = 0; i < spec.thermal_conditions.size(); ++i) {
    const cases::ThermalConditionSpec& c = spec.thermal_conditions[i];
    if (c.kind != Kind::film || m.surfaces[i].body < 0 || !is_number(c.coefficient) || !is_number(c.factor))
      continue;
    // The film acts on this body alone, with a number that is known.
    const auto b = as_size(m.surfaces[i].body);
    const double h = c.coefficient.table.value(0) * c.factor.table.value(0);
    if (is_number(c.factor) && c.factor.table.value(0) == 0)
      findings.push_back({false, c.where, fmt::format("the factor of '{}' is 0: it does nothing", c.name),
                          "above 0, or without the condition"});
    const std::string what =
        fmt::format("the film '{}' has {:g} W/m2/K on '{}'", c.name, h, spec.bodies[b].name);
    const bool poured = m.is_poured(b);
    // Sand cannot give off what such a film takes, since its own resistance is far larger.
    if (!poured && h > k_on_sand && a.materials[b].conductivity.value(a.start[b].low) < k_sand)
      findings.push_back({false, c.where, what + ", which conducts as sand does",
                          "sand is in air: 5 to 50 W/m2/K; water cools metal"});
    if (poured && h > k_on_riser && cases::role_of(spec.bodies[b], a.materials[b]) == cases::Role::riser)
      findings.push_back({false, c.where, what + ", which is to freeze last",
                          "risers are in air, 5 to 50 W/m2/K, or under a cover"});
  }
}

/// Finds films, radiation and held temperatures that keep a mould above the solidus of what is poured.
void heated_moulds(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                   Findings& findings) {
  if (m.pours.empty()) return;
  // The highest solidus of all that is poured: below it every casting can still freeze.
  double solidus = 0;
  for (const Pour& pour : m.pours)
    solidus = std::max(solidus, a.materials[pour.body].solidification()->fraction.solidus());
  for (std::size_t i = 0; i < spec.thermal_conditions.size(); ++i) {
    const cases::ThermalConditionSpec& c = spec.thermal_conditions[i];
    const bool surrounded = c.kind == Kind::film || c.kind == Kind::radiation;
    if ((!surrounded && c.kind != Kind::temperature) || !c.stages.empty() || m.surfaces[i].body < 0) continue;
    // Held temperatures and surroundings are compared alike, on bodies that are not poured.
    const auto b = as_size(m.surfaces[i].body);
    const Function& temperature = surrounded ? c.ambient : c.temperature;
    if (m.is_poured(b) || !is_number(temperature)) continue;
    const double level = temperature.table.value(0);
    if (level > solidus && level < k_hottest_air)
      findings.push_back(
          {false, c.where,
           fmt::format("'{}' {} '{}' at {:.0f} degC, above the solidus of what is poured, {:.0f} degC",
                       c.name, surrounded ? "surrounds" : "holds", spec.bodies[b].name, celsius(level),
                       celsius(solidus)),
           "room temperature, or that of channels"});
  }
}

/// Risers feed by their weight, and pressures are counted from that of the air.
void weight(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_mechanics() || m.pours.empty()) return;
  // Any component of gravity gives a weight.
  const std::array<double, 3> g = setup::gravity(spec.analysis);
  const bool weighs = std::any_of(g.begin(), g.end(), [](double v) { return v != 0; });
  for (const Pour& pour : m.pours)
    if (const cases::BodySpec& body = spec.bodies[pour.body]; !weighs && body.role == cases::Role::riser)
      findings.push_back({false, body.where,
                          fmt::format("the riser '{}' has no weight: gravity is 0", body.name),
                          "gravity = \"9.81 m/s2\" in [analysis]"});
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (c.kind != cases::MechanicalConditionSpec::Kind::pressure || !is_number(c.pressure)) continue;
    // Near one bar, and no farther off than the weather: this is the pressure of the air.
    if (const double p = c.pressure.table.value(0); p > k_air && p < k_air_at_most)
      findings.push_back(
          {false, c.where,
           fmt::format("'{}' presses with {:g} Pa, as the air does, which acts on all sides already", c.name,
                       p),
           "pressures above that of the air"});
  }
}

void criteria(const cases::CaseSpec& spec, Findings& findings) {
  const cases::CriteriaSpec& c = spec.criteria;
  const auto warn = [&](const std::string& what, const char* usual) {
    findings.push_back({false, c.where, what, usual});
  };
  if (!c.follow && !c.feeders.empty())
    warn(fmt::format("the feeder '{}' has no effect: criteria.follow = false", c.feeders.front()),
         "without criteria.follow, which is true then");
  if (c.follow && c.feeding_limit < k_least_feeding)
    warn(fmt::format("criteria.feeding_limit = {:g}: melt that is {:.0f} % liquid feeds no more",
                     c.feeding_limit, 100 * (1 - c.feeding_limit)),
         "0.5 to 0.9, a fraction of solid");
  if (c.follow && c.evaluation > k_most_evaluation)
    warn(fmt::format("criteria.evaluation = {:g}: gradients are taken near the liquidus", c.evaluation),
         "0 to 0.2, a share of the freezing range above the solidus");
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat()) return;
  chills(spec, a, m, findings);
  insulating_moulds(spec, a, m, findings);
  swapped(spec, a, m, findings);
  strong_films(spec, a, m, findings);
  heated_moulds(spec, a, m, findings);
  weight(spec, m, findings);
  criteria(spec, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_roles() {
  return {
      .name = "roles",
      .place = 240,
      .find = &find,
      .rows = {
          {Topic::pour, "a chill that takes up no heat",
           fmt::format("it starts above {:.0f} °C, or conducts less than {} W/m/K",
                       k_hot_chill - k_zero_celsius, number(k_conducts))},
          {Topic::pour, "a mould of insulation",
           fmt::format("a body with the role of a mould, next to metal, has a heat diffusivity √(kρc) below "
                       "{} W√s/(m²K): plaster and loose sand have 570 and 600",
                       number(k_insulates))},
          {Topic::pour, "a mould within its casting",
           "every mould or die lies in the casting's bounding box: perhaps groups or roles are swapped"},
          {Topic::pour, "a riser without weight, or cooled",
           fmt::format("gravity is zero where a riser deforms; a film above {} W/m²K on it",
                       number(k_on_riser))},
          {Topic::pour, "criteria that evaluate nothing",
           fmt::format("feeders with `follow = false`; a `feeding_limit` below {}, an `evaluation` above {}",
                       number(k_least_feeding), number(k_most_evaluation))},
          {Topic::conditions, "a mould that is kept above the solidus",
           "surroundings or a temperature of one number, at all times"},
          {Topic::conditions, "water on sand",
           fmt::format("a film above {} W/m²K on a body that conducts less than {} W/m/K and is not poured",
                       number(k_on_sand), number(k_sand))},
          {Topic::conditions, "a film whose factor is 0", "of one number"},
          {Topic::mechanics, "the pressure of the air as a load",
           fmt::format("{} to {} bar: pressures are counted from it", number(1e-5 * k_air),
                       number(1e-5 * k_air_at_most))}}};
}

}  // namespace solidus::check
