/// The table of what a case was understood to be (results/overview.hpp).
#pragma once

#include "model/case_measures.hpp"
#include "results/overview.hpp"

namespace solidus::model {

results::Overview overview(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m);

}  // namespace solidus::model
