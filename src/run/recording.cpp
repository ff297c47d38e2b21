/// The recorder's options are copied from the case and from what was built of it.
#include "run/recording.hpp"

#include <algorithm>

#include "setup/cast_bodies.hpp"
#include "setup/run_input.hpp"
#include "setup/time_input.hpp"
#include "system/processes.hpp"

namespace solidus::run {

namespace {

bool melts(const std::vector<material::Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const material::Material& m) { return m.solidification() != nullptr; });
}

/// The largest step that an adaptive run may take [s]; 0 where steps are equal.
double largest_adaptive_step(const cases::CaseSpec& spec) {
  if (!spec.time.adaptive || spec.time.steady) return 0;
  const coupling::TimeOptions time = setup::time_options(spec);
  double largest = time.stages.empty() ? time.step.largest() : 0;
  for (const coupling::Stage& stage : time.stages) largest = std::max(largest, stage.step.largest());
  return largest;
}

}  // namespace

bool has_shots(const setup::Assembly& a) {
  return std::any_of(a.stages.begin(), a.stages.end(), [](const cases::StageRun& s) { return s.shot > 0; });
}

results::MeshCounts counts(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  results::MeshCounts counts = results::count(mesh);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) counts.elements_of_body[b].first = spec.bodies[b].name;
  return counts;
}

results::RecorderOptions recorder_options(const setup::Case& c, const RunOptions& options,
                                          const setup::Assembly& a) {
  // What is recorded follows from the case: probes, profiles, fields, and which columns the tables have.
  const cases::CaseSpec& spec = c.spec;
  results::RecorderOptions r;
  r.kind = spec.analysis.kind;
  r.probes = setup::probes(spec);
  r.profiles = setup::profiles(spec);
  r.fields = spec.output.fields;
  for (const auto& [format, asked_for] : spec.output.formats)
    if (asked_for) r.formats.push_back(format);
  for (const cases::ChannelSpec& channel : spec.channels) r.channels.push_back(channel.name);
  for (const cases::SourceSpec& source : spec.sources) r.sources.push_back(source.name);
  for (const cases::StageSpec& stage : spec.stages) r.stages.push_back(stage.name);
  if (!r.stages.empty())
    for (const coupling::Stage& stage : setup::time_options(spec).stages) r.stage_ends.push_back(stage.end);
  r.shots = has_shots(a);
  r.steady = spec.time.steady;
  r.fixed_steps = !spec.time.adaptive && !spec.time.steady;
  r.progress = options.progress;
  r.profile = options.profile;
  r.castings = setup::cast_bodies(spec, a.materials, a.start);
  // The terminal's line needs to know what can be shown: fractions only of what melts, contacts
  // where there are some.
  r.units = {spec.output.length_unit, spec.output.temperature_unit, spec.output.stress_unit};
  r.progress_options.end = spec.time.end.value_or(0);
  r.progress_options.until_solid = spec.time.until == cases::TimeSpec::Until::solid;
  r.progress_options.heat = spec.has_heat();
  r.progress_options.mechanics = spec.has_mechanics();
  r.progress_options.contact = !spec.contacts.empty();
  r.progress_options.melting = r.melting = spec.has_heat() && melts(a.materials);
  r.progress_options.largest_step = largest_adaptive_step(spec);
  r.progress_options.terminal = options.terminal;
  // The summary gets what is known before the run: names, mesh, melts, and the number of processes.
  r.summary.case_file = c.file.string();
  r.summary.variant = results::default_run_folder(c.file, c.variant).filename().string();
  r.summary.title = spec.title;
  r.summary.mesh = counts(spec, a.mesh);
  if (a.mechanics)
    for (std::size_t b = 0; b < a.mechanics->bodies().melt.size(); ++b)
      if (const material::MeltModulus& melt = a.mechanics->bodies().melt[b]; melt.modulus > 0)
        r.summary.melt.push_back(
            {spec.bodies[b].name, melt.modulus, melt.time, material::measured_against(melt)});
  r.summary.processes = processes::count();
  return r;
}

}  // namespace solidus::run
