/// Keys of [time].
#include "cases/case_keys.hpp"

namespace solidus::cases {

namespace {

/// Declares how adaptive steps measure their error, and how much of it a run may have.
void error_control_keys(Section<TimeSpec>& s) {
  using coupling::ErrorControl;
  s.choice("error_control", &TimeSpec::error_control,
           {{"predictor", ErrorControl::predictor,
             "the heat flows and displacements of a step against those of the one before; costs little"},
            {"doubling", ErrorControl::doubling,
             "the step against two of half its size, whose result is kept; measures the coupling scheme's "
             "error too, costs three steps for one"},
            {"none", ErrorControl::none, "not at all"}})
      .initially("predictor")
      .doc("How adaptive steps measure their local error.");
  s.quantity("temperature_error", &TimeSpec::temperature_error, "K")
      .positive()
      .difference()
      .doc(
          "Temperature error of the whole run that the size of adaptive steps may cause: root mean square "
          "over a body, of the body where it is largest. Without it 1 K. Where bodies deform, the size of "
          "the steps in which the last melt of a casting freezes is also proportional to its square root.");
  s.quantity("displacement_error", &TimeSpec::displacement_error, "m")
      .positive()
      .doc(
          "The same for the displacement of metal above coherency; melt that flows is not counted. Where "
          "something melts it is the error of the worst node. Without it 3e-4 times the modulus (volume over "
          "cooling surface) of the deforming body with the smallest one.");
  s.key("stress_error", &TimeSpec::stress_error)
      .range(1e-6, 1)
      .doc(
          "Local error of an adaptive step in the stress of solid metal that creeps (flow that depends on "
          "its rate), as a fraction of the stress in the body where that fraction is largest; without it "
          "0.005.");
  s.key("solid_fraction_change", &TimeSpec::solid_fraction_change)
      .range(1e-4, 1)
      .doc(
          "Largest change in an adaptive step of the solid fraction of all metal that can melt; without it "
          "0.1 with heat alone. Where bodies deform it is 0.013 divided by the fraction that freezes at one "
          "temperature, but at most 0.1, and 0.016 where the casting expands as it freezes, both times the "
          "square root of displacement_error over its default.");
  s.key("skin_change", &TimeSpec::skin_change)
      .range(1e-3, 1)
      .doc(
          "Fraction of a casting's surface in contact that may become coherent in an adaptive step, where "
          "bodies deform. Without it 0.03; where `displacement_error` is given, 0.03 times the square root "
          "of its ratio to the default, between 0.001 and 0.5.");
}

/// Declares how small and how large adaptive steps become.
void step_size_keys(Section<TimeSpec>& s) {
  s.quantity("min_step", &TimeSpec::min_step, "s")
      .positive()
      .doc(
          "The run stops when a step of this size fails. Without it the control of errors makes no step "
          "shorter than step / 1024, and the run stops when a step of step / 2^20 fails; with a "
          "[[deposition]] one of step / 16.");
  s.quantity("max_step", &TimeSpec::max_step, "s")
      .positive()
      .doc("Largest adaptive step; without it ten times `step`.");
  s.key("growth", &TimeSpec::growth)
      .initially(1.5)
      .range(1.0001, 10)
      .doc("Largest factor from one step to the next.");
  s.key("cut", &TimeSpec::cut)
      .initially(0.5)
      .range(0.01, 0.99)
      .doc("Factor by which a step that failed is shortened.");
  s.key("easy_iterations", &TimeSpec::easy_iterations)
      .initially(8)
      .range(1, 1000)
      .doc(
          "Adaptive steps grow by the full factor `growth` where no phase took more Newton iterations than "
          "this. With more iterations they grow less, and from three times as many on not at all; beyond "
          "four times as many they shrink, but not below `step`.");
}

}  // namespace

/// Keys of [time]: the end, the first step, and how adaptive steps are chosen.
Section<TimeSpec> time_keys() {
  Section<TimeSpec> s("time", "The time that is simulated and the size of its steps.");
  s.key("steady", &TimeSpec::steady)
      .initially(false)
      .doc(
          "Solve for the final equilibrium at once, without time: the temperatures at which nothing warms or "
          "cools any more and, in mechanics, the deformation that goes with them and with the gaps, from the "
          "unstressed bodies of the start. Conditions are those of t = 0; [coupling] says nothing here.");
  s.quantity("end", &TimeSpec::end, "s")
      .positive()
      .doc(
          "The run goes from zero to this time; required unless the analysis is steady or has stages, whose "
          "durations add up to the end.");
  s.choice("until", &TimeSpec::until,
           {{"end", TimeSpec::Until::end, "the run goes on to `end`"},
            {"solid", TimeSpec::Until::solid,
             "it ends with the first step after which everything that can melt is solid, at `end` at the "
             "latest"}})
      .initially("end")
      .doc("What ends the run; without stages.");
  s.quantity("step", &TimeSpec::step, "s")
      .positive()
      .doc(
          "The time step; where steps are adaptive the first one; required unless steady or given by "
          "every stage.");
  s.key("adaptive", &TimeSpec::adaptive)
      .initially(false)
      .doc(
          "Choose the size of each step by its local error, the change of solid fraction and the number of "
          "iterations.");
  error_control_keys(s);
  step_size_keys(s);
  s.place(&TimeSpec::where);
  return s;
}

}  // namespace solidus::cases
