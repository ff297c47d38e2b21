/// A material: every property a table over absolute temperature, with its source and validity.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "material/casting.hpp"
#include "material/enthalpy.hpp"
#include "material/flow.hpp"
#include "material/gas.hpp"
#include "material/graphite.hpp"
#include "material/phase_change.hpp"
#include "numbers/table.hpp"
#include "numbers/types.hpp"

namespace solidus::material {

class ExternalLaw;  // external_law.hpp

/// Source and range of validity of a property; used to warn when a run leaves the range.
struct PropertyNote {
  std::string property, source;
  double valid_from = 0, valid_to = 0;  ///< [K]; both zero: no range stated
};

/// Condition under which a specific heat was measured (docs/theory/constitutive.md, "Two specific heats").
enum class SpecificHeatAt {
  constant_pressure,  ///< free of stress: C_p of calorimeters and handbooks
  constant_strain,    ///< at ε = 0: C_v of the monograph (2.49c)
};

/// A property that its user declares (added_property.hpp).
struct GivenProperty {
  std::string unit;  ///< SI
  Table table;       ///< over absolute temperature
};

struct Material {
  std::string name, title;
  double density = 0;   ///< ρ of the reference configuration [kg/m³]
  Table conductivity;   ///< k(Θ) [W/(m K)]
  Table specific_heat;  ///< C(Θ) [J/(kg K)]
  SpecificHeatAt specific_heat_at = SpecificHeatAt::constant_pressure;
  std::vector<PhaseChange> phase_changes;

  Table young_modulus;                  ///< E(Θ) [Pa]
  Table poisson_ratio;                  ///< ν(Θ)
  Table expansion;                      ///< α(Θ), mean linear coefficient from Θ_ref [1/K]
  double expansion_reference = 293.15;  ///< Θ_ref of 2.51 [K]
  /// η of s = η ε̇ (2.83, 2.104), twice the Newtonian shear viscosity [Pa s]; used where f_S < 1. Not given
  /// (zero): the mechanical phase chooses it (material/melt.hpp).
  Table liquid_viscosity;
  LiquidModel liquid_model = LiquidModel::maxwell;
  LiquidNumbers liquid_numbers{};  ///< the parameters of that model in its order
  std::optional<Flow> flow;        ///< absent: the solid is elastic
  /// The law of the solid from a shared object, instead of `flow`; null: the laws of the program.
  std::shared_ptr<const ExternalLaw> external;
  Casting casting;                   ///< for criteria; no law uses it
  std::optional<Gas> gas;            ///< absent: none is known of
  std::optional<Graphite> graphite;  ///< absent: none precipitates, or the card gives its volume itself
  std::map<std::string, GivenProperty, std::less<>> added;  ///< by their keys; those that the card gives

  std::vector<PropertyNote> notes;

  /// The tables that are given, in the order of the material file; flow curves are none.
  std::vector<Property> properties() const;
  EnthalpyCurve enthalpy() const { return {density, specific_heat, phase_changes}; }
  /// True when elastic properties are given; a material without them serves heat conduction only.
  bool mechanical() const { return young_modulus.min_value() > 0; }
  /// The solidification, if the material has one; without it the material is always solid (f_S = 1).
  const PhaseChange* solidification() const;
  double solid_fraction(double temperature) const;  ///< f_S of 2.65
  /// Whether a change, or a part of it, gives off its heat at one temperature: then the temperature does not
  /// tell how much has changed.
  bool changes_isothermally() const { return !enthalpy().jumps().empty(); }
  /// True when the melt has a dashpot whose viscosity is not given: η then comes from
  /// material/melt.hpp.
  bool chooses_viscosity() const;
};

}  // namespace solidus::material
