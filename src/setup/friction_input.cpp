/// Keys of friction and wear become their specifications, in SI.
#include "setup/friction_input.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "input/units.hpp"

namespace solidus::setup {
namespace {

/// The unit of the internal variable, in SI.
double unit_of(const cases::FrictionSpec& spec) {
  const bool slip = spec.internal_variable == contact::InternalVariable::slip;
  const char* si = slip ? "m" : "N/m";
  const std::string unit = spec.internal_variable_unit.value_or(si);
  if (!units::compatible(unit, si))
    throw InputError(spec.where,
                     fmt::format("internal_variable_unit = \"{}\" is no unit of {}", unit,
                                 slip ? "slip" : "work per area"),
                     slip ? "a length, as \"mm\"" : "force per length, as \"kN/mm\" (work per area)");
  return units::conversion(unit, si).scale;
}

contact::FrictionCurve curve(const cases::FrictionCurveSpec& spec, bool only) {
  if (!spec.temperature && !only)
    throw InputError(spec.where, "one of several friction curves has no temperature",
                     "a temperature for each");
  if (spec.internal_variable.size() != spec.coefficient.size())
    throw InputError(
        spec.where,
        fmt::format("a friction curve has {} values of the internal variable and {} coefficients",
                    spec.internal_variable.size(), spec.coefficient.size()),
        "as many of both");
  try {
    return {spec.temperature.value_or(0), Table(spec.internal_variable, spec.coefficient)};
  } catch (const std::invalid_argument& e) {
    throw InputError(spec.where, e.what(), "internal_variable = [0, …] that rises");
  }
}

}  // namespace

contact::FrictionParameters friction_spec(const cases::FrictionSpec& spec) {
  contact::FrictionParameters r;
  r.where = r.coefficient.where = spec.where;
  r.internal_variable = spec.internal_variable;
  r.coefficient.unit = unit_of(spec);
  r.coefficient.law = spec.law;
  for (const Function& term : spec.coefficient) r.coefficient.terms.push_back(term.table);
  for (const cases::FrictionCurveSpec& c : spec.curves)
    r.coefficient.curves.push_back(curve(c, spec.curves.size() == 1));
  r.tangential_penalty = spec.tangential_penalty;
  r.tangential_penalty_factor = spec.tangential_penalty_factor;
  r.symmetric = spec.symmetric;
  r.thermal_return_mapping = spec.thermal_return_mapping;
  contact::FrictionCoefficient checked(r.coefficient);
  return r;
}

contact::WearParameters wear_spec(const cases::WearSpec& spec) {
  return {spec.archard, spec.hardness.table, spec.master_share, spec.where};
}

}  // namespace solidus::setup
