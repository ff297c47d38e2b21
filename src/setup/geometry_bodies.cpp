/// Volumes of a geometry are told apart by name and place, with the role that each may have.
#include "setup/geometry_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "cases/roles.hpp"
#include "input/keys.hpp"
#include "mesh/files/body_partition.hpp"
#include "numbers/index_casts.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

std::map<std::string, cases::Role> wanted_roles(const std::vector<std::string>& as) {
  const std::vector<cases::Role> all = {cases::Role::casting, cases::Role::riser, cases::Role::gating,
                                        cases::Role::mould,   cases::Role::core,  cases::Role::chill,
                                        cases::Role::sleeve,  cases::Role::die,   cases::Role::insulation};
  std::map<std::string, cases::Role> wanted;
  // All roles by the names that a case gives them.
  std::vector<std::string> names;
  for (const cases::Role role : all) names.emplace_back(cases::name(role));
  // Each assignment names a body and one of the roles.
  for (const std::string& assignment : as) {
    const std::size_t equals = assignment.find('=');
    const std::string what = equals == std::string::npos ? "" : assignment.substr(equals + 1);
    const auto role = std::ranges::find(names, what);
    if (equals == 0 || role == names.end())
      throw InputError({"--as"}, fmt::format("'{}' gives no body a role", assignment),
                       "--as NAME=ROLE, a role being " + one_of(names, what));
    wanted[assignment.substr(0, equals)] = all[as_size(role - names.begin())];
  }
  return wanted;
}

}  // namespace

int body_preference(const std::string& group) {
  // "casting" tells no role, as what has no other role is cast.
  std::string low = group;
  std::ranges::transform(low, low.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return cases::role_in_name(group) || low.find("casting") != std::string::npos
             ? 2
             : mesh::plain_preference(group);
}

std::vector<GeometryBody> bodies_of(const mesh::RawMesh& mesh, const std::vector<std::string>& as,
                                    const std::string& path) {
  std::map<std::string, cases::Role> wanted = wanted_roles(as);
  // The names of assignments preferred, so that a group which the user names is a body in any case.
  std::vector<GeometryBody> bodies;
  std::vector<std::string> names;
  const mesh::BodyPartition partition = mesh::partition_of(mesh, path, [&](const std::string& group) {
    return wanted.contains(group) ? 3 : body_preference(group);
  });
  for (const std::string& note : partition.notes) logging::info("{}: {}", path, note);
  // The role given by the user goes before the one that the name of the group tells; a body without either is
  // a casting.
  for (const std::string& group : partition.bodies) {
    names.push_back(group);
    GeometryBody& body =
        bodies.emplace_back(GeometryBody{group, cases::Role::casting, mesh::extent_of(mesh, group)});
    if (const auto role = wanted.find(group); role != wanted.end()) {
      body.role = role->second;
      wanted.erase(role);
    } else if (const auto told = cases::role_in_name(group)) {
      body.role = *told;
    }
  }
  // What is left over names no body; and a part needs a casting.
  if (!wanted.empty())
    throw InputError({"--as"}, fmt::format("the geometry has no body '{}'", wanted.begin()->first),
                     one_of(names, wanted.begin()->first));
  if (std::ranges::none_of(bodies, [](const GeometryBody& b) { return b.role == cases::Role::casting; }))
    throw InputError({"--as"}, "no body of the geometry is a casting",
                     fmt::format("--as NAME=casting, of {}", fmt::join(names, ", ")));
  return bodies;
}

}  // namespace solidus::setup
