/// Colours the bodies of the mesh so that two with a common node get different fields.
#include "mechanics/state/body_fields.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

BodyFields body_fields(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                       const std::vector<char>& blocks) {
  // Bodies of different materials that share a node need a field of their own there, because the same
  // temperature gives them different fractions.
  const std::size_t n = mesh.bodies.size();
  std::vector<char> at_node(mesh.x.size() * n, 0);
  std::vector<int> touching(n * n, 0);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    if (!blocks[b]) continue;
    for (const Index node : mesh.blocks[b].nodes)
      at_node[as_size(node) * n + as_size(mesh.blocks[b].body)] = 1;
  }
  for (std::size_t node = 0; node < mesh.x.size(); ++node)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; at_node[node * n + a] && b < n; ++b)
        if (at_node[node * n + b] && materials[a].name != materials[b].name) touching[a * n + b] = 1;
  // Fields are given greedily: each body takes the first one that no touching body has.
  processes::largest(touching);
  BodyFields fields{1, std::vector<int>(n, 0)};
  for (std::size_t a = 0; a < n; ++a) {
    const auto taken = [&](int field) {
      for (std::size_t b = 0; b < a; ++b)
        if (touching[a * n + b] && fields.of_body[b] == field) return true;
      return false;
    };
    while (taken(fields.of_body[a])) ++fields.of_body[a];
    fields.n_fields = std::max(fields.n_fields, fields.of_body[a] + 1);
  }
  return fields;
}

}  // namespace solidus::mechanics
