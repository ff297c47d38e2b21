/// A riser for a part that has none, as an opening guess.
#pragma once

#include "new_case/new_case_text.hpp"
#include "new_case/part_measures.hpp"

namespace solidus::model {

/// An upright cylinder with 1.2 times the modulus of the thickest place, and metal enough for the shrinkage
/// of all; on top of that of the thickest places that has the least metal above it.
/// @param shrinkage  of the alloy when it freezes, a share of its volume, positive
DraftRiser choose_riser(const PartMeasures& part, double shrinkage);

}  // namespace solidus::model
