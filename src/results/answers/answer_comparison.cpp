/// Each error is the difference of two answers times the factor of Richardson's extrapolation.
#include "results/answers/answer_comparison.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::results {

namespace {

class Comparison {
 public:
  Comparison(ErrorPart part, double ratio) : part_(part), factor_(k_safety / (ratio - 1)) {}

  void take(double value, double beside, std::optional<ErrorBand>& error) const {
    if (!error) error.emplace();
    double& of_part = part_ == ErrorPart::step ? error->step : error->mesh;
    of_part = std::max(factor_ * std::abs(value - beside), k_least * of_part);
    (part_ == ErrorPart::step ? error->step_compared : error->mesh_compared) = true;
  }
  void take(ValueAt& value, const ValueAt& beside) const { take(value.value, beside.value, value.error); }
  void take(std::optional<ValueAt>& value, const std::optional<ValueAt>& beside) const {
    if (value && beside) take(*value, *beside);
  }

 private:
  static constexpr double k_safety = 1.25, k_least = 0.5;
  ErrorPart part_;
  double factor_;
};

void compare_gaps(const Comparison& comparison, const std::vector<GapAnswer>& beside,
                  std::vector<GapAnswer>& gaps) {
  for (GapAnswer& gap : gaps) {
    const auto other = std::ranges::find(beside, gap.contact, &GapAnswer::contact);
    if (other != beside.end()) comparison.take(gap.gap, other->gap);
  }
}

}  // namespace

void compare_errors(ErrorPart part, double ratio, const Answers& beside,
                    const std::vector<criteria::CriterionResult>& beside_criteria, Answers& answers,
                    const std::vector<criteria::CriterionResult>& criteria) {
  const Comparison comparison(part, ratio);
  // Answer by answer with the same one of the other run; criteria are found by their names.
  for (std::size_t i = 0; i < answers.castings.size() && i < beside.castings.size(); ++i)
    comparison.take(answers.castings[i].froze, beside.castings[i].froze);
  // Gaps and overlaps are matched by their contact, the others are single values.
  compare_gaps(comparison, beside.gaps, answers.gaps);
  compare_gaps(comparison, beside.overlaps, answers.overlaps);
  comparison.take(answers.distortion, beside.distortion);
  comparison.take(answers.stress, beside.stress);
  if (answers.pores)
    comparison.take(answers.pores->share, beside.pores ? beside.pores->share : 0.0, answers.pores->error);
  for (auto& [name, error] : answers.criteria_errors) {
    const auto own = std::ranges::find(criteria, name, &criteria::CriterionResult::name);
    const auto other = std::ranges::find(beside_criteria, name, &criteria::CriterionResult::name);
    // A criterion that only one of the runs has cannot be compared.
    if (own == criteria.end() || other == beside_criteria.end()) continue;
    std::optional<ErrorBand> found = error;
    comparison.take(own->value, other->value, found);
    error = *found;
  }
}

}  // namespace solidus::results
