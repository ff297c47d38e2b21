/// The faces of a mesh that one element alone of a body has: the skins of the bodies, face by face, over all
/// processes.
#pragma once

#include <array>
#include <functional>
#include <set>
#include <span>
#include <string>

#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::mesh {

/// A face of an element, by its vertices in rising order of their numbers over all processes.
struct BodyFace {
  std::array<GlobalIndex, 4> key{-1, -1, -1, -1};
  int body = 0;
  std::array<Index, 8> nodes{};  ///< in the order of the element, outward: vertices first
  int n_vertices = 0, n_nodes = 0;
  std::span<const Index> vertices() const { return std::span(nodes).first(as_size(n_vertices)); }
  std::span<const Index> all_nodes() const { return std::span(nodes).first(as_size(n_nodes)); }
};

/// The key of a face with these vertices.
std::array<GlobalIndex, 4> body_face_key(const Mesh& mesh, std::span<const Index> vertices);

/// The keys of this process's faces of surfaces; groups that are no surfaces have none.
std::set<std::array<GlobalIndex, 4>> body_face_keys(const Mesh& mesh, const std::set<std::string>& surfaces);

/// Calls visit(face, same) for each face that one element alone of its body has; `same` are the faces with
/// the same vertices, those of other bodies included. A face is visited by the process that owns its lowest
/// vertex. In bounded memory: faces are looked at a part at a time.
void each_body_face(const Mesh& mesh,
                    const std::function<void(const BodyFace& face, std::span<const BodyFace> same)>& visit);

/// The same of each such face that has a vertex owned here, on every process that owns one. `same` is whole.
void each_body_face_at_owned(
    const Mesh& mesh, const std::function<void(const BodyFace& face, std::span<const BodyFace> same)>& visit);

}  // namespace solidus::mesh
