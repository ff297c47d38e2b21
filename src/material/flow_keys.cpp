/// The keys of [plasticity] in a material file.
#include "material/flow_keys.hpp"

#include <set>
#include <string_view>

#include "material/laws/hardening_law.hpp"

namespace solidus::material {
namespace {

const std::vector<Argument> k_temperature{Argument::temperature};

Section<FlowCurveData> curve_keys() {
  Section<FlowCurveData> s("flow_curve",
                           "A measured flow curve: true stress over equivalent plastic strain at one "
                           "temperature. Any number, in any order, each with strains of its own; linear in "
                           "strain and temperature between them, level beyond the last ones.");
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

/// The names of the laws with that parameter.
std::vector<std::string> laws_with(std::string_view key) {
  std::vector<std::string> names;
  for (const HardeningLaw* law : hardening_laws())
    for (const LawParameter& parameter : law->parameters())
      if (parameter.key == key) names.emplace_back(law->name());
  return names;
}

void parameter_key(Section<FlowData>& s, const LawParameter& parameter) {
  Key& key = s.function(parameter.key, &FlowData::hardening, parameter.unit);
  key.range(parameter.least, parameter.greatest)
      .of(k_temperature)
      .when("isotropic_hardening", laws_with(parameter.key))
      .doc(parameter.doc);
  key.lower_open = parameter.above_least;
  for (const HardeningLaw* law : hardening_laws())
    for (const LawParameter& other : law->parameters())
      if (std::string_view(other.key) == parameter.key && other.optional) key.required = false;
}

void isotropic_keys(Section<FlowData>& s) {
  std::vector<Section<FlowData>::Choice<IsotropicHardening>> laws;
  std::vector<std::string> with_flow_stress;
  for (const HardeningLaw* law : hardening_laws()) {
    const auto kind = static_cast<IsotropicHardening>(laws.size());
    laws.push_back({std::string(law->name()), kind, std::string(law->equation())});
    if (kind != IsotropicHardening::table) with_flow_stress.emplace_back(law->name());
  }
  s.choice("isotropic_hardening", &FlowData::isotropic, laws)
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
          "temperature (2.121). Give small positive values up to the liquidus: what is partly solid yields.");
  std::set<std::string_view> declared;
  for (const HardeningLaw* law : hardening_laws())
    for (const LawParameter& parameter : law->parameters())
      if (declared.insert(parameter.key).second) parameter_key(s, parameter);
  s.sections("flow_curve", &FlowData::curves, curve_keys()).when("isotropic_hardening", {"table"});
}

void kinematic_keys(Section<FlowData>& s) {
  using enum KinematicHardening;
  s.choice("kinematic_hardening", &FlowData::kinematic,
           {{"none", none, "q = 0"},
            {"linear", linear, "dq = 2/3 K d(eps_vp) (2.59b; Prager)"},
            {"armstrong_frederick", armstrong_frederick,
             "dq = 2/3 K d(eps_vp) - recall q d(xi) (Armstrong and Frederick)"}})
      .initially("none")
      .doc("How the back stress q, the centre of the yield surface, follows the viscoplastic strain.");
  s.function("kinematic_modulus", &FlowData::kinematic_modulus, "Pa")
      .positive()
      .of(k_temperature)
      .when("kinematic_hardening", {"linear", "armstrong_frederick"})
      .doc("K, the (initial) slope of a tensile test over plastic strain.");
  s.function("recall", &FlowData::recall, "1")
      .positive()
      .of(k_temperature)
      .when("kinematic_hardening", {"armstrong_frederick"})
      .doc("The back stress of a tensile test saturates at K/recall.");
}

void rate_keys(Section<FlowData>& s) {
  s.choice("rate_dependence", &FlowData::perzyna,
           {{"none", false, "the stress cannot leave the yield surface (2.112)"},
            {"perzyna", true,
             "it can, and then gamma' = f_S/eta Phi (Phi/D)^(n - 1), with gamma' = |d(eps_vp)/dt|, the solid "
             "fraction f_S and the overstress Phi = |s - q| - sqrt(2/3) sigma_y (2.109b, whose eta is this "
             "eta times D^(n - 1))"}})
      .initially("none")
      .doc("How the stress depends on the strain rate.");
  s.function("viscosity", &FlowData::viscosity, "Pa s")
      .positive()
      .of(k_temperature)
      .when("rate_dependence", {"perzyna"})
      .doc(
          "eta of the overstress: with n = 1, Phi = eta |d(eps_vp)/dt|, which in a tensile test is 3/2 eta "
          "times the strain rate above the yield stress. Left out: twice_shear_viscosity, the single eta of "
          "the monograph (2.98).");
  s.function("rate_exponent", &FlowData::rate_exponent, "1")
      .range(k_least_rate_exponent, 100)
      .of(k_temperature)
      .when("rate_dependence", {"perzyna"})
      .doc("n; left out: 1. Below 1 the overstress rises faster than the strain rate.");
  s.function("drag_stress", &FlowData::drag_stress, "Pa")
      .positive()
      .of(k_temperature)
      .when("rate_dependence", {"perzyna"})
      .doc(
          "D: at the overstress Phi = D, gamma' = D/eta whatever n. Needed unless n = 1 everywhere, where it "
          "changes nothing.");
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
          "Accepts a flow stress that rises with temperature, although plastic flow then takes entropy away "
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
