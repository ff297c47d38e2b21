/// Shells that cross each other become one: programs that draw a casting of several solids often write them
/// as they were drawn, one sticking in the other.
#pragma once

#include <string>
#include <vector>

#include "mesh/making/closed_shells.hpp"

namespace solidus::mesh {

/// Unites shells of one name that cross each other or touch, by the union of what they enclose.
/// @param path   for messages
/// @param notes  a sentence for each union is added: how many shells, where, and the volume that they had in
///               common
/// Throws UnusableGeometry, with the place, where shells of different names cross each other, where one that
/// looks inward (a cavity) crosses one that looks outward, and where shells cannot be united, because one of
/// them crosses itself.
ClosedShells united_shells(ClosedShells all, const std::string& path, std::vector<std::string>& notes);

}  // namespace solidus::mesh
