#include "run/run.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "build/assembly.hpp"
#include "build/cast_bodies.hpp"
#include "build/fingerprint.hpp"
#include "build/heat_input.hpp"
#include "build/mechanics_input.hpp"
#include "build/mesh_input.hpp"
#include "build/run_input.hpp"
#include "build/scheme_input.hpp"
#include "build/time_input.hpp"
#include "case/case_keys.hpp"
#include "case/case_materials.hpp"
#include "case/overrides.hpp"
#include "case/stage_input.hpp"
#include "check/coupling_estimate.hpp"
#include "check/findings.hpp"
#include "check/overview.hpp"
#include "coupling/shot_map.hpp"
#include "coupling/simulation.hpp"
#include "coupling/steady.hpp"
#include "input/units.hpp"
#include "linear/interruption.hpp"
#include "parallel/parallel.hpp"
#include "results/recorder.hpp"
#include "results/run_lock.hpp"
#include "run/advice.hpp"
#include "run/audit_watch.hpp"
#include "run/bounds_watch.hpp"
#include "run/range_watch.hpp"
#include "system/free_memory.hpp"
#include "system/log.hpp"
#include "system/profile.hpp"

namespace solidus::model {

namespace {

// The second law for deformation: every law dissipates; warns once where one does not (2.113).
class DissipationWatch : public coupling::Observer {
 public:
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override {
    constexpr double k_rounding = 1e-9;
    if (warned_ || record.least_dissipation >= -k_rounding * record.largest_dissipation) return;
    logging::warn("t = {:g} s: deformation dissipates {:.3g} W/m3 somewhere; it must not be negative",
                  state.time, record.least_dissipation);
    warned_ = true;
  }
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

 private:
  bool warned_ = false;
};

// Remembers why a run stopped, for the caller.
class StopReason : public coupling::Observer {
 public:
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord&, const coupling::State&) override {}
  void stopped(const coupling::Stop& why, const coupling::State& state) override {
    stop = why;
    time = state.time;
  }
  void end(const coupling::State&) override {}
  coupling::Stop stop;
  double time = 0;
};

/// With the names of the bodies, which need not be those of their groups.
results::MeshCounts counts(const CaseSpec& spec, const mesh::Mesh& mesh) {
  results::MeshCounts counts = results::count(mesh);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) counts.elements_of_body[b].first = spec.bodies[b].name;
  return counts;
}

bool melts(const std::vector<material::Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const material::Material& m) { return m.solidification() != nullptr; });
}

bool has_shots(const Assembly& a) {
  return std::any_of(a.stages.begin(), a.stages.end(), [](const StageRun& s) { return s.shot > 0; });
}

results::RecorderOptions recorder_options(const Case& c, const RunOptions& options, const Assembly& a) {
  const CaseSpec& spec = c.spec;
  results::RecorderOptions r;
  r.kind = spec.analysis.kind;
  r.probes = probes(spec);
  r.profiles = profiles(spec);
  r.fields = spec.output.fields;
  r.vtkhdf = spec.output.vtkhdf;
  r.stages = !spec.stages.empty();
  r.shots = has_shots(a);
  r.steady = spec.time.steady;
  r.progress = options.progress;
  r.profile = options.profile;
  r.castings = cast_bodies(spec, a.materials, a.start);
  r.units = {spec.output.length_unit, spec.output.temperature_unit, spec.output.stress_unit};
  r.progress_options.end = spec.time.end.value_or(0);
  r.progress_options.heat = spec.has_heat();
  r.progress_options.mechanics = spec.has_mechanics();
  r.progress_options.contact = !spec.contacts.empty();
  r.progress_options.melting = r.melting = spec.has_heat() && melts(a.materials);
  r.progress_options.terminal = options.terminal;
  r.summary.case_file = c.file.string();
  r.summary.variant = results::default_run_folder(c.file).filename().string();
  r.summary.title = spec.title;
  r.summary.mesh = counts(spec, a.mesh);
  if (a.mechanics)
    for (std::size_t b = 0; b < a.mechanics->melt().size(); ++b)
      if (const material::MeltModulus& melt = a.mechanics->melt()[b]; melt.modulus > 0)
        r.summary.melt.push_back({spec.bodies[b].name, melt.modulus, material::measured_against(melt)});
  MPI_Comm_size(PETSC_COMM_WORLD, &r.summary.processes);
  return r;
}

