/// Runs that Python drives step by step: steps, fields and changes.
#include <algorithm>
#include <memory>

#include "material/external_law.hpp"
#include "mesh/files/vtk_cells.hpp"
#include "numbers/index_casts.hpp"
#include "python/bindings.hpp"
#include "results/fields/state_fields.hpp"
#include "results/formats/vtu.hpp"
#include "run/session.hpp"
#include "setup/assembly.hpp"
#include "system/errors.hpp"

namespace solidus::python {

namespace {

py::dict dict_of(const coupling::PhaseEffort& effort) {
  py::dict d;
  d["iterations"] = effort.iterations;
  d["linear_iterations"] = effort.linear_iterations;
  d["residual"] = effort.residual;
  d["seconds"] = effort.seconds;
  return d;
}

py::dict dict_of(const coupling::EnergyAudit& energy) {
  py::dict d;
  d["stored_heat"] = energy.stored_heat;
  d["heat_in"] = energy.heat_in;
  d["heat_exchanged"] = energy.heat_exchanged;
  d["structural"] = energy.structural;
  d["contact"] = energy.contact;
  d["kinetic"] = energy.kinetic;
  d["friction"] = energy.friction;
  d["numerical"] = energy.numerical;
  d["work"] = energy.work;
  d["viscous_dissipation"] = energy.viscous_dissipation;
  d["plastic_dissipation"] = energy.plastic_dissipation;
  d["plastic_work"] = energy.plastic_work;
  d["defect"] = energy.defect();
  return d;
}

py::dict dict_of(const coupling::StepRecord& record) {
  py::dict d;
  d["number"] = record.number;
  d["time"] = record.time;
  d["step"] = record.dt;
  d["reason"] = record.reason;
  d["rejected"] = record.rejected;
  d["shortened"] = record.shortened;
  d["rejection"] = record.rejection;
  d["output"] = record.output;
  d["stage"] = record.stage;
  d["cycle"] = record.cycle;
  d["heat"] = dict_of(record.heat);
  d["mechanics"] = dict_of(record.mechanics);
  d["coupling_iterations"] = record.coupling_iterations;
  d["solid_fraction"] = record.solid_fraction;
  d["min_temperature"] = record.min_temperature;
  d["max_temperature"] = record.max_temperature;
  d["temperature_error"] = record.temperature_error;
  d["displacement_error"] = record.displacement_error;
  d["stress_error"] = record.stress_error;
  d["energy"] = dict_of(record.energy);
  return d;
}

/// A session with its fields, which are brought up to date when they are asked for. Every function is
/// collective.
class Driver {
 public:
  Driver(const std::string& path, const std::vector<std::string>& assignments,
         std::optional<std::string> physics, const std::string& folder, bool restart, bool trust_script,
         bool trust_laws) {
    // Heat alone is a change of the case as it is read, and as that of the command line.
    std::optional<cases::Physics> wanted;
    if (physics) wanted = *physics == "heat" ? cases::Physics::heat : cases::Physics::thermomechanical;
    setup::Case c = setup::load_case(path, assignments, wanted);
    c.spec.mesh.trust_script = trust_script;
    if (trust_laws) material::trust_external_laws();
    run::RunOptions options;
    options.folder = folder;
    options.restart = restart;
    // A signal of Python stops the run between steps.
    options.stop_asked = interrupted;
    const py::gil_scoped_release others_may_work;
    session_ = std::make_unique<run::Session>(std::move(c), std::move(options));
  }

  using Ended = std::optional<std::pair<bool, std::string>>;
  Ended run() {
    return moved([&] { return std::optional(session_->run()); });
  }
  Ended advance(std::optional<double> step) {
    return moved([&] { return session_->advance(step); });
  }
  Ended repeat(std::optional<double> step) {
    return moved([&] { return session_->repeat(step); });
  }
  void commit() {
    moved([&] {
      session_->commit();
      return std::optional<run::RunResult>();
    });
  }
  void change(const std::string& assignment) { session_->change(assignment); }
  bool pending() const { return session_->pending(); }
  double time() const { return session_->state().time; }
  py::dict record() const { return dict_of(session_->record()); }
  std::string resolved() const { return session_->made().running.toml(); }
  std::optional<double> end() const { return session_->made().running.spec.time.end; }
  std::string title() const { return session_->made().running.spec.title; }

  std::vector<std::string> bodies() const {
    std::vector<std::string> names;
    for (const cases::BodySpec& body : session_->made().running.spec.bodies) names.push_back(body.name);
    return names;
  }

  /// Nodes of this process, ghosts behind; cells that it counts, of bodies that are there, in VTK's order of
  /// nodes.
  py::dict mesh() {
    bring_up_to_date(false);
    // Coordinates in one flat list, three a node.
    const mesh::Mesh& m = session_->made().assembly.mesh;
    std::vector<double> points;
    points.reserve(3 * m.x.size());
    for (const mesh::Point& x : m.x) points.insert(points.end(), x.begin(), x.end());
    std::vector<std::int64_t> connectivity, offsets, element;
    std::vector<std::int32_t> body;
    std::vector<std::uint8_t> types;
    for_cells([&](const mesh::ElementBlock& block, Index e, std::size_t) {
      for (const int a : mesh::vtk_node_order(block.shape)) connectivity.push_back(block.element(e)[a]);
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      types.push_back(static_cast<std::uint8_t>(mesh::vtk_cell_type(block.shape)));
      body.push_back(block.body);
      element.push_back(block.input_element[as_size(e)]);
    });
    // Numbers of nodes and cells are those of the input, so that scripts can compare runs.
    py::dict d;
    d["points"] = array_of(std::move(points), {static_cast<py::ssize_t>(m.x.size()), 3});
    d["connectivity"] = py::array_t<std::int64_t>(py::cast(connectivity));
    d["offsets"] = py::array_t<std::int64_t>(py::cast(offsets));
    d["types"] = py::array_t<std::uint8_t>(py::cast(types));
    d["body"] = py::array_t<std::int32_t>(py::cast(body));
    d["element"] = py::array_t<std::int64_t>(py::cast(element));
    d["node"] = py::array_t<std::int64_t>(py::cast(m.input_node.part(0, m.input_node.size())));
    d["owned"] = m.n_owned_nodes;
    return d;
  }

