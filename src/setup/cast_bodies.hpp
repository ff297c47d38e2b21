/// Selection of the bodies that are cast and of the feeders among them: the one place that decides it for
/// criteria and summary.
#pragma once

#include <vector>

#include "results/answers/answers.hpp"
#include "setup/assembly.hpp"

namespace solidus::setup {

/// The bodies that are poured: their material can freeze and they are hotter than its solidus somewhere at
/// the start. A chill of the same iron that starts cold is none. Of them those feed whose group is one of
/// criteria.feeders.
std::vector<results::CastBody> cast_bodies(const cases::CaseSpec& spec,
                                           const std::vector<material::Material>& materials,
                                           const std::vector<InitialTemperatureRange>& start);

/// The bodies whose melt criteria follow, [body]: those that are poured; where none is (a solid that is
/// melted in the course of the run), all that can melt.
std::vector<char> followed_bodies(const cases::CaseSpec& spec,
                                  const std::vector<material::Material>& materials,
                                  const std::vector<InitialTemperatureRange>& start);

}  // namespace solidus::setup
