/// Keys of [[channel]]: a cooling channel as a line in a die.
#include "cases/case_keys.hpp"

namespace solidus::cases {

namespace {

Section<ChannelPathSpec> path_keys() {
  using P = ChannelPathSpec;
  Section<P> s("path",
               "The way of the middle of the channel, in the direction of the flow. In two dimensions each "
               "point is a bore through the plane, or a ring around the axis, and they are passed in turn.");
  s.key("file", &P::file)
      .initially("")
      .doc(
          "A CSV file of the corners with the columns x, y and, in space, z and their units: `x[mm]`; "
          "relative to this file.");
  s.quantity("x", &P::x, "m")
      .or_one()
      .initially(Value::list())
      .doc("Without a file: the x of each corner; axisymmetric: its radius.");
  s.quantity("y", &P::y, "m")
      .or_one()
      .initially(Value::list())
      .doc("The y of each corner; axisymmetric: along the axis.");
  s.quantity("z", &P::z, "m").or_one().initially(Value::list()).doc("In space, the z of each corner.");
  return s;
}

/// Declares what flows, how much of it and how warm.
void fluid_keys(Section<ChannelSpec>& s) {
  using C = ChannelSpec;
  s.function("flow", &C::flow, "m3/s")
      .of({Argument::time})
      .at_least(0)
      .doc("Volume flow (\"8 l/min\"); zero: the water stands, or is blown out, and nothing is exchanged.");
  s.function("mass_flow", &C::mass_flow, "kg/s").of({Argument::time}).at_least(0).doc("In place of `flow`.");
  s.function("inlet_temperature", &C::inlet, "K")
      .of({Argument::time})
      .positive()
      .doc("Temperature of what comes in.");
  s.key("after", &C::after)
      .initially("")
      .doc(
          "Name of a [[channel]] further up whose outlet feeds this one, in place of flow and "
          "inlet_temperature.");
  s.choice("fluid", &C::fluid,
           {{"water", C::Fluid::water,
             "liquid water: density, heat capacity, viscosity and conductivity by temperature (IAPWS)"},
            {"given", C::Fluid::given, "oil or another: the four properties are given here"}})
      .initially("water")
      .doc("What flows.");
  const auto property = [&s](const char* name, Function C::*member, const char* unit, const char* doc) {
    s.function(name, member, unit).of({Argument::temperature}).positive().when("fluid", {"given"}).doc(doc);
  };
  property("density", &C::density, "kg/m3", "Density of the fluid.");
  property("specific_heat", &C::specific_heat, "J/kg/K", "Heat capacity of the fluid per mass.");
  property("conductivity", &C::conductivity, "W/m/K", "Thermal conductivity of the fluid.");
  property("viscosity", &C::viscosity, "Pa s", "Dynamic viscosity of the fluid.");
}

}  // namespace

Section<ChannelSpec> channel_keys() {
  using C = ChannelSpec;
  Section<C> s(
      "channel",
      "A cooling channel as a line in a body, which needs no elements of its own. Its fluid warms up "
      "on its way; history.csv has its heat, outlet temperature, Reynolds number, film coefficient "
      "and the hottest place of its wall.");
  // Where it runs, then what flows in it, then how well heat passes and when.
  s.key("name", &C::name).doc("A name of your choice; history.csv has columns of this name.");
  s.key("body", &C::body).doc("The body that it runs through: a group of the mesh.");
  s.section("path", &C::path, path_keys());
  s.quantity("diameter", &C::diameter, "m").positive().doc("Inner diameter.");
  fluid_keys(s);
  // The film between the fluid and the wall, and what of the channel is in the model.
  s.choice("law", &C::law,
           {{"gnielinski", heat::ChannelLaw::gnielinski,
             "Gnielinski's, with Petukhov's friction, from Re = 4000 on"},
            {"dittus_boelter", heat::ChannelLaw::dittus_boelter,
             "0.023 Re^0.8 Pr^n from Re = 10 000 on, n = 0.4 heated and 0.3 cooled"}})
      .initially("gnielinski")
      .doc(
          "Nusselt number of turbulent flow. Up to Re = 2300 flow is laminar; between, the number goes on a "
          "straight line.");
  s.key("laminar_nusselt", &C::laminar)
      .initially(3.66)
      .range(1, 100)
      .doc("Nusselt number of laminar flow: 3.66 for a wall of one temperature, 4.36 of one heat flux.");
  s.key("share", &C::share)
      .initially(1)
      .range(0.01, 1)
      .doc(
          "Share of the channel that is in the model: 0.5 where its middle lies in a plane of symmetry. "
          "The flow is that of the whole channel.");
  s.quantity("pressure", &C::pressure, "Pa")
      .initially("101325 Pa")
      .positive()
      .doc("Absolute pressure in the channel, by which `run` warns of water that boils at the wall.");
  s.key("stages", &C::stages)
      .or_one()
      .initially(Value::list())
      .doc("The stages in which it flows; empty: in all.");
  s.choice("time", &C::clock,
           {{"run", TimeOrigin::run, "the start of the run"},
            {"stage", TimeOrigin::stage, "the start of each stage"}})
      .initially("run")
      .doc("What tables of time count from.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::cases
