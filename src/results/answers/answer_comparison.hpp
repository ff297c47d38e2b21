/// Errors of the answers of a run from those of a further run, with longer steps or larger elements: with
/// a and b the answers and r the ratio of the numbers of steps, or of elements along an edge,
///
///   5/4 |a − b| / (r − 1)
///
/// which is Richardson's extrapolation for an error of first order, with the factor of safety of P. J.
/// Roache, Perspective: a method for uniform reporting of grid refinement studies, J. Fluids Eng. 116 (1994)
/// 405–413. An error of second order is then a third of it with r = 2. Two runs can agree by chance: what
/// comes out below half of the estimate is taken as that half.
#pragma once

#include <vector>

#include "results/answers/answers.hpp"

namespace solidus::results {

enum class ErrorPart { step, mesh };

/// Takes this part of the error of every answer that both runs have from the comparison, in place of the
/// estimate; an answer that only the run itself has keeps its estimate.
/// @param ratio   r, above one
/// @param beside  answers and findings of criteria of the other run
void compare_errors(ErrorPart part, double ratio, const Answers& beside,
                    const std::vector<criteria::CriterionResult>& beside_criteria, Answers& answers,
                    const std::vector<criteria::CriterionResult>& criteria);

}  // namespace solidus::results
