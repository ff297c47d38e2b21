/// At each step: columns, fields if they are due, the progress; at the end the answers and the summary.
#include "results/recorder.hpp"

#include <algorithm>
#include <type_traits>

#include "coupling/all_fields.hpp"
#include "coupling/columns.hpp"
#include "coupling/energy_scale.hpp"
#include "coupling/internal_energy.hpp"
#include "criteria/quantities.hpp"
#include "heat/thermal_parts.hpp"
#include "results/answers/stress_jump.hpp"
#include "results/output/output_error.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::results {

namespace columns = coupling::columns;

namespace {

bool dynamic(const coupling::Phases& phases) {
  return phases.mechanics != nullptr && phases.mechanics->bodies().inertia != nullptr;
}

bool follows_internal_energy(const coupling::Phases& phases, const RecorderOptions& options) {
  return coupling::has_internal_energy(phases, !options.stages.empty());
}

GlobalHistory::Options global_columns(const coupling::Phases& phases, const RecorderOptions& options) {
  GlobalHistory::Options columns{.melting = phases.heat != nullptr && options.melting,
                                 .contact = !phases.contacts.empty(),
                                 .mechanics = phases.mechanics != nullptr,
                                 .plastic = phases.mechanics != nullptr && phases.mechanics->bodies().plastic,
                                 .dynamics = dynamic(phases),
                                 .stability = phases.audits_stability(),
                                 .heat = phases.heat != nullptr,
                                 .internal_energy = follows_internal_energy(phases, options),
                                 .grows = phases.growth != nullptr,
                                 .bodies = options.shots || phases.growth != nullptr};
  columns.sources = options.sources;
  columns.channels = options.channels;
  // Columns of each pair as far as it has friction and heat.
  if (phases.mechanics != nullptr)
    for (const contact::ContactPair* pair : phases.contacts)
      columns.pairs.push_back({pair->parts().spec.name, pair->parts().spec.friction.has_value(),
                               phases.heat != nullptr && pair->parts().spec.heat.has_value(), options.kind});
  return columns;
}

std::vector<Reading> with_stage(std::vector<Reading> readings, int stage, int cycle) {
  readings.insert(readings.begin(), {{csv_column(columns::k_stage), static_cast<double>(stage)},
                                     {csv_column(columns::k_cycle), static_cast<double>(cycle)}});
  return readings;
}

std::vector<Reading> with_shot(std::vector<Reading> readings, int shot, double since_pouring) {
  readings.insert(readings.begin(), {{csv_column(columns::k_shot), static_cast<double>(shot)},
                                     {csv_column(columns::k_since_pouring), since_pouring}});
  return readings;
}

// The columns of history.csv besides time and probes, all with the value zero: what probes may repeat.
std::vector<Reading> global_readings(const coupling::Phases& phases, const RecorderOptions& options) {
  std::vector<Reading> readings = GlobalHistory(global_columns(phases, options)).all();
  if (options.shots) readings = with_shot(std::move(readings), 0, 0);
  return options.stages.empty() ? readings : with_stage(std::move(readings), 0, 0);
}

// A probe that samples a field of a criterion.
bool samples_criteria(const Probe& probe, const std::vector<const quantities::Quantity*>& fields) {
  return std::visit(
      [&](const auto& p) {
        if constexpr (std::is_base_of_v<Sampled, std::decay_t<decltype(p)>>)
          return std::any_of(fields.begin(), fields.end(), [&](const auto& f) { return f->name == p.field; });
        else
          return false;
      },
      probe);
}

/// Whether a criterion of the run shows a field.
bool follows(const coupling::Phases& phases, const quantities::Quantity& field) {
  return phases.criteria != nullptr && std::ranges::count(criteria::fields_of(*phases.criteria), &field) > 0;
}

bool samples_criteria(const coupling::Phases& phases, const std::vector<Probe>& probes) {
  if (phases.criteria == nullptr) return false;
  const std::vector<const quantities::Quantity*> fields = criteria::fields_of(*phases.criteria);
  return std::any_of(probes.begin(), probes.end(),
                     [&](const Probe& p) { return samples_criteria(p, fields); });
}

}  // namespace

