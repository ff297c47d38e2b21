/// A body is cast if it starts above its solidus and its role is one that is poured; names tell feeders
/// only where the case does not.
#include "setup/cast_bodies.hpp"

#include <algorithm>

#include "cases/roles.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::setup {

std::vector<results::CastBody> cast_bodies(const cases::CaseSpec& spec,
                                           const std::vector<material::Material>& materials,
                                           const std::vector<InitialTemperatureRange>& start) {
  std::vector<results::CastBody> cast;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    // What can freeze and starts above its solidus somewhere counts, unless its role denies it.
    const material::PhaseChange* freezing = materials[b].solidification();
    if (freezing == nullptr || start[b].high <= freezing->fraction.solidus()) continue;
    const cases::BodySpec& body = spec.bodies[b];
    const cases::Role role = cases::role_of(body, materials[b]);
    if (!cases::is_poured(role)) continue;
    const std::vector<std::string>& feeders = spec.criteria.feeders;
    // Names tell only where the case does not.
    const bool named = feeders.empty() && cases::role_in_name(body.name) == cases::Role::riser;
    const bool feeds = role == cases::Role::riser || named ||
                       std::find(feeders.begin(), feeders.end(), body.mesh_group()) != feeders.end();
    const bool gates =
        role == cases::Role::gating || (!body.role && cases::role_in_name(body.name) == cases::Role::gating);
    cast.push_back({static_cast<int>(b), spec.bodies[b].name, feeds, gates && !feeds});
  }
  return cast;
}

std::vector<char> followed_bodies(const cases::CaseSpec& spec,
                                  const std::vector<material::Material>& materials,
                                  const std::vector<InitialTemperatureRange>& start) {
  std::vector<char> followed(spec.bodies.size(), 0);
  for (const results::CastBody& cast : cast_bodies(spec, materials, start)) followed[as_size(cast.body)] = 1;
  if (std::find(followed.begin(), followed.end(), 1) == followed.end())
    for (std::size_t b = 0; b < materials.size(); ++b)
      followed[b] = materials[b].solidification() != nullptr ? 1 : 0;
  return followed;
}

}  // namespace solidus::setup
