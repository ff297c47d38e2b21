/// Finds the group of a mesh that a thermal condition names, and gives names to powers.
#pragma once

#include <string>

#include "system/errors.hpp"

namespace solidus::heat {

/// Power of one condition into the bodies, over all processes.
struct NamedPower {
  std::string name;
  double value;  ///< [W]
};

/// Throws InputError, with the names that there are, where there is no such group.
/// @param kind  of group, for the message
template <class Map>
const typename Map::mapped_type& named_group(const Map& groups, const std::string& name, const char* kind) {
  const auto found = groups.find(name);
  if (found != groups.end()) return found->second;
  std::string allowed;
  for (const auto& group : groups) allowed += (allowed.empty() ? "" : ", ") + group.first;
  throw InputError({}, std::string("no ") + kind + " '" + name + "' in the mesh", allowed);
}

}  // namespace solidus::heat
