/// Materials, constitutive updates of many points, and material points under mixed control.
#include <cmath>
#include <memory>
#include <stdexcept>

#include "cases/case_materials.hpp"
#include "material/cards/library.hpp"
#include "material/external_law.hpp"
#include "material/melt.hpp"
#include "material/viscoplastic.hpp"
#include "numbers/index_casts.hpp"
#include "point/material_point.hpp"
#include "python/bindings.hpp"
#include "system/errors.hpp"

namespace solidus::python {

namespace {

using material::Material;
using material::Viscoplastic;
using Shared = std::shared_ptr<Material>;
using State = Viscoplastic::State<double>;

constexpr py::ssize_t k_state = 19;  ///< ε^v, ε^vp, ζ, ξ

Shared find(const std::string& reference) {
  return std::make_shared<Material>(material::find_material(reference, cases::material_folders()));
}

/// One value for each temperature.
template <class F>
py::array_t<double> each(const Array& temperature, F value) {
  std::vector<double> values(as_size(temperature.size()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(temperature.data()[i]);
  return array_of(std::move(values), {temperature.shape(), temperature.shape() + temperature.ndim()});
}

py::array_t<double> property(const Material& m, const std::string& name, const Array& temperature) {
  for (const material::Property& p : m.properties())
    if (p.name == name) return each(temperature, [&](double t) { return p.table->value(t); });
  throw py::key_error(name);
}

py::dict points_of(const Material& m, const std::string& name) {
  for (const material::Property& p : m.properties())
    if (p.name == name) {
      py::dict points;
      points["x"] = std::vector<double>(p.table->x().begin(), p.table->x().end());
      points["y"] = std::vector<double>(p.table->y().begin(), p.table->y().end());
      return points;
    }
  throw py::key_error(name);
}

py::dict properties(const Material& m) {
  py::dict units;
  for (const material::Property& p : m.properties()) units[p.name.c_str()] = p.unit;
  return units;
}

py::dict notes(const Material& m) {
  py::dict all;
  for (const material::PropertyNote& note : m.notes) {
    py::dict entry;
    entry["source"] = note.source;
    entry["valid"] = note.valid_to > note.valid_from
                         ? py::object(py::make_tuple(note.valid_from, note.valid_to))
                         : py::object(py::none());
    all[note.property.c_str()] = entry;
  }
  return all;
}

py::list phase_changes(const Material& m) {
  py::list all;
  for (const material::PhaseChange& change : m.phase_changes) {
    py::dict entry;
    entry["name"] = change.name;
    entry["latent_heat"] = change.latent_heat;
    entry["volume_change"] = change.volume_change;
    entry["solidus"] = change.fraction.solidus();
    entry["liquidus"] = change.fraction.liquidus();
    entry["solidification"] = change.solidification;
    all.append(entry);
  }
  return all;
}

Sym<double> sym(const double* values) {
  Sym<double> s;
  for (int i = 0; i < 6; ++i) s[i] = values[i];
  return s;
}

void put(const Sym<double>& s, double* values) {
  for (int i = 0; i < 6; ++i) values[i] = s[i];
}

State state_of(const double* values) {
  return {sym(values), sym(values + 6), sym(values + 12), values[18]};
}

void put(const State& s, double* values) {
  put(s.viscous_strain, values);
  put(s.plastic_strain, values + 6);
  put(s.back_strain, values + 12);
  values[18] = s.hardening;
}

Viscoplastic::Properties<double> properties_at(const Viscoplastic& law, double temperature, double reference,
                                               double dt) {
  Viscoplastic::Properties<double> p = law.properties_at(temperature, reference);
  if (law.material().chooses_viscosity())
    p.elastic.viscosity = material::melt_modulus(law.material(), 0, 0, 0).viscosity(dt);
  return p;
}

void require_mechanics(const Material& m) {
  if (!m.mechanical())
    throw InputError({}, "the material '" + m.name + "' has no elastic properties", "one with young_modulus");
  if (external_law(m) != nullptr)
    throw InputError({}, name_of_law(m) + " is not called from here",
                     "solidus point, or a Simulation (with trust_laws where the law is in a shared object)");
}

/// The update of every point by itself. Shapes were checked by the package.
/// @param strain, start  [point][6], [point][19]; written back to: nothing
py::dict update(const Shared& m, const Array& strain, const Array& temperature, const Array& start, double dt,
                double reference, bool with_tangent) {
  require_mechanics(*m);
  const Viscoplastic law(*m);
  const py::ssize_t n = strain.shape(0);
  // Flat arrays with one part a point, which become arrays of Python without a copy.
  const auto size = as_size(n);
  std::vector<double> stress(6 * size), state(k_state * size), tangent(with_tangent ? 36 * size : 0),
      dissipation(size), flow(size), fraction(size);
  std::vector<double> converged(size);
  // Other threads of Python may go on, since nothing here touches its objects.
  {
    const py::gil_scoped_release others_may_work;
    for (std::size_t i = 0; i < size; ++i) {
      const auto p = properties_at(law, temperature.data()[i], reference, dt);
      const auto r = law.update(p, state_of(start.data() + k_state * i), sym(strain.data() + 6 * i), dt);
      put(r.stress, &stress[6 * i]);
      put(r.state, &state[k_state * i]);
      dissipation[i] = r.dissipation;
      flow[i] = r.flow_increment;
      fraction[i] = p.elastic.solid_fraction;
      converged[i] = r.status == material::Status::converged ? 1 : 0;
      if (!with_tangent) continue;
      const Sym4<double> c = material::full_tangent(r);
      for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b) tangent[36 * i + 6 * as_size(a) + as_size(b)] = c[a][as_size(b)];
    }
  }
  py::dict result;
  result["stress"] = array_of(std::move(stress), {n, 6});
  result["state"] = array_of(std::move(state), {n, k_state});
  if (with_tangent) result["tangent"] = array_of(std::move(tangent), {n, 6, 6});
  result["dissipation"] = array_of(std::move(dissipation), {n});
  result["flow_increment"] = array_of(std::move(flow), {n});
  result["solid_fraction"] = array_of(std::move(fraction), {n});
  result["converged"] = array_of(std::move(converged), {n});
  return result;
}

/// Bulk and shear modulus, thermal strain, solid fraction, flow stress at temperatures.
py::dict moduli(const Shared& m, const Array& temperature, double reference) {
  // Only what has elastic properties has these.
  require_mechanics(*m);
  const Viscoplastic law(*m);
  py::dict result;
  const auto add = [&](const char* name, auto value) {
    result[name] = each(temperature, [&](double t) { return value(law.properties_at(t, reference)); });
  };
  add("bulk", [](const auto& p) { return p.elastic.bulk; });
  add("shear", [](const auto& p) { return p.elastic.shear; });
  add("thermal_strain", [](const auto& p) { return p.elastic.thermal_strain; });
  add("solid_fraction", [](const auto& p) { return p.elastic.solid_fraction; });
  add("flow_stress", [](const auto& p) { return p.flow.flow_stress; });
  return result;
}

/// A bar that is drawn: the axial strain is imposed, all other stresses are zero.
/// @param time, strain, temperature  at the ends of the steps, the first the start; strain is counted from
/// the
///                                   bar free of stress at the first temperature
/// Returns axial stress, lateral strain and equivalent plastic strain; the number of the step that found no
/// equilibrium, or -1.
py::tuple draw(const Shared& m, const Array& time, const Array& strain, const Array& temperature) {
  require_mechanics(*m);
  const auto n = as_size(time.size());
  point::MaterialPoint::Options options;
  options.temperature = temperature.data()[0];
  options.strain_reference = options.temperature;
  point::MaterialPoint bar(*m, options);
  std::vector<double> stress(n), lateral(n), hardening(n);
  py::ssize_t stopped = -1;
  {
    const py::gil_scoped_release others_may_work;
    for (std::size_t i = 1; i < n; ++i) {
      point::Target end{};
      end.of.fill(point::Control::stress);
      end.of[0] = point::Control::strain;
      end.value[0] = strain.data()[i];
      end.temperature = temperature.data()[i];
      const point::StepResult step = bar.attempt(end, time.data()[i] - time.data()[i - 1]);
      if (!step.converged) {
        stopped = static_cast<py::ssize_t>(i);
        break;
      }
      bar.accept(step);
      stress[i] = step.state.stress[0];
      lateral[i] = step.state.strain[1];
      hardening[i] = step.state.history.hardening;
    }
  }
  const auto shape = static_cast<py::ssize_t>(n);
  return py::make_tuple(array_of(std::move(stress), {shape}), array_of(std::move(lateral), {shape}),
                        array_of(std::move(hardening), {shape}), stopped);
}

}  // namespace

void bind_materials(py::module_& core) {
  // The class with what scripts read from a material; arrays go through each(), one number at a time.
  py::class_<Material, Shared>(core, "Material")
      .def_readonly("name", &Material::name)
      .def_readonly("title", &Material::title)
      .def_readonly("density", &Material::density)
      .def_property_readonly("mechanical", &Material::mechanical)
      .def("property", &property)
      .def("points", &points_of)
      .def("properties", &properties)
      .def("notes", &notes)
      .def("phase_changes", &phase_changes)
      .def("solid_fraction",
           [](const Material& m, const Array& t) {
             return each(t, [&](double value) { return m.solid_fraction(value); });
           })
      .def("enthalpy",
           [](const Material& m, const Array& t) {
             const material::EnthalpyCurve curve = m.enthalpy();
             return each(t, [&](double value) { return curve.upper(value); });
           })
      .def("temperature", [](const Material& m, const Array& h) {
        const material::EnthalpyCurve curve = m.enthalpy();
        return each(h, [&](double value) { return curve.temperature(value); });
      });
  // Functions of the library, and the law of many points at once.
  core.def("find_material", &find);
  core.def("material_names", [] { return material::material_names(cases::material_folders()); });
  core.def("update", &update);
  core.def("moduli", &moduli);
  core.def("draw", &draw);
}

}  // namespace solidus::python
