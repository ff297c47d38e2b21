/// Nodal fields of bodies that share nodes: bodies of different materials have different ones there.
#pragma once

#include <vector>

#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

/// The number of nodal fields and that of each body.
struct BodyFields {
  int n_fields = 1;
  std::vector<int> of_body;  ///< [body]
};

/// As few fields as there can be. Collective.
/// @param blocks  1 for blocks of the mesh whose nodes have a value, [block]
BodyFields body_fields(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                       const std::vector<char>& blocks);

}  // namespace solidus::mechanics
