/// Risers for a part that has none, as an opening guess.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "new_case/feeding_distance.hpp"
#include "new_case/new_case_text.hpp"
#include "new_case/part_measures.hpp"

namespace solidus::new_case {

struct RiserChoice {
  std::vector<DraftRiser> risers;  ///< the one with the largest modulus below it first
  std::vector<std::string> notes;  ///< on places that none of them feeds
};

/// Upright cylinders, one for each group of thick places that is cut off from the others: where every way
/// through the metal is at its narrowest thinner than 0.8 of the place.
///
/// Each has 1.2 times the modulus of the thickest place of its group, and metal enough for the shrinkage of
/// what is nearer to it than to others. The modulus of a place is that of the metal within twice the radius
/// of the largest sphere there, its volume over its skin, between a third of the radius (a ball) and the
/// radius (a plate). It stands on that of the thickest places that has the least metal above it, in the
/// middle of the level ground there, moved so that no metal rises next to it and little of its foot hangs
/// over an edge. Where metal is further from all of them than an alloy is fed (feeding_distance.hpp), there
/// are more.
///
/// The riser of half a part stands on the plane of symmetry, which halves it, where a place there is nearly
/// as thick as the thickest, or where it would touch its mirror image next to it. Else each half has one of
/// its own, with metal for its half.
/// @param shrinkage  of the alloy when it freezes, a share of its volume, positive
/// @param distance   how far the alloy is fed; nothing where no rule is known
/// @param symmetry   half of the part is computed
RiserChoice choose_risers(const PartMeasures& part, double shrinkage,
                          const std::optional<FeedingDistance>& distance,
                          const std::optional<DraftSymmetry>& symmetry);

}  // namespace solidus::new_case
