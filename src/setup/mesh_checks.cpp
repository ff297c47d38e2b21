/// What the case names must be in the mesh, and what the mesh has should be named: the first is an error,
/// the second a warning.
#include "setup/mesh_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>

#include "mesh/surfaces/vertex_sets.hpp"
#include "numbers/index_casts.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

using mesh::RawMesh;

std::string what_it_is(int dimension, int of_mesh) {
  if (dimension == of_mesh) return "a body";
  if (dimension == of_mesh - 1) return "a surface";
  return dimension == 0 ? "a point" : "a line";
}

/// The names of the groups of a dimension; of all groups for −1.
std::vector<std::string> group_names(const RawMesh& mesh, int dimension) {
  std::vector<std::string> names;
  for (const auto& [name, group] : mesh.groups)
    if (dimension < 0 || group.dimension == dimension) names.push_back(name);
  return names;
}

/// @param dimension that the group must have; −1: any
/// @param also names that would do, too, for messages
void require(const RawMesh& mesh, const std::string& name, int dimension, const SourceLocation& where,
             const std::string& user, const std::vector<std::string>& also = {}) {
  const auto group = mesh.groups.find(name);
  if (group == mesh.groups.end()) {
    std::vector<std::string> names = group_names(mesh, dimension);
    names.insert(names.end(), also.begin(), also.end());
    throw InputError(where, fmt::format("the mesh has no group '{}' ({})", name, user), one_of(names, name));
  }
  if (dimension >= 0 && group->second.dimension != dimension)
    throw InputError(where,
                     fmt::format("the group '{}' is {} ({})", name,
                                 what_it_is(group->second.dimension, mesh.dimension), user),
                     fmt::format("{} is needed, {}", what_it_is(dimension, mesh.dimension),
                                 one_of(group_names(mesh, dimension), name)));
}

void require_body(const cases::CaseSpec& spec, const std::string& name, const SourceLocation& where,
                  const std::string& user) {
  std::vector<std::string> bodies;
  for (const cases::BodySpec& body : spec.bodies) bodies.push_back(body.mesh_group());
  if (std::find(bodies.begin(), bodies.end(), name) == bodies.end())
    throw InputError(where, fmt::format("the group '{}' is no body of the case ({})", name, user),
                     one_of(bodies, name));
}

void check_radius(const cases::CaseSpec& spec, const RawMesh& mesh) {
  if (spec.analysis.kind != AnalysisKind::axisymmetric) return;
  double least = 0, greatest = 0;
  for (const mesh::Point& x : mesh.x) {
    least = std::min(least, x[0]);
    greatest = std::max(greatest, x[0]);
  }
  constexpr double k_rounding = 1e-9;  // of what meshing programs leave at the axis
  if (least < -k_rounding * greatest)
    throw InputError(spec.mesh.where,
                     fmt::format("the mesh has a node at x = {:.6g} m, a negative radius", least),
                     "x >= 0 in an axisymmetric analysis");
}

void check_rigid_names(const cases::CaseSpec& spec, const RawMesh& mesh) {
  for (const cases::RigidSurfaceSpec& s : spec.rigid_surfaces) {
    if (mesh.groups.count(s.name) > 0)
      throw InputError(s.where,
                       fmt::format("the rigid surface '{}' is called like a group of the mesh", s.name),
                       "a name of its own");
    if (std::none_of(spec.contacts.begin(), spec.contacts.end(),
                     [&](const cases::ContactSpec& c) { return c.master == s.name; }))
      throw InputError(s.where,
                       fmt::format("no [[contact]] has the rigid surface '{}' as its master", s.name),
                       fmt::format("a contact with master = \"{}\", or no such section", s.name));
  }
}