  /// Name, unit, place and whether it is a criterion, of all fields.
  py::list fields() {
    py::list all;
    for (const results::Field& field : state_fields().bodies().all())
      all.append(py::make_tuple(field.name, field.unit,
                                field.place == mesh::FieldPlace::node ? "nodes" : "elements",
                                is_criterion(field.name)));
    return all;
  }

  py::array_t<double> field(const std::string& name) {
    const results::Field* found = state_fields().bodies().find(name);
    if (found == nullptr) throw py::key_error(name);
    // A criterion has no value for a step that may still be taken back.
    if (is_criterion(name) && pending())
      throw InputError({},
                       "'" + name + "' is a criterion, which follows committed steps, and a step is pending",
                       "commit() first");
    bring_up_to_date(is_criterion(name));
    std::vector<double> storage;
    const std::span<const double> values = found->read(storage);
    // Vectors of the plane get a third component, as the readers of such arrays expect.
    const auto nc = as_size(found->components);
    const std::size_t padded = nc == 2 ? 3 : nc;
    std::vector<double> taken;
    const auto take = [&](std::size_t entity) {
      for (std::size_t i = 0; i < padded; ++i) taken.push_back(i < nc ? values[entity * nc + i] : 0.0);
    };
    if (found->place == mesh::FieldPlace::node)
      for (std::size_t i = 0; i < session_->made().assembly.mesh.x.size(); ++i) take(i);
    else
      for_cells([&](const mesh::ElementBlock&, Index, std::size_t number) { take(number); });
    const auto n = static_cast<py::ssize_t>(taken.size() / padded);
    std::vector<py::ssize_t> shape{n};
    if (padded > 1) shape.push_back(static_cast<py::ssize_t>(padded));
    return array_of(std::move(taken), std::move(shape));
  }

 private:
  /// Returns what `move` tells of the end of the run, and raises the exception that a signal asks for.
  template <class Move>
  Ended moved(Move move) {
    stale_ = true;
    std::optional<run::RunResult> result;
    {
      const py::gil_scoped_release others_may_work;
      result = move();
    }
    raise_if_interrupted(result ? result->reason : "");
    if (!result) return {};
    return std::pair(result->finished, result->reason);
  }

  /// @param use  called with the block, the element and its number among all
  template <class Use>
  void for_cells(Use use) {
    const mesh::Mesh& m = session_->made().assembly.mesh;
    const linear::ActiveSet* active = state_fields().bodies().active();
    std::size_t first = 0;
    for (const mesh::ElementBlock& block : m.blocks) {
      if (active == nullptr || active->body(block.body))
        for (Index e = 0; e < block.n_counted; ++e) use(block, e, first + as_size(e));
      first += as_size(block.size());
    }
  }

  results::StateFields& state_fields() {
    const setup::Assembly& a = session_->made().assembly;
    if (!fields_) fields_.emplace(a.mesh, a.phases, session_->made().running.spec.analysis.kind);
    return *fields_;
  }

  void bring_up_to_date(bool criteria) {
    if (stale_) {
      state_fields().update(session_->state());
      stale_ = false;
      criteria_stale_ = true;
    }
    if (criteria && criteria_stale_) {
      state_fields().update_criteria(session_->state());
      criteria_stale_ = false;
    }
  }

  bool is_criterion(const std::string& name) const {
    const criteria::Criteria* criteria = session_->made().assembly.phases.criteria;
    if (criteria == nullptr) return false;
    const std::vector<const quantities::Quantity*> fields = criteria::fields_of(*criteria);
    return std::any_of(fields.begin(), fields.end(), [&](const auto* field) { return field->name == name; });
  }

  std::unique_ptr<run::Session> session_;
  std::optional<results::StateFields> fields_;
  bool stale_ = true, criteria_stale_ = true;
};

}  // namespace

void bind_sessions(py::module_& core) {
  py::class_<Driver>(core, "Session")
      .def(py::init<const std::string&, const std::vector<std::string>&, std::optional<std::string>,
                    const std::string&, bool, bool, bool>())
      .def("run", &Driver::run)
      .def("advance", &Driver::advance)
      .def("repeat", &Driver::repeat)
      .def("commit", &Driver::commit)
      .def("change", &Driver::change)
      .def_property_readonly("pending", &Driver::pending)
      .def_property_readonly("time", &Driver::time)
      .def_property_readonly("end", &Driver::end)
      .def_property_readonly("title", &Driver::title)
      .def_property_readonly("record", &Driver::record)
      .def_property_readonly("bodies", &Driver::bodies)
      .def("resolved", &Driver::resolved)
      .def("mesh", &Driver::mesh)
      .def("fields", &Driver::fields)
      .def("field", &Driver::field);
}

}  // namespace solidus::python
