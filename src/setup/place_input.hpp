/// Makes the function that the phases evaluate from a quantity of the case that varies with position.
#pragma once

#include <memory>

#include "cases/case_spec.hpp"
#include "cases/stage_input.hpp"
#include "input/place_spec.hpp"
#include "numbers/place_function.hpp"

namespace solidus::setup {

/// Reads the files that it names. Values are checked as they are evaluated: one that is not finite or not in
/// the key's range is an InputError at the place in the case file, and says where and when it came up.
/// @param kind  what the coordinates are called: x, y; in axisymmetry r, z too, for x, y; in a solid x, y, z
/// Throws InputError for coordinates that the analysis does not have. Not collective.
std::shared_ptr<const PlaceLaw> place_law(const PlaceSpec& spec, AnalysisKind kind);

/// A function of the case on the clock that the user chose: a table of time, or a place. Throws as
/// place_law().
PlaceFunction place_function(const Function& function, cases::TimeOrigin clock, const cases::StageRun* stage,
                             AnalysisKind kind);

}  // namespace solidus::setup
