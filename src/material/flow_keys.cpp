/// The keys of [plasticity] in a material file.
#include "material/flow_keys.hpp"

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

void isotropic_keys(Section<FlowData>& s) {
  using enum IsotropicHardening;
  s.choice("isotropic_hardening", &FlowData::isotropic,
           {{"none", none, "sigma_y = sigma_0"},
            {"linear", linear, "sigma_y = sigma_0 + H xi"},
            {"saturation", saturation,
             "sigma_y = sigma_0 + (sigma_inf - sigma_0)(1 - exp(-delta xi)) + H xi (2.60; Voce)"},
            {"power", power, "sigma_y = sigma_0 (1 + xi/eps_0)^m (Swift)"},
            {"table", table, "sigma_y(xi, T) from [[plasticity.flow_curve]]"}})
      .initially("none")
      .doc(
          "How the yield stress sigma_y of a tensile test grows with the equivalent plastic strain xi; every "
          "parameter may depend on temperature.");
  s.function("flow_stress", &FlowData::flow_stress, "Pa")
      .positive()
      .of(k_temperature)
      .when("isotropic_hardening", {"none", "linear", "saturation", "power"})
      .doc(
          "sigma_0, the yield stress of a tensile test at zero plastic strain. It must not rise with "
          "temperature (2.121). Give small positive values up to the liquidus: what is partly solid yields.");
  s.function("saturation_stress", &FlowData::saturation_stress, "Pa")
      .positive()
      .of(k_temperature)
      .when("isotropic_hardening", {"saturation"})
      .doc("sigma_inf, at least the flow stress at every temperature.");
  s.function("saturation_rate", &FlowData::saturation_rate, "1")
      .positive()
      .of(k_temperature)
      .when("isotropic_hardening", {"saturation"})
      .doc("delta: at xi = 1/delta, 63 % of the hardening is there.");
  s.function("hardening_modulus", &FlowData::hardening_modulus, "Pa")
      .at_least(0)
      .of(k_temperature)
      .when("isotropic_hardening", {"linear", "saturation"})
      .doc("H, the slope over plastic strain; of saturation it may be left out (0).");
  s.function("reference_strain", &FlowData::reference_strain, "1")
      .positive()
      .of(k_temperature)
      .when("isotropic_hardening", {"power"})
      .doc("eps_0; the initial slope is sigma_0 m/eps_0.");
  s.function("hardening_exponent", &FlowData::hardening_exponent, "1")
      .range(0, 1)
      .of(k_temperature)
      .when("isotropic_hardening", {"power"})
      .doc("m.");
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
      .range(1, 100)
      .of(k_temperature)
      .when("rate_dependence", {"perzyna"})
      .doc("n; left out: 1.");
  s.function("drag_stress", &FlowData::drag_stress, "Pa")
      .positive()
      .of(k_temperature)
      .when("rate_dependence", {"perzyna"})
      .doc(
          "D: at the overstress Phi = D, gamma' = D/eta whatever n. Needed unless n = 1 everywhere, where it "
          "changes nothing.");
}

Section<FlowData> flow_keys() {
  Section<FlowData> s(
      "plasticity",
      "How the solid yields, hardens and creeps: von Mises plasticity with the yield stress sigma_y (2.106 - "
      "2.109). Without this section the solid is elastic. A material `like` another inherits key by key.");
  isotropic_keys(s);
  kinematic_keys(s);
  rate_keys(s);
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
