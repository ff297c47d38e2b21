/// A description of the case that `solidus new` is about to make, before anything is meshed, for a page that
/// shows it.
#pragma once

#include <string>

#include "new_case/new_case_text.hpp"
#include "new_case/part_measures.hpp"

namespace solidus::new_case {

/// JSON with the corners of the mould (or of the room of the shell), its walls, the sizes of elements and the
/// risers of the draft. All lengths are in metres.
std::string preview_text(const Draft& draft, const PartMeasures& part);

}  // namespace solidus::new_case
