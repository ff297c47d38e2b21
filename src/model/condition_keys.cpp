#include "model/case_keys.hpp"

namespace solidus::model {

Section<ThermalConditionSpec> thermal_condition_keys() {
  using C = ThermalConditionSpec;
  Section<C> s("thermal_condition",
               "Heat at the boundary or in the volume. Where nothing is said, a surface is insulated.");
  s.key("name", &C::name).doc("A name of your choice; a variant refers to it.");
  s.key("group", &C::group).doc("Surface group of the mesh; for kind = \"source\" a body.");
  s.choice("kind", &C::kind,
           {{"temperature", C::Kind::temperature, "prescribed temperature"},
            {"flux", C::Kind::flux, "prescribed heat flux"},
            {"film", C::Kind::film, "h (ambient - T)"},
            {"radiation", C::Kind::radiation, "grey body: emissivity x Stefan-Boltzmann (ambient^4 - T^4)"},
            {"source", C::Kind::source, "heat released in the volume of a body"}})
      .doc("What acts there.");
  s.function("temperature", &C::temperature, "K")
      .of({Argument::time})
      .positive()
      .when("kind", {"temperature"})
      .doc("The temperature.");
  s.function("flux", &C::flux, "W/m2")
      .of({Argument::time})
      .when("kind", {"flux"})
      .doc("Heat into the body per area.");
  s.function("coefficient", &C::coefficient, "W/m2/K")
      .of({Argument::time, Argument::temperature})
      .at_least(0)
      .when("kind", {"film"})
      .doc("Film coefficient h; a table of temperature takes that of the surface.");
  s.function("emissivity", &C::emissivity, "1")
      .of({Argument::time, Argument::temperature})
      .range(0, 1)
      .when("kind", {"radiation"})
      .doc("Grey emissivity of the surface.");
  s.function("ambient", &C::ambient, "K")
      .of({Argument::time})
      .positive()
      .when("kind", {"film", "radiation"})
      .doc("Temperature of the surroundings.");
  s.function("power", &C::power, "W/m3")
      .of({Argument::time})
      .when("kind", {"source"})
      .doc("Heat released per volume and time.");
  s.place(&C::where);
  return s;
}

Section<MechanicalConditionSpec> mechanical_condition_keys() {
  using C = MechanicalConditionSpec;
  Section<C> s("mechanical_condition", "Supports and loads. Where nothing is said, a surface is free.");
  s.key("name", &C::name).doc("A name of your choice; a variant refers to it.");
  s.key("group", &C::group)
      .doc("Group of the mesh: a surface; for kind = \"displacement\" also a point or a body.");
  s.choice("kind", &C::kind,
           {{"displacement", C::Kind::displacement, "prescribed displacement components"},
            {"pressure", C::Kind::pressure, "normal to the surface"},
            {"traction", C::Kind::traction, "in fixed directions"}})
      .doc("What acts there.");
  s.function("ux", &C::ux, "m")
      .of({Argument::time})
      .when("kind", {"displacement"})
      .doc("Displacement along x.");
  s.function("uy", &C::uy, "m")
      .of({Argument::time})
      .when("kind", {"displacement"})
      .doc("Displacement along y.");
  s.function("uz", &C::uz, "m")
      .of({Argument::time})
      .when("kind", {"displacement"})
      .doc("Displacement along z; in axisymmetry along the axis.");
  s.function("ur", &C::ur, "m")
      .of({Argument::time})
      .when("kind", {"displacement"})
      .doc("Radial displacement, in axisymmetry.");
  s.function("pressure", &C::pressure, "Pa")
      .of({Argument::time})
      .when("kind", {"pressure"})
      .doc("Positive pushes on the body.");
  s.function("traction", &C::traction, "Pa")
      .of({Argument::time})
      .when("kind", {"traction"})
      .doc("Force per area, one value per direction of the mesh: [\"1 MPa\", \"0 MPa\"].");
  s.place(&C::where);
  return s;
}

Section<ContactSpec> contact_keys() {
  using H = ContactHeatSpec;
  using C = ContactSpec;
  Section<H> heat("heat", "Heat through the interface; without this section it is insulated.");
  heat.quantity("conductance", &H::conductance, "W/m2/K")
      .positive()
      .doc("h_co, from body to body: where the bodies touch, and where the gap law starts at a gap of zero.");
  heat.key("exponent", &H::exponent)
      .initially(0.0)
      .range(0, 2)
      .doc("Exponent of h = h_co (p / hardness)^exponent where the bodies touch (3.49); zero: constant.");
  heat.quantity("hardness", &H::hardness, "Pa")
      .positive()
      .doc("Hardness H_e of 3.49; needed with an exponent.");
  heat.choice("gap_law", &H::gap_law,
              {{"constant", H::GapLaw::constant, "the conductance whatever the gap"},
               {"table", H::GapLaw::table, "a table of the gap"},
               {"gas", H::GapLaw::gas, "conduction through gas, k / (gap + k / conductance) (3.50)"}})
      .doc("Heat across the open gap.");
  heat.function("gap_conductance", &H::gap_conductance, "W/m2/K")
      .of({Argument::gap})
      .at_least(0)
      .when("gap_law", {"table"})
      .doc("Conductance as a table of the gap; its value at zero should be the conductance.");
  heat.quantity("gas_conductivity", &H::gas_conductivity, "W/m/K")
      .positive()
      .when("gap_law", {"gas"})
      .doc("Conductivity of the gas in the gap.");
  heat.place(&H::where);

  Section<C> s("contact",
               "Two surfaces that may touch and part: unilateral contact without friction, small sliding.");
  s.key("name", &C::name).doc("A name of your choice.");
  s.key("slave", &C::slave).doc("Surface group that is integrated over: the finer or softer one.");
  s.key("master", &C::master).doc("Surface group that it is projected on.");
  s.quantity("penalty", &C::penalty, "N/m3")
      .positive()
      .doc("Pressure per penetration; without it from `penalty_factor`.");
  s.key("penalty_factor", &C::penalty_factor)
      .initially(10.0)
      .positive()
      .doc("Penalty = factor x Young's modulus of the stiffer body / height of its elements.");
  s.choice("integration", &C::integration,
           {{"segments", C::Integration::segments,
             "slave faces cut where master faces end: exact on non-matching meshes"},
            {"nodal", C::Integration::nodal, "at the slave's nodes"},
            {"gauss", C::Integration::gauss, "at Gauss points of the slave's faces"}})
      .initially("segments")
      .doc("Where contact is integrated.");
  s.section("heat", &C::heat, heat);
  s.place(&C::where);
  return s;
}

}  // namespace solidus::model