/// @param recorder  null: nothing is written
/// @param steady    the state reached
RunResult run_steady(const CaseSpec& spec, Assembly& a, coupling::Observer* recorder, coupling::State& steady,
                     coupling::StepRecord& record) {
  if (recorder != nullptr) recorder->begin(a.initial);
  record = {};
  try {
    static_cast<coupling::StepEffort&>(record) = coupling::solve_steady(a.phases, a.initial, steady);
  } catch (const StepRejected& rejected) {
    const coupling::Stop stop{false, rejected.reason(), rejected.where(), 0, 0};
    if (recorder != nullptr) recorder->stopped(stop, a.initial);
    return {false, stop_text(stop, spec, 0, {})};
  }
  record.number = 1;
  record.reason = "steady";
  record.output = true;
  if (recorder == nullptr) return {};
  recorder->step(record, steady);
  recorder->end(steady);
  return {};
}

/// Null in a case without shots, or without heat. Before bodies leave.
std::unique_ptr<coupling::ShotMap> shot_map(const CaseSpec& spec, const Assembly& a) {
  if (!a.heat || !has_shots(a)) return nullptr;
  coupling::PeriodicOptions options;
  if (const CycleSpec* cycle = periodic_cycle(spec)) {
    options.tolerance = *cycle->periodic;
    options.accelerate = cycle->search == CycleSpec::Search::anderson;
  }
  return std::make_unique<coupling::ShotMap>(*a.heat, staying_bodies(spec), options);
}

/// What marches through time: the simulation with all that watches it. The parts refer to each other.
class Transient {
 public:
  /// @param recorder  null: nothing is written
  Transient(const CaseSpec& spec, const RunOptions& options, Assembly& a, coupling::Observer* recorder)
      : spec_(spec),
        options_(options),
        a_(a),
        simulation_(make_simulation(spec, a)),
        range_(spec, a),
        stability_(spec, a.coldest_start()),
        first_law_(spec, a.heat.get()),
        walls_(a.phases.contacts) {
    simulation_.add(range_);
    if (a.heat) simulation_.add(bounds_.emplace(spec, *a.heat));
    if (a.phases.coherency != nullptr) simulation_.add(walls_);
    if (lags_a_step(spec, a.phases.coherency != nullptr)) simulation_.add(lag_);
    simulation_.add(dissipation_);
    if (a.phases.audits_stability()) simulation_.add(stability_);
    if (spec.has_heat()) simulation_.add(first_law_);
    if (recorder != nullptr) simulation_.add(*recorder);
    simulation_.add(why_);
    if (a.criteria) simulation_.follow(*a.criteria);
    if (!a.initial.burning.lit.empty()) simulation_.follow_burning(*a.heat);
    simulation_.stop_when(options.stop_asked);
    simulation_.at_stage(
        [this](std::size_t stage, const coupling::StageStart& start, coupling::State* begins) {
          return apply(spec_, stage, start.displacement, begins, a_);
        });
    shots_ = shot_map(spec, a);
    if (shots_) simulation_.follow_shots(*shots_);
  }
  Transient(const Transient&) = delete;
  Transient& operator=(const Transient&) = delete;

  void begin(std::optional<results::Checkpoint> from) {
    // A state is large: the one at the start is not needed beside those of the run.
    coupling::State start = std::move(from ? from->state : a_.initial);
    a_.initial = {};
    simulation_.begin(
        std::move(start),
        [this](const coupling::State& state) {
          return a_.heat ? a_.heat->mean_solid_fraction(state.heat) : 1.0;
        },
        from ? std::optional(from->continuation) : std::nullopt);
  }

  /// What a step ended with; nothing while the run goes on.
  std::optional<RunResult> result(std::optional<coupling::Outcome> outcome) const {
    if (!outcome) return {};
    if (*outcome == coupling::Outcome::finished) return RunResult{};
    std::vector<CouplingEstimate> couplings;
    if (spec_.coupled() && spec_.coupling.scheme->traits().needs_weak_coupling)
      couplings = coupling_estimates(spec_, a_.materials, a_.mesh, a_.start);
    const std::string checkpoint =
        options_.folder.empty()
            ? ""
            : results::CheckpointFolder(options_.folder).latest().lexically_normal().string();
    return RunResult{false, stop_text(why_.stop, spec_, why_.time, checkpoint, couplings)};
  }

  /// Gives the phases the conditions that the case has now.
  void change_conditions() {
    const coupling::StageStart& start = simulation_.stage_start();
    if (!a_.stages.empty()) {
      apply(spec_, simulation_.stage(), start.displacement, nullptr, a_);
    } else {
      if (a_.mechanics) a_.mechanics->set_conditions(mechanical_conditions(spec_), start.displacement);
      if (a_.heat) a_.heat->set_conditions(thermal_conditions(spec_));
    }
    simulation_.conditions_changed();
  }

  coupling::Simulation& simulation() { return simulation_; }

