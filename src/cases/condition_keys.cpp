/// Keys of thermal and mechanical conditions, in the order of the manual.
#include "cases/case_keys.hpp"

namespace solidus::cases {

namespace {

/// Keys for the stages of a condition and for the origin of time of its tables.
template <class C>
void add_stage_keys(Section<C>& s) {
  s.key("stages", &C::stages)
      .or_one()
      .initially(Value::list())
      .doc("The stages in which it holds; empty: in all.");
  s.choice("time", &C::clock,
           {{"run", TimeOrigin::run, "the start of the run"},
            {"stage", TimeOrigin::stage, "the start of each stage"}})
      .initially("run")
      .doc("What tables of time count from.");
}

/// Declares the heat of a surface: a temperature, a flux, a film, radiation.
void surface_heat_keys(Section<ThermalConditionSpec>& s) {
  using C = ThermalConditionSpec;
  s.function("temperature", &C::temperature, "K")
      .of({Argument::time})
      .anywhere()
      .positive()
      .when("kind", {"temperature"})
      .doc("The temperature.");
  s.function("flux", &C::flux, "W/m2")
      .of({Argument::time})
      .anywhere()
      .when("kind", {"flux"})
      .doc("Heat into the body per area.");
  s.function("coefficient", &C::coefficient, "W/m2/K")
      .of({Argument::time, Argument::temperature})
      .anywhere()
      .at_least(0)
      .when("kind", {"film"})
      .doc("Film coefficient h; a table of temperature takes that of the surface.");
  s.function("emissivity", &C::emissivity, "1")
      .of({Argument::time, Argument::temperature})
      .anywhere()
      .range(0, 1)
      .when("kind", {"radiation"})
      .doc("Grey emissivity of the surface.");
  s.function("ambient", &C::ambient, "K")
      .of({Argument::time})
      .anywhere()
      .positive()
      .when("kind", {"film", "radiation"})
      .doc("Temperature of the surroundings.");
}

/// Declares the heat that a body releases in its volume, at all times or once.
void volume_heat_keys(Section<ThermalConditionSpec>& s) {
  using C = ThermalConditionSpec;
  s.function("power", &C::power, "W/m3")
      .of({Argument::time})
      .anywhere()
      .when("kind", {"source"})
      .doc("Heat released per volume and time.");
  s.quantity("heat", &C::heat, "J/m3")
      .positive()
      .when("kind", {"exothermic"})
      .doc("Heat that the body releases in all, per volume: heat per mass times its density.");
  s.quantity("ignition", &C::ignition, "K")
      .positive()
      .when("kind", {"exothermic"})
      .doc("The temperature at which a place ignites.");
  s.quantity("duration", &C::duration, "s")
      .positive()
      .when("kind", {"exothermic"})
      .doc("How long a place burns; its heat comes evenly.");
}

}  // namespace

/// Keys of [[thermal_condition]]. `kind` decides which of the others may be given: each names the kinds that
/// it belongs to.
Section<ThermalConditionSpec> thermal_condition_keys() {
  using C = ThermalConditionSpec;
  Section<C> s("thermal_condition",
               "Heat at the boundary or in the volume. Where nothing is said, a surface is insulated.");
  s.key("name", &C::name).doc("A name of your choice; a variant refers to it.");
  s.key("group", &C::group)
      .doc("Surface group of the mesh; for kind = \"source\" and \"exothermic\" a body.");
  s.choice("kind", &C::kind,
           {{"temperature", C::Kind::temperature, "prescribed temperature"},
            {"flux", C::Kind::flux, "prescribed heat flux"},
            {"film", C::Kind::film, "h (ambient - T)"},
            {"radiation", C::Kind::radiation, "grey body: emissivity x Stefan-Boltzmann (ambient^4 - T^4)"},
            {"source", C::Kind::source, "heat released in the volume of a body"},
            {"exothermic", C::Kind::exothermic,
             "heat that a body releases once, place after place, when it has become hot enough: a sleeve or "
             "a topping that burns"}})
      .doc("What acts there.");
  surface_heat_keys(s);
  volume_heat_keys(s);
  s.function("factor", &C::factor, "1")
      .of({Argument::time})
      .anywhere()
      .initially(1)
      .at_least(0)
      .when("kind", {"flux", "film", "radiation", "source"})
      .doc(
          "The flux, coefficient, emissivity or power is multiplied by it: where and when a condition acts "
          "whose coefficient is a table of temperature.");
  add_stage_keys(s);
  s.place(&C::where);
  return s;
}

/// Keys of [[mechanical_condition]]. Components of the displacement that are left out stay free.
Section<MechanicalConditionSpec> mechanical_condition_keys() {
  using C = MechanicalConditionSpec;
  Section<C> s("mechanical_condition", "Supports and loads. Where nothing is said, a surface is free.");
  s.key("name", &C::name).doc("A name of your choice; a variant refers to it.");
  s.key("group", &C::group)
      .doc("Group of the mesh: a surface; for kind = \"displacement\" also a point or a body.");
  s.choice("kind", &C::kind,
           {{"displacement", C::Kind::displacement, "prescribed displacement components"},
            {"pressure", C::Kind::pressure, "normal to the surface"},
            {"traction", C::Kind::traction, "in fixed directions"},
            {"plane", C::Kind::plane,
             "the face stays plane and parallel to itself; without loads on it its net force is zero"}})
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
  s.key("relative", &C::relative)
      .initially(false)
      .when("kind", {"displacement"})
      .doc(
          "Count displacements from where each node is when the stage begins: 0 holds it there. Otherwise "
          "from "
          "the mesh.");
  add_stage_keys(s);
  s.place(&C::where);
  return s;
}

}  // namespace solidus::cases
