/// The mesh is read or made, checked for faults, given layers and interfaces, and distributed.
#include "setup/mesh_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <stdexcept>
#include <utility>

#include "mesh/files/file_unit.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/coats.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/making/wall_layers.hpp"
#include "mesh/message.hpp"
#include "mesh/parts/distribute.hpp"
#include "mesh/refinement/refine.hpp"
#include "numbers/index_casts.hpp"
#include "results/output/output_error.hpp"
#include "setup/interfaces.hpp"
#include "setup/mesh_checks.hpp"
#include "setup/mesh_soundness.hpp"
#include "setup/node_set_surfaces.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"
#include "system/stopwatch.hpp"

namespace solidus::setup {

namespace {

mesh::Shape shape_named(const std::string& wanted) {
  using mesh::Shape;
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet4, Shape::tet10,
                            Shape::hex8, Shape::hex20})
    if (mesh::name(shape) == wanted) return shape;
  throw std::logic_error("the declaration of mesh.element allows an unknown element");
}

mesh::RawMesh built_in_shape(const cases::MeshSpec& m) {
  const mesh::Shape shape = shape_named(m.element);
  if (m.block) return mesh::make_block({m.block->size, m.block->origin, m.block->divisions}, shape);
  if (m.two_blocks) {
    const cases::TwoBlocksSpec& t = *m.two_blocks;
    return mesh::make_two_blocks({t.lower, t.upper, t.lower_divisions, t.upper_divisions, t.gap}, shape);
  }
  const cases::CylinderInMouldSpec& c = *m.cylinder_in_mould;
  return mesh::make_cylinder_in_mould({c.radius, c.height, c.mould_wall, c.mould_bottom, c.mould_height,
                                       c.element_size, c.mould_element_size, c.interface_ratio},
                                      shape);
}

mesh::GeometryChoice geometry_choice(const cases::MeshSpec& m) {
  mesh::GeometryChoice choice;
  choice.conforming = m.conforming;
  // Groups by rule are found later, in the mesh; here are those by numbers, labels and boxes of the geometry.
  for (const cases::MeshGroupSpec& g : m.groups) {
    // Name and kind of the group, then exactly one way to choose it.
    if (g.by_rule()) continue;
    mesh::GeometryGroup& group = choice.groups.emplace_back();
    group.name = g.name;
    group.bodies = g.kind == cases::MeshGroupSpec::Kind::body;
    group.numbers = g.numbers;
    group.label = g.label;
    if (g.lowest.empty()) continue;
    group.box.emplace();
    std::copy_n(g.lowest.begin(), 3, (*group.box)[0].begin());
    std::copy_n(g.highest.begin(), 3, (*group.box)[1].begin());
  }
  return choice;
}

/// Three coordinates that have been checked.
mesh::Point point_of(const std::vector<double>& x) {
  return {x[0], x[1], x[2]};
}

mesh::CastingGeometry casting_geometry(const cases::MeshSpec& m) {
  // A size without a smallest one may shrink to a quarter where the part is thin.
  mesh::CastingGeometry geometry;
  for (const cases::MeshSizeSpec& s : m.sizes) {
    if (s.smallest && *s.smallest > s.size)
      throw InputError(s.where,
                       fmt::format("'smallest' is {:g} m, larger than 'size', {:g} m", *s.smallest, s.size),
                       "a smallest size of at most the largest one");
    geometry.sizes.push_back({s.body, s.size, s.smallest.value_or(s.size / 4), s.across, s.growth});
  }
  // One wall for all sides, or six.
  if (m.mould) {
    mesh::MouldBlock& mould = geometry.mould.emplace();
    mould.name = m.mould->name;
    mould.core = m.mould->core;
    for (std::size_t i = 0; i < 6; ++i)
      mould.walls[i] = m.mould->walls.size() == 6 ? m.mould->walls[i] : m.mould->walls[0];
  }
  for (const cases::RiserBlockSpec& r : m.risers) {
    mesh::RiserCylinder& riser = geometry.risers.emplace_back();
    riser = {r.name,       point_of(r.foot), r.diameter, r.height, r.neck_diameter.value_or(r.diameter),
             r.neck_height};
    if (!r.neck_to.empty()) riser.neck_to = point_of(r.neck_to);
    riser.sleeve = r.sleeve;
  }
  for (const cases::GatingBlockSpec& g : m.gatings)
    geometry.gatings.push_back({g.name, point_of(g.gate), g.gate_size[0], g.gate_size[1], g.gate_length,
                                g.runner_size[0], g.runner_size[1], point_of(g.sprue), g.foot_diameter,
                                g.top_diameter});
  for (const cases::ChillBlockSpec& c : m.chills)
    geometry.chills.push_back({c.name, point_of(c.lowest), point_of(c.highest)});
  if (m.symmetry) geometry.symmetry = {m.symmetry->axis[0] - 'x', m.symmetry->at};
  if (m.way > 0) geometry.only_way = m.way - 1;
  return geometry;
}

