/// The keys of a material file.
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "material/added_property.hpp"
#include "material/cards/external_keys.hpp"
#include "material/cards/granular_keys.hpp"
#include "material/cards/library.hpp"
#include "material/laws/fraction_law.hpp"
#include "material/laws/liquid_law.hpp"

namespace solidus::material {
namespace {

Section<FractionData> fraction_keys() {
  Section<FractionData> s("fraction", "The phase that is stable when cold, as a function of temperature.");
  s.kinds("kind", &FractionData::law, fraction_laws()).initially("linear").doc("The form of the curve.");
  s.place(&FractionData::where);
  return s;
}

Section<PhaseChangeData> phase_change_keys() {
  Section<PhaseChangeData> s("phase_change", "A phase change: solidification or a change in the solid.");
  s.key("name", &PhaseChangeData::name).doc("For messages.");
  s.key("solidification", &PhaseChangeData::solidification)
      .initially(false)
      .doc("The fraction of this phase change is the solid fraction; true for at most one phase change.");
  s.quantity("latent_heat", &PhaseChangeData::latent_heat, "J/kg").at_least(0).doc("Released on cooling.");
  s.key("volume_change", &PhaseChangeData::volume_change)
      .initially(0.0)
      .range(-0.5, 0.5)
      .doc("Relative volume change on cooling through the whole change: negative shrinks, positive expands.");
  s.key("graphite", &PhaseChangeData::graphite)
      .initially(false)
      .doc(
          "True: it is the precipitation of graphite, whose volume_change is computed from [graphite] and is "
          "not given.");
  s.section("fraction", &PhaseChangeData::fraction, fraction_keys());
  s.key("source", &PhaseChangeData::source).initially("").doc("Where the data come from.");
  s.place(&PhaseChangeData::where);
  return s;
}

/// Declares the data of hot tearing.
void tearing_keys(Section<Casting>& s) {
  s.key("brittle_range", &Casting::brittle_range)
      .initially(Value::list({0.90, 0.99}))
      .range(0, 1)
      .doc(
          "Solid fractions between which strain can tear the metal open and no melt flows in to heal the "
          "tear.");
  s.key("crack_strain", &Casting::crack_strain)
      .range(1e-6, 10)
      .doc(
          "phi in the critical strain of the brittle range, phi/(rate^m width^n), rate in 1/s and width in K "
          "(Won, Yeo, Seol and Oh 2000; 0.02821 of carbon steels). Without it there is no cracking_index.");
  s.key("crack_rate_exponent", &Casting::crack_rate_exponent)
      .initially(0.3131)
      .range(0, 2)
      .doc("m of the same law.");
  s.key("crack_range_exponent", &Casting::crack_range_exponent)
      .initially(0.8638)
      .range(0, 2)
      .doc("n of the same law.");
}

/// Declares the arm spacing, and how melt flows through mush.
void arms_and_melt_keys(Section<Casting>& s) {
  s.quantity("arm_spacing", &Casting::arm_spacing, "m")
      .positive()
      .doc(
          "Secondary arm spacing after a local solidification time of one second: c in c (t_f/1 s)^n. "
          "Without it there are no fields secondary_arm_spacing and dimensionless_niyama, and the "
          "permeability of the mushy zone is that of a spacing of 50 um.");
  s.key("arm_spacing_exponent", &Casting::arm_spacing_exponent)
      .initially(0.333)
      .range(0, 1)
      .doc("n of the same law.");
  s.quantity("melt_viscosity", &Casting::melt_viscosity, "Pa s")
      .positive()
      .doc(
          "Newtonian shear viscosity of the melt at the liquidus, for dimensionless_niyama and for the flow "
          "of melt through the mushy zone (2 mPa s without it); not twice_shear_viscosity, which is a "
          "numerical "
          "choice.");
  s.quantity("critical_pressure_drop", &Casting::critical_pressure_drop, "Pa")
      .initially("101325 Pa")
      .positive()
      .doc(
          "The pressure drop of the melt at which pores form in the mushy zone, for dimensionless_niyama and "
          "pore_fraction.");
}

Section<Casting> casting_keys() {
  // The keys of [casting], in the order of the reference: strength of mush, hot tearing, moulds, arm spacing,
  // and flow of melt.
  Section<Casting> s("casting", "Data for the criteria of a casting (docs/theory/criteria.md).");
  s.key("coherency_fraction", &Casting::coherency_fraction)
      .initially(0.75)
      .range(0, 1)
      .doc(
          "Solid fraction from which the solid is a coherent network: strain before coherency is strain of "
          "the melt, strain after it is strain of the casting. From this fraction to 1 the part of the "
          "metal's contraction that the network follows rises from zero to one.");
  s.quantity("pore_tension", &Casting::pore_tension, "Pa")
      .initially("100 Pa")
      .positive()
      .doc(
          "Tension, relative to the pressure of the atmosphere, at which pores open in metal below the "
          "coherency_fraction: an unfed pool then shrinks by forming pores (field pore_fraction) and stays "
          "on its walls. Almost zero by default, because oxide films and gas open at once.");
  tearing_keys(s);
  s.key("rigidity", &Casting::rigidity)
      .initially(1.0)
      .range(0, 1)
      .doc(
          "Of a mould: the fraction of the graphite expansion that it resists, so that it feeds the casting; "
          "the rest moves the mould wall. feeding.mould_rigidity of a case takes precedence.");
  arms_and_melt_keys(s);
  s.key("source", &Casting::source).initially("").doc("Where the data come from.");
  return s;
}

Section<Gas> gas_keys() {
  Section<Gas> s("gas", "Diatomic gas in solution, for gas pores (docs/theory/gas.md).");
  s.key("name", &Gas::name).doc("Name of the gas in messages: hydrogen, nitrogen.");
  s.key("melt", &Gas::melt)
      .range(-1e5, 1e5)
      .doc(
          "a and b [K] of the solubility in the melt at one atmosphere, log10(S) = a - b/T with S in cm3 at "
          "standard state per 100 g of metal.");
  s.key("solid", &Gas::solid).range(-1e5, 1e5).doc("The same of the solid.");
  s.quantity("content", &Gas::content, "m3/kg")
      .at_least(0)
      .doc(
          "Usual content of the melt when it is poured, volume of gas at standard state (0 degC, 101325 Pa) "
          "per mass; gas.content of a case takes precedence.");
  s.quantity("surface_tension", &Gas::surface_tension, "N/m")
      .at_least(0)
      .doc(
          "Surface tension between melt and gas: a pore between dendrites has half of secondary_arm_spacing "
          "as its radius, and its gas has to overcome twice the tension over the radius.");
  s.key("source", &Gas::source).initially("").doc("Where the data come from.");
  return s;
}

Section<Graphite> graphite_keys() {
  Section<Graphite> s("graphite",
                      "Carbon and silicon of a cast iron, and its graphite (docs/theory/graphite.md).");
  s.key("carbon", &Graphite::carbon).range(2.1, 5).doc("In mass per cent.");
  s.key("silicon", &Graphite::silicon).range(0, 6).doc("In mass per cent.");
  s.choice(
       "rule", &Graphite::rule,
       {{"lever", Graphite::Rule::lever, "all carbon beyond the solubility in eutectic austenite"},
        {"scheil", Graphite::Rule::scheil,
         "that of the eutectic alone; there is less eutectic, because primary austenite keeps its carbon"}})
      .initially("lever")
      .doc("Amount of graphite when the last melt has frozen.");
  s.choice("form", &Graphite::form,
           {{"flake", Graphite::Form::flake, "grey iron"},
            {"compacted", Graphite::Form::compacted, "vermicular, compacted iron"},
            {"nodular", Graphite::Form::nodular, "spheroidal graphite, ductile iron"}})
      .doc(
          "Form of the graphite. Flakes grow in contact with the melt and push it through the mushy zone; "
          "nodules grow within shells of austenite, which push the mould wall: a yielding wall takes more of "
          "their expansion (docs/theory/graphite.md).");
  s.key("expansion", &Graphite::expansion)
      .initially(0.032)
      .range(0, 0.1)
      .doc("Relative increase of volume for one mass per cent of precipitated graphite.");
  s.key("source", &Graphite::source).initially("").doc("Where the data come from.");
  return s;
}

Section<LocalLaw> local_keys() {
  // First the measures of how the metal froze, of which one is given, then the values along it.
  Section<LocalLaw> s("local",
                      "Strength, elongation, hardness and grain size as functions of the local freezing "
                      "conditions, measured on castings (docs/theory/local_properties.md).");
  s.quantity("section", &LocalLaw::section, "m")
      .initially(Value::list())
      .doc(
          "Wall thicknesses of the values, rising; a place of a casting is looked up by its plate_thickness. "
          "Give this, arm_spacing or cooling_rate. Between the values a power law is used; beyond them the "
          "fields have no value.");
  s.quantity("arm_spacing", &LocalLaw::arm_spacing, "m")
      .initially(Value::list())
      .doc("Secondary arm spacings of the values, rising.");
  s.quantity("cooling_rate", &LocalLaw::cooling_rate, "K/s")
      .initially(Value::list())
      .doc("Cooling rates near the end of freezing of the values, rising.");
  s.quantity("tensile_strength", &LocalLaw::tensile_strength, "Pa")
      .initially(Value::list())
      .doc("Tensile strength there.");
  s.key("elongation", &LocalLaw::elongation)
      .initially(Value::list())
      .doc("Elongation at fracture there, as a share: 0.07 is 7 per cent.");
  s.key("hardness", &LocalLaw::hardness).initially(Value::list()).doc("Brinell hardness there.");
  s.quantity("grain_size", &LocalLaw::grain_size, "m").initially(Value::list()).doc("Grain size there.");
  s.key("spread", &LocalLaw::spread)
      .initially(0.0)
      .range(0, 1)
      .doc("Half width of the range that holds most measured values, as a share of the value.");
  s.key("source", &LocalLaw::source).doc("Where the data come from.");
  s.place(&LocalLaw::where);
  return s;
}

void liquid_keys(Section<MaterialData>& s) {
  std::vector<Section<MaterialData>::Choice<LiquidModel>> models;
  for (const LiquidLaw* law : liquid_laws())
    models.push_back(
        {std::string(law->name()), static_cast<LiquidModel>(models.size()), std::string(law->doc())});
  s.choice("liquid_model", &MaterialData::liquid_model, models)
      .initially("maxwell")
      .doc("Response of liquid and mushy metal to shear; f_S is the solid fraction.");
  std::map<std::string_view, std::vector<std::string>> models_with;
  for (const LiquidLaw* law : liquid_laws())
    for (const LawParameter& parameter : law->parameters())
      models_with[parameter.key].emplace_back(law->name());
  for (const LiquidLaw* law : liquid_laws())
    for (const LawParameter& parameter : law->parameters()) {
      if (models_with.at(parameter.key).front() != law->name()) continue;  // declared by another one
      Key& key = s.function(parameter.key, &MaterialData::liquid_numbers, parameter.unit);
      key.range(parameter.least, parameter.greatest)
          .when("liquid_model", models_with.at(parameter.key))
          .doc(parameter.doc);
      key.lower_open = parameter.above_least;
      if (parameter.optional) key.required = false;
    }
}

/// Declares density, conductivity and specific heat.
void heat_keys(Section<MaterialData>& s) {
  const std::vector<Argument> temperature{Argument::temperature};
  s.function("density", &MaterialData::density, "kg/m3")
      .positive()
      .doc("Density in the reference configuration.");
  s.function("conductivity", &MaterialData::conductivity, "W/m/K")
      .positive()
      .of(temperature)
      .doc("Thermal conductivity.");
  s.function("specific_heat", &MaterialData::specific_heat, "J/kg/K")
      .positive()
      .of(temperature)
      .doc(
          "At constant pressure, as in handbooks, unless specific_heat_at says otherwise; without the latent "
          "heat of the phase changes that are given below.");
  s.choice(
       "specific_heat_at", &MaterialData::specific_heat_at,
       {{"constant_pressure", SpecificHeatAt::constant_pressure,
         "free of stress, as in calorimeters and handbooks: C_p"},
        {"constant_strain", SpecificHeatAt::constant_strain,
         "at zero strain: C_v of the monograph (2.49c), below C_p by 9 k alpha^2 T/rho, some 4 to 8 % of a "
         "hot metal"}})
      .initially("constant_pressure")
      .doc(
          "The condition under which specific_heat was measured. Where only heat is computed it makes no "
          "difference.");
}

/// Declares elastic constants and thermal expansion.
void elastic_keys(Section<MaterialData>& s) {
  const std::vector<Argument> temperature{Argument::temperature};
  s.function("young_modulus", &MaterialData::young_modulus, "Pa")
      .positive()
      .of(temperature)
      .doc("Young's modulus.");
  s.function("poisson_ratio", &MaterialData::poisson_ratio, "1")
      .range(-0.99, 0.4999)
      .of(temperature)
      .doc("Poisson's ratio.");
  s.function("expansion", &MaterialData::expansion, "1/K")
      .range(-1e-3, 1e-3)
      .of(temperature)
      .doc("Coefficient of linear thermal expansion, of the kind that expansion_as says.");
  s.choice("expansion_as", &MaterialData::expansion_as,
           {{"mean", ExpansionAs::mean,
             "the secant: relative change of length from expansion_reference to the temperature, over the "
             "difference of the two, as in handbooks"},
            {"instantaneous", ExpansionAs::instantaneous,
             "the tangent: relative change of length per kelvin at the temperature, as in physical theory "
             "and some codes; the program integrates it"}})
      .initially("mean")
      .doc("The kind of the expansion coefficient; for a single number both are the same.");
  s.quantity("expansion_reference", &MaterialData::expansion_reference, "K")
      .initially("20 degC")
      .positive()
      .doc("Temperature at which the strain of the expansion measurement is zero.");
}

/// Declares what the users of properties have added (added_property.hpp). Throws std::logic_error where the
/// card has such a key already.
void added_keys(Section<MaterialData>& s) {
  for (const AddedProperty& property : added_properties()) {
    const std::string key(property.key);
    if (s.info().find(key) != nullptr)
      throw std::logic_error("the material property '" + key + "': the card has a key of that name");
    s.function(key, &MaterialData::added, std::string(property.unit))
        .of({Argument::temperature})
        .range(property.least, property.greatest)
        .doc(std::string(property.doc))
        .required = false;
  }
}

Section<MaterialData> material_keys() {
  // The keys of a card on its first level: names, thermal properties, elastic ones, and the sections.
  Section<MaterialData> s("",
                          "A material: every property with its unit, its source and the range of "
                          "temperatures in which it is valid.");
  s.key("title", &MaterialData::title).initially("").doc("What it is, in one line.");
  s.key("designations", &MaterialData::designations)
      .initially(Value::list())
      .doc(
          "Standard and trade names of the material: where a case uses one of them, the error names the "
          "material of the library.");
  s.key("like", &MaterialData::like)
      .initially("")
      .doc(
          "Another material (a name in the library, or a file): keys that are not given here are taken from "
          "it, those of [plasticity] one by one too.");
  const std::vector<Argument> temperature{Argument::temperature};
  heat_keys(s);
  elastic_keys(s);
  s.function("twice_shear_viscosity", &MaterialData::twice_shear_viscosity, "Pa s")
      .positive()
      .of(temperature)
      .doc(
          "Viscosity eta of the liquid in s = eta * strain rate (s the stress deviator, tensor strain rate), "
          "which is TWICE the Newtonian shear viscosity. Without it the program chooses it, so that the "
          "modulus of the melt in a step is small against the metallostatic pressure and the strength of the "
          "solid shell, and reports it. The real 1e-3 Pa s has no effect on stress.");
  liquid_keys(s);
  s.sections("phase_change", &MaterialData::phase_changes, phase_change_keys());
  s.section("plasticity", &MaterialData::plasticity, flow_section());
  s.section("external", &MaterialData::external, external_section());
  s.section("granular", &MaterialData::granular, granular_section());
  s.section("casting", &MaterialData::casting, casting_keys());
  s.section("gas", &MaterialData::gas, gas_keys());
  s.section("graphite", &MaterialData::graphite, graphite_keys());
  s.sections("local", &MaterialData::local_laws, local_keys());
  s.section("spread", &MaterialData::spread, material_spread_keys());
  added_keys(s);
  s.place(&MaterialData::where);
  return s;
}

}  // namespace

const Section<MaterialData>& material_section() {
  static const Section<MaterialData> section = material_keys();
  return section;
}

}  // namespace solidus::material