 private:
  static coupling::Simulation make_simulation(const CaseSpec& spec, Assembly& a) {
    coupling::TimeOptions times = time_options(spec);
    std::optional<coupling::ErrorEstimate> estimate;
    if (spec.time.adaptive) {
      coupling::BodyNorm norm(a.mesh, spec.analysis.kind);
      const double error = displacement_error(spec.time, norm.diagonal());
      const auto limit = [&](coupling::StepLimits& limits) {
        limits.displacement = error;
        limits.inertia = spec.dynamics.has_value();
      };
      limit(times.step.limits);
      for (coupling::Stage& stage : times.stages) limit(stage.step.limits);
      using coupling::Displacement;
      estimate.emplace(std::move(norm), &a.phases,
                       spec.dynamics ? Displacement::motion : Displacement::distortion);
    }
    return coupling::Simulation(coupling_scheme(spec, a.phases), std::move(times), std::move(estimate));
  }

  const CaseSpec& spec_;
  const RunOptions& options_;
  Assembly& a_;
  coupling::Simulation simulation_;
  RangeWatch range_;
  std::optional<BoundsWatch> bounds_;
  DissipationWatch dissipation_;
  StabilityWatch stability_;
  FirstLawWatch first_law_;
  WallWatch walls_;
  LagWatch lag_;
  std::unique_ptr<coupling::ShotMap> shots_;
  StopReason why_;
};

// The checkpoint that a run is to go on from; nothing without --restart.
std::optional<results::Checkpoint> checkpoint(const CaseSpec& spec, const RunOptions& options, Assembly& a,
                                              const results::Fingerprint& fingerprint) {
  if (!options.restart) return {};
  const results::CheckpointFolder folder(options.folder);
  results::Checkpoint found = folder.read(a.mesh, fingerprint, a.initial);
  check_stage_of_checkpoint(spec, found.continuation.stage, found.state.time);
  const CycleSpec* cycle = periodic_cycle(spec);
  const StageRun* stage = found.continuation.stage.number > 0
                              ? &a.stages[static_cast<std::size_t>(found.continuation.stage.number) - 1]
                              : nullptr;
  const bool periodic = cycle != nullptr && stage != nullptr && stage->ends_shot &&
                        found.state.time == stage->end && found.continuation.shots.shots > 0 &&
                        found.continuation.shots.change <= *cycle->periodic;
  if (periodic && results::is_finished(options.folder))
    throw InputError(cycle->where,
                     fmt::format("the run has found its periodic state already, to {:.3g} K in shot {}",
                                 found.continuation.shots.change, found.state.shot),
                     "a smaller 'periodic' in the cycle");
  constexpr double k_solid = 1 - 1e-12;
  const bool solid = spec.time.until == TimeSpec::Until::solid && a.heat &&
                     a.heat->mean_solid_fraction(found.state.heat) >= k_solid;
  if (solid && results::is_finished(options.folder))
    throw InputError(
        spec.time.where,
        fmt::format("the run has ended at t = {:g} s: all that was poured is solid", found.state.time),
        "time.until = \"end\" to go on until time.end");
  // A run that was killed behind its last checkpoint has but its summary to write.
  const bool reached = found.state.time == *spec.time.end || periodic || solid;
  if (reached && !results::is_finished(options.folder)) {
    logging::info("the run has reached t = {:g} s already; its results are completed", found.state.time);
    return found;
  }
  if (found.state.time >= *spec.time.end)
    throw InputError(spec.time.where,
                     fmt::format("the run has reached t = {:g} s already; the end is at {:g} s",
                                 found.state.time, *spec.time.end),
                     spec.stages.empty() ? "a later end: time.end" : "further stages");
  return found;
}

// Reports errors that case and folder show before the mesh is read.
void check_restart(const CaseSpec& spec, const RunOptions& options) {
  if (!options.restart) return;
  if (spec.time.steady)
    throw InputError(spec.time.where, "a steady analysis has nothing to continue", "run without --restart");
  results::CheckpointFolder(options.folder).require();
}

}  // namespace

CheckedRun check_run(Case c) {
  Assembly a;
  a.materials = load_materials(c.spec);
  a.mesh = load_mesh(c.spec);
  build(c.spec, a);
  const CaseMeasures measures = measure(c.spec, a);
  report(findings(c.spec, a, measures));
  results::check_output(a.mesh, a.phases, recorder_options(c, {}, a));
  for (std::size_t i = 0; i < a.stages.size(); ++i)
    if (a.stages[i].cycle <= 1) apply(c.spec, i, {}, nullptr, a);
  CheckedRun checked{counts(c.spec, a.mesh), overview(c.spec, a, measures), {}};
  if (a.phases.audits_stability())
    checked.couplings = coupling_estimates(c.spec, a.materials, a.mesh, a.start);
  return checked;
}

