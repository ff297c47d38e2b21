/// Factors and spreads are declared once for each quantity and applied to the specification.
#include "cases/variation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/case_spec.hpp"
#include "system/log.hpp"

namespace solidus::cases {

namespace {

template <class T>
Key& factor_key(Section<T>& s, const char* key, double T::*member, const std::string& doc) {
  constexpr double k_most = 100;
  return s.key(key, member).initially(1.0).range(1 / k_most, k_most).doc(doc);
}
template <class T>
Key& shift_key(Section<T>& s, const char* key, double T::*member, const std::string& doc) {
  constexpr double k_most = 500;  // [K]
  return s.quantity(key, member, "K").difference().initially("0 K").range(-k_most, k_most).doc(doc);
}

/// Keys of the factors of a body's material.
Section<BodyFactors> body_vary_keys() {
  Section<BodyFactors> s("body", "Of a body, by its name: its material and its temperature at the start.");
  for (const material::VariedProperty& row : material::varied_properties()) {
    double BodyFactors::*const member = row.factor;
    if (row.shift)
      shift_key(s, row.key, member, fmt::format("{} Added.", row.doc));
    else
      factor_key(s, row.key, member, fmt::format("{} A factor.", row.doc));
  }
  shift_key(s, "initial_temperature", &BodyFactors::initial_temperature,
            "Added to the temperature at the start.");
  return s;
}

/// Keys of the factors of a contact.
Section<ContactFactors> contact_vary_keys() {
  Section<ContactFactors> s("contact",
                            "Of the heat through a contact, by its name; that of an interface is A_B.");
  factor_key(s, "conductance", &ContactFactors::conductance, "On the conductance of contact. A factor.");
  factor_key(s, "gap", &ContactFactors::gap,
             "On the conductance of the open gap (for example of its gas), which lies in series with the "
             "resistance of contact. A factor.");
  return s;
}

/// Keys of the factors of a condition.
Section<ConditionFactors> condition_vary_keys() {
  Section<ConditionFactors> s("thermal_condition", "Of a thermal condition, by its name.");
  factor_key(s, "coefficient", &ConditionFactors::coefficient,
             "On coefficient, emissivity, flux, power or heat, whichever the kind has. A factor.");
  shift_key(s, "temperature", &ConditionFactors::temperature, "Added to ambient or temperature.");
  return s;
}

/// Keys of the spreads of a body.
Section<BodySpreads> body_spread_keys() {
  Section<BodySpreads> s("body",
                         "Of a body, by its name; it replaces the spread in the file of its material.");
  for (const material::VariedProperty& row : material::varied_properties()) {
    std::optional<material::Spread> BodySpreads::*const member = row.spread;
    s.section(row.key, member, material::spread_keys()).doc(row.doc);
  }
  s.section("initial_temperature", &BodySpreads::initial_temperature, material::spread_keys())
      .doc("Of the temperature at the start.");
  return s;
}

/// Keys of the spreads of a condition.
Section<ConditionSpreads> condition_spread_keys() {
  Section<ConditionSpreads> s("thermal_condition", "Of a thermal condition, by its name.");
  s.section("coefficient", &ConditionSpreads::coefficient, material::spread_keys())
      .doc("Of coefficient, emissivity, flux, power or heat.");
  s.section("temperature", &ConditionSpreads::temperature, material::spread_keys())
      .doc("Of ambient or temperature.");
  return s;
}

template <class Map, class Sections>
void check_names(const Map& named, const Sections& sections, const char* heading,
                 const SourceLocation& where) {
  std::vector<std::string> names;
  for (const auto& section : sections) names.push_back(section.name);
  for (const auto& [name, data] : named)
    if (std::ranges::find(names, name) == names.end())
      throw InputError(where, fmt::format("there is no {} named '{}' to vary", heading, name),
                       one_of(names, name));
}

/// A constant or a table, changed at every point; what is given by place has a function of its own.
void change(Function& f, double factor, double shift, const std::string& what) {
  if (f.place != nullptr)
    throw InputError(f.where, fmt::format("{} is a function of place and cannot be varied", what),
                     "a number or a table");
  // The arguments and the extrapolation of a table stay; only its values change.
  const Table& old = f.table;
  std::vector<double> x(old.x().begin(), old.x().end()), y(old.y().begin(), old.y().end());
  for (double& value : y) value = value * factor + shift;
  f.table = old.constant() ? Table(y.front()) : Table(std::move(x), std::move(y), old.extrapolation());
}

void vary(ThermalConditionSpec& c, const ConditionFactors& by) {
  // The factor of the coefficient acts on what the kind of the condition has in its place: film coefficient,
  // emissivity, flux, power or heat.
  using Kind = ThermalConditionSpec::Kind;
  const std::string what = fmt::format("the thermal condition '{}'", c.name);
  if (by.coefficient != 1) {
    switch (c.kind) {
      case Kind::film:
        change(c.coefficient, by.coefficient, 0, what);
        break;
      case Kind::radiation:
        change(c.emissivity, by.coefficient, 0, what);
        break;
      case Kind::flux:
        change(c.flux, by.coefficient, 0, what);
        break;
      case Kind::source:
        change(c.power, by.coefficient, 0, what);
        break;
      case Kind::exothermic:
        c.heat *= by.coefficient;
        break;
      case Kind::temperature:
        throw InputError(c.where, what + " has no coefficient to vary", "temperature, which is a shift");
    }
    // An emissivity stays at one at most, whatever its factor.
    if (c.kind == Kind::radiation && c.emissivity.table.max_value() > 1)
      change(c.emissivity, 1 / c.emissivity.table.max_value(), 0, what);
  }
  // A shift of the temperature is one of the surroundings, or of the temperature that is held.
  if (by.temperature == 0) return;
  if (c.kind == Kind::film || c.kind == Kind::radiation)
    change(c.ambient, 1, by.temperature, what);
  else if (c.kind == Kind::temperature)
    change(c.temperature, 1, by.temperature, what);
  else
    throw InputError(c.where, what + " has no temperature to vary", "coefficient, which is a factor");
}

/// Spreads of temperatures are shifts, all others are relative or factors.
void check_spreads(const SpreadSpec& spreads) {
  const auto check = [](const std::optional<material::Spread>& spread, bool temperature,
                        const std::string& key, const std::string& of) {
    if (spread) material::check_spread(*spread, temperature, fmt::format("'{}' of '{}'", key, of));
  };
  for (const auto& [name, body] : spreads.bodies) {
    for (const material::VariedProperty& row : material::varied_properties())
      check(body.*row.spread, row.shift, row.key, name);
    check(body.initial_temperature, true, "initial_temperature", name);
  }
  for (const auto& [name, contact] : spreads.contacts) check_spreads(contact, name);
  for (const auto& [name, condition] : spreads.conditions) {
    check(condition.coefficient, false, "coefficient", name);
    check(condition.temperature, true, "temperature", name);
  }
}

/// Factors and shifts that change something, in words: "conductivity x 1.1".
class Changes {
 public:
  void factor(const std::string& where, const std::string& key, double by) {
    if (by != 1) texts_.push_back(fmt::format("{} of {} x {:.4g}", key, where, by));
  }
  void shift(const std::string& where, const std::string& key, double by) {
    if (by != 0) texts_.push_back(fmt::format("{} of {} {:+.4g} K", key, where, by));
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::vector<std::string> texts_;
};

/// Says what is not as the data have it: cards and files of the case do not show it.
void announce(const VarySpec& vary) {
  Changes changes;
  for (const auto& [name, body] : vary.bodies) {
    for (const material::VariedProperty& row : material::varied_properties())
      row.shift ? changes.shift(name, row.key, body.*row.factor)
                : changes.factor(name, row.key, body.*row.factor);
    changes.shift(name, "initial_temperature", body.initial_temperature);
  }
  for (const auto& [name, contact] : vary.contacts) {
    changes.factor(name, "conductance", contact.conductance);
    changes.factor(name, "gap", contact.gap);
  }
  for (const auto& [name, condition] : vary.conditions) {
    changes.factor(name, "coefficient", condition.coefficient);
    changes.shift(name, "temperature", condition.temperature);
  }
  if (!changes.texts().empty()) logging::info("varied: {}", fmt::join(changes.texts(), ", "));
}

}  // namespace

Section<ContactSpreads> contact_spread_keys(const char* name, const char* doc) {
  Section<ContactSpreads> s(name, doc);
  s.section("conductance", &ContactSpreads::conductance, material::spread_keys())
      .doc("Of the conductance of contact.");
  s.section("gap", &ContactSpreads::gap, material::spread_keys())
      .doc("Of the conductance of the open gap, which lies in series with the resistance of contact.");
  return s;
}

void check_spreads(const ContactSpreads& spreads, const std::string& of) {
  if (spreads.conductance)
    material::check_spread(*spreads.conductance, false, fmt::format("'conductance' of '{}'", of));
  if (spreads.gap) material::check_spread(*spreads.gap, false, fmt::format("'gap' of '{}'", of));
}

/// Keys of [vary]: factors and shifts by which a study varies a case.
Section<VarySpec> vary_keys() {
  Section<VarySpec> s("vary",
                      "Factors and shifts on data of the case, for whole tables: for studies; `solidus "
                      "uncertain` changes them from run to run.");
  s.named_sections("body", &VarySpec::bodies, body_vary_keys());
  s.named_sections("contact", &VarySpec::contacts, contact_vary_keys());
  s.named_sections("thermal_condition", &VarySpec::conditions, condition_vary_keys());
  s.place(&VarySpec::where);
  return s;
}

Section<SpreadSpec> spread_keys_of_case() {
  Section<SpreadSpec> s("spread",
                        "How far data of the case may differ from the true values, for `solidus uncertain`; "
                        "a run ignores it. Names as in [vary].");
  s.named_sections("body", &SpreadSpec::bodies, body_spread_keys());
  s.named_sections("contact", &SpreadSpec::contacts,
                   contact_spread_keys("contact", "Of the heat through a contact, by its name."));
  s.named_sections("thermal_condition", &SpreadSpec::conditions, condition_spread_keys());
  s.place(&SpreadSpec::where);
  return s;
}

void vary_conditions(CaseSpec& spec) {
  check_names(spec.vary.bodies, spec.bodies, "body", spec.vary.where);
  check_names(spec.vary.conditions, spec.thermal_conditions, "thermal condition", spec.vary.where);
  check_names(spec.spread.bodies, spec.bodies, "body", spec.spread.where);
  check_names(spec.spread.conditions, spec.thermal_conditions, "thermal condition", spec.spread.where);
  check_spreads(spec.spread);
  // Then bodies, conditions and, where the mesh has made them, contacts change by what [vary] says.
  announce(spec.vary);
  for (BodySpec& body : spec.bodies)
    if (const auto by = spec.vary.bodies.find(body.name);
        by != spec.vary.bodies.end() && by->second.initial_temperature != 0)
      change(body.initial_temperature, 1, by->second.initial_temperature,
             fmt::format("the initial_temperature of '{}'", body.name));
  for (ThermalConditionSpec& condition : spec.thermal_conditions)
    if (const auto by = spec.vary.conditions.find(condition.name); by != spec.vary.conditions.end())
      vary(condition, by->second);
}

/// Contacts are varied later than all else, because interfaces become contacts only with the mesh.
void vary_contacts(CaseSpec& spec) {
  check_names(spec.vary.contacts, spec.contacts, "contact", spec.vary.where);
  check_names(spec.spread.contacts, spec.contacts, "contact", spec.spread.where);
  for (ContactSpec& contact : spec.contacts) {
    const auto by = spec.vary.contacts.find(contact.name);
    if (by == spec.vary.contacts.end()) continue;
    if (!contact.heat)
      throw InputError(spec.vary.where, fmt::format("no heat passes the contact '{}'", contact.name),
                       "a contact with [contact.heat]");
    contact.heat->conductance_factor = by->second.conductance;
    contact.heat->gap_factor = by->second.gap;
  }
}

}  // namespace solidus::cases
