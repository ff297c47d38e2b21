/// The faults of a mesh are searched; what can be mended without a choice is mended and told, the rest is
/// refused.
#include "setup/mesh_soundness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "mesh/surfaces/soundness.hpp"
#include "numbers/index_casts.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

using Skins = std::vector<std::vector<mesh::OuterFace>>;  // [body]

std::string in_mm(const mesh::Point& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
}

/// [node] whether it lies on a surface of a contact: parts of one body may touch there.
std::vector<char> nodes_in_contact(const cases::CaseSpec& spec, const mesh::RawMesh& mesh) {
  std::vector<char> marked(mesh.x.size(), 0);
  for (const cases::ContactSpec& contact : spec.contacts)
    for (const std::string& side : contact.sides())
      if (const auto group = mesh.groups.find(side); group != mesh.groups.end())
        for (const mesh::RawBlock& block : group->second.blocks)
          for (const Index node : block.nodes) marked[as_size(node)] = 1;
  return marked;
}

void drop_repeated_things(const cases::CaseSpec& spec, mesh::RawMesh& mesh) {
  for (const cases::BodySpec& body : spec.bodies)
    if (const std::size_t n = mesh::drop_repeated(mesh.groups.at(body.mesh_group())); n > 0)
      logging::warn("{} elements of the body '{}' are in the mesh twice; each counts once", n, body.name);
  for (const auto& [name, where] : wanted_surfaces(spec))
    if (const auto group = mesh.groups.find(name); group != mesh.groups.end())
      if (const std::size_t n = mesh::drop_repeated(group->second); n > 0)
        logging::warn("{} faces of the surface '{}' are in the mesh twice; each counts once", n, name);
}

void refuse_inner_faces(const cases::CaseSpec& spec, const mesh::RawMesh& mesh, const Skins& skins) {
  std::vector<std::string> bodies;
  for (const cases::BodySpec& body : spec.bodies) bodies.push_back(body.mesh_group());
  for (const auto& [name, where] : wanted_surfaces(spec)) {
    const auto group = mesh.groups.find(name);
    if (group == mesh.groups.end() || group->second.dimension != mesh.dimension - 1) continue;
    const mesh::InnerFaces inner = mesh::inner_faces(mesh, bodies, skins, group->second);
    if (inner.n > 0)
      throw InputError(
          where,
          fmt::format("{} of the {} faces of '{}' lie inside of a body, one of them at {}: what acts on "
                      "a surface would act within the body",
                      inner.n, inner.n_all, name, in_mm(inner.where)),
          "faces on the skin of a body");
  }
}

}  // namespace

std::map<std::string, SourceLocation> wanted_surfaces(const cases::CaseSpec& spec) {
  std::map<std::string, SourceLocation> wanted;
  for (const auto& s : spec.sources)
    for (const std::string& group : s.groups)
      if (s.on_surface()) wanted.try_emplace(group, s.where);
  for (const auto& c : spec.thermal_conditions)
    if (!c.in_volume() && c.kind != cases::ThermalConditionSpec::Kind::temperature)
      wanted.try_emplace(c.group, c.where);
  for (const auto& c : spec.mechanical_conditions)
    if (c.on_faces() || c.kind == cases::MechanicalConditionSpec::Kind::plane)
      wanted.try_emplace(c.group, c.where);
  for (const auto& c : spec.contacts)
    for (const std::string& side : c.sides())
      if (spec.rigid_surface(side) == nullptr) wanted.try_emplace(side, c.where);
  for (const auto& l : spec.mesh.layers) wanted.try_emplace(l.surface, l.where);
  return wanted;
}

void make_sound(const cases::CaseSpec& spec, mesh::RawMesh& mesh) {
  // What is there twice goes first, as it would hide faces of the skins, on which all that follows looks.
  drop_repeated_things(spec, mesh);
  // The skin of each body is found once for all checks.
  Skins skins;
  for (const cases::BodySpec& body : spec.bodies)
    skins.push_back(mesh::faces_on_skin(mesh, body.mesh_group()));
  refuse_inner_faces(spec, mesh, skins);
  const std::vector<char> in_contact = nodes_in_contact(spec, mesh);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    std::vector<mesh::OuterFace>& skin = skins[b];
    // Halves that coincide corner on corner are joined; only then are corners that still lie in a face
    // errors.
    if (const mesh::Crack crack = mesh::find_crack(mesh, skin, in_contact); crack.n_pairs > 0) {
      logging::warn(
          "{} pairs of faces inside of the body '{}' coincide, one of them at {}, and share no nodes: they "
          "are "
          "joined. A [[contact]] between two surfaces keeps parts of a body apart",
          crack.n_pairs, body.name, in_mm(crack.where));
      mesh::replace_nodes(mesh, crack.replaced);
      skin = mesh::faces_on_skin(mesh, body.mesh_group());
    }
    // Nodes that hang make the mesh unsound, which is told when it is used.
    const mesh::HangingNodes hanging = mesh::hanging_nodes(mesh, skin, in_contact);
    if (hanging.n > 0 && !mesh.unsound)
      mesh.unsound.emplace(
          body.where,
          fmt::format(
              "{} nodes hang in faces of the body '{}' without being their corners, one of them at {}: "
              "the mesh is not joined there, no heat and no force would go across",
              hanging.n, body.name, in_mm(hanging.where)),
          "a mesh whose elements share their faces; or two bodies, and a [[contact]] between their surfaces");
    // Pieces are no mistake by themselves: a body may be two chills.
    if (const std::size_t pieces = mesh::n_pieces(mesh, body.mesh_group()); pieces > 1)
      logging::info("the body '{}' is in {} pieces that share no nodes", body.name, pieces);
  }
  // At last whether one body lies within another.
  for (std::size_t a = 0; a < skins.size(); ++a)
    for (std::size_t b = 0; b < skins.size(); ++b) {
      constexpr double k_most = 0.5;
      const double share = a == b ? 0 : mesh::share_inside(mesh, spec.bodies[b].mesh_group(), skins[a]);
      if (share > k_most)
        throw InputError(
            spec.bodies[b].where,
            fmt::format("the bodies '{}' and '{}' are in one place: {:.0f} % of the elements of '{}' lie "
                        "inside of '{}'",
                        spec.bodies[a].name, spec.bodies[b].name, 100 * share, spec.bodies[b].name,
                        spec.bodies[a].name),
            "bodies next to each other; a mould is hollow where its casting is");
    }
}

}  // namespace solidus::setup