void check_output(const mesh::Mesh& mesh, const coupling::Phases& phases, const RecorderOptions& options) {
  const StateFields fields(mesh, phases, options.kind);
  const Probes probes(mesh, options.kind, options.probes, fields.bodies(), global_readings(phases, options));
  for (const Profile& profile : options.profiles)
    const ProfileTable table(mesh, options.kind, profile, fields.bodies());
  fields.bodies().select(options.fields);
}

Recorder::Recorder(const RunFolder& folder, const mesh::Mesh& mesh, const coupling::Phases& phases,
                   RecorderOptions options)
    : folder_(folder),
      mesh_(mesh),
      phases_(phases),
      options_(std::move(options)),
      rank_(processes::rank()),
      fields_(mesh, phases, options_.kind),
      probes_(mesh, options_.kind, options_.probes, fields_.bodies(), global_readings(phases, options_)),
      globals_(global_columns(phases, options_), probes_.columns()),
      output_(folder, mesh, options_.formats,
              options_.continue_from ? std::optional(options_.continue_from->state.time) : std::nullopt),
      checkpoints_(folder.root()),
      criteria_probed_(samples_criteria(phases, options_.probes)) {
  seconds_.began = processes::wall_time();
  // Profiles and fields are made on every process; a field that does not exist is complained about before the
  // run begins.
  for (const Profile& profile : options_.profiles)
    tables_.profiles.emplace_back(mesh, options_.kind, profile, fields_.bodies());
  fields_.bodies().select(options_.fields);  // complains about a field there is not
  // Tables are written by the first process alone. A run that continues keeps the rows up to its checkpoint.
  on_first_process([&] {
    // Columns of the history: time, stage and shot, probes, then the sums over the whole case.
    std::vector<CsvColumn> head{csv_column(columns::k_time)};
    const auto add = [&](const quantities::Column& column) { head.push_back(csv_column(column)); };
    if (!options_.stages.empty()) add(columns::k_stage), add(columns::k_cycle);
    if (options_.shots) add(columns::k_shot), add(columns::k_since_pouring);
    head.insert(head.end(), probes_.columns().begin(), probes_.columns().end());
    for (const CsvColumn& c : globals_.columns()) head.push_back(c);
    if (options_.continue_from) {
      const double time = options_.continue_from->state.time;
      tables_.history.emplace(folder.history(), head, time);
      tables_.steps.emplace(folder.steps(), step_columns(step_table()), time);
    } else {
      tables_.history.emplace(folder.history(), head);
      tables_.steps.emplace(folder.steps(), step_columns(step_table()));
    }
    // Tables of pools, feeding and shots exist only where the run has something to put into them.
    if (phases.criteria != nullptr && phases.heat != nullptr && options_.melting)
      tables_.pools.emplace(folder.pools(), options_.continue_from
                                                ? std::optional(options_.continue_from->state.time)
                                                : std::nullopt);
    if (follows(phases, criteria::fields::k_emptied))
      tables_.feeding.emplace(folder.feeding(), options_.continue_from
                                                    ? std::optional(options_.continue_from->state.time)
                                                    : std::nullopt);
    if (options_.shots && phases.heat != nullptr)
      tables_.shots.emplace(folder.shots(), options_.continue_from
                                                ? std::optional(options_.continue_from->state.time)
                                                : std::nullopt);
    if (!options_.stages.empty())
      tables_.stages.emplace(folder.stages(), options_.continue_from
                                                  ? std::optional(options_.continue_from->state.time)
                                                  : std::nullopt);
    if (options_.progress != nullptr) progress_.emplace(*options_.progress, options_.progress_options);
  });
}

std::vector<Reading> Recorder::readings() const {
  std::vector<Reading> readings = globals_.all();
  if (options_.shots) readings = with_shot(std::move(readings), last_.shot, last_.since_pouring);
  return options_.stages.empty() ? readings : with_stage(std::move(readings), last_.stage, last_.cycle);
}

double Recorder::heat_of_bodies(const coupling::State& state) const {
  return (options_.shots || phases_.growth != nullptr) && phases_.heat != nullptr
             ? phases_.heat->states().heat_content(state.heat)
             : 0.0;
}

StepTable Recorder::step_table() const {
  return {.dynamics = dynamic(phases_),
          .stability = phases_.audits_stability(),
          .stages = !options_.stages.empty(),
          .heat = phases_.heat != nullptr};
}

