/// The verb `check`: everything but solving.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "cases/stage_input.hpp"
#include "run/session.hpp"

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

const char* text(cases::Physics physics) {
  switch (physics) {
    case cases::Physics::heat:
      return "heat";
    case cases::Physics::mechanics:
      return "mechanics";
    case cases::Physics::thermomechanical:
      return "heat and mechanics";
  }
  return "";
}

/// Stages as they come first, and how often each cycle comes round.
std::string stage_lines(const cases::CaseSpec& spec) {
  std::string out;
  for (const cases::StageRun& run : cases::stage_runs(spec))
    if (run.cycle <= 1)
      out += fmt::format("\n  stage       {}: {:.6g} s to {:.6g} s in steps of {:.6g} s", run.stage->name,
                         run.start, run.end, cases::first_step(*run.stage, spec.time));
  for (const cases::CycleSpec& cycle : spec.cycles)
    out += fmt::format(
        "\n  cycle       {}: {}{} times {}{}", cycle.name, cycle.periodic ? "at most " : "", cycle.repeat,
        fmt::join(cycle.stages, ", "),
        cycle.periodic
            ? fmt::format("; until the temperature of what stays is periodic to {:g} K", *cycle.periodic)
            : "");
  return out;
}

ExitCode check_case(const CaseArguments& arguments) {
  const setup::Case c = load_case(arguments);
  const cases::CaseSpec& spec = c.spec;
  // All that a run needs is built first; the overview is printed only if that went well.
  const run::CheckedRun checked = run::check_run(c);
  const results::MeshCounts& counts = checked.mesh;

  // Title, kind and mesh at the head.
  std::string out = fmt::format("{}\n  analysis    {}, {}\n  mesh        {} nodes", spec.title,
                                text(spec.analysis.kind), text(spec.analysis.physics), counts.nodes);
  for (const auto& [shape, n] : counts.elements_of_shape) out += fmt::format(", {} {}", n, shape);
  // The tables of bodies, skins and pours, then conditions of mechanics and coupling in one line
  // each.
  out += results::text(checked.overview);
  for (const auto& m : spec.mechanical_conditions)
    out += fmt::format("\n  mechanics   {} on {}", m.name, m.group);
  for (const check::CouplingEstimate& estimate : checked.couplings)
    out += "\n  coupling    " + check::text(estimate);
  out += stage_lines(spec);
  // At last the time, or the stages in place of it.
  if (!spec.stages.empty())
    out += fmt::format("\n  time        {:.6g} s", *spec.time.end);
  else
    out += spec.time.steady ? "\n  time        steady"
                            : fmt::format("\n  time        {:.6g} s in steps of {:.6g} s", *spec.time.end,
                                          *spec.time.step);
  print(out + "\nThe case is in order.\n");
  return k_done;
}

class Check final : public Verb {
 public:
  explicit Check(CLI::App& program) : Verb(program, "check", "Check a case: everything but solving") {
    add_case(command(), arguments_);
    add_physics(command(), arguments_);
    add_trust(command(), arguments_.trust_script);
    add_trust_laws(command());
  }
  ExitCode run() override { return check_case(arguments_); }

 private:
  CaseArguments arguments_;
};

}  // namespace

std::unique_ptr<Verb> check_verb(CLI::App& program) {
  return std::make_unique<Check>(program);
}

}  // namespace solidus::app