/// The order is that of making; the later refer to the earlier.
struct Session::Parts {
  Case c;
  RunOptions options;
  Assembly a;
  std::optional<results::RunLock> lock;
  std::optional<results::RunFolder> folder;
  std::optional<results::Recorder> recorder;
  std::optional<results::Checkpoint> from;
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
    if (begun && simulation().pending()) simulation().commit_step();
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

Session::Session(Case given, RunOptions options) : parts_(std::make_unique<Parts>()) {
  const double start = MPI_Wtime();
  parts_->c = std::move(given);
  parts_->options = std::move(options);
  Case& c = parts_->c;
  const RunOptions& o = parts_->options;
  check_restart(c.spec, o);
  Assembly& a = parts_->a;
  std::optional<profile::Part> part;
  part.emplace("materials");
  a.materials = load_materials(c.spec);
  part.reset();
  a.mesh = load_mesh(c.spec);
  const double loaded = MPI_Wtime();
  part.emplace("set-up");
  build(c.spec, a);
  return_free_memory();
  part.emplace("findings");
  const CaseMeasures measures = measure(c.spec, a);
  report(findings(c.spec, a, measures));
  part.emplace("set-up");
  if (a.phases.audits_stability())
    announce_isothermal(c.spec, coupling_estimates(c.spec, a.materials, a.mesh, a.start));

  results::RecorderOptions r = recorder_options(c, o, a);
  if (o.folder.empty()) {
    if (!c.spec.time.steady) parts_->transient.emplace(c.spec, o, a, nullptr);
    return;
  }
  r.summary.overview = overview(c.spec, a, measures);
  r.fingerprint = fingerprint(c.spec, a.mesh, a.materials, a.initial.heat.temperature);
  parts_->lock.emplace(o.folder);
  std::optional<results::Checkpoint>& from = parts_->from;
  from = checkpoint(c.spec, o, a, r.fingerprint);
  if (from) {
    r.progress_options.start = from->state.time;
    // A state is large: of this one the recorder asks for the time.
    r.continue_from = {{}, from->continuation, from->energy, from->rejected, from->stability};
    r.continue_from->state.time = from->state.time;
  }
  for (const results::ChosenMelt& melt : r.summary.melt)
    logging::info(
        "body '{}': its melt has the modulus 2G = {:.3g} Pa in every step, {}; its viscosity is that times "
        "the step",
        melt.body, melt.modulus, melt.against);
  std::vector<std::string> tables;
  for (const ProfileSpec& profile : c.spec.profiles) tables.push_back(profile.name + ".csv");
  parts_->folder.emplace(o.folder, c.toml(), o.restart, tables);
  r.summary.seconds.emplace_back("mesh", loaded - start);
  r.summary.seconds.emplace_back("set_up", MPI_Wtime() - loaded);
  parts_->recorder.emplace(*parts_->folder, a.mesh, a.phases, std::move(r));
  if (!c.spec.time.steady) parts_->transient.emplace(c.spec, o, a, &*parts_->recorder);
}

Session::~Session() = default;

RunResult Session::run() {
  Parts& p = *parts_;
  if (p.ended) return *p.ended;
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
  if (!assignment.starts_with("thermal_condition.") && !assignment.starts_with("mechanical_condition."))
    throw InputError(where, "this key cannot change within a run",
                     "keys of conditions, for example thermal_condition.NAME.ambient=50 degC");
  if (!p.transient) throw InputError(where, "a steady analysis has no steps between which something changes");
  Value document = p.c.document;
  apply_override(document, assignment);
  CaseSpec spec;
  case_keys().assign(spec, document);
  resolve_stages(spec);
  check_case(spec);
  p.c.document = std::move(document);
  p.c.spec.thermal_conditions = std::move(spec.thermal_conditions);
  p.c.spec.mechanical_conditions = std::move(spec.mechanical_conditions);
  p.begin();  // with the conditions that the phases were built with
  p.changed = true;
}

bool Session::pending() const {
  return parts_->begun && parts_->simulation().pending();
}

const coupling::State& Session::state() const {
  if (parts_->steady) return *parts_->steady;
  return parts_->begun  ? parts_->simulation().state()
         : parts_->from ? parts_->from->state
                        : parts_->a.initial;
}

const coupling::StepRecord& Session::record() const {
  return parts_->begun ? parts_->simulation().record() : parts_->steady_record;
}

const Case& Session::running() const {
  return parts_->c;
}

const Assembly& Session::assembly() const {
  return parts_->a;
}

RunResult run_case(Case c, const RunOptions& options) {
  return Session(std::move(c), options).run();
}

}  // namespace solidus::model
