/// A law gives a formula, which is read as that of the key `power` is.
#include "cases/source_law.hpp"

#include "cases/case_spec.hpp"
#include "input/keys.hpp"

namespace solidus::cases {

namespace {

/// The power that the case gives itself.
struct GivenPower {
  static constexpr std::string_view name = "given", doc = "`power` gives it";
  std::string power() const { return {}; }
};

}  // namespace

Kinds<SourceLaw>& source_laws() {
  static Kinds<SourceLaw> laws = [] {
    Kinds<SourceLaw> all("law of a heat source");
    all.add(kind_of<SourceLaw, SourceLawOf<GivenPower>>());
    return all;
  }();
  return laws;
}

void set_powers(CaseSpec& spec) {
  Key key;
  key.name = "power";
  key.unit = "W/m3";
  key.kind = Key::Kind::function;
  key.anywhere();
  for (ThermalConditionSpec& condition : spec.thermal_conditions) {
    const std::string formula = condition.law != nullptr ? condition.law->power() : std::string();
    if (formula.empty()) continue;
    Value power;
    power.set("formula", formula);
    power.where = condition.where;
    keys::read(power, key, condition.power);
  }
}

}  // namespace solidus::cases