/// Cuts the coats of a shell out of the block of mould.
void add_coats(const cases::MeshSpec& m, const std::string& source, mesh::RawMesh& mesh) {
  if (m.coats.empty()) return;
  std::vector<mesh::Coat> coats;
  for (const cases::MeshCoatSpec& coat : m.coats) coats.push_back({coat.name, coat.thickness});
  const auto reports = mesh::make_coats(mesh, m.mould->name, coats, m.mould->bed, source);
  for (std::size_t i = 0; i < reports.size(); ++i)
    logging::info("coat '{}': {:.3g} mm thick, {:.4g} cm3, {} elements", reports[i].name,
                  1e3 * coats[i].thickness, 1e6 * reports[i].volume, reports[i].elements);
}

/// Sections of one body with as many layers of equal growth are made together, so that layers of neighbours
/// meet.
void add_layers(const std::vector<cases::MeshLayersSpec>& sections, const std::string& source,
                mesh::RawMesh& mesh) {
  std::vector<char> done(sections.size(), 0);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (done[i] != 0 || sections[i].number == 0) continue;
    // Sections that belong together are collected from the rest of the list.
    std::vector<mesh::WallLayers> together;
    for (std::size_t k = i; k < sections.size(); ++k) {
      const cases::MeshLayersSpec& l = sections[k];
      if (l.body != sections[i].body || l.number != sections[i].number || l.growth != sections[i].growth)
        continue;
      done[k] = 1;
      together.push_back({l.surface, l.body, l.number, l.growth, l.first});
    }
    // What has come of each is told, with a warning where there was too little room.
    const std::vector<mesh::WallLayerReport> reports = mesh::add_wall_layers(mesh, together, source);
    for (std::size_t k = 0; k < reports.size(); ++k) {
      const mesh::WallLayerReport& report = reports[k];
      const std::string &body = together[k].body, &surface = together[k].surface;
      logging::info("layers of '{}' on '{}': {} of {:.3g} mm, the first {:.3g} mm; in the mean {:.3g} mm",
                    body, surface, together[k].number, 1e3 * report.whole, 1e3 * report.first,
                    1e3 * report.mean);
      constexpr double k_least_share_of_depth =
          0.35;  // deep layers are thinner at corners and between bodies
      if (report.mean < k_least_share_of_depth * report.whole)
        logging::warn(
            "the layers of thin elements in '{}' at '{}' have room for {:.2g} of {:.2g} mm in the mean{}: "
            "the heat that it takes up is less accurate there",
            body, surface, 1e3 * report.mean, 1e3 * report.whole,
            report.n_bare > 0 ? fmt::format(", and for none at {} of {} nodes", report.n_bare,
                                            report.n_bare + report.n_columns)
                              : std::string());
    }
  }
}

/// The mesh of a case on process 0, and the contacts that its interfaces make.
mesh::RawMesh make_raw_mesh(cases::CaseSpec& spec, std::vector<FoundInterface>& found) {
  const cases::MeshSpec& m = spec.mesh;
  const std::string name = m.file ? *m.file : *m.shape;
  mesh::RawMesh result;
  // From a file, meshed where it is a geometry; else one of the built-in shapes.
  if (m.file) {
    mesh::MeshSource source{*m.file, mesh::metres_of_unit(*m.file, m.unit, "m", m.where),
                            m.element_size.value_or(0), m.order};
    for (const cases::MeshConstantSpec& constant : m.constants)
      source.constants[constant.name] = constant.value;
    source.geometry = geometry_choice(m);
    source.trust_script = m.trust_script;
    source.size_factor = m.size_factor;
    result = m.sizes.empty() && !m.mould && m.risers.empty() && m.gatings.empty() && m.chills.empty() &&
                     !m.symmetry
                 ? mesh::read_mesh(source)
                 : mesh::mesh_casting(source, casting_geometry(m));
    add_coats(m, name, result);
  } else {
    try {
      result = built_in_shape(m);
    } catch (const std::invalid_argument& error) {
      throw InputError(m.where, "the shape '" + *m.shape + "': " + error.what());
    }
  }
  // Interfaces and rules need bodies, and interfaces make contacts of what they find.
  if (!spec.interfaces.empty() || std::ranges::any_of(m.groups, &cases::MeshGroupSpec::by_rule)) {
    check_bodies_of(spec, result);
    add_rule_groups(spec, result, name);
    found = find_interfaces(spec, result, name);
    add_contacts(found, spec);
  }
  if (result.dimension == spec.dimension()) {  // else check_groups says so
    check_bodies_of(spec, result);
    make_surfaces_of_node_sets(spec, result);
  }
  check_groups(spec, result);
  if (m.file) make_sound(spec, result);
  add_layers(m.layers, name, result);
  mesh::validate_and_orient(result, name);
  return result;
}

