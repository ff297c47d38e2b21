/// The bodies of a geometry that `solidus new` makes a case of, with their roles.
#pragma once

#include <string>
#include <vector>

#include "case/case_spec.hpp"
#include "mesh/hot_spots.hpp"

namespace solidus::model {

/// A body of the file.
struct GeometryBody {
  std::string name;
  Role role = Role::casting;
  mesh::BodyExtent extent;
};

/// @param as  "NAME=ROLE"; without one the name of a body tells its role
/// Throws InputError for a role or a body that there is not, and where no body is a casting.
std::vector<GeometryBody> bodies_of(const mesh::RawMesh& mesh, const std::vector<std::string>& as);

}  // namespace solidus::model
