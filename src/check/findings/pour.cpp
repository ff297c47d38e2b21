// Findings on the pour: is it liquid, and is it the right body?
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

constexpr double k_apart = 100;           // of the hottest and the coldest body, where one is poured [K]
constexpr double k_hot = 573.15;          // hot for a mould [K]
constexpr double k_conducts = 5;          // more than sand, ceramics and insulation do [W/(m K)]
constexpr double k_most_superheat = 270;  // less than what kelvins read as degrees Celsius add [K]

double celsius(double kelvin) {
  return units::to_display(kelvin, "K", "degC");
}

/// The hottest body, where one is hotter than the others by a casting's measure; −1: none is.
int hottest(const setup::Assembly& a) {
  const auto hot = std::max_element(a.start.begin(), a.start.end(),
                                    [](const auto& x, const auto& y) { return x.high < y.high; });
  const auto cold = std::min_element(a.start.begin(), a.start.end(),
                                     [](const auto& x, const auto& y) { return x.low < y.low; });
  if (hot == a.start.end() || hot->high - cold->low < k_apart) return -1;
  return static_cast<int>(hot - a.start.begin());
}

/// Whether another body is part of a mould, by its role or name.
bool has_mould(const cases::CaseSpec& spec, std::size_t other_than) {
  const auto of_mould = [](std::optional<cases::Role> role) { return role && !cases::is_poured(*role); };
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (b != other_than &&
        (of_mould(spec.bodies[b].role) || of_mould(cases::role_in_name(spec.bodies[b].name))))
      return true;
  return false;
}

/// Bodies with the role of a casting or riser that do not freeze, next to others that do.
void risers_that_do_not_freeze(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    if (!body.role || !cases::is_poured(*body.role) || a.materials[b].solidification() != nullptr) continue;
    findings.push_back({false, body.where,
                        fmt::format("the {} '{}' is of '{}', which does not freeze", name(*body.role),
                                    body.name, body.material),
                        "the alloy that is poured, or the role of a chill, core or mould"});
  }
}

/// Bodies that are to be cast, of what does not freeze: where nothing else is poured, those without a role
/// too.
void castings_that_do_not_freeze(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  for (const material::Material& material : a.materials)
    if (material.solidification() != nullptr) return risers_that_do_not_freeze(spec, a, findings);
  // The hottest body, or the first where none is hot: the comparison below asks again.
  const auto hot = as_size(std::max(hottest(a), 0));
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    // Three signs that a body was meant to be cast: its role, sand that is hot, and a mould around
    // it.
    const bool told = body.role && cases::is_poured(*body.role);
    const bool of_sand = hottest(a) >= 0 && b == hot && !body.role && a.start[b].high > k_hot &&
                         a.materials[b].conductivity.value(a.start[b].high) < k_conducts;
    const bool in_a_mould =
        hottest(a) >= 0 && b == hot && !body.role && a.start[b].high > k_hot && has_mould(spec, b);
    if (!told && !of_sand && !in_a_mould) continue;
    findings.push_back(
        {false, body.where,
         fmt::format(
             "{} '{}', which starts at {:.0f} degC, is of '{}', which does not freeze: nothing is poured",
             told ? "the " + std::string(name(*body.role)) : "the hottest body,", body.name,
             celsius(a.start[b].high), body.material),
         "a material with a [[phase_change]] that is its solidification"});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  if (spec.has_heat() && spec.criteria.follow) castings_that_do_not_freeze(spec, a, findings);
  // A case that switches the criteria of castings off states that nothing freezes in it.
  if (!spec.has_heat() || !spec.criteria.follow || hottest(a) < 0) return;
  // Where the mould was filled its skin may begin hotter than the metal, which has cooled on its way.
  if (spec.filling) return;
  // The hottest body is taken for the casting: its role, then its superheat, then whether it freezes at all.
  const auto poured = as_size(hottest(a));
  const cases::BodySpec& body = spec.bodies[poured];
  if (body.role && !cases::is_poured(*body.role)) {
    const auto casting =
        std::find_if(spec.bodies.begin(), spec.bodies.end(),
                     [](const cases::BodySpec& other) { return other.role == cases::Role::casting; });
    if (casting != spec.bodies.end())
      findings.push_back(
          {false, body.where,
           fmt::format("the hottest body, '{}', has the role of a {}, and '{}' that of a casting: it "
                       "starts at {:.0f} degC",
                       body.name, name(*body.role), casting->name,
                       celsius(a.start[as_size(casting - spec.bodies.begin())].high)),
           "are the roles swapped?"});
  }
  const double start = a.start[poured].high;
  // Poured below the liquidus, it is partly or wholly solid; far above, kelvins were read as
  // degrees.
  if (const material::PhaseChange* freezing = a.materials[poured].solidification()) {
    const double liquidus = freezing->fraction.liquidus();
    if (start < liquidus)
      findings.push_back(
          {false, body.where,
           fmt::format(
               "the hottest body, '{}', starts at {:.0f} degC, below the liquidus of '{}' at {:.0f} degC: {}",
               body.name, celsius(start), body.material, celsius(liquidus),
               start < freezing->fraction.solidus() ? "nothing is liquid" : "it is partly solid"),
           "castings are poured 20 to 150 K above the liquidus; is the number in K?"});
    else if (start > liquidus + k_most_superheat)
      findings.push_back({false, body.where,
                          fmt::format("body '{}' starts {:.0f} K above the liquidus of '{}'", body.name,
                                      start - liquidus, body.material),
                          "castings are poured 20 to 150 K above the liquidus; is the number in K?"});
    return;
  }
  // Something else would be liquid at that temperature and starts cold: materials are swapped
  // between two bodies.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (const material::PhaseChange* freezing = a.materials[b].solidification();
        freezing != nullptr && a.start[b].high < freezing->fraction.solidus() &&
        start > freezing->fraction.liquidus())
      findings.push_back(
          {false, body.where,
           fmt::format(
               "the hottest body, '{}', is of '{}', which does not freeze, and '{}' of '{}', which would be "
               "liquid at {:.0f} degC, starts cold",
               body.name, body.material, spec.bodies[b].name, spec.bodies[b].material, celsius(start)),
           "are the materials of casting and mould swapped?"});
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_pour() {
  return {.name = "pour",
          .place = 50,
          .find = &find,
          .rows = {{Topic::pour,
                    fmt::format("the hottest body starts below its liquidus, or more than {} K above",
                                number(k_most_superheat)),
                    fmt::format("it can freeze, and is {} K hotter than the coldest body", number(k_apart))},
                   {Topic::pour, "a casting of a material that does not freeze",
                    fmt::format("a body has the role of a casting or riser; or nothing in the case freezes, "
                                "and the hottest body is of sand above {0:.0f} °C, or has no role and starts "
                                "above {0:.0f} °C next to a mould, core or chill (by role or name)",
                                k_hot - k_zero_celsius)},
                   {Topic::pour, "roles swapped",
                    "the hottest body is given another role than `casting` or `riser`, and a body that role"},
                   {Topic::materials, "materials swapped",
                    "the hottest body cannot freeze, and the material of a cold one would be liquid at the "
                    "temperature of the hottest"}}};
}

}  // namespace solidus::check