void Recorder::begin(const coupling::State& state) {
  const profile::Part part("output");
  // The state at the start is summarised as a step would be, so that the tables have a row of it.
  coupling::StepEffort initial;
  coupling::summarise(phases_, state, initial);
  measure_internal_energy(initial, state);
  show_castings(initial, state);
  const double heat_content =
      phases_.heat != nullptr ? coupling::heat_content(*phases_.heat, state.heat) : 0.0;
  if (progress_) progress_->begin(heat_content);
  fields_.update(state);
  if (options_.continue_from) {
    // Rows and fields of this state were written before; stresses follow with the first step.
    globals_.start(initial, options_.continue_from->energy, options_.continue_from->stability, heat_content,
                   heat_of_bodies(state));
    options_.summary.steps = options_.continue_from->continuation.steps;
    options_.summary.rejected = options_.continue_from->rejected;
    options_.summary.shortened = options_.continue_from->shortened;
    last_.row = history_row(state);
    // Stresses follow with the first step: a run that stops before it ends with the row that it has.
    on_first_process([&] {
      const std::vector<double> row = last_row(folder_.history());
      if (row.size() == last_.row.size()) last_.row = row;
    });
    return;
  }
  // A fresh run starts its balance here.
  coupling::EnergyAudit none;
  none.internal_at_start = initial.internal_energy;
  if (phases_.growth != nullptr) globals_.deposited(phases_.growth->mass());
  globals_.start(initial, none, {}, heat_content, heat_of_bodies(state));
  if (criteria_probed_) fields_.update_criteria(state);
  add_history_row(state);
  add_pools(state);
  if (!options_.steady) write_fields(state);
}

void Recorder::step(const coupling::StepRecord& taken, const coupling::State& state) {
  const profile::Part part("output");
  const double start = processes::wall_time();
  // A copy of the record, since what is measured here is added to it.
  coupling::StepRecord record = taken;
  // What belongs to the step itself first, then histories and tables, fields where the step asks for them,
  // and the times that all this took.
  show_castings(record, state);
  measure_internal_energy(record, state);
  if (phases_.growth != nullptr) globals_.deposited(phases_.growth->mass());
  globals_.add(record, heat_of_bodies(state));
  last_.stage = record.stage_of_case;
  last_.cycle = record.cycle;
  fields_.update(state);
  if (!options_.castings.empty()) last_.step.step(fields_.bodies());
  if (criteria_probed_) fields_.update_criteria(state);
  on_first_process([&] { tables_.steps->add(step_row(record, step_table())); });
  add_history_row(state);
  add_pools(state);
  // Fields are written where the step asks for them, after everything else is up to date.
  if (record.output) write_fields(state);
  if (std::ranges::binary_search(options_.stage_ends, record.time)) add_stage(record, state);
  if (record.temperature_error > last_.largest_error[0])
    last_.largest_error = {record.temperature_error, record.time};
  if (progress_) progress_->step(record);
  // Times of the two phases and of the output, for the profile at the end.
  seconds_.heat += record.heat.seconds;
  seconds_.mechanics += record.mechanics.seconds;
  seconds_.output += processes::wall_time() - start;
  options_.summary.steps = record.number;
  options_.summary.rejected += record.rejected;
  options_.summary.shortened += record.shortened;
  note_left_walls(record);
  note_unsettled_augmentations(record);
}

void Recorder::shot(const coupling::ShotRecord& record, const coupling::State& state) {
  fields_.update_criteria(state);
  const std::optional<double> solid = time_to_solidify(mesh_, fields_.bodies(), options_.castings);
  if (!criteria_probed_) fields_.release_criteria();
  on_first_process([&] {
    if (!tables_.shots) return;
    tables_.shots->add(record, solid);
    if (progress_) progress_->shot(shot_text(tables_.shots->rows().back()));
  });
}

void Recorder::add_stage(const coupling::StepRecord& record, const coupling::State& state) {
  fields_.update_criteria(state);
  const StageRow row = stage_row(mesh_, phases_, record, state, options_.castings, fields_.bodies());
  if (!criteria_probed_) fields_.release_criteria();
  on_first_process([&] { tables_.stages->add(row); });
}

