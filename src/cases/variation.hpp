/// Variations of a case: factors and shifts on the data of its bodies, contacts and conditions ([vary]), and
/// how far these data may be off ([spread]). Both name the same quantities in the same places.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "input/keys.hpp"
#include "material/spread.hpp"
#include "material/varied.hpp"

namespace solidus::cases {

struct CaseSpec;

/// Variation of a body: of its material, and of its temperature at the start.
struct BodyFactors : material::MaterialFactors {
  double initial_temperature = 0;  ///< [K], added
};
struct BodySpreads : material::MaterialSpreads {
  std::optional<material::Spread> initial_temperature;
};

/// Variation of the heat transfer of a contact (contact/interface/heat_transfer.hpp).
struct ContactFactors {
  double conductance = 1, gap = 1;
};
struct ContactSpreads {
  std::optional<material::Spread> conductance, gap;
};

/// Variation of a thermal condition.
struct ConditionFactors {
  double coefficient = 1;  ///< on coefficient, emissivity, flux, power or heat, whichever its kind has
  double temperature = 0;  ///< added to ambient or temperature [K]
};
struct ConditionSpreads {
  std::optional<material::Spread> coefficient, temperature;
};

/// By the names of bodies, contacts and thermal conditions.
struct VarySpec {
  std::map<std::string, BodyFactors> bodies;
  std::map<std::string, ContactFactors> contacts;
  std::map<std::string, ConditionFactors> conditions;
  SourceLocation where;
};
struct SpreadSpec {
  std::map<std::string, BodySpreads> bodies;
  std::map<std::string, ContactSpreads> contacts;
  std::map<std::string, ConditionSpreads> conditions;
  SourceLocation where;
};

Section<VarySpec> vary_keys();
Section<SpreadSpec> spread_keys_of_case();
/// Keys of the spreads of a contact, also of a card of the library of interface laws.
Section<ContactSpreads> contact_spread_keys(const char* name, const char* doc);
/// Checks both spreads of a card or a contact. Throws InputError.
void check_spreads(const ContactSpreads& spreads, const std::string& of);

/// Checks names and spreads, and varies conditions and the temperatures at the start; bodies and contacts
/// follow with their materials and laws. Throws InputError.
void vary_conditions(CaseSpec& spec);
/// Varies the laws of heat transfer of the contacts, those of interfaces among them. Throws InputError for a
/// name that no contact with heat has.
void vary_contacts(CaseSpec& spec);

}  // namespace solidus::cases
