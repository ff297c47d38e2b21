/// The answer of `solidus new` on the terminal: what was measured and chosen, and notes on what is doubtful.
#pragma once

#include <string>

#include "new_case/draft_refinement.hpp"
#include "new_case/new_case.hpp"
#include "new_case/new_case_text.hpp"
#include "new_case/part_measures.hpp"

namespace solidus::new_case {

/// Lines for people, in mm, cm³, °C and s.
std::string report_text(const Draft& draft, const PartMeasures& part, const DraftEstimate& estimate,
                        const NewCaseOptions& options);

}  // namespace solidus::new_case
