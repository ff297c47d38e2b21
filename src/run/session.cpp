/// A run as a whole, or step by step.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "cases/case_keys.hpp"
#include "cases/case_materials.hpp"
#include "cases/overrides.hpp"
#include "cases/source_law.hpp"
#include "cases/stage_input.hpp"
#include "check/case_overview.hpp"
#include "check/findings.hpp"
#include "coupling/steady.hpp"
#include "linear/interruption.hpp"
#include "results/output/run_lock.hpp"
#include "run/advice.hpp"
#include "run/diagnose.hpp"
#include "run/recording.hpp"
#include "run/restart.hpp"
#include "run/sensitivities.hpp"
#include "run/session.hpp"
#include "run/transient.hpp"
#include "setup/fingerprint.hpp"
#include "setup/jet_input.hpp"
#include "setup/mesh_input.hpp"
#include "system/alike_texts.hpp"
#include "system/free_memory.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::run {

namespace {

/// @param recorder  null: nothing is written
/// @param steady    the state reached
RunResult run_steady(const cases::CaseSpec& spec, setup::Assembly& a, coupling::Observer* recorder,
                     coupling::State& steady, coupling::StepRecord& record) {
  // A steady state is one step without a length; what fails has no checkpoint.
  if (recorder != nullptr) recorder->begin(a.initial);
  record = {};
  try {
    static_cast<coupling::StepEffort&>(record) = coupling::solve_steady(a.phases, a.initial, steady);
  } catch (const StepRejected& rejected) {
    const coupling::Stop stop{false,
                              rejected.reason(),
                              rejected.where(),
                              0,
                              0,
                              rejected.failure(),
                              diagnose(spec, a, {}, a.initial, rejected, 0)};
    if (recorder != nullptr) recorder->stopped(stop, a.initial);
    return {false, stop_text(stop, spec, 0, {})};
  }
  // It is written as a step, so that the same files exist as for a transient run.
  record.number = 1;
  record.reason = "steady";
  record.output = true;
  if (recorder == nullptr) return {};
  recorder->step(record, steady);
  recorder->end(steady);
  return {};
}

}  // namespace

/// The order is that of making; the later refer to the earlier.
struct Session::Parts {
  setup::Case c;
  RunOptions options;
  setup::Assembly a;
  std::optional<results::RunLock> lock;
  std::optional<results::RunFolder> folder;
  std::optional<results::Recorder> recorder;
  std::optional<results::Checkpoint> from;
  std::optional<Sensitivities> sensitivities;
  std::optional<Transient> transient;
  std::optional<coupling::State> steady;  ///< the state that a steady case has reached
  coupling::StepRecord steady_record;
  std::optional<RunResult> ended;
  bool changed = false;  ///< the case has other conditions than the phases
  bool begun = false;

  void begin() {
    if (begun) return;
    begun = true;
    transient->begin(std::move(from));
    from.reset();
  }
  coupling::Simulation& simulation() { return transient->simulation(); }
  void commit() {
    if (begun && simulation().present().pending) simulation().commit_step();
  }
  /// The next step, after changes of conditions and with the size that is wanted.
  std::optional<RunResult> take(std::optional<double> step) {
    if (std::exchange(changed, false)) transient->change_conditions();
    if (step) simulation().ask_step(*step);
    ended = transient->result(simulation().take_step());
    return ended;
  }
};

namespace {

void check_step(std::optional<double> step) {
  if (step && !(*step > 0 && std::isfinite(*step)))
    throw InputError({}, fmt::format("a step of {:g} s", *step), "a step above zero");
}

}  // namespace

