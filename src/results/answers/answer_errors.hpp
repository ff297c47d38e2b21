/// Errors of the answers of a run from its steps and its mesh, as far as one run can tell
/// (docs/theory/step_and_mesh.md, "The error of an answer"); a comparison with nearby runs
/// (run/error_runs.hpp) tells more.
///
/// With η² of criteria::Resolution, that of the body and the largest of the others added up, and Δt the step
/// in which the last melt of a body froze, t its time to freeze:
///
///                        step                                  mesh
///   time to freeze       Δt/2                                  k η² t
///   gap g                its change in the last step, g Δt/2t  k η² g, 1/5 of the difference to around
///   distortion d         its change in the last step, d Δt/2t  k η² d, 1/2 of the difference to around
///   von Mises stress σ   its change in the last step, σ Δt/2t  k η² σ, the difference to around
///   pores                |ΔV/V| Δt/4t                          0.01 |ΔV/V| η
///   least Niyama N       N Δt/2t                               k η² N, 1/2 of the difference to around
///
/// with k = 0.65 in two dimensions and 0.15 in three, where meshes have few elements across a wall and η² is
/// large.
/// The difference to around is that of an extreme to the mean of its neighbours in the mesh. The factors are
/// those with which the sums cover the difference to a run with half the element and an eighth of the step in
/// most castings of many shapes, alloys and moulds (docs/verification/answer_errors.md).
#pragma once

#include <string>
#include <vector>

#include "coupling/phases.hpp"
#include "coupling/state.hpp"
#include "results/answers/answers.hpp"
#include "results/fields/field.hpp"

namespace solidus::results {

/// Copies of the fields from which answers are taken, at the ends of the last two steps.
class LastStep {
 public:
  /// A step was committed, and `bodies` shows its end.
  void step(const FieldSet& bodies);
  /// The values before the last step; empty where there are none, because fewer than two steps were seen.
  std::span<const double> before(std::string_view field) const;

 private:
  struct Kept {
    std::string field;
    std::vector<double> before, now;
  };
  std::vector<Kept> kept_;
};

/// Gives every answer that has one its error. Collective.
/// @param criteria  findings of the criteria, which have errors of their own
void add_errors(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::State& state,
                const FieldSet& fields, const LastStep& last, Answers& answers,
                const std::vector<criteria::CriterionResult>& criteria);

}  // namespace solidus::results
