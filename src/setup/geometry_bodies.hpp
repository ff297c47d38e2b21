/// The bodies of a geometry that `solidus new` makes a case of, with their roles.
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "mesh/making/hot_spots.hpp"

namespace solidus::setup {

/// A body of the file.
struct GeometryBody {
  std::string name;
  cases::Role role = cases::Role::casting;
  mesh::BodyExtent extent;
};

/// Preference of a name for a body (mesh/files/body_partition.hpp): 2 where it tells a role.
int body_preference(const std::string& group);

/// Finds the bodies of a mesh and their roles. Where groups hold the same elements it chooses those that are
/// bodies and names the others in the log.
/// @param as    "NAME=ROLE"; without one the name of a body tells its role
/// @param path  of the mesh, for messages
/// Throws InputError for a role or a body that there is not, where no body is a casting, and where groups
/// overlap so that none of them can be the bodies.
std::vector<GeometryBody> bodies_of(const mesh::RawMesh& mesh, const std::vector<std::string>& as,
                                    const std::string& path);

}  // namespace solidus::setup
