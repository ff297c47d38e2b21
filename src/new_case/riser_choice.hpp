/// A riser for a part that has none, as an opening guess.
#pragma once

#include <optional>

#include "new_case/new_case_text.hpp"
#include "new_case/part_measures.hpp"

namespace solidus::new_case {

/// An upright cylinder with 1.2 times the modulus of the thickest place, and metal enough for the shrinkage
/// of all; on top of that of the thickest places that has the least metal above it, moved by up to four
/// tenths of its diameter so that no metal rises beside it and little of its foot hangs over an edge.
///
/// The riser of half a part stands on the plane of symmetry, which halves it, where a place there is nearly
/// as thick as the thickest, or where it would touch its mirror image beside it. Else each half has one of
/// its own, with metal for its half.
/// @param shrinkage  of the alloy when it freezes, a share of its volume, positive
/// @param symmetry   half of the part is computed
DraftRiser choose_riser(const PartMeasures& part, double shrinkage,
                        const std::optional<DraftSymmetry>& symmetry);

}  // namespace solidus::new_case
