#include "run/sensitivities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "cases/case_materials.hpp"
#include "heat/quantities.hpp"
#include "heat/thermal_parts.hpp"
#include "mechanics/quantities.hpp"
#include "results/fields/state_fields.hpp"
#include "results/tables/probes.hpp"
#include "setup/mesh_input.hpp"
#include "setup/run_input.hpp"
#include "setup/scheme_input.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::run {

namespace {

/// The fields whose derivatives are known: the unknowns of the two phases.
bool differentiated(const results::Sampled& sampled) {
  return sampled.field == heat::fields::k_temperature.name ||
         sampled.field == mechanics::fields::k_displacement.name;
}

/// The probes of a case that sample them, at points and over groups.
std::vector<results::Probe> probes_of_unknowns(const cases::CaseSpec& spec) {
  std::vector<results::Probe> probes;
  // Other fields are left out without a complaint: a case may have probes of stresses in addition to those
  // whose derivatives are wanted.
  for (const results::Probe& probe : setup::probes(spec)) {
    const auto* point = std::get_if<results::PointProbe>(&probe);
    const auto* group = std::get_if<results::GroupProbe>(&probe);
    if ((point != nullptr && differentiated(*point)) || (group != nullptr && differentiated(*group)))
      probes.push_back(probe);
  }
  return probes;
}

void check_case(const cases::CaseSpec& spec) {
  const SourceLocation& where = spec.time.where;
  // Steps that adapt would differ between the run and its neighbours, and a difference of two runs at
  // different times is no derivative.
  if (spec.time.steady || spec.time.adaptive)
    throw InputError(where, "derivatives are known of runs with steps of a given size",
                     "time.steady = false, time.adaptive = false");
  if (!spec.stages.empty())
    throw InputError(where, "derivatives are not known across stages", "a case without [[stage]]");
  if (processes::count() > 1)
    throw InputError(where, "derivatives are computed on one process", "solidus without mpirun");
}

/// Of bodies that deform the order of the phases is that in which coupling::StepSensitivity takes a step.
void check_scheme(const setup::Case& base, const setup::Assembly& a) {
  const cases::CaseSpec& spec = base.spec;
  if (!spec.has_mechanics()) return;
  // Schemes that solve both phases at once or iterate lag by nothing; heat first has gaps of its own.
  if (!setup::lags_a_step(spec, setup::keeps_strain(spec, a.materials, a.start)))
    throw InputError({base.file.string(), 0, 0},
                     "derivatives are known of a sequential split that solves deformation first",
                     "order = \"mechanics_first\" in [coupling]");
}

bool same_mesh(const mesh::Mesh& a, const mesh::Mesh& b) {
  // Coordinates that are equal to the last bit mean the same divisions; a neighbour with other places would
  // need an interpolation that no derivative survives.
  return a.x == b.x && a.bodies.size() == b.bodies.size() && a.blocks.size() == b.blocks.size();
}

}  // namespace

struct Sensitivities::Reader {
  results::StateFields fields;
  results::Probes probes;

  Reader(const cases::CaseSpec& spec, const setup::Assembly& a)
      : fields(a.mesh, a.phases, spec.analysis.kind),
        probes(a.mesh, spec.analysis.kind, probes_of_unknowns(spec), fields.bodies()) {}
  std::vector<double> values(const coupling::State& state) {
    fields.update(state);
    return probes.values(fields.bodies());
  }
};

struct Sensitivities::Built {
  std::string name;
  double change;
  setup::Case c;
  setup::Assembly a;
  coupling::State state;  ///< as its probes read it
  std::unique_ptr<Reader> reader;

  explicit Built(Neighbour neighbour)
      : name(std::move(neighbour.name)), change(neighbour.change), c(std::move(neighbour.c)) {
    // The neighbour is set up like a run of its own, from materials over the mesh to the phases, since any of
    // them may depend on the parameter.
    a.materials = cases::load_materials(c.spec);
    a.mesh = setup::load_mesh(c.spec);
    setup::build(c.spec, a);
    // Its initial state belongs to the probes from here on; only its heat is replaced at each step.
    state = std::move(a.initial);
    reader = std::make_unique<Reader>(c.spec, a);
  }
};

Sensitivities::Sensitivities(const setup::Case& base, const setup::Assembly& a,
                             std::vector<Neighbour> neighbours, const std::filesystem::path& file) {
  check_case(base.spec);
  check_scheme(base, a);
  if (!base.spec.depositions.empty())
    throw InputError(base.spec.depositions.front().where, "derivatives of bodies that grow are not there yet",
                     "a case without [[deposition]]");
  if (base.spec.feeding.moves_heat)
    throw InputError(base.spec.feeding.where, "derivatives of heat that moves with metal are not there yet",
                     "moves_heat = false in [feeding]");
  // Columns follow the probes of the base case, and their number decides what is comparable among the
  // neighbours.
  reader_ = std::make_unique<Reader>(base.spec, a);
  const std::vector<results::CsvColumn>& probed = reader_->probes.columns();
  if (probed.empty())
    throw InputError({base.file.string(), 0, 0},
                     "no probe samples a temperature or displacement, of which derivatives are",
                     "[[probe]] with field = \"temperature\"");
  if (base.spec.has_mechanics()) twin_ = std::make_unique<Built>(Neighbour{"", 1, base});
  std::vector<coupling::StepSensitivity::Neighbour> followed;
  std::vector<results::CsvColumn> columns{{"time", "s"}};
  // Each neighbour is built as a whole and then compared: a parameter that moves nodes is refused with its
  // name, not found by a wrong number later.
  for (Neighbour& neighbour : neighbours) {
    built_.push_back(std::make_unique<Built>(std::move(neighbour)));
    const Built& n = *built_.back();
    if (!same_mesh(a.mesh, n.a.mesh) || n.reader->probes.columns().size() != probed.size())
      throw InputError({base.file.string(), 0, 0},
                       fmt::format("the parameter '{}' changes the mesh or the probes", n.name),
                       "data, conditions and places of probes");
    followed.push_back({&n.a.phases, n.state});
    // One column for each parameter and probe, in the order in which add_row() has the values.
    for (const results::CsvColumn& column : probed)
      columns.push_back({column.header() + " by " + n.name, ""});
  }
  if (a.phases.heat != nullptr) a.phases.heat->parts().keeps_stages = true;
  steps_.emplace(twin_ ? twin_->a.phases : a.phases, std::move(followed));
  // The table is opened by the first process alone: two that wrote one file would spoil it.
  if (processes::rank() == 0) table_.emplace(file, std::move(columns));
}

Sensitivities::~Sensitivities() = default;

void Sensitivities::begin(const coupling::State& state) {
  steps_->begin(state);
  add_row(state);
}

void Sensitivities::step(const coupling::StepRecord& record, const coupling::State& state) {
  steps_->step(record, state);
  add_row(state);
}

/// One column a parameter and probe: the difference of the neighbour's value from the run's, over the change.
void Sensitivities::add_row(const coupling::State& state) {
  // The values of the run are read once, and serve all neighbours.
  const std::vector<double> here = reader_->values(state);
  std::vector<double> row{state.time};
  for (std::size_t i = 0; i < built_.size(); ++i) {
    Built& n = *built_[i];
    // The neighbour's state comes from the solver of derivatives, and its probes read it like that of any
    // run.
    steps_->read(i, n.state);
    const std::vector<double> there = n.reader->values(n.state);
    for (std::size_t k = 0; k < here.size(); ++k) row.push_back((there[k] - here[k]) / n.change);
  }
  if (table_) table_->add(row);
}

}  // namespace solidus::run