/// [raw node]: whether it lies on a body of the case.
std::vector<char> nodes_of_bodies(const cases::CaseSpec& spec, const RawMesh& mesh) {
  std::vector<char> carried(mesh.x.size(), 0);
  for (const cases::BodySpec& body : spec.bodies)
    for (const mesh::RawBlock& block : mesh.groups.at(body.mesh_group()).blocks)
      for (const Index node : block.nodes) carried[as_size(node)] = 1;
  return carried;
}

/// A group of full dimension with nodes that lie on no body: a [[body]] was forgotten, and what would face it
/// is insulated.
void warn_of_forgotten_bodies(const cases::CaseSpec& spec, const RawMesh& mesh) {
  const std::vector<char> carried = nodes_of_bodies(spec, mesh);
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension) continue;
    const bool left_out =
        std::any_of(group.blocks.begin(), group.blocks.end(), [&](const mesh::RawBlock& block) {
          return std::any_of(block.nodes.begin(), block.nodes.end(),
                             [&](Index node) { return carried[as_size(node)] == 0; });
        });
    if (left_out)
      logging::warn(
          "{}: the mesh has a group '{}' that lies on no body of the case: it is left out, and what touches "
          "it is insulated there; a [[body]] for it, if it is there",
          spec.mesh.where.text(), name);
  }
}

/// Faces that belong to no element of a body, such as those of surfaces that a geometry program has replaced,
/// take no part: a film or a contact would be smaller than its group without a word.
void warn_of_loose_faces(const cases::CaseSpec& spec, const RawMesh& mesh) {
  const std::vector<char> carried = nodes_of_bodies(spec, mesh);
  // Groups that something acts on, of one dimension less than the mesh.
  std::set<std::string> used;
  for (const auto& c : spec.thermal_conditions) used.insert(c.group);
  for (const auto& s : spec.sources) used.insert(s.groups.begin(), s.groups.end());
  for (const auto& c : spec.mechanical_conditions) used.insert(c.group);
  for (const auto& c : spec.contacts) used.insert({c.sides()[0], c.sides()[1]});
  for (const std::string& name : used) {
    const auto group = mesh.groups.find(name);
    if (group == mesh.groups.end() || group->second.dimension != mesh.dimension - 1) continue;
    std::size_t faces = 0, loose = 0;
    for (const mesh::RawBlock& block : group->second.blocks) {
      // A face is loose where one of its nodes lies on no body.
      const auto n = as_size(node_count(block.shape));
      for (std::size_t first = 0; first < block.nodes.size(); first += n, ++faces)
        loose += std::any_of(block.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                             block.nodes.begin() + static_cast<std::ptrdiff_t>(first + n),
                             [&](Index node) { return carried[as_size(node)] == 0; });
    }
    if (loose > 0)
      logging::warn("{} of the {} faces of the surface '{}' lie on no body of the case", loose, faces, name);
  }
}

/// Two bodies that hold the same elements would heat and load them twice.
void refuse_shared_elements(const cases::CaseSpec& spec, const RawMesh& mesh) {
  std::vector<mesh::VertexSet> sets;
  std::vector<std::size_t> body_of_set;
  // All elements of all bodies as sets of vertices, of which equal ones are found by sorting.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    mesh::append_element_vertex_sets(mesh.groups.at(spec.bodies[b].mesh_group()), sets);
    body_of_set.resize(sets.size(), b);
  }
  const std::vector<Index> first = mesh::first_equal_set(sets);
  // Counted by pairs of bodies, the first of which is told.
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> n_shared;  // (later body, earlier body)
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (const std::size_t other = body_of_set[as_size(first[i])]; other != body_of_set[i])
      ++n_shared[{body_of_set[i], other}];
  if (n_shared.empty()) return;
  const auto& [bodies, n] = *n_shared.begin();
  const cases::BodySpec &body = spec.bodies[bodies.first], &other = spec.bodies[bodies.second];
  throw InputError(
      body.where,
      fmt::format("the bodies '{}' and '{}' have {} elements in common, of {} of '{}'", other.name, body.name,
                  n, std::ranges::count(body_of_set, bodies.first), body.name),
      "groups of which no two hold the same element; solidus mesh-info lists them");
}

}  // namespace

