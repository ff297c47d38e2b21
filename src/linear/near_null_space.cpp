/// Rigid-body modes from the coordinates, constants for scalar fields.
#include "linear/near_null_space.hpp"

#include "numbers/index_casts.hpp"

namespace solidus::linear {

using multigrid::NearNullSpace;

NearNullSpace rigid_body_modes(const mesh::Mesh& mesh, int components) {
  const auto n = as_size(mesh.n_owned_nodes), nc = as_size(components);
  const auto modes = as_size(rigid_body_mode_count(components));
  NearNullSpace space{static_cast<int>(modes), std::vector<double>(n * nc * modes, 0.0)};
  for (std::size_t node = 0; node < n; ++node) {
    const mesh::Point& x = mesh.x[node];
    double* const rows = space.values.data() + node * nc * modes;
    // Translations are ones in their own component.
    for (std::size_t i = 0; i < nc; ++i) rows[i * modes + i] = 1;
    // Rotations about z, x and y.
    rows[0 * modes + nc] = -x[1];
    rows[1 * modes + nc] = x[0];
    if (nc < 3) continue;
    rows[1 * modes + 4] = -x[2];
    rows[2 * modes + 4] = x[1];
    rows[2 * modes + 5] = -x[0];
    rows[0 * modes + 5] = x[2];
  }
  return space;
}

int rigid_body_mode_count(int components) {
  return components == 3 ? 6 : 3;
}

NearNullSpace constants(const mesh::Mesh& mesh, int components) {
  const auto n = as_size(mesh.n_owned_nodes), nc = as_size(components);
  NearNullSpace space{components, std::vector<double>(n * nc * nc, 0.0)};
  for (std::size_t i = 0; i < n * nc; ++i) space.values[i * nc + i % nc] = 1;
  return space;
}

}  // namespace solidus::linear
