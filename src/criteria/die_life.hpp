/// The strain range of a die from shot to shot, and how many shots it bears until its skin cracks by thermal
/// fatigue (fatigue_law.hpp, docs/theory/criteria.md).
///
/// A node has its hottest and its coldest moment in every shot. Where the die deforms, the range is the
/// equivalent strain between the two,
///
///   Δε = 3/(2 (1 + ν)) √(2/3 e:e),   e the deviator of ε_hot − ε_cold
///
/// which is the range of strain of a bar under one stress; thermal strain, which is the same in all
/// directions, is not in it. Where a die only conducts heat, its skin is taken as held in both of its
/// directions,
///
///   Δε = 2 |α(Θ_hot)(Θ_hot − Θ_ref) − α(Θ_cold)(Θ_cold − Θ_ref)|
///
/// an upper bound for a die that was free at first: what is held completely and yields, whose thickness
/// takes up what its sides cannot.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/element_strain.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

class DieLife : public Criterion {
 public:
  /// Null where no fatigue is followed, or no heat is.
  static std::unique_ptr<DieLife> make(const CriterionContext& context);
  explicit DieLife(const CriterionContext& context);

  CriterionRecord initial(const CriterionInput& start) const override;
  /// The shot goes on with further castings.
  CriterionRecord restart(const CriterionRecord& before, const CriterionInput& start) const override;
  /// The range of the shot before is kept.
  CriterionRecord next_shot(const CriterionRecord& before, const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override;
  /// Fills the range of strain of the last complete shot or of the present one, whichever is larger.
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// The largest range and the fewest shots, with their places.
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;

 private:
  /// A block of a body whose deformation is known.
  struct Deforming {
    ElementStrain strain;
    const mesh::ElementBlock* block;
  };
  std::vector<double> strains(const CriterionInput& moment) const;
  double present_range(const CriterionRecord& record, std::size_t node) const;
  double range(const CriterionRecord& record, std::size_t node) const;

  const mesh::Mesh& mesh_;
  std::vector<std::optional<FatigueLaw>> laws_;  ///< [body]
  std::vector<Table> expansion_, poisson_;       ///< [body]
  std::vector<double> reference_;                ///< [body] of the expansion [K]
  std::vector<int> body_;                        ///< whose law a node has, −1: none; [local node]
  std::vector<Deforming> blocks_;
  parallel::GhostExchange ghosts_;
};

}  // namespace solidus::criteria
