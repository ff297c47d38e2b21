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
             "the step against two of half its size, which are kept; sees the coupling scheme's error too, "
             "costs three steps for one"},
            {"none", ErrorControl::none, "not at all"}})
      .initially("predictor")
      .doc("How adaptive steps measure their local error.");
  s.quantity("temperature_error", &TimeSpec::temperature_error, "K")
      .positive()
      .difference()
      .doc(
          "Error of a run with adaptive steps that is left to their size, root mean square over the body "
          "where it is largest. Without it 1 K. Where bodies deform, steps in which the last melt of a "
          "casting freezes go with its root too.");
  s.quantity("displacement_error", &TimeSpec::displacement_error, "m")
      .positive()
      .doc(
          "The same of the displacement of what is coherent: melt that flows costs no step. Where something "
          "melts it is that of the worst node. Without it 3e-4 of the section, volume over cooling surface, "
          "of the body that deforms where it is least.");
  s.key("stress_error", &TimeSpec::stress_error)
      .range(1e-6, 1)
      .doc(
          "Local error of an adaptive step in the stress of solid metal that creeps (flow that depends on "
          "its "
          "rate), as a share of the stress of the body where it is largest; without it 0.005.");
  s.key("solid_fraction_change", &TimeSpec::solid_fraction_change)
      .range(1e-4, 1)
      .doc(
          "Change in an adaptive step of the solid share of the volume that can melt; without it 0.1 with "
          "heat alone; where bodies deform 0.013 over the share that freezes at one temperature, but at most "
          "0.1, and 0.016 where the casting expands as it freezes, both times the root of displacement_error "
          "over its default.");
  s.key("skin_change", &TimeSpec::skin_change)
      .range(1e-3, 1)
      .doc(
          "Share of a skin in contact that may become coherent in an adaptive step, where bodies deform. "
          "Without it 0.03, and where `displacement_error` is given that times the root of its ratio to the "
          "default, from 0.001 to 0.5.");
}

/// Declares how small and how large adaptive steps become.
void step_size_keys(Section<TimeSpec>& s) {
  s.quantity("min_step", &TimeSpec::min_step, "s")
      .positive()
      .doc(
          "The run stops when a step of this size does not go through. Without it errors make no step "
          "shorter than step / 1024, and the run stops when step / 2^20 does not go through; with a "
          "[[deposition]] it is step / 16.");
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
      .doc("Factor of the step after one that did not go through.");
  s.key("easy_iterations", &TimeSpec::easy_iterations)
      .initially(8)
      .range(1, 1000)
      .doc(
          "Adaptive steps grow by `growth` where no phase took more Newton iterations than this, the less "
          "the more there were, and not at all from three times as many on; beyond four times as many they "
          "shrink, not below `step`.");
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
      .doc("The run goes from zero to this time; required unless steady or in stages, which make the end.");
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
          "The step asked for, where steps are adaptive the first one; required unless steady or given by "
          "every stage.");
  s.key("adaptive", &TimeSpec::adaptive)
      .initially(false)
      .doc(
          "Let steps follow their local error, the change of solid fraction and the effort of the "
          "iteration.");
  error_control_keys(s);
  step_size_keys(s);
  s.place(&TimeSpec::where);
  return s;
}

}  // namespace solidus::cases
