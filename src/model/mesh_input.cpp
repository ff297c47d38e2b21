#include "model/mesh_input.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "base/log.hpp"
#include "base/profile.hpp"
#include "base/units.hpp"
#include "mesh/distribute.hpp"
#include "mesh/shapes.hpp"
#include "mesh/wall_layers.hpp"
#include "model/mesh_checks.hpp"
#include "results/output_error.hpp"

namespace solidus::model {

namespace {

mesh::Shape shape_named(const std::string& wanted) {
  using mesh::Shape;
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet4, Shape::tet10,
                            Shape::hex8, Shape::hex20})
    if (mesh::name(shape) == wanted) return shape;
  throw std::logic_error("the declaration of mesh.element allows an unknown element");
}

mesh::RawMesh built_in_shape(const MeshSpec& m) {
  const mesh::Shape shape = shape_named(m.element);
  if (m.block) return mesh::make_block({m.block->size, m.block->origin, m.block->divisions}, shape);
  if (m.two_blocks) {
    const TwoBlocksSpec& t = *m.two_blocks;
    return mesh::make_two_blocks({t.lower, t.upper, t.lower_divisions, t.upper_divisions, t.gap}, shape);
  }
  const CylinderInMouldSpec& c = *m.cylinder_in_mould;
  return mesh::make_cylinder_in_mould({c.radius, c.height, c.mould_wall, c.mould_bottom, c.mould_height,
                                       c.element_size, c.mould_element_size, c.interface_ratio},
                                      shape);
}

mesh::GeometryChoice geometry_choice(const MeshSpec& m) {
  mesh::GeometryChoice choice;
  choice.conforming = m.conforming;
  for (const MeshGroupSpec& g : m.groups) {
    mesh::GeometryGroup& group = choice.groups.emplace_back();
    group.name = g.name;
    group.bodies = g.kind == MeshGroupSpec::Kind::body;
    group.numbers = g.numbers;
    group.label = g.label;
    if (g.lowest.empty()) continue;
    group.box.emplace();
    std::copy_n(g.lowest.begin(), 3, (*group.box)[0].begin());
    std::copy_n(g.highest.begin(), 3, (*group.box)[1].begin());
  }
  return choice;
}

void add_layers(const MeshLayersSpec& l, const std::string& source, mesh::RawMesh& mesh) {
  const mesh::WallLayerReport report =
      mesh::add_wall_layers(mesh, {l.surface, l.body, l.number, l.growth, l.first}, source);
  logging::info("layers of '{}' on '{}': {} of {:.3g} mm, the first {:.3g} mm", l.body, l.surface, l.number,
                1e3 * report.whole, 1e3 * report.first);
  if (report.mean < 0.7 * report.whole)
    logging::warn(
        "layers of '{}' on '{}' have room for {:.2g} of {:.2g} mm in the mean; {} of {} vertices have none",
        l.body, l.surface, 1e3 * report.mean, 1e3 * report.whole, report.n_bare,
        report.n_bare + report.n_columns);
}

}  // namespace

mesh::RawMesh raw_mesh(const CaseSpec& spec) {
  const MeshSpec& m = spec.mesh;
  mesh::RawMesh result;
  if (m.file) {
    mesh::MeshSource source{*m.file, units::convert(1, m.unit, "m"), m.element_size.value_or(0), m.order};
    for (const MeshConstantSpec& constant : m.constants) source.constants[constant.name] = constant.value;
    source.geometry = geometry_choice(m);
    source.trust_script = m.trust_script;
    result = mesh::read_mesh(source);
  } else {
    try {
      result = built_in_shape(m);
    } catch (const std::invalid_argument& error) {
      throw InputError(m.where, "the shape '" + *m.shape + "': " + error.what());
    }
  }
  check_groups(spec, result);
  for (const MeshLayersSpec& layers : m.layers)
    if (layers.number > 0) add_layers(layers, m.file ? *m.file : *m.shape, result);
  mesh::validate_and_orient(result, m.file ? *m.file : *m.shape);
  return result;
}

mesh::Mesh load_mesh(const CaseSpec& spec) {
  mesh::RawMesh raw;
  {
    const profile::Part part("reading and meshing");
    results::on_first_process([&] { raw = raw_mesh(spec); });
  }
  const profile::Part part("partition");
  std::vector<std::string> bodies, replicated;
  std::vector<mesh::BodyWork> work;
  for (const BodySpec& body : spec.bodies) {
    bodies.push_back(body.mesh_group());
    work.push_back(body.physics == BodySpec::Physics::heat ? mesh::BodyWork::heat : mesh::BodyWork::all);
  }
  for (const ContactSpec& contact : spec.contacts)
    for (const std::string& surface : contact.sides())
      if (spec.rigid_surface(surface) == nullptr) replicated.push_back(surface);
  return mesh::distribute(raw, bodies, replicated, work);
}

}  // namespace solidus::model
