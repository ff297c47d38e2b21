/// Makes the overview of a case (results/overview.hpp).
#pragma once

#include "check/case_measures.hpp"
#include "results/overview.hpp"

namespace solidus::model {

results::Overview overview(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m);

}  // namespace solidus::model
