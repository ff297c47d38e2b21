/// [contact.friction], [contact.wear] and [contact.interface] as the user wrote them, in SI
/// (setup/friction_input.hpp makes the contact room's specifications of them).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/interface/friction.hpp"
#include "input/keys.hpp"

namespace solidus::cases {

struct FrictionCurveSpec {
  std::optional<double> temperature;  ///< [K]
  std::vector<double> internal_variable, coefficient;
  SourceLocation where;
};

struct FrictionSpec {
  std::shared_ptr<const contact::CoefficientLaw> law;  ///< null: coefficient or curves
  std::vector<Function> coefficient;                   ///< μ_0, μ_1, …; empty: curves
  std::vector<FrictionCurveSpec> curves;
  contact::InternalVariable internal_variable = contact::InternalVariable::normal_work;
  std::optional<std::string> internal_variable_unit;
  std::optional<double> tangential_penalty;  ///< ε_T [N/m³]; absent: from the factor
  double tangential_penalty_factor = 0;      ///< of ε_N
  bool symmetric = false;
  bool thermal_return_mapping = false;
  SourceLocation where;
};

struct WearSpec {
  double archard = 0;  ///< k [1]
  Function hardness;   ///< [Pa] of temperature
  double master_share = 0;
  SourceLocation where;
};

struct InterfaceSpec {
  double heat_capacity = 0;  ///< C_co [J/(m² K)]
};

Section<FrictionSpec> friction_keys();
Section<WearSpec> wear_keys();
Section<InterfaceSpec> interface_keys();

}  // namespace solidus::cases
