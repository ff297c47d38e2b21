/// How long a die is hot enough in a shot for metal to stick to it (soldering).
///
/// Aluminium and steel react above a critical temperature of the die's surface to a liquid rich in aluminium,
/// which joins casting and die as it freezes: the solidus of what the two alloys make together (Q. Han, S.
/// Viswanathan, Metall. Mater. Trans. A 34 (2003) 139). The criterion measures the time above this
/// temperature,
///
///   t_s = ∫ [Θ > Θ_s] dt over a shot,
///
/// with temperatures linear in a step. Θ_s is the user's: iron in the alloy, coatings and lubricants decide
/// it. Validity: it tells places and designs apart; there is no published limit of t_s.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/criterion_kind.hpp"

namespace solidus::criteria {

/// Part of a step in which a temperature that goes linearly from one value to another lies above a limit.
double part_above(double from, double to, double limit);

class Soldering : public Criterion {
 public:
  /// Null where no body has a soldering temperature, or no heat is followed.
  static std::unique_ptr<Soldering> make(const CriterionContext& context);
  explicit Soldering(const CriterionContext& context);

  CriterionRecord initial(const CriterionInput& start) const override;
  /// The shot goes on with further castings.
  CriterionRecord restart(const CriterionRecord& before, const CriterionInput& start) const override;
  CriterionRecord next_shot(const CriterionRecord& before, const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override;
  /// Fills the time of the last complete shot or of the present one, whichever is longer.
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// The longest time, with its place.
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;

 private:
  double longest(const CriterionRecord& record, std::size_t node) const;

  const mesh::Mesh& mesh_;
  std::vector<DieLimits> limits_;  ///< [body]
  std::vector<int> body_;          ///< followed body of a node, −1: none; [local node]
};

}  // namespace solidus::criteria
