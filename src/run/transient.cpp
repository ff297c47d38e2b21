/// The simulation and its watches are made in the order in which they report.
#include "run/transient.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "cases/case_materials.hpp"
#include "cases/stage_input.hpp"
#include "check/coupling_estimate.hpp"
#include "coupling/internal_energy.hpp"
#include "criteria/moved_metal.hpp"
#include "numbers/index_casts.hpp"
#include "run/advice.hpp"
#include "run/diagnose.hpp"
#include "run/recording.hpp"
#include "setup/cast_bodies.hpp"
#include "setup/event_input.hpp"
#include "setup/heat_input.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/scheme_input.hpp"
#include "setup/time_input.hpp"

namespace solidus::run {

namespace {

/// Null in a case without shots, or without heat. Before bodies leave.
std::unique_ptr<coupling::ShotMap> shot_map(const cases::CaseSpec& spec, const setup::Assembly& a) {
  if (!a.heat || !has_shots(a)) return nullptr;
  coupling::PeriodicOptions options;
  if (const cases::CycleSpec* cycle = cases::periodic_cycle(spec)) {
    options.tolerance = *cycle->periodic;
    options.accelerate = cycle->search == cases::CycleSpec::Search::anderson;
  }
  return std::make_unique<coupling::ShotMap>(*a.heat, cases::staying_bodies(spec), options);
}

/// Whether a cast body expands while it freezes. Graphite that precipitates presses melt out of the mush to
/// the very end, which moves what is next to it by half of the whole distortion (decision 0090).
bool expands_as_it_freezes(const std::vector<results::CastBody>& cast,
                           const std::vector<material::Material>& materials) {
  return std::any_of(cast.begin(), cast.end(), [&](const results::CastBody& body) {
    const auto& changes = materials[as_size(body.body)].phase_changes;
    return std::any_of(changes.begin(), changes.end(), [](const material::PhaseChange& change) {
      return change.graphite || (change.solidification && change.volume_change > 0);
    });
  });
}

/// What steps are down to while the last melt freezes, as a share of the time since it was poured.
double last_melt_share(bool expands) {
  return expands ? 0.004 : 0.01;
}

/// The change of the solid fraction in a step of a casting that deforms. What freezes at one temperature
/// contracts, and the error of the temperature does not tell of it: only so much of it may freeze in a step.
double solid_fraction_of_step(const std::vector<results::CastBody>& cast,
                              const std::vector<material::Material>& materials, bool expands) {
  constexpr double k_at_one_temperature = 0.013, k_where_it_expands = 0.016, k_most = 0.1;
  if (expands) return k_where_it_expands;
  double largest = 0;
  for (const results::CastBody& body : cast)
    for (const material::PhaseChange& change : materials[as_size(body.body)].phase_changes)
      if (change.solidification) largest = std::max(largest, change.fraction.isothermal_share());
  return largest * k_most > k_at_one_temperature ? k_at_one_temperature / largest : k_most;
}

coupling::Simulation make_simulation(const cases::CaseSpec& spec, setup::Assembly& a) {
  coupling::TimeOptions times = setup::time_options(spec);
  times.events = [&spec, &a, step = times.step.step, end = times.end](std::size_t stage) {
    if (a.stages.empty()) return setup::time_events(spec, nullptr, 0, end, step);
    const cases::StageRun& run = a.stages[stage];
    return setup::time_events(spec, &run, run.start, run.end, cases::first_step(*run.stage, spec.time));
  };
  // A steady analysis has no error of time to estimate; others limit the displacement error of each step, of
  // the stages too.
  std::optional<coupling::ErrorEstimate> estimate;
  if (!spec.time.steady) {
    coupling::BodyNorm norm(a.mesh, spec.analysis.kind);
    const std::vector<double> sections = setup::sections_of(spec, a.mesh);
    const double error = setup::displacement_error(spec.time, sections);
    const std::vector<results::CastBody> cast = setup::cast_bodies(spec, a.materials, a.start);
    const bool expands = expands_as_it_freezes(cast, a.materials);
    const auto limit = [&](coupling::StepLimits& limits) {
      limits.displacement = error;
      limits.skin = setup::skin_change(spec.time, sections);
      limits.solid_fraction = setup::solid_fraction_change(
          spec.time, sections, solid_fraction_of_step(cast, a.materials, expands));
      limits.inertia = spec.dynamics.has_value();
      limits.last_melt = spec.has_mechanics() && !cast.empty() ? last_melt_share(expands) : 0;
      // A gap is between two displacements.
      if (spec.has_mechanics()) limits.opening = 2 * error;
    };
    limit(times.step.limits);
    for (coupling::Stage& stage : times.stages) limit(stage.step.limits);
    using coupling::Displacement;
    estimate.emplace(std::move(norm), &a.phases,
                     spec.dynamics ? Displacement::motion : Displacement::distortion);
  }
  return coupling::Simulation(
      setup::coupling_scheme(spec, a.phases, setup::keeps_strain(spec, a.materials, a.start)),
      std::move(times), std::move(estimate));
}

/// The work of the stresses of the ends of steps becomes heat in the energy form. The other forms lose what
/// it is too large by, which the first law says (energy_defect).
bool heats_by_end_stresses(const cases::CaseSpec& spec) {
  return spec.exchanges_heat() && setup::structural_form(spec) == mechanics::StructuralForm::energy;
}

}  // namespace

Transient::Watches::Watches(const cases::CaseSpec& spec, setup::Assembly& a)
    : range(spec, a),
      stability(spec, a.coldest_start()),
      first_law(spec, a.heat.get()),
      walls(a.phases.contacts),
      lag(setup::keeps_strain(spec, a.materials, a.start)),
      friction_lag(a.phases.contacts,
                   setup::may_map_slip_again(spec, setup::keeps_strain(spec, a.materials, a.start)),
                   setup::slips_after_heat(spec, setup::keeps_strain(spec, a.materials, a.start))),
      gaps(a.phases.contacts),
      channels(spec) {}

Transient::Transient(const cases::CaseSpec& spec, const RunOptions& options, setup::Assembly& a,
                     coupling::Observer* recorder)
    : spec_(spec), options_(options), a_(a), simulation_(make_simulation(spec, a)), watches_(spec, a) {
  // Observers see each step in the order in which they are added. The recorder comes after those that watch
  // the run, so that what they find in a step precedes what it writes of it.
  simulation_.add(watches_.range);
  if (a.heat) simulation_.add(watches_.bounds.emplace(spec, *a.heat));
  if (a.phases.coherency != nullptr) {
    simulation_.add(watches_.walls);
    simulation_.add(watches_.melts.emplace(spec, a));
  }
  if (setup::lags_a_step(spec, setup::keeps_strain(spec, a.materials, a.start)))
    simulation_.add(watches_.lag);
  simulation_.add(watches_.friction_lag);
  if (heats_by_end_stresses(spec)) simulation_.add(watches_.stress_work);
  simulation_.add(watches_.gaps);
  if (chooses_shortest_step_of_growth(spec)) simulation_.add(watches_.growth_steps.emplace(spec, a));
  if (!spec.channels.empty()) simulation_.add(watches_.channels);
  simulation_.add(watches_.dissipation);
  if (a.phases.audits_stability()) simulation_.add(watches_.stability);
  if (spec.has_heat()) simulation_.add(watches_.first_law);
  if (recorder != nullptr) simulation_.add(*recorder);
  simulation_.add(why_);
  coupling::Followers& goes_along = simulation_.followers();
  // Criteria, loads and burning are followed by the simulation itself, since their state belongs to it.
  if (a.criteria) goes_along.criteria = a.criteria.get();
  if (a.heat) goes_along.loads = a.heat.get();
  if (a.growth) goes_along.growth = a.growth.get();
  if (!a.initial.burning.lit.empty()) goes_along.burning = a.heat.get();
  if (a.heat && a.criteria && spec.feeding.moves_heat)
    goes_along.moves_heat = [&a, moves = setup::followed_bodies(spec, a.materials, a.start)](
                                coupling::State& state, bool has_moved) {
      const criteria::NodalMetal metal = criteria::metal_at_nodes(state.criteria);
      if (metal.held.empty()) return;
      const std::span<const double> owned = std::span(metal.held).first(as_size(a.mesh.n_owned_nodes));
      a.heat->move_metal({moves, owned, metal.filled}, has_moved ? nullptr : &state.heat);
    };
  goes_along.stop_asked = options.stop_asked;
  // Failures are explained by diagnose(), stages are set up by apply(): both need the case, which the
  // simulation does not know.
  goes_along.diagnose = [this](const coupling::State& last, const StepRejected& rejected, double dt) {
    return diagnose(spec_, a_, watches_.melts ? watches_.melts->ran_out() : std::string(), last, rejected,
                    dt);
  };
  goes_along.stage_begins = [this](std::size_t stage, const coupling::StageStart& start,
                                   coupling::State* begins) {
    return setup::apply(spec_, stage, start.displacement, begins, a_);
  };
  if (coupling::has_internal_energy(a.phases, true))
    goes_along.internal_energy = [this](const coupling::State& state) {
      return coupling::internal_energy(a_.phases, state);
    };
  shots_ = shot_map(spec, a);
  if (shots_) goes_along.shots = &*shots_;
}

void Transient::begin(std::optional<results::Checkpoint> from) {
  // A state is large: the one at the start is not needed in addition to those of the run.
  coupling::State start = std::move(from ? from->state : a_.initial);
  a_.initial = {};
  simulation_.begin(
      std::move(start),
      [this](const coupling::State& state) {
        return a_.heat ? a_.heat->states().mean_solid_fraction(state.heat) : 1.0;
      },
      from ? std::optional(from->continuation) : std::nullopt);
}

std::optional<RunResult> Transient::result(std::optional<coupling::Outcome> outcome) const {
  if (!outcome) return {};
  if (*outcome == coupling::Outcome::finished) return RunResult{};
  std::vector<check::CouplingEstimate> couplings;
  if (spec_.coupled() && spec_.coupling.scheme->traits().needs_weak_coupling)
    couplings = check::coupling_estimates(spec_, a_.materials, a_.mesh, a_.start);
  const std::string checkpoint =
      options_.folder.empty()
          ? ""
          : results::CheckpointFolder(options_.folder).latest().lexically_normal().string();
  return RunResult{false, stop_text(why_.stop, spec_, why_.time, checkpoint, couplings)};
}

void Transient::change_conditions() {
  const coupling::StageStart& start = simulation_.present().stage_start;
  if (!a_.stages.empty()) {
    setup::apply(spec_, simulation_.present().stage, start.displacement, nullptr, a_);
  } else {
    if (a_.mechanics) a_.mechanics->set_conditions(setup::mechanical_conditions(spec_), start.displacement);
    if (a_.heat) a_.heat->set_conditions(setup::thermal_conditions(spec_));
  }
  simulation_.conditions_changed();
}

}  // namespace solidus::run