void Recorder::measure_internal_energy(coupling::StepEffort& effort, const coupling::State& state) const {
  if (follows_internal_energy(phases_, options_))
    effort.internal_energy = coupling::internal_energy(phases_, state);
}

void Recorder::show_castings(coupling::StepEffort& effort, const coupling::State& state) const {
  if (phases_.heat != nullptr && !options_.castings.empty())
    effort.solid_fraction = solid_fraction(phases_, state, options_.castings, mesh_);
}

void Recorder::note_left_walls(const coupling::StepRecord& record) {
  std::vector<LeftWall>& left = options_.summary.left_walls;
  for (std::size_t i = 0; i < record.contacts.size(); ++i) {
    const coupling::ContactSummary& now = record.contacts[i];
    if (!(now.left_area > 0)) continue;
    const std::string& name = phases_.contacts[i]->parts().spec.name;
    auto wall = std::find_if(left.begin(), left.end(), [&](const LeftWall& w) { return w.contact == name; });
    if (wall == left.end())
      wall = left.insert(wall, {.contact = name, .gap = 0, .area = 0, .from = record.time, .to = 0});
    wall->gap = std::max(wall->gap, now.left_gap);
    wall->area = std::max(wall->area, now.left_area);
    wall->to = record.time;
  }
}

void Recorder::note_unsettled_augmentations(const coupling::StepRecord& record) {
  std::vector<UnsettledAugmentations>& pairs = options_.summary.unsettled;
  for (std::size_t i = 0; i < record.contacts.size(); ++i) {
    const double left = record.contacts[i].left_penetration;
    if (!(left > 0)) continue;
    const std::string& name = phases_.contacts[i]->parts().spec.name;
    auto pair = std::ranges::find(pairs, name, &UnsettledAugmentations::contact);
    if (pair == pairs.end()) pair = pairs.insert(pair, {.contact = name});
    ++pair->steps;
    pair->penetration = std::max(pair->penetration, left);
  }
}

void Recorder::checkpoint(const coupling::RestartData& continuation, const coupling::State& state) {
  const profile::Part part("checkpoints");
  const double start = processes::wall_time();
  checkpoints_.write(mesh_, options_.fingerprint,
                     {state, continuation, globals_.energy(), options_.summary.rejected,
                      options_.summary.shortened, globals_.stability()});
  seconds_.output += processes::wall_time() - start;
}

void Recorder::stopped(const coupling::Stop& stop, const coupling::State& state) {
  const std::string physics = coupling::text(stop.diagnosis);
  const std::string reason = stop.asked ? "as asked" : physics.empty() ? stop.reason : physics;
  // Without a step of this run there are no stresses to show.
  const bool moved = !options_.continue_from || state.time > options_.continue_from->state.time;
  // Bodies may have grown since the last step was recorded: what is active is that of phases made anew.
  if (moved && phases_.growth != nullptr) fields_.update(state);
  if (moved) write_fields(state);
  conclude("stopped: " + reason, state, moved);
}

void Recorder::end(const coupling::State& state) {
  conclude("finished", state, true);
}

void Recorder::conclude(const std::string& outcome, const coupling::State& state, bool mechanical) {
  if (progress_) progress_->end(outcome, options_.profile ? profile::text() : "");
  Summary& s = options_.summary;
  if (mechanical && phases_.mechanics != nullptr)
    // Answers are found from the fields of the last state, with the criteria that were accumulated.
    tell_stress_jumps(mesh_, phases_.mechanics->bodies().kind, fields_.bodies(), options_.castings);
  if (!options_.steady) {
    fields_.update_criteria(state);
    s.answers = answers(mesh_, phases_, state, options_.castings, fields_.bodies(), mechanical);
    if (phases_.criteria != nullptr) s.criteria = criteria::findings_of(*phases_.criteria, state.criteria);
    add_errors(mesh_, phases_, state, fields_.bodies(), last_.step, *s.answers, s.criteria);
    if (tables_.shots) s.answers->shots = tables_.shots->rows();
    if (tables_.stages) s.answers->stages = {options_.stages, tables_.stages->rows()};
    if (options_.fixed_steps && last_.largest_error[0] > 0) s.answers->step_error = last_.largest_error;
    if (!criteria_probed_) fields_.release_criteria();
    if (phases_.heat != nullptr) s.answers->energy_defect = globals_.relative_defect();
  }
  // Before the summary, which says that the run is finished.
  output_.end();
  write_summary_file(outcome, state);
  if (progress_ && s.answers)
    *options_.progress << text(*s.answers, s.criteria, options_.units) << std::flush;
}

