/// The depth that a die loses to wear in a shot, and after how many shots it is worn out.
///
/// The contact room follows the depth h of wear by Archard's law at every point (contact/interface/wear.hpp).
/// In the periodic state of a die every shot wears the same depth, so that
///
///   Δh = h(end of the shot) − h(its start),   N = h_allowed / Δh.
///
/// Validity: the law's coefficient is constant over the life, and the shape of the die changes by so little
/// that its contact does not change (the geometry stays as it is).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/criterion_kind.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

class DieWear : public Criterion {
 public:
  /// Null where no body has a depth at which it is worn out.
  static std::unique_ptr<DieWear> make(const CriterionContext& context);
  explicit DieWear(const CriterionContext& context);

  CriterionRecord initial(const CriterionInput& start) const override;
  /// The shot goes on with further castings.
  CriterionRecord restart(const CriterionRecord& before, const CriterionInput& start) const override;
  CriterionRecord next_shot(const CriterionRecord& before, const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override;
  /// Fills the depth of the last complete shot or of the present one, whichever is larger, and the shots.
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// The largest depth in a shot and the fewest shots, with their places.
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;

 private:
  double in_shot(const CriterionRecord& record, std::size_t node) const;
  double shots(double depth, std::size_t node) const;

  const mesh::Mesh& mesh_;
  std::vector<DieLimits> limits_;  ///< [body]
  std::vector<int> body_;          ///< followed body of a node, −1: none; [local node]
  parallel::GhostExchange ghosts_;
};

}  // namespace solidus::criteria
