/// Keys of [[mesh.riser]], [[mesh.gating]] and [[mesh.chill]].
#pragma once

#include "cases/feeder_spec.hpp"
#include "input/keys.hpp"

namespace solidus::cases {

Section<RiserBlockSpec> riser_keys();
Section<GatingBlockSpec> gating_keys();
Section<ChillBlockSpec> chill_keys();

/// Throws InputError for risers, gating and chills that no solid can be made of.
void check_feeders(const std::vector<RiserBlockSpec>& risers, const std::vector<GatingBlockSpec>& gatings,
                   const std::vector<ChillBlockSpec>& chills);

}  // namespace solidus::cases