std::vector<double> Recorder::history_row(const coupling::State& state) {
  last_.shot = state.shot;
  last_.since_pouring = state.time - state.poured;
  std::vector<double> row = {state.time};
  if (!options_.stages.empty())
    row.insert(row.end(), {static_cast<double>(last_.stage), static_cast<double>(last_.cycle)});
  if (options_.shots) row.insert(row.end(), {static_cast<double>(last_.shot), last_.since_pouring});
  for (const double v : probes_.values(fields_.bodies(), readings())) row.push_back(v);
  for (const double v : globals_.values()) row.push_back(v);
  return row;
}

void Recorder::add_history_row(const coupling::State& state) {
  last_.row = history_row(state);
  on_first_process([&] { tables_.history->add(last_.row); });
}

void Recorder::add_pools(const coupling::State& state) {
  on_first_process([&] {
    if (tables_.pools) tables_.pools->add(state);
    if (tables_.feeding) tables_.feeding->add(state);
  });
}

void Recorder::write_fields(const coupling::State& state) {
  fields_.update_criteria(state);
  output_.write(state.time, fields_.bodies().select(options_.fields), fields_.surfaces());
  for (const ProfileTable& profile : tables_.profiles) profile.write(folder_.root(), fields_.bodies());
  if (!criteria_probed_) fields_.release_criteria();
}

void Recorder::write_summary_file(const std::string& outcome, const coupling::State& state) {
  // The summary is filled in the order of the file: outcome, times and bytes of each part, balance between
  // the processes, criteria, fields, warnings and the profile. All of it is collective but the writing.
  Summary& s = options_.summary;
  s.outcome = outcome;
  s.end_time = state.time;
  s.memory = peak_memory();
  if (phases_.heat != nullptr) s.relative_energy_defect = globals_.relative_defect();
  s.seconds.emplace_back("heat", seconds_.heat);
  s.seconds.emplace_back("mechanics", seconds_.mechanics);
  s.seconds.emplace_back("output", seconds_.output);
  s.seconds.emplace_back("run", processes::wall_time() - seconds_.began);
  if (phases_.heat != nullptr) {
    s.seconds.emplace_back("heat_solver", phases_.heat->parts().solver->seconds());
    s.table_bytes.emplace_back("heat", heat::bytes(*phases_.heat));
  }
  if (phases_.mechanics != nullptr) {
    s.seconds.emplace_back("mechanics_assembly", phases_.mechanics->equations().seconds().assembly);
    s.seconds.emplace_back("mechanics_residual", phases_.mechanics->equations().seconds().residual);
    s.seconds.emplace_back("mechanics_solver", phases_.mechanics->system().seconds());
    std::size_t bytes = phases_.mechanics->bytes();
    for (const mechanics::SharedElementValues& values : state.mechanics.elements)
      if (values) bytes += values->bytes();
    s.table_bytes.emplace_back("mechanics", bytes);
  }
  for (const contact::ContactPair* pair : phases_.contacts)
    s.table_bytes.emplace_back("contact " + pair->parts().spec.name, pair->bytes());
  s.balance = balance(mesh_, s.seconds);
  if (phases_.criteria != nullptr) {
    s.criteria = criteria::findings_of(*phases_.criteria, state.criteria);
    s.seconds.emplace_back("criteria", phases_.criteria->seconds());
    s.table_bytes.emplace_back("criteria", criteria::bytes(*phases_.criteria));
  }
  const FieldSet written = fields_.bodies().select(options_.fields);
  for (const Field& field : written.all())
    if (const quantities::Quantity* known = coupling::find_field(field.name)) s.fields.push_back(known);
  s.warnings = logging::warnings();
  s.profile = profile::rows();
  s.profile_total = profile::total();
  // The first process adds the last row of the history, and writes.
  on_first_process([&] {
    const auto& columns = tables_.history->columns();
    for (std::size_t i = 0; i < columns.size(); ++i)
      s.final_values.emplace_back(columns[i].header(), last_.row[i]);
    write_summary(folder_.summary(), s);
  });
}

}  // namespace solidus::results
