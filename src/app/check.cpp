/// The verb `check`: everything but solving.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/verbs.hpp"
#include "base/units.hpp"
#include "model/body_input.hpp"
#include "model/run.hpp"
#include "model/stage_input.hpp"

namespace solidus::app {

namespace {

const char* text(AnalysisKind kind) {
  switch (kind) {
    case AnalysisKind::plane_strain:
      return "plane strain";
    case AnalysisKind::axisymmetric:
      return "axisymmetric";
    case AnalysisKind::solid:
      return "three-dimensional";
  }
  return "";
}

const char* text(model::Physics physics) {
  switch (physics) {
    case model::Physics::heat:
      return "heat";
    case model::Physics::mechanics:
      return "mechanics";
    case model::Physics::thermomechanical:
      return "heat and mechanics";
  }
  return "";
}

/// "670 degC", "400 to 670 degC".
std::string text(const model::TemperatureRange& range) {
  const double low = units::to_display(range.low, "K", "degC"),
               high = units::to_display(range.high, "K", "degC");
  return range.low == range.high ? fmt::format("{:.6g} degC", low)
                                 : fmt::format("{:.6g} to {:.6g} degC", low, high);
}

/// Stages as they come first, and how often each cycle comes round.
std::string stage_lines(const model::CaseSpec& spec) {
  std::string out;
  for (const model::StageRun& run : model::stage_runs(spec))
    if (run.cycle <= 1)
      out += fmt::format("\n  stage       {}: {:.6g} s to {:.6g} s in steps of {:.6g} s", run.stage->name,
                         run.start, run.end, model::first_step(*run.stage, spec.time));
  for (const model::CycleSpec& cycle : spec.cycles)
    out += fmt::format("\n  cycle       {}: {} times {}", cycle.name, cycle.repeat,
                       fmt::join(cycle.stages, ", "));
  return out;
}

}  // namespace

ExitCode check(const CaseArguments& arguments) {
  const model::Case c = load_case(arguments);
  const model::CaseSpec& spec = c.spec;
  const model::CheckedRun checked = model::check_run(c);
  const results::MeshCounts& counts = checked.mesh;

  std::string out = fmt::format("{}\n  analysis    {}, {}\n  mesh        {} nodes", spec.title,
                                text(spec.analysis.kind), text(spec.analysis.physics), counts.nodes);
  for (const auto& [shape, n] : counts.elements_of_shape) out += fmt::format(", {} {}", n, shape);
  for (std::size_t i = 0; i < spec.bodies.size(); ++i)
    out += fmt::format("\n  body        {}: {} at {}, {} elements{}{}", spec.bodies[i].name,
                       spec.bodies[i].material, text(checked.start[i]), counts.elements_of_body[i].second,
                       model::only_conducts(spec.bodies[i]) ? ", only conducts heat" : "",
                       spec.bodies[i].stages.empty()
                           ? ""
                           : fmt::format(", there in {}", fmt::join(spec.bodies[i].stages, ", ")));
  for (const auto& t : spec.thermal_conditions)
    out += fmt::format("\n  heat        {} on {}", t.name, t.group);
  for (const auto& m : spec.mechanical_conditions)
    out += fmt::format("\n  mechanics   {} on {}", m.name, m.group);
  for (const auto& k : spec.contacts)
    out += fmt::format("\n  contact     {}: {} on {}", k.name, k.sides()[0], k.sides()[1]);
  for (const model::CouplingEstimate& estimate : checked.couplings)
    out += "\n  coupling    " + model::text(estimate);
  out += stage_lines(spec);
  if (!spec.stages.empty())
    out += fmt::format("\n  time        {:.6g} s", *spec.time.end);
  else
    out += spec.time.steady ? "\n  time        steady"
                            : fmt::format("\n  time        {:.6g} s in steps of {:.6g} s", *spec.time.end,
                                          *spec.time.step);
  print(out + "\nThe case is in order.\n");
  return k_done;
}

}  // namespace solidus::app
