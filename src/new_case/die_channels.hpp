/// Channels that a drawing of a die has: bores for water or oil, told from other holes by their skin.
#pragma once

#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::new_case {

/// A bore of a die.
struct DieChannel {
  std::string die;                  ///< the body
  mesh::Point place{};              ///< on its skin [m]
  double diameter = 0, length = 0;  ///< [m]
  bool operator==(const DieChannel&) const = default;
};

/// The smooth parts of the free skin of a die that are bores: they close around an axis, their normals point
/// at it, and none of their nodes is at a surface that the die shares with another body, as the mouth of a
/// hole for an ejector or a core pin is, and they are as wide as channels are made, 4 to 25 mm. The longest
/// first.
/// @param free    the group of the die's skin that faces no other body
/// @param shared  groups of the die's skin that do
std::vector<DieChannel> die_channels(const mesh::RawMesh& mesh, const std::string& die,
                                     const std::string& free, const std::vector<std::string>& shared);

/// The speed of water at 30 °C that is taken for a channel: 1 m/s, in a narrow one as much more as makes the
/// flow turbulent, Re = 10 000 [m/s].
/// @param diameter  [m]
double speed_of_water(double diameter);

/// The coefficient of water at 30 °C and that speed, Nu = 0.023 Re^0.8 Pr^0.4 (F. W. Dittus, L. M. K.
/// Boelter, Univ. California Publ. Eng. 2 (1930) 443–461, with the constant of W. H. McAdams, Heat
/// Transmission, 1954): 5.3 kW/(m² K) at 10 mm [W/(m² K)].
double film_of_water(double diameter);

}  // namespace solidus::new_case
