/// Further runs along with a run, for the errors of its answers: `solidus run --sure`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/session.hpp"

namespace solidus::run {

/// Loads the case that ran, with further overrides.
using LoadBeside = std::function<setup::Case(const std::vector<std::string>& overrides)>;

/// What comes of the further runs.
struct ErrorRuns {
  results::Summary summary;  ///< that of the run, its answers with errors by comparison
  bool complete = true;      ///< both comparisons were made; else the estimates are kept where one is missing
};

/// Runs the case with longer steps and with larger elements (cases/nearby_case.hpp), in the folders
/// sure/longer_steps and sure/larger_elements of the run's, and takes the errors of its answers from the
/// differences (results/answers/answer_comparison.hpp). A further run that cannot be made, does not end or
/// does not differ enough leaves the estimate. Writes summary.json again. Collective.
/// @param summary             of the run, which must have ended
/// @param displacement_error  of the case (displacement_error() of setup/time_input.hpp) [m]
/// @param options             of the run
/// @param say                 told what is done, in sentences
ErrorRuns run_beside(const setup::Case& c, results::Summary summary, double displacement_error,
                     const RunOptions& options, const LoadBeside& load,
                     const std::function<void(const std::string&)>& say);

}  // namespace solidus::run
