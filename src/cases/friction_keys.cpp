/// The keys of [contact.friction], [contact.wear] and [contact.interface].
#include "cases/friction_spec.hpp"
#include "contact/laws/coefficient_law.hpp"

namespace solidus::cases {
namespace {

/// Keys of one curve of the coefficient of friction at a temperature.
Section<FrictionCurveSpec> curve_keys() {
  using C = FrictionCurveSpec;
  Section<C> s(
      "curve",
      "The coefficient of friction as a table of the internal variable, instead of `coefficient`. One "
      "curve, or several at different temperatures, linear between them; constant beyond the last points and "
      "temperatures.");
  s.quantity("temperature", &C::temperature, "K")
      .positive()
      .doc("Of the surface; needed where there are several curves.");
  s.key("internal_variable", &C::internal_variable)
      .doc("Rising numbers from 0 on, in `internal_variable_unit`.");
  s.key("coefficient", &C::coefficient).doc("The coefficient of friction at each of them, above zero.");
  s.place(&C::where);
  return s;
}

}  // namespace

/// Keys of [contact.friction]: the coefficient, the internal variable that it follows, the tangential
/// penalty, and what of it enters the matrix and the thermal phase.
Section<FrictionSpec> friction_keys() {
  using F = FrictionSpec;
  using enum contact::InternalVariable;
  Section<F> s("friction", "Coulomb friction |t_T| <= mu p; without this section surfaces slide freely.");
  s.kinds("law", &F::law, contact::coefficient_laws())
      .initially("data")
      .doc("The coefficient of friction mu as a function of the internal variable z in its unit.");
  s.function("coefficient", &F::coefficient, "1")
      .of({Argument::temperature})
      .or_one()
      .when("law", {"data"})
      .doc(
          "mu: a number, a table of temperature, or a list [mu_0, mu_1, ...] of such, the polynomial mu_0 + "
          "mu_1 z + mu_2 z^2 + ... of the internal variable z in its unit (3.62). mu_0 must not rise with "
          "temperature (3.60). Or give [[contact.friction.curve]].")
      .required = false;
  s.sections("curve", &F::curves, curve_keys()).when("law", {"data"});
  s.choice("internal_variable", &F::internal_variable,
           {{"normal_work", normal_work, "pressure times slip (3.53b); its hardening stores energy (3.41c)"},
            {"frictional_work", frictional_work, "the work of friction"},
            {"slip", slip, "the sliding distance"}})
      .initially("normal_work")
      .doc(
          "The variable z with which the surface hardens, softens or wears, accumulated at the slave's "
          "points.");
  s.key("internal_variable_unit", &F::internal_variable_unit)
      .doc("Unit of z, as \"kN/mm\"; without it N/m for work and m for slip.");
  s.quantity("tangential_penalty", &F::tangential_penalty, "N/m3")
      .positive()
      .doc("Traction per elastic slip before it slides; without it from `tangential_penalty_factor`.");
  s.key("tangential_penalty_factor", &F::tangential_penalty_factor)
      .initially(1.0)
      .positive()
      .doc("Tangential penalty = factor x penalty.");
  s.key("symmetric", &F::symmetric)
      .initially(false)
      .doc(
          "Leaves the derivative of the friction limit by the pressure out of the matrix, not out of the "
          "forces: for symmetric solvers, at the price of more iterations.");
  s.key("thermal_return_mapping", &F::thermal_return_mapping)
      .initially(false)
      .doc(
          "The thermal phase of a split computes slip and temperature of the interface again, with the "
          "coefficient of friction at the new temperature (5.40-5.51). Without it the slip of the mechanical "
          "phase is kept, with which energy is conserved. Schemes whose fields agree at the end of a step "
          "solve these equations in any case; a scheme that cannot use them refuses the key.");
  s.place(&F::where);
  return s;
}

/// Keys of [contact.wear]: Archard's coefficient and what it wears.
Section<WearSpec> wear_keys() {
  using W = WearSpec;
  Section<W> s(
      "wear",
      "Wear depth by Archard's law, dh = k p dg / H, as a field on the surface that wears; the geometry "
      "stays as it is. Needs [contact.friction].");
  s.key("archard", &W::archard).positive().doc("k, the dimensionless coefficient of wear, 1e-8 to 1e-3.");
  s.function("hardness", &W::hardness, "Pa")
      .positive()
      .of({Argument::temperature})
      .doc("H of the softer surface.");
  s.key("master_share", &W::master_share)
      .initially(0.0)
      .range(0, 1)
      .doc(
          "Fraction of the depth that the master loses; the slave loses the rest: 0 only the slave wears, 1 "
          "only the master. The wear of the master is stored at its nodes, wherever the slave goes.");
  s.place(&W::where);
  return s;
}

/// Keys of [contact.interface]: heat that the interface itself stores.
Section<InterfaceSpec> interface_keys() {
  Section<InterfaceSpec> s("interface", "The interface as a body of its own, with a temperature.");
  s.quantity("heat_capacity", &InterfaceSpec::heat_capacity, "J/m2/K")
      .at_least(0)
      .initially("0 J/m2/K")
      .doc(
          "C_co (3.41b). Zero: it stores no heat, and its temperature balances the heat flows. With "
          "hardening that depends on temperature, the proof of stability of an isentropic split needs a "
          "value above zero.");
  return s;
}

}  // namespace solidus::cases
