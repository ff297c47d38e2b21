/// Keys of [[mesh.riser]] and [[mesh.chill]].
#pragma once

#include "cases/feeder_spec.hpp"
#include "input/keys.hpp"

namespace solidus::cases {

Section<RiserBlockSpec> riser_keys();
Section<ChillBlockSpec> chill_keys();

/// Throws InputError for risers and chills that no solid can be made of.
void check_feeders(const std::vector<RiserBlockSpec>& risers, const std::vector<ChillBlockSpec>& chills);

}  // namespace solidus::cases
