#include "model/case_keys.hpp"

namespace solidus::model {

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
      .doc("Direction of gravity, of any length; empty: down the last axis (-y, in a solid -z).");
  s.place(&AnalysisSpec::where);
  return s;
}

Section<TimeSpec> time_keys() {
  Section<TimeSpec> s("time", "The time that is simulated and the size of its steps.");
  s.key("steady", &TimeSpec::steady)
      .initially(false)
      .doc("Solve for the final equilibrium at once, without time.");
  s.quantity("end", &TimeSpec::end, "s")
      .positive()
      .doc("The run goes from zero to this time; required unless steady.");
  s.quantity("step", &TimeSpec::step, "s").positive().doc("The step asked for; required unless steady.");
  s.key("adaptive", &TimeSpec::adaptive)
      .initially(false)
      .doc("Let easy steps grow beyond `step`, up to `max_step`.");
  s.quantity("min_step", &TimeSpec::min_step, "s")
      .positive()
      .doc("The run stops when a step of this size is rejected; without it step / 1024.");
  s.quantity("max_step", &TimeSpec::max_step, "s")
      .positive()
      .doc("Largest adaptive step; without it ten times `step`.");
  s.key("growth", &TimeSpec::growth)
      .initially(1.5)
      .range(1.0001, 10)
      .doc("Factor of the step after an easy step.");
  s.key("cut", &TimeSpec::cut)
      .initially(0.5)
      .range(0.01, 0.99)
      .doc("Factor of the step after a rejected step.");
  s.key("easy_iterations", &TimeSpec::easy_iterations)
      .initially(6)
      .range(1, 1000)
      .doc("A step is easy when no phase took more Newton iterations than this.");
  s.place(&TimeSpec::where);
  return s;
}

Section<BodySpec> body_keys() {
  Section<BodySpec> s("body", "A body: a named group of the mesh, its material and initial temperature.");
  s.key("name", &BodySpec::name).doc("A name of your choice; messages and results use it.");
  s.key("group", &BodySpec::group)
      .doc("Group of the mesh that holds its elements; without it the group called `name`.");
  s.key("material", &BodySpec::material)
      .doc("Name in the material library (`solidus materials`), or a material file (relative to this file).");
  s.quantity("initial_temperature", &BodySpec::initial_temperature, "K")
      .positive()
      .doc("Uniform at the start; the body is free of thermal strain there.");
  s.place(&BodySpec::where);
  return s;
}

const Section<CaseSpec>& case_keys() {
  static const Section<CaseSpec> declaration = [] {
    Section<CaseSpec> s("", "A case of Solidus.");
    s.key("title", &CaseSpec::title).doc("What the case is about, one line.");
    s.key("include", &CaseSpec::include)
        .doc("Another case file that this one starts from; what stands here is laid over it.");
    s.section("analysis", &CaseSpec::analysis, analysis_keys());
    s.section("mesh", &CaseSpec::mesh, mesh_keys());
    s.section("time", &CaseSpec::time, time_keys());
    s.sections("body", &CaseSpec::bodies, body_keys());
    s.sections("thermal_condition", &CaseSpec::thermal_conditions, thermal_condition_keys());
    s.sections("mechanical_condition", &CaseSpec::mechanical_conditions, mechanical_condition_keys());
    s.sections("contact", &CaseSpec::contacts, contact_keys());
    s.section("heat", &CaseSpec::heat, heat_keys());
    s.section("mechanics", &CaseSpec::mechanics, mechanics_keys());
    s.section("coupling", &CaseSpec::coupling, coupling_keys());
    s.sections("probe", &CaseSpec::probes, probe_keys());
    s.section("output", &CaseSpec::output, output_keys());
    return s;
  }();
  return declaration;
}

}  // namespace solidus::model
