/// How far melt sinks in each pool that gives some away.
///
/// A node i at heights from l_i to h_i is drained to the share x_i(L) = (h_i − L)/(h_i − l_i), between zero
/// and one, when melt reaches the level L. Of the metal that can move it gives the room m_i (x_i(L) − x_i),
/// with x_i its share so far; one level serves the nodes of a pool that air or vacuum can reach:
///
///   Σ_i m_i V_i max(0, x_i(L) − x_i)/v_i = M
///
/// m_i [-] the share of its metal that moves, V_i [m³] its room, v_i [-] the volume of its metal
/// (metal_volume.hpp), M [m³] the metal that leaves the pool. The left side is a broken line of L, found by
/// Newton's method between bounds.
#pragma once

#include <span>
#include <vector>

namespace solidus::criteria {

/// A node of a pool that can be drained.
struct DrainedNode {
  std::size_t node = 0, pool = 0;
  double low = 0, high = 0;  ///< l, h [m]
  double drained = 0;        ///< x; below zero where metal rises above its top
  double room = 0;           ///< m V [m³]
  double metal = 0;          ///< m V/v [m³]
  /// x(L) − x, not below zero.
  double gain(double level) const;
};

struct PoolLevel {
  double level = 0;  ///< L [m]
  double given = 0;  ///< metal that the nodes give down to L [m³]
};

/// One of each pool, the same on every process; where the nodes of a pool hold less than is asked of it, down
/// to its bottom. Collective.
/// @param nodes   of this process
/// @param metal   that leaves each pool [m³], the same on every process; none where it is not above zero
std::vector<PoolLevel> find_levels(std::span<const DrainedNode> nodes, std::span<const double> metal);

}  // namespace solidus::criteria