void check_bodies_of(const cases::CaseSpec& spec, const mesh::RawMesh& mesh) {
  for (const cases::BodySpec& body : spec.bodies)
    require(mesh, body.mesh_group(), spec.dimension(), body.where, "body '" + body.name + "'");
}

void check_groups(const cases::CaseSpec& spec, const RawMesh& mesh) {
  // Every group that a section names has to be in the mesh, with the dimension that its use needs. The
  // message names the section and lists the groups there are.
  check_radius(spec, mesh);
  const int dimension = spec.dimension(), surface = dimension - 1;
  if (mesh.dimension != dimension)
    throw InputError(
        spec.mesh.where,
        fmt::format("{}: the mesh has {} dimensions, the analysis {}",
                    spec.mesh.file ? *spec.mesh.file : *spec.mesh.shape, mesh.dimension, dimension),
        "another `kind` in [analysis], or another mesh");
  check_bodies_of(spec, mesh);
  // No two bodies may own one group or share elements.
  std::vector<std::string> bodies;
  for (const cases::BodySpec& body : spec.bodies) {
    if (std::find(bodies.begin(), bodies.end(), body.mesh_group()) != bodies.end())
      throw InputError(body.where, fmt::format("the group '{}' belongs to two bodies", body.mesh_group()));
    bodies.push_back(body.mesh_group());
  }
  refuse_shared_elements(spec, mesh);
  for (const auto& l : spec.mesh.layers) {
    require(mesh, l.surface, surface, l.where, "layers of the mesh");
    require(mesh, l.body, dimension, l.where, "layers of the mesh");
  }
  // Conditions in a volume need a body, others a surface; those on values may be on any group.
  for (const auto& c : spec.thermal_conditions) {
    const std::string user = "thermal condition '" + c.name + "'";
    if (c.in_volume())
      require_body(spec, c.group, c.where, user);
    else
      require(mesh, c.group, c.kind == cases::ThermalConditionSpec::Kind::temperature ? -1 : surface, c.where,
              user);
  }
  for (const auto& s : spec.sources)
    for (const std::string& group : s.groups) {
      const std::string user = "source '" + s.name + "'";
      if (s.on_surface())
        require(mesh, group, surface, s.where, user);
      else
        require_body(spec, group, s.where, user);
    }
  for (const auto& d : spec.depositions) {
    const std::string user = "deposition '" + d.name + "'";
    require_body(spec, d.body, d.where, user);
    if (!d.bare.empty()) require(mesh, d.bare, surface, d.where, user);
  }
  for (const auto& c : spec.mechanical_conditions) {
    using Kind = cases::MechanicalConditionSpec::Kind;
    const std::string user = "mechanical condition '" + c.name + "'";
    if (c.kind == Kind::body_force)
      require_body(spec, c.group, c.where, user);
    else
      require(mesh, c.group, c.kind == Kind::displacement ? -1 : surface, c.where, user);
  }
  // The master of a contact may be a rigid surface instead of a group.
  std::vector<std::string> tools;
  for (const auto& s : spec.rigid_surfaces) tools.push_back(s.name);
  for (const auto& c : spec.contacts) {
    require(mesh, c.sides()[0], surface, c.where, "slave of contact '" + c.name + "'");
    if (spec.rigid_surface(c.sides()[1]) == nullptr)
      require(mesh, c.sides()[1], surface, c.where, "master of contact '" + c.name + "'", tools);
  }
  check_rigid_names(spec, mesh);
  for (const auto& p : spec.probes)
    if (!p.group.empty()) require(mesh, p.group, -1, p.where, "probe '" + p.name + "'");
  warn_of_loose_faces(spec, mesh);
  warn_of_forgotten_bodies(spec, mesh);
}

}  // namespace solidus::setup
