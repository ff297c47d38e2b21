/// A case is built as for a run, and what matters to the flow is written out.
#include "run/filling_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "cases/case_materials.hpp"
#include "cases/roles.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "input/keys.hpp"
#include "numbers/index_casts.hpp"
#include "results/formats/vtu.hpp"
#include "results/output/json_document.hpp"
#include "results/output/output_error.hpp"
#include "results/output/output_file.hpp"
#include "setup/assembly.hpp"
#include "setup/mesh_input.hpp"

namespace solidus::run {

namespace {

using results::Json;

constexpr double k_gravity = 9.80665;  ///< standard gravity, of a case that says none [m/s²]
constexpr double k_coldest = 200, k_beyond = 300, k_step = 0.25;  ///< of the tables [K]

template <class Numbers>
Json list(const Numbers& numbers) {
  Json::Array array;
  for (const auto& number : numbers) array.emplace_back(number);
  return array;
}

/// The tables of a material up to a temperature [K], so fine that straight lines between their points serve.
Json material_json(const material::Material& m, double hottest) {
  const material::EnthalpyCurve curve = m.enthalpy();
  // Points in even steps, and two where heat is given off at one temperature.
  std::vector<double> temperature, enthalpy, conductivity;
  for (double t = k_coldest; t < hottest; t += k_step) {
    for (const auto& jump : curve.jumps())
      if (jump.temperature > t - k_step && jump.temperature <= t)
        for (const double h : {curve.lower(jump.temperature), curve.upper(jump.temperature)}) {
          temperature.push_back(jump.temperature);
          enthalpy.push_back(h);
          conductivity.push_back(m.conductivity.value(jump.temperature));
        }
    temperature.push_back(t);
    enthalpy.push_back(curve.upper(t));
    conductivity.push_back(m.conductivity.value(t));
  }
  Json json;
  json.add("name", m.name).add("density", m.density);
  json.add("temperatures", list(temperature)).add("enthalpy", list(enthalpy));
  json.add("conductivity", list(conductivity));
  if (const material::PhaseChange* freezing = m.solidification()) {
    // Half solid is where the fraction passes a half on cooling.
    const double solidus = freezing->fraction.solidus(), liquidus = freezing->fraction.liquidus();
    double low = solidus, high = liquidus;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (freezing->fraction.value(middle) > 0.5 ? low : high) = middle;
    }
    json.add("solidus", solidus).add("liquidus", liquidus).add("half_solid", high);
    json.add("latent_heat", freezing->latent_heat);
  }
  if (m.casting.melt_viscosity) json.add("melt_viscosity", *m.casting.melt_viscosity);
  if (m.gas && m.gas->surface_tension > 0) json.add("surface_tension", m.gas->surface_tension);
  return json;
}

Json bodies_json(const cases::CaseSpec& spec, const setup::Assembly& a, double hottest) {
  Json::Array bodies;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::Role role = cases::role_of(spec.bodies[b], a.materials[b]);
    Json body;
    body.add("name", spec.bodies[b].name).add("role", std::string(cases::name(role)));
    body.add("poured", cases::is_poured(role));
    body.add("coldest", a.start[b].low).add("hottest", a.start[b].high);
    body.add("material", material_json(a.materials[b], hottest));
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// The bodies that have faces in a surface.
std::set<int> bodies_of(const mesh::Mesh& mesh, const std::string& surface) {
  std::set<int> bodies;
  if (const auto found = mesh.surfaces.find(surface); found != mesh.surfaces.end())
    for (const mesh::ElementBlock& block : found->second.faces)
      if (block.size() > 0) bodies.insert(block.body);
  return bodies;
}

/// The conductance of each pair of bodies in contact, closed and wet: where the law has none without
/// pressure, at that of the atmosphere, which holds melt on its wall.
Json interfaces_json(const setup::Assembly& a, double temperature) {
  Json::Array interfaces;
  for (const auto& pair : a.contacts) {
    const contact::ContactParameters& p = pair->parts().spec;
    if (!p.heat) continue;
    const contact::HeatTransferLaw law(contact::without_bodies(*p.heat));
    double conductance = law.at(0, 0, temperature).value;
    if (!(conductance > 0)) conductance = law.at(0, p.atmosphere, temperature).value;
    for (const int slave : bodies_of(a.mesh, p.slave))
      for (const int master : bodies_of(a.mesh, p.master)) {
        Json entry;
        entry.add("bodies", Json::Array{Json(slave), Json(master)}).add("heat_transfer", conductance);
        interfaces.push_back(std::move(entry));
      }
  }
  return interfaces;
}

/// The faces of a group as triangles, nine coordinates each [m].
Json triangles_of(const mesh::Mesh& mesh, const std::string& group, const SourceLocation& where) {
  const auto found = mesh.surfaces.find(group);
  if (found == mesh.surfaces.end()) {
    std::vector<std::string> names;
    for (const auto& [name, surface] : mesh.surfaces) names.push_back(name);
    throw InputError(where, fmt::format("the mesh has no group of faces '{}'", group), one_of(names, group));
  }
  // Corners come before mid nodes: three or four of each face.
  Json::Array triangles;
  for (const mesh::ElementBlock& block : found->second.faces) {
    const int corners = block.shape == mesh::Shape::tri3 || block.shape == mesh::Shape::tri6 ? 3 : 4;
    for (Index e = 0; e < block.size(); ++e)
      for (int k = 2; k < corners; ++k) {
        std::vector<double> numbers;
        for (const int corner : {0, k - 1, k})
          for (const double x : mesh.x[as_size(block.element(e)[corner])]) numbers.push_back(x);
        triangles.emplace_back(list(numbers));
      }
  }
  return triangles;
}

Json filling_json(const cases::FillingSpec& f, const mesh::Mesh& mesh) {
  Json json;
  if (f.gate) json.add("gate", triangles_of(mesh, *f.gate, f.where));
  if (!f.gate_at.empty()) json.add("gate_at", list(f.gate_at));
  if (f.gate_width) json.add("gate_width", *f.gate_width);
  if (f.time) json.add("time", *f.time);
  if (f.rate) json.add("rate", *f.rate);
  if (f.head) json.add("head", *f.head);
  if (!f.times.empty()) json.add("times", list(f.times));
  if (!f.speed.empty()) json.add("speed", list(f.speed));
  if (!f.pressure.empty()) json.add("pressure", list(f.pressure));
  if (!f.tilt.empty()) json.add("tilt", list(f.tilt)).add("tilt_axis", list(f.tilt_axis));
  if (f.temperature) json.add("pouring", *f.temperature);
  Json::Array vents;
  for (const std::string& vent : f.vents) vents.push_back(triangles_of(mesh, vent, f.where));
  json.add("vents", std::move(vents));
  json.add("cells", f.cells);
  if (f.cell_size) json.add("cell_size", *f.cell_size);
  return json;
}

/// Gravity [m/s²] as three numbers: that of the case, or the standard one.
Json gravity_json(const cases::AnalysisSpec& analysis) {
  std::vector<double> direction = analysis.gravity_direction;
  if (direction.empty()) direction = {0, 0, -1};
  double length = 0;
  for (const double d : direction) length = std::hypot(length, d);
  for (double& d : direction) d *= (analysis.gravity > 0 ? analysis.gravity : k_gravity) / length;
  return list(direction);
}

}  // namespace

void write_filling_input(setup::Case c, const std::filesystem::path& folder) {
  if (!c.spec.filling)
    throw InputError({c.file.string()}, "the case does not say how the mould is filled",
                     "a section [filling]; `solidus explain filling` lists its keys");
  c.spec.filling->result.reset();  // that of an earlier filling is not what this one starts from
  setup::Assembly a;
  a.materials = cases::load_materials(c.spec);
  a.mesh = setup::load_mesh(c.spec);
  setup::build(c.spec, a);
  setup::require_sound_mesh(c.spec);
  // The metal is as hot as its hottest body, or as the gate says.
  double hottest = 0;
  for (std::size_t b = 0; b < c.spec.bodies.size(); ++b)
    if (cases::is_poured(cases::role_of(c.spec.bodies[b], a.materials[b])))
      hottest = std::max(hottest, a.start[b].high);
  if (!(hottest > 0))
    throw InputError(c.spec.filling->where, "the case has no body that is poured",
                     "a body of the role casting");
  hottest = std::max(hottest, c.spec.filling->temperature.value_or(0));
  Json json;
  json.add("title", c.spec.title).add("gravity", gravity_json(c.spec.analysis));
  json.add("filling", filling_json(*c.spec.filling, a.mesh));
  json.add("bodies", bodies_json(c.spec, a, hottest + k_beyond))
      .add("interfaces", interfaces_json(a, hottest));
  // Both files are in a folder of their own.
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw results::OutputError(folder.string(), "cannot make this folder: " + error.message(),
                               "-o names another one");
  results::write_vtu(folder / "mesh.vtu", a.mesh, {}, 0);
  results::write_file(folder / "cavity.json", json.text());
}

}  // namespace solidus::run
