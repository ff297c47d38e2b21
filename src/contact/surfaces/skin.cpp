/// Means of the nodes on each side by their shares; the weaker side decides what the skin does.
#include "contact/surfaces/skin.hpp"

#include <algorithm>
#include <array>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

Skin skin_at(std::span<const Index> nodes, std::span<const double> share, std::size_t n_slave,
             const Solidity& of_nodes) {
  std::array<double, 2> side{}, solid{};
  std::array<bool, 2> molten{true, true};
  // Coherency of both sides at the point, and that which it would have as a solid.
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    const std::size_t of = b < n_slave ? 0 : 1;
    const auto node = as_size(nodes[b]);
    const double at_node = of_nodes.coherency[node], part = of == 0 ? share[b] : -share[b];
    side[of] += part * at_node;
    solid[of] += part * (of_nodes.of_solid.empty() ? 1.0 : of_nodes.of_solid[node]);
    molten[of] = molten[of] && at_node < k_coherent;
  }
  Skin skin;
  // Strength is coherency above 1 as a share of the solid's, and the weaker side decides; a side below
  // coherency is molten.
  for (std::size_t of = 0; of < (nodes.size() > n_slave ? 2 : 1); ++of) {
    const double range = solid[of] - 1, above = side[of] - 1;
    skin.strength =
        std::min(skin.strength, range > 1 - k_coherent ? std::clamp(above / range, 0.0, 1.0) : 1.0);
    if (side[of] >= k_coherent) continue;
    skin.strength = 0;
    skin.molten = true;
    skin.liquid = skin.liquid || molten[of];
  }
  return skin;
}

}  // namespace solidus::contact
