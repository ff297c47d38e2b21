/// Makes the overview of a case (results/overview.hpp).
#pragma once

#include "check/case_measures.hpp"
#include "results/overview.hpp"

namespace solidus::check {

results::Overview overview(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m);

}  // namespace solidus::check