Session::Session(setup::Case given, RunOptions options) : parts_(std::make_unique<Parts>()) {
  const double start = processes::wall_time();
  parts_->c = std::move(given);
  parts_->options = std::move(options);
  setup::Case& c = parts_->c;
  const RunOptions& o = parts_->options;
  // In the order of the data: materials, mesh, phases, and then findings, since these need all of it.
  if (c.spec.filling && !c.spec.filling->result)
    throw InputError(c.spec.filling->where, "the mould has not been filled yet",
                     "`solidus run`, which fills it first, or filling.result of `solidus fill`");
  check_restart(c.spec, o);
  setup::Assembly& a = parts_->a;
  std::optional<profile::Part> part;
  part.emplace("materials");
  a.materials = cases::load_materials(c.spec);
  part.reset();
  const double made_in = o.mesh != nullptr ? o.mesh->seconds : 0;
  a.mesh = setup::load_mesh(c.spec, o.mesh.get());
  const double loaded = processes::wall_time();
  part.emplace("set-up");
  setup::build(c.spec, a);
  return_free_memory();
  part.emplace("findings");
  const check::CaseMeasures measures = check::measure(c.spec, a);
  check::report(check::findings(c.spec, a, measures));
  if (a.criteria != nullptr) a.criteria->know_plates(measures.plates());
  setup::require_sound_mesh(c.spec);
  part.emplace("set-up");
  if (a.phases.audits_stability())
    check::announce_isothermal(c.spec, check::coupling_estimates(c.spec, a.materials, a.mesh, a.start));

  // Without a folder nothing is recorded.
  results::RecorderOptions r = recorder_options(c, o, a);
  if (o.folder.empty()) {
    if (!c.spec.time.steady) parts_->transient.emplace(c.spec, o, a, nullptr);
    return;
  }
  // A mistake in what is to be written shows before results that the folder holds are removed.
  results::check_output(a.mesh, a.phases, r);
  // With a folder: everything that a restart has to agree with is fingerprinted, and the folder is
  // locked against a second run.
  r.summary.overview = check::overview(c.spec, a, measures);
  r.fingerprint = setup::fingerprint(c.spec, a.mesh, a.materials, a.initial.heat.temperature);
  parts_->lock.emplace(o.folder);
  std::optional<results::Checkpoint>& from = parts_->from;
  // From a checkpoint time, energies and counters go on.
  from = checkpoint(c.spec, o, a, r.fingerprint);
  if (from) {
    r.progress_options.start = from->state.time;
    // A state is large: of this one the recorder asks for the time.
    r.continue_from = {
        {}, from->continuation, from->energy, from->rejected, from->shortened, from->stability};
    r.continue_from->state.time = from->state.time;
  }
  // What the program has chosen for melts is told once.
  std::vector<std::string> melts;
  for (const results::ChosenMelt& melt : r.summary.melt)
    melts.push_back(
        fmt::format("body '{}': its melt has a viscosity of {:.3g} Pa s: {:.3g} Pa, {}, times {:.3g} s, a "
                    "hundredth of the time "
                    "in which heat crosses its section",
                    melt.body, melt.modulus * melt.time, melt.modulus, melt.against, melt.time));
  for (const std::string& text : logging::told_once(melts)) logging::info("{}", text);
  std::vector<std::string> tables;
  for (const cases::ProfileSpec& profile : c.spec.profiles) tables.push_back(profile.name + ".csv");
  // The folder gets the resolved case at once, so that a run that dies can be understood.
  parts_->folder.emplace(o.folder, c.toml(), o.restart, tables);
  r.summary.seconds.emplace_back("mesh", made_in + loaded - start);
  r.summary.seconds.emplace_back("set_up", processes::wall_time() - loaded);
  parts_->recorder.emplace(*parts_->folder, a.mesh, a.phases, std::move(r));
  if (!parts_->options.neighbours.empty())
    parts_->sensitivities.emplace(c, a, std::exchange(parts_->options.neighbours, {}),
                                  parts_->folder->sensitivities());
  if (!c.spec.time.steady) parts_->transient.emplace(c.spec, o, a, &*parts_->recorder);
  if (parts_->sensitivities) parts_->transient->simulation().add(*parts_->sensitivities);
}

Session::~Session() = default;

RunResult Session::run() {
  Parts& p = *parts_;
  if (p.ended) return *p.ended;
  // An interruption outside a step has nothing to save.
  try {
    if (p.c.spec.time.steady) {
      coupling::Observer* recorder = p.recorder ? &*p.recorder : nullptr;
      p.ended = run_steady(p.c.spec, p.a, recorder, p.steady.emplace(p.a.initial), p.steady_record);
      return *p.ended;
    }
    p.begin();
    p.commit();
    while (!p.take({})) p.simulation().commit_step();
    return *p.ended;
  } catch (const linear::Interrupted&) {  // outside of a step: there is no new state to keep
    return {false, "stopped as asked before the first step"};
  }
}

std::optional<RunResult> Session::advance(std::optional<double> step) {
  Parts& p = *parts_;
  if (!p.transient)
    throw InputError(p.c.spec.time.where, "a steady analysis has no steps", "run() computes it at once");
  check_step(step);
  if (p.ended) return p.ended;
  p.begin();
  p.commit();
  return p.take(step);
}

std::optional<RunResult> Session::repeat(std::optional<double> step) {
  Parts& p = *parts_;
  if (!pending()) throw InputError({}, "there is no step to repeat", "repeat() behind advance()");
  check_step(step);
  p.simulation().discard_step(step);
  return p.take({});
}

void Session::commit() {
  parts_->commit();
}

void Session::change(const std::string& assignment) {
  Parts& p = *parts_;
  const SourceLocation where{"--set " + assignment, 0, 0};
  // Only conditions may change: a mesh, a material or a scheme would need everything built again.
  if (!assignment.starts_with("thermal_condition.") && !assignment.starts_with("mechanical_condition."))
    throw InputError(where, "this key cannot change within a run",
                     "keys of conditions, for example thermal_condition.NAME.ambient=50 degC");
  if (!p.transient) throw InputError(where, "a steady analysis has no steps between which something changes");
  // The whole case is read and checked again with the change, as its first reading was; only conditions are
  // taken over.
  Value document = p.c.document;
  cases::apply_override(document, assignment);
  cases::CaseSpec spec;
  cases::case_keys().assign(spec, document);
  cases::resolve_stages(spec);
  setup::add_jets(spec);
  cases::set_powers(spec);
  setup::check_case(spec);
  cases::vary_conditions(spec);
  p.c.document = std::move(document);
  p.c.spec.thermal_conditions = std::move(spec.thermal_conditions);
  p.c.spec.mechanical_conditions = std::move(spec.mechanical_conditions);
  p.begin();  // with the conditions that the phases were built with
  p.changed = true;
}

bool Session::pending() const {
  return parts_->begun && parts_->simulation().present().pending;
}

const coupling::State& Session::state() const {
  if (parts_->steady) return *parts_->steady;
  return parts_->begun  ? parts_->simulation().present().state
         : parts_->from ? parts_->from->state
                        : parts_->a.initial;
}

const coupling::StepRecord& Session::record() const {
  return parts_->begun ? parts_->simulation().present().record : parts_->steady_record;
}

Session::Made Session::made() const {
  return {parts_->c, parts_->a};
}

const results::Summary* Session::summary() const {
  return parts_->recorder ? &parts_->recorder->summary() : nullptr;
}

RunResult run_case(setup::Case c, const RunOptions& options) {
  return Session(std::move(c), options).run();
}

}  // namespace solidus::run