/// Halves the edges of the parts of all processes, and says what has become of the mesh.
/// @param curved  new nodes of the skin lie on arcs
mesh::Mesh refined(const cases::MeshSpec& m, bool curved, mesh::Mesh mesh,
                   const std::vector<mesh::OtherGroup>& others) {
  try {
    mesh::check_refined_size(mesh, m.refine);
  } catch (const InputError& error) {
    throw InputError(m.where, fmt::format("'refine' is {}: {}", m.refine, error.what()));
  }
  const GlobalIndex before = mesh.n_global_nodes;
  double seconds = 0;
  mesh::RefinementReport report;
  {
    const Stopwatch watch(seconds);
    mesh = mesh::refine(std::move(mesh), {m.refine, curved}, others, report);
  }
  logging::info("mesh refined {}: {} nodes from {}, in {:.2g} s",
                m.refine == 1 ? "once" : fmt::format("{} times", m.refine), mesh.n_global_nodes, before,
                seconds);
  if (report.on_arcs > 0 || report.straightened > 0)
    logging::info(
        "new nodes of the skin: {} on arcs; {} on straight edges, where an arc would have folded an "
        "element",
        report.on_arcs, report.straightened);
  return mesh;
}

/// Distributes the interfaces that process 0 has found to all processes.
std::vector<FoundInterface> everywhere(const std::vector<FoundInterface>& found) {
  mesh::Packer packer;
  // Numbers of a fixed order, which the receiving side takes apart in the same one.
  packer.put_size(found.size());
  for (const FoundInterface& f : found) {
    packer.put(std::vector<GlobalIndex>{static_cast<GlobalIndex>(f.section), f.a, f.b});
    packer.put(f.surface_a);
    packer.put(f.surface_b);
    packer.put(std::vector<double>{f.distance});
  }
  std::vector<char> buffer = std::move(packer).buffer();
  processes::broadcast(buffer);
  // On the first process too, so that all have the same list.
  mesh::Unpacker unpacker(buffer);
  std::vector<FoundInterface> all(unpacker.size());
  for (FoundInterface& f : all) {
    const auto numbers = unpacker.vector<GlobalIndex>();
    f.section = as_size(numbers[0]);
    f.a = static_cast<int>(numbers[1]);
    f.b = static_cast<int>(numbers[2]);
    f.surface_a = unpacker.string();
    f.surface_b = unpacker.string();
    f.distance = unpacker.vector<double>()[0];
  }
  return all;
}

}  // namespace

mesh::RawMesh raw_mesh(cases::CaseSpec spec) {
  return make_mesh(std::move(spec)).mesh;
}

MadeMesh make_mesh(cases::CaseSpec spec) {
  MadeMesh made;
  double seconds = 0;
  {
    const Stopwatch watch(seconds);
    made.mesh = make_raw_mesh(spec, made.interfaces);
  }
  made.seconds = seconds;
  return made;
}

void require_sound_mesh(const cases::CaseSpec& spec) {
  results::on_first_process([&] {
    if (spec.mesh.unsound) throw InputError(*spec.mesh.unsound);
  });
}

mesh::Mesh load_mesh(cases::CaseSpec& spec, MadeMesh* made) {
  MadeMesh own;
  {
    const profile::Part part("reading and meshing");
    results::on_first_process([&] { own = made != nullptr ? std::move(*made) : make_mesh(spec); });
    // Interfaces of geometry are found by the first process alone and told to the others.
    if (!spec.interfaces.empty()) add_contacts(everywhere(own.interfaces), spec);
  }
  mesh::RawMesh raw = std::move(own.mesh);
  // Factors on contacts can be applied only when all of them are there.
  cases::vary_contacts(spec);
  // A body that only conducts costs less than one with mechanics; the partition weighs them so. Sides of
  // contacts are present on every process.
  const profile::Part part("partition");
  std::vector<std::string> bodies, replicated;
  std::vector<mesh::BodyWork> work;
  for (const cases::BodySpec& body : spec.bodies) {
    bodies.push_back(body.mesh_group());
    work.push_back(body.physics == cases::BodySpec::ActivePhysics::heat ? mesh::BodyWork::heat
                                                                        : mesh::BodyWork::all);
  }
  // Rigid surfaces are no part of the mesh, and known to all anyway.
  for (const cases::ContactSpec& contact : spec.contacts)
    for (const std::string& surface : contact.sides())
      if (spec.rigid_surface(surface) == nullptr) replicated.push_back(surface);
  spec.mesh.unsound = raw.unsound;
  if (spec.mesh.refine == 0) return mesh::distribute(std::move(raw), bodies, replicated, work);
  // Facets of a drawn geometry enclose its volume (mesh/gmsh/curved_faces.hpp): their vertices lie outside of
  // it, and arcs through them would enclose too much.
  std::vector<mesh::OtherGroup> others;
  int curved = 0;
  results::on_first_process([&] {
    curved = spec.mesh.refined_skin == "curved" ||
             (spec.mesh.refined_skin == "automatic" && raw.drawn_faces.empty());
    others = mesh::prepare_refinement(raw, bodies);
  });
  processes::broadcast(std::span(&curved, 1));
  return refined(spec.mesh, curved != 0, mesh::distribute(std::move(raw), bodies, replicated, work), others);
}

}  // namespace solidus::setup
