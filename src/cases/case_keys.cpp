/// The sections of a case file in the order of the manual; each room of keys declares its own.
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [analysis]: which fields are solved for, in how many dimensions, and gravity.
Section<AnalysisSpec> analysis_keys() {
  Section<AnalysisSpec> s("analysis", "What is computed.");
  s.choice("kind", &AnalysisSpec::kind,
           {{"plane_strain", AnalysisKind::plane_strain, "x, y in the plane, one metre thick"},
            {"axisymmetric", AnalysisKind::axisymmetric, "x is the radius, y the axis of revolution"},
            {"solid", AnalysisKind::solid, "three-dimensional"}})
      .doc("What the coordinates of the mesh mean.");
  s.choice("physics", &AnalysisSpec::physics,
           {{"heat", Physics::heat, "temperature only"},
            {"mechanics", Physics::mechanics, "displacement only, at the initial temperature"},
            {"thermomechanical", Physics::thermomechanical, "both, coupled"}})
      .initially("thermomechanical")
      .doc("The fields that are solved for.");
  s.quantity("gravity", &AnalysisSpec::gravity, "m/s2")
      .initially("0 m/s2")
      .at_least(0)
      .doc("Magnitude of gravity.");
  s.key("gravity_direction", &AnalysisSpec::gravity_direction)
      .initially(Value::list())
      .doc("Direction of gravity, of any length; empty: down the last axis (-y; with kind = \"solid\" -z).");
  s.place(&AnalysisSpec::where);
  return s;
}

namespace {

/// Keys of [body.initial_stress].
Section<InitialStressSpec> initial_stress_keys() {
  using S = InitialStressSpec;
  Section<S> s("initial_stress",
               "Stress of the body at the start: the field of a file, or its components as functions of "
               "position. Solid metal only; the first step brings it into equilibrium.");
  s.key("file", &S::file)
      .initially("")
      .doc("A .vtu or .pvtu file of another run or program, relative to this file.");
  s.key("field", &S::field)
      .initially("stress")
      .doc(
          "Field of its cells or points, with six components: xx, yy, zz, xy, yz, xz; about an axis rr, zz, "
          "hoop, rz, 0, 0.");
  s.key("unit", &S::unit)
      .initially("")
      .doc("Unit of the file's numbers; empty: what the file says, else Pa.");
  s.key("length_unit", &S::length_unit).initially("").doc("Unit of the file's coordinates; empty: m.");
  s.key("body", &S::body)
      .initially(-1)
      .at_least(-1)
      .doc("Only cells of the file whose cell data `body` is this; -1: all.");
  const auto component = [&s](const char* name, std::optional<Function> S::*member, const char* doc) {
    s.function(name, member, "Pa").anywhere(Key::Place::position).doc(doc);
  };
  component("xx", &S::xx, "Stress along x; about an axis the radial one. Components left out are zero.");
  component("yy", &S::yy, "Stress along y; about an axis the axial one.");
  component("zz", &S::zz, "Stress along z; about an axis the hoop stress.");
  component("xy", &S::xy, "Shear stress in the plane of x and y.");
  component("yz", &S::yz, "Shear stress in the plane of y and z, in a solid.");
  component("xz", &S::xz, "Shear stress in the plane of x and z, in a solid.");
  s.place(&S::where);
  return s;
}

}  // namespace

