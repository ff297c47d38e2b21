/// Keys of thermal and mechanical conditions, in the order of the manual.
#include "cases/case_keys.hpp"
#include "cases/source_law.hpp"

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
      .doc("Temperature of the surroundings; of an enclosure, of what is seen through its opening.");
  s.choice("radiation", &C::sees,
           {{"ambient", C::Sees::ambient, "the surface sees surroundings of one temperature alone"},
            {"enclosure", C::Sees::enclosure,
             "it sees all surfaces whose conditions have this value, and the surroundings where none of them "
             "is in the way: grey and diffuse, with view factors by ray tracing. Emissivity, ambient and "
             "factor cannot be functions of position then"}})
      .initially("ambient")
      .when("kind", {"radiation"})
      .doc("What the surface exchanges radiation with.");
}

/// Declares the heat that a body releases in its volume, at all times or once.
void volume_heat_keys(Section<ThermalConditionSpec>& s) {
  using C = ThermalConditionSpec;
  s.kinds("law", &C::law, source_laws())
      .initially("given")
      .when("kind", {"source"})
      .doc("What the power of the source follows from.");
  s.function("power", &C::power, "W/m3")
      .of({Argument::time})
      .anywhere()
      .when("law", {"given"})
      .doc("Heat released per volume and time.");
  s.quantity("heat", &C::heat, "J/m3")
      .positive()
      .when("kind", {"exothermic"})
      .doc("Heat that the body releases in all, per volume: heat per mass times its density.");
  s.quantity("ignition", &C::ignition, "K")
      .positive()
      .when("kind", {"exothermic"})
      .doc("The temperature at which a point ignites.");
  s.quantity("duration", &C::duration, "s")
      .positive()
      .when("kind", {"exothermic"})
      .doc("How long a point burns; it releases its heat at a constant rate.");
}

}  // namespace

/// Keys of [[thermal_condition]]. `kind` decides which of the others may be given: each names the kinds that
/// it belongs to.
Section<ThermalConditionSpec> thermal_condition_keys() {
  using C = ThermalConditionSpec;
  Section<C> s("thermal_condition",
               "Heat at the boundary or in the volume. Without a condition a surface is insulated.");
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
             "heat that each point of a body releases once, when it reaches its ignition temperature: a "
             "sleeve or a topping that burns"}})
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
          "The flux, coefficient, emissivity or power is multiplied by it: it gives a condition whose "
          "coefficient is a table of temperature a dependence on place and time.");
  add_stage_keys(s);
  s.place(&C::where);
  return s;
}

namespace {

/// Declares what moves a surface, a point or a body.
void displacement_keys(Section<MechanicalConditionSpec>& s) {
  using C = MechanicalConditionSpec;
  const auto component = [&s](const char* name, std::optional<Function> C::*member, const char* doc) {
    s.function(name, member, "m").of({Argument::time}).anywhere().when("kind", {"displacement"}).doc(doc);
  };
  component("ux", &C::ux, "Displacement along x.");
  component("uy", &C::uy, "Displacement along y.");
  component("uz", &C::uz, "Displacement along z; in axisymmetry along the axis.");
  component("ur", &C::ur, "Radial displacement, in axisymmetry.");
  s.key("relative", &C::relative)
      .initially(false)
      .when("kind", {"displacement"})
      .doc(
          "Displacements count from the position of each node when the stage begins: 0 holds it there. "
          "Otherwise they count from the mesh.");
}

/// Declares what loads a surface or the volume of a body.
void load_keys(Section<MechanicalConditionSpec>& s) {
  using C = MechanicalConditionSpec;
  s.function("pressure", &C::pressure, "Pa")
      .of({Argument::time})
      .anywhere()
      .when("kind", {"pressure"})
      .doc("Positive pushes on the body.");
  s.function("traction", &C::traction, "Pa")
      .of({Argument::time})
      .anywhere()
      .when("kind", {"traction"})
      .doc("Force per area, one value per direction of the mesh: [\"1 MPa\", \"0 MPa\"].");
  s.function("force", &C::force, "N/m3")
      .of({Argument::time})
      .anywhere()
      .when("kind", {"body_force"})
      .doc("Force per volume besides the weight, one value per direction of the mesh.");
  s.function("level", &C::level, "m")
      .of({Argument::time})
      .when("kind", {"metallostatic"})
      .doc("Height of the surface of the melt, as a coordinate against gravity; no pressure acts above it.");
  s.quantity("density", &C::density, "kg/m3")
      .positive()
      .when("kind", {"metallostatic"})
      .doc("Density of the melt.");
  s.function("squeeze", &C::squeeze, "Pa")
      .of({Argument::time})
      .initially("0 Pa")
      .when("kind", {"metallostatic"})
      .doc("Pressure of a gas or a piston on the surface of the melt; it acts everywhere below.");
}

}  // namespace

/// Keys of [[mechanical_condition]]. Components of the displacement that are left out stay free.
Section<MechanicalConditionSpec> mechanical_condition_keys() {
  using C = MechanicalConditionSpec;
  Section<C> s("mechanical_condition", "Supports and loads. Without a condition a surface is free.");
  s.key("name", &C::name).doc("A name of your choice; a variant refers to it.");
  s.key("group", &C::group)
      .doc(
          "Group of the mesh: a surface; for kind = \"displacement\" also a point or a body, for kind = "
          "\"body_force\" a body.");
  s.choice("kind", &C::kind,
           {{"displacement", C::Kind::displacement, "prescribed displacement components"},
            {"pressure", C::Kind::pressure, "normal to the surface"},
            {"traction", C::Kind::traction, "in fixed directions"},
            {"metallostatic", C::Kind::metallostatic,
             "the pressure of a melt that is no part of the mesh: density x gravity x depth below its level"},
            {"body_force", C::Kind::body_force, "in the volume of a body, in fixed directions"},
            {"plane", C::Kind::plane,
             "the face stays plane and parallel to itself; without loads on it its net force is zero"}})
      .doc("What acts there.");
  displacement_keys(s);
  load_keys(s);
  add_stage_keys(s);
  s.place(&C::where);
  return s;
}

/// Keys of [rotation].
Section<RotationSpec> rotation_keys() {
  Section<RotationSpec> s(
      "rotation",
      "Bodies that rotate about an axis, such as a centrifugally cast pipe: a centrifugal force acts in the "
      "frame that rotates with them. Coriolis' force and that of a changing speed "
      "are left out.");
  s.function("omega", &RotationSpec::omega, "rad/s")
      .of({Argument::time})
      .at_least(0)
      .doc("Angular velocity; \"900 rpm\" is 94.2 rad/s.");
  s.key("axis", &RotationSpec::axis)
      .initially(Value::list())
      .doc(
          "Direction of the axis, of any length; empty: the last axis of a solid, the normal of a plane, the "
          "axis of revolution.");
  s.quantity("point", &RotationSpec::point, "m")
      .initially(Value::list())
      .doc("A point of the axis; empty: the origin.");
  s.key("bodies", &RotationSpec::bodies)
      .initially(Value::list())
      .doc("Names of the bodies that turn; empty: all.");
  s.place(&RotationSpec::where);
  return s;
}

}  // namespace solidus::cases
