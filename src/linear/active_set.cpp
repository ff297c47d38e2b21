/// Bodies are named, nodes follow from their elements, faces from the elements that they bound.
#include "linear/active_set.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <unordered_set>

#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::linear {

namespace {

mesh::FaceKey face_of_element(const mesh::ElementBlock& block, Index element, int face) {
  const auto local = mesh::face_nodes(block.shape, face);
  std::array<Index, 4> vertices{};
  const int n = mesh::vertex_count(mesh::face_shape(block.shape));
  for (std::size_t i = 0; i < as_size(n); ++i) vertices[i] = block.element(element)[local[i]];
  return mesh::face_key(vertices.data(), n);
}

}  // namespace

ActiveSet::ActiveSet(const mesh::Mesh& mesh, std::span<const std::string> absent)
    : complete_(absent.empty()), bodies_(mesh.bodies.size(), 1), nodes_(mesh.x.size(), 1) {
  // Names become flags of bodies; a name that no body has is an error of the caller.
  for (const std::string& name : absent) {
    const auto found = std::find_if(mesh.bodies.begin(), mesh.bodies.end(),
                                    [&](const mesh::Body& body) { return body.name == name; });
    if (found == mesh.bodies.end())
      throw std::invalid_argument("no body '" + name + "' in the mesh that could be absent");
    bodies_[as_size(found - mesh.bodies.begin())] = 0;
  }
  // A process holds every element at the nodes it owns; their owners know the ghosts.
  std::vector<double> touched(mesh.x.size(), 0.0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (body(block.body))
      for (const Index node : block.nodes) touched[as_size(node)] = 1;
  // Without bodies that are absent all nodes have elements, but where a body grows (growing_mesh.hpp).
  const auto owned = static_cast<std::ptrdiff_t>(mesh.n_owned_nodes);
  if (complete_) {
    const bool bare = std::any_of(touched.begin(), touched.begin() + owned, [](double t) { return t == 0; });
    if (!parallel::any_process(bare)) return;
    complete_ = false;
  }
  parallel::GhostExchange(mesh).update(touched, 1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i] = touched[i] > 0 ? 1 : 0;
}

mesh::Surface ActiveSet::part(const mesh::Mesh& mesh, const mesh::Surface& surface) const {
  // Where two bodies share nodes, faces belong to one of them. If that body is absent, a face is part of the
  // surface only where an active body has an element on its other side. Faces are compared by the sorted
  // numbers of their vertices.
  using Faces = std::unordered_set<mesh::FaceKey, mesh::FaceKeyHash>;
  const auto key = [](const mesh::ElementBlock& faces, Index f) {
    return mesh::face_key(faces.element(f), mesh::vertex_count(faces.shape));
  };
  // First the faces in question are collected, then the faces of all elements of active bodies are searched
  // for them.
  Faces asked, found;
  for (const mesh::ElementBlock& faces : surface.faces)
    for (Index f = 0; reversed(faces) && f < faces.size(); ++f) asked.insert(key(faces, f));
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (asked.empty() || !body(block.body)) continue;
    for (Index e = 0; e < block.size(); ++e)
      for (int k = 0; k < mesh::face_count(block.shape); ++k) {
        const mesh::FaceKey face = face_of_element(block, e, k);
        if (asked.contains(face)) found.insert(face);
      }
  }
  // The part keeps the faces in their order, those that are counted first, so that n_counted goes on to hold.
  mesh::Surface part;
  for (const mesh::ElementBlock& faces : surface.faces) {
    mesh::ElementBlock& to = part.faces.emplace_back();
    to.shape = faces.shape;
    to.body = faces.body;
    for (Index f = 0; f < faces.size(); ++f) {
      if (reversed(faces) && !found.contains(key(faces, f))) continue;
      const Index* nodes = faces.element(f);
      to.nodes.insert(to.nodes.end(), nodes, nodes + mesh::node_count(faces.shape));
      to.input_element.push_back(faces.input_element[as_size(f)]);
      if (f < faces.n_counted) ++to.n_counted;
    }
  }
  return part;
}

}  // namespace solidus::linear