/// Keys of [[body]]: what it is made of and starts from, its role, what physics it takes part in, and up to
/// which stage it is there.
Section<BodySpec> body_keys() {
  Section<BodySpec> s("body", "A body: a named group of the mesh, its material and initial temperature.");
  s.key("name", &BodySpec::name).doc("A name of your choice; messages and results use it.");
  s.key("group", &BodySpec::group)
      .doc("Group of the mesh that holds its elements; without it the group called `name`.");
  s.key("material", &BodySpec::material)
      .doc("Name in the material library (`solidus materials`), or a material file (relative to this file).");
  s.function("initial_temperature", &BodySpec::initial_temperature, "K")
      .anywhere(Key::Place::position)
      .positive()
      .doc("At the start; the body is free of thermal strain there.");
  s.section("initial_stress", &BodySpec::initial_stress, initial_stress_keys());
  s.choice("role", &BodySpec::role,
           {{"automatic", std::nullopt,
             "a casting where the material can melt, else the role that its name contains"},
            {"casting", Role::casting, "metal that is poured"},
            {"riser", Role::riser, "metal that feeds the casting"},
            {"gating", Role::gating, "sprue, runners and gates: poured with the casting and cut off"},
            {"mould", Role::mould, "a mould that is broken off or shaken out"},
            {"core", Role::core, "a mould inside the casting"},
            {"chill", Role::chill, "a block that draws heat, of any material"},
            {"sleeve", Role::sleeve, "keeps a riser warm"},
            {"die", Role::die, "a mould that is used again"},
            {"insulation", Role::insulation, "a layer or board that holds heat back"}})
      .initially("automatic")
      .doc(
          "What the body is to the foundry. Solid fraction, criteria and summary are those of castings and "
          "risers.");
  s.choice("physics", &BodySpec::physics,
           {{"automatic", BodySpec::ActivePhysics::automatic,
             "heat where the body is no casting and its material has no elastic properties, else all"},
            {"all", BodySpec::ActivePhysics::all, "those of the analysis"},
            {"heat", BodySpec::ActivePhysics::heat,
             "in a thermomechanical analysis it conducts heat and does not deform"}})
      .initially("automatic")
      .doc(
          "The fields that are solved for in the body. One that only conducts heat (a sand mould) costs no "
          "mechanics: nodes that it shares with other bodies move with them, and in contact it is a rigid "
          "wall.");
  s.key("stages", &BodySpec::stages)
      .or_one()
      .initially(Value::list())
      .doc(
          "The stages in which the body exists, from the first one on without a break; empty: all. A body "
          "that was removed does not come back.");
  s.quantity("initial_velocity", &BodySpec::initial_velocity, "m/s")
      .initially(Value::list())
      .doc(
          "One component a direction, with [dynamics] only; empty: at rest. Prescribed displacements take "
          "precedence.");
  s.place(&BodySpec::where);
  return s;
}

/// All sections of a case, in the order of the reference. The declaration is made once, and is what parsing,
/// checks, the schema and the manual are derived from.
const Section<CaseSpec>& case_keys() {
  static const Section<CaseSpec> declaration = [] {
    Section<CaseSpec> s("", "A case of Solidus.");
    s.key("title", &CaseSpec::title).doc("What the case is about, one line.");
    s.key("include", &CaseSpec::include)
        .or_one()
        .initially(Value::list())
        .doc(
            "The case file, or files, that this one starts from: keys of a later file replace those of an "
            "earlier one, and keys of this file replace them all.");
    s.section("analysis", &CaseSpec::analysis, analysis_keys());
    s.section("mesh", &CaseSpec::mesh, mesh_keys());
    s.section("time", &CaseSpec::time, time_keys());
    s.sections("stage", &CaseSpec::stages, stage_keys());
    s.sections("cycle", &CaseSpec::cycles, cycle_keys());
    s.sections("body", &CaseSpec::bodies, body_keys());
    s.sections("thermal_condition", &CaseSpec::thermal_conditions, thermal_condition_keys());
    s.sections("channel", &CaseSpec::channels, channel_keys());
    s.sections("source", &CaseSpec::sources, source_keys());
    s.sections("deposition", &CaseSpec::depositions, deposition_keys());
    s.sections("mechanical_condition", &CaseSpec::mechanical_conditions, mechanical_condition_keys());
    s.section("rotation", &CaseSpec::rotation, rotation_keys());
    s.sections("contact", &CaseSpec::contacts, contact_keys());
    s.sections("interface", &CaseSpec::interfaces, body_interface_keys());
    s.sections("rigid_surface", &CaseSpec::rigid_surfaces, rigid_surface_keys());
    s.section("heat", &CaseSpec::heat, heat_keys());
    s.section("mechanics", &CaseSpec::mechanics, mechanics_keys());
    s.section("dynamics", &CaseSpec::dynamics, dynamics_keys());
    s.section("coupling", &CaseSpec::coupling, coupling_keys());
    s.sections("probe", &CaseSpec::probes, probe_keys());
    s.sections("profile", &CaseSpec::profiles, profile_keys());
    s.section("criteria", &CaseSpec::criteria, criteria_keys());
    s.sections("die_life", &CaseSpec::die_lives, die_life_keys());
    s.sections("jet", &CaseSpec::jets, jet_keys());
    s.sections("shot_sleeve", &CaseSpec::shot_sleeves, shot_sleeve_keys());
    s.section("feeding", &CaseSpec::feeding, feeding_keys());
    s.section("gas", &CaseSpec::gas, gas_keys());
    s.section("filling", &CaseSpec::filling, filling_keys());
    s.section("output", &CaseSpec::output, output_keys());
    s.section("vary", &CaseSpec::vary, vary_keys());
    s.section("spread", &CaseSpec::spread, spread_keys_of_case());
    return s;
  }();
  return declaration;
}

}  // namespace solidus::cases
