/// The keys of [plasticity] in a material file.
#include "material/cards/flow_keys.hpp"

#include <fmt/format.h>

#include <set>
#include <span>
#include <stdexcept>
#include <string_view>

#include "material/laws/hardening_law.hpp"
#include "material/laws/kinematic_law.hpp"
#include "material/laws/rate_law.hpp"

namespace solidus::material {
namespace {

const std::vector<Argument> k_temperature{Argument::temperature};

Section<FlowCurveData> curve_keys() {
  Section<FlowCurveData> s("flow_curve",
                           "A measured flow curve: true stress over equivalent plastic strain at one "
                           "temperature. Any number of curves in any order, each with strains of its own; "
                           "linear in strain and temperature between them, constant beyond the last ones.");
  s.quantity("temperature", &FlowCurveData::temperature, "K").positive().doc("Of the test.");
  s.function("stress", &FlowCurveData::stress, "Pa")
      .positive()
      .of({Argument::strain})
      .doc(
          "Points [plastic strain, true stress]; the first one, at strain 0, is the flow stress. It must not "
          "fall with strain.");
  s.place(&FlowCurveData::where);
  return s;
}

/// The keys of the parameters of all laws of a kind, each once; they belong where the key `chosen_by` has the
/// name of a law with that parameter. Throws std::logic_error where a key is that of another kind of law too.
template <class Law>
void parameter_keys(Section<FlowData>& s, const std::string& chosen_by, std::span<const Law* const> laws) {
  // A parameter that several laws have is declared once, with the names of all of them in `when`.
  std::set<std::string_view> declared;
  for (const Law* law : laws)
    for (const LawParameter& parameter : law->parameters()) {
      if (!declared.insert(parameter.key).second) continue;
      if (s.info().find(parameter.key) != nullptr)
        throw std::logic_error(
            fmt::format("the key '{}' of the {} '{}' is taken", parameter.key, chosen_by, law->name()));
      // It is required only if every law that has it needs it.
      std::vector<std::string> names;
      bool required = true;
      for (const Law* other : laws)
        for (const LawParameter& same : other->parameters())
          if (std::string_view(same.key) == parameter.key) {
            names.emplace_back(other->name());
            required = required && !same.optional;
          }
      Key& key = s.function(parameter.key, &FlowData::parameters, parameter.unit);
      key.range(parameter.least, parameter.greatest)
          .of(k_temperature)
          .when(chosen_by, names)
          .doc(parameter.doc);
      key.lower_open = parameter.above_least;
      if (!required) key.required = false;
    }
}

/// The words of the laws of a kind, with their equations.
template <class Kind, class Law>
std::vector<Section<FlowData>::Choice<Kind>> choices_of(std::span<const Law* const> laws) {
  std::vector<Section<FlowData>::Choice<Kind>> words;
  for (const Law* law : laws)
    words.push_back(
        {std::string(law->name()), static_cast<Kind>(words.size()), std::string(law->equation())});
  return words;
}

void isotropic_keys(Section<FlowData>& s) {
  std::vector<std::string> with_flow_stress;
  for (std::size_t i = 0; i < hardening_laws().size(); ++i)
    if (static_cast<IsotropicHardening>(i) != IsotropicHardening::table)
      with_flow_stress.emplace_back(hardening_laws()[i]->name());
  s.choice("isotropic_hardening", &FlowData::isotropic, choices_of<IsotropicHardening>(hardening_laws()))
      .initially("none")
      .doc(
          "How the yield stress sigma_y of a tensile test grows with the equivalent plastic strain xi; every "
          "parameter may depend on temperature.");
  s.function("flow_stress", &FlowData::flow_stress, "Pa")
      .positive()
      .of(k_temperature)
      .when("isotropic_hardening", with_flow_stress)
      .doc(
          "sigma_0, the yield stress of a tensile test at zero plastic strain. It must not rise with "
          "temperature (2.121). Give small positive values up to the liquidus, because mushy metal yields "
          "too.");
  parameter_keys(s, "isotropic_hardening", hardening_laws());
  s.sections("flow_curve", &FlowData::curves, curve_keys()).when("isotropic_hardening", {"table"});
}

void kinematic_keys(Section<FlowData>& s) {
  std::vector<std::string> with_modulus;
  for (std::size_t i = 0; i < kinematic_laws().size(); ++i)
    if (static_cast<KinematicHardening>(i) != KinematicHardening::none)
      with_modulus.emplace_back(kinematic_laws()[i]->name());
  s.choice("kinematic_hardening", &FlowData::kinematic, choices_of<KinematicHardening>(kinematic_laws()))
      .initially("none")
      .doc("How the back stress q, the centre of the yield surface, follows the viscoplastic strain.");
  s.function("kinematic_modulus", &FlowData::kinematic_modulus, "Pa")
      .positive()
      .of(k_temperature)
      .when("kinematic_hardening", with_modulus)
      .doc("K, the (initial) slope of a tensile test over plastic strain.");
  parameter_keys(s, "kinematic_hardening", kinematic_laws());
}

void rate_keys(Section<FlowData>& s) {
  s.choice("rate_dependence", &FlowData::rate_dependence, choices_of<RateDependence>(rate_laws()))
      .initially("none")
      .doc("How the stress depends on the strain rate.");
  parameter_keys(s, "rate_dependence", rate_laws());
}

void heat_keys(Section<FlowData>& s) {
  s.function("taylor_quinney", &FlowData::taylor_quinney, "1")
      .range(0, 1)
      .of(k_temperature)
      .doc(
          "Factor of Taylor and Quinney: the share of the plastic power s : d(eps_vp)/dt that becomes heat, "
          "such "
          "as 0.9; the rest is stored in the metal. Left out: what hardening does not store, 1 - "
          "K_xi/sigma_y "
          "for isotropic hardening (2.118).");
}

Section<FlowData> flow_keys() {
  Section<FlowData> s(
      "plasticity",
      "How the solid yields, hardens and creeps: von Mises plasticity with the yield stress sigma_y (2.106 - "
      "2.109). Without this section the solid is elastic. A material `like` another inherits key by key.");
  isotropic_keys(s);
  kinematic_keys(s);
  rate_keys(s);
  heat_keys(s);
  s.key("allow_thermal_hardening", &FlowData::allow_thermal_hardening)
      .initially(false)
      .doc(
          "Accepts a flow stress that rises with temperature, although plastic flow then reduces entropy "
          "(2.120, 2.121).");
  s.place(&FlowData::where);
  return s;
}

}  // namespace

const Section<FlowData>& flow_section() {
  static const Section<FlowData> section = flow_keys();
  return section;
}

}  // namespace solidus::material
