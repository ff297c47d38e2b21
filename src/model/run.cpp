#include "model/run.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "algebra/interruption.hpp"
#include "algebra/parallel.hpp"
#include "base/free_memory.hpp"
#include "base/log.hpp"
#include "base/profile.hpp"
#include "base/units.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/simulation.hpp"
#include "model/advice.hpp"
#include "model/assembly.hpp"
#include "model/audit_watch.hpp"
#include "model/bounds_watch.hpp"
#include "model/case_materials.hpp"
#include "model/cast_bodies.hpp"
#include "model/coupling_estimate.hpp"
#include "model/findings.hpp"
#include "model/fingerprint.hpp"
#include "model/mesh_input.hpp"
#include "model/overview.hpp"
#include "model/range_watch.hpp"
#include "model/run_input.hpp"
#include "model/scheme_input.hpp"
#include "model/stage_input.hpp"
#include "model/time_input.hpp"
#include "results/recorder.hpp"
#include "results/run_lock.hpp"

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

results::RecorderOptions recorder_options(const Case& c, const RunOptions& options, const Assembly& a) {
  const CaseSpec& spec = c.spec;
  results::RecorderOptions r;
  r.kind = spec.analysis.kind;
  r.probes = probes(spec);
  r.profiles = profiles(spec);
  r.fields = spec.output.fields;
  r.stages = !spec.stages.empty();
  r.steady = spec.time.steady;
  r.progress = options.progress;
  r.profile = options.profile;
  r.castings = cast_bodies(spec, a.materials, a.start);
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

RunResult run_steady(const CaseSpec& spec, Assembly& a, results::Recorder& recorder) {
  recorder.begin(a.initial);
  coupling::StepRecord record;
  coupling::State steady = a.initial;
  try {
    const double start = MPI_Wtime();
    const heat::PhaseReport report = a.heat->solve_steady(a.initial.heat, steady.heat, 0);
    record.heat = {report.newton.iterations, report.newton.linear_iterations,
                   report.newton.residuals.empty() ? 0.0 : report.newton.residuals.back(),
                   MPI_Wtime() - start};
    // Joules are those of one second.
    for (const heat::ConditionHeat& condition : report.balance.conditions)
      record.energy.heat_in += condition.heat;
    record.energy.entropy_in = report.balance.entropy_in;
    record.energy.heat_exchanged = report.balance.exchanged;
    coupling::commit_contact_heat(a.phases, steady.heat.temperature, report.balance.contributions,
                                  record.energy);
    coupling::summarise(a.phases, steady, record);
  } catch (const StepRejected& rejected) {
    const coupling::Stop stop{false, rejected.reason(), rejected.where(), 0, 0};
    recorder.stopped(stop, a.initial);
    return {false, stop_text(stop, spec, 0, {})};
  }
  record.number = 1;
  record.reason = "steady";
  record.output = true;
  recorder.step(record, steady);
  recorder.end(steady);
  return {};
}

RunResult run_transient(const CaseSpec& spec, const RunOptions& options, Assembly& a,
                        std::optional<results::Checkpoint> from, results::Recorder& recorder) {
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
  coupling::Simulation simulation(coupling_scheme(spec, a.phases), std::move(times), std::move(estimate));
  RangeWatch watch(spec, a);
  DissipationWatch dissipation;
  StabilityWatch stability(spec, a.coldest_start());
  FirstLawWatch first_law(spec, a.heat.get());
  WallWatch walls(a.phases.contacts);
  StopReason why;
  simulation.add(watch);
  std::optional<BoundsWatch> bounds;
  if (a.heat) simulation.add(bounds.emplace(spec, *a.heat));
  if (a.phases.coherency != nullptr) simulation.add(walls);
  LagWatch lag;
  if (lags_a_step(spec, a.phases.coherency != nullptr)) simulation.add(lag);
  simulation.add(dissipation);
  if (a.phases.audits_stability()) simulation.add(stability);
  if (spec.has_heat()) simulation.add(first_law);
  simulation.add(recorder);
  simulation.add(why);
  if (a.criteria) simulation.follow(*a.criteria);
  simulation.stop_when(options.stop_asked);
  simulation.at_stage([&](std::size_t stage, const coupling::StageStart& start, coupling::State* begins) {
    apply(spec, stage, start.displacement, begins, a);
  });
  // A state is large: the one at the start is not needed beside those of the run.
  coupling::State start = std::move(from ? from->state : a.initial);
  a.initial = {};
  const coupling::Outcome outcome = simulation.run(
      std::move(start),
      [&a](const coupling::State& state) { return a.heat ? a.heat->mean_solid_fraction(state.heat) : 1.0; },
      from ? std::optional(from->continuation) : std::nullopt);
  if (outcome == coupling::Outcome::finished) return {};
  std::vector<CouplingEstimate> couplings;
  if (spec.coupled() && spec.coupling.scheme->traits().needs_weak_coupling)
    couplings = coupling_estimates(spec, a.materials, a.mesh, a.start);
  return {false, stop_text(why.stop, spec, why.time,
                           results::CheckpointFolder(options.folder).latest().lexically_normal().string(),
                           couplings)};
}

// The checkpoint that a run is to go on from; nothing without --restart.
std::optional<results::Checkpoint> checkpoint(const CaseSpec& spec, const RunOptions& options, Assembly& a,
                                              const results::Fingerprint& fingerprint) {
  if (!options.restart) return {};
  const results::CheckpointFolder folder(options.folder);
  results::Checkpoint found = folder.read(a.mesh, fingerprint, a.initial);
  check_stage_of_checkpoint(spec, found.continuation.stage, found.state.time);
  // A run that was killed behind its last checkpoint has but its summary to write.
  const bool reached = found.state.time == *spec.time.end;
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

RunResult run_case(Case c, const RunOptions& options) {
  const double start = MPI_Wtime();
  check_restart(c.spec, options);
  Assembly a;
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

  results::RecorderOptions r = recorder_options(c, options, a);
  r.summary.overview = overview(c.spec, a, measures);
  r.fingerprint = fingerprint(c.spec, a.mesh, a.materials, a.initial.heat.temperature);
  const results::RunLock lock(options.folder);
  std::optional<results::Checkpoint> from = checkpoint(c.spec, options, a, r.fingerprint);
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
  const results::RunFolder folder(options.folder, c.toml(), options.restart, tables);
  r.summary.seconds.emplace_back("mesh", loaded - start);
  r.summary.seconds.emplace_back("set_up", MPI_Wtime() - loaded);
  results::Recorder recorder(folder, a.mesh, a.phases, std::move(r));
  part.reset();
  try {
    return c.spec.time.steady ? run_steady(c.spec, a, recorder)
                              : run_transient(c.spec, options, a, std::move(from), recorder);
  } catch (const algebra::Interrupted&) {  // outside of a step: there is no new state to keep
    return {false, "stopped as asked before the first step"};
  }
}

}  // namespace solidus::model
