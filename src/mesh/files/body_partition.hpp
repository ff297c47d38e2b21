/// Bodies among groups that hold the same elements: files of other programs name everything, each volume and
/// each material in sets of their own.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// How well a name stands for a body; the greater the better.
using NamePreference = std::function<int(const std::string& name)>;

/// 0 for a name that a program gives (Eall, Volume1, body_2), 1 for any other one.
int plain_preference(const std::string& name);

struct BodyPartition {
  std::vector<std::string> bodies;    ///< in alphabetical order; every element is in one of them
  std::vector<std::string> left_out;  ///< the other groups of full dimension
  std::vector<std::string> notes;     ///< what was left out and why, a sentence each
};

/// Chooses groups of full dimension that hold each element once: of groups with the same elements the one
/// with the better name, and instead of a group that others fill exactly, those others, unless its name is
/// better than theirs. A group inside of another whose other elements have no group is left out.
/// Throws InputError where no choice holds all elements once.
/// @param path  of the mesh, for messages
BodyPartition partition_of(const RawMesh& mesh, const std::string& path,
                           const NamePreference& preference = plain_preference);

}  // namespace solidus::mesh
