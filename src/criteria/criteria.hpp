/// The list of all criteria of a run.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "criteria/criterion.hpp"
#include "heat/thermal_phase.hpp"

namespace solidus::criteria {

/// Moments come without solid fractions and plateau shares; the criteria get them with.
class Criteria {
 public:
  /// @param phase  of the states to come; null: there is none. Must outlive the criteria.
  explicit Criteria(const heat::ThermalPhase* phase) : phase_(phase) {}
  void add(std::unique_ptr<Criterion> criterion) { list_.push_back(std::move(criterion)); }
  std::span<const std::unique_ptr<Criterion>> each() const { return list_; }
  /// Goes on with criteria of the same kinds for a mesh that has more elements.
  void replace(Criteria by);
  /// Gives criteria the wear of the present state of contact with every step (CriterionInput::wear).
  using Wear = std::function<std::vector<double>()>;
  void follow_wear(Wear wear) { wear_ = std::move(wear); }
  /// Hands on to each criterion how long plates take in the moulds (Criterion::know_plates).
  void know_plates(std::span<const PlateTimes> plates);

  CriteriaState initial(const CriterionInput& start) const;
  /// The same where other castings come while some stay (Criterion::restart).
  CriteriaState restart(const CriteriaState& before, const CriterionInput& start) const;
  /// The same where another shot begins (Criterion::next_shot).
  CriteriaState next_shot(const CriteriaState& before, const CriterionInput& start) const;
  /// Advances all criteria over a step, as Criterion::step does. `state` is that of t_n and becomes that of
  /// t_{n+1}. Collective.
  void step(const CriterionInput& old, const CriterionInput& next, CriteriaState& state);
  /// @param values  one span per field, in the order of fields_of()
  void fill(const CriterionInput& now, const CriteriaState& state,
            std::span<const std::span<double>> values) const;
  double seconds() const { return seconds_; }  ///< spent in steps so far

 private:
  /// Nodal solid fractions and plateau shares at a moment, from the thermal phase.
  struct NodalFractions {
    std::vector<double> solid_fraction, plateau_share, wear = {};
    CriterionInput of(const CriterionInput& moment) const {
      return {moment.time, moment.heat, moment.mechanics, solid_fraction, plateau_share, wear};
    }
  };
  NodalFractions phases_of(const CriterionInput& moment) const;
  /// The same with the wear of the present state of contact.
  NodalFractions present(const CriterionInput& moment) const;

  const heat::ThermalPhase* phase_;
  std::vector<std::unique_ptr<Criterion>> list_;
  std::vector<PlateTimes> plates_;
  Wear wear_;  ///< empty: nothing wears
  double seconds_ = 0;
};

/// The fields of all criteria, one after the other.
std::vector<const quantities::Quantity*> fields_of(const Criteria& criteria);
std::vector<CriterionResult> findings_of(const Criteria& criteria, const CriteriaState& state);
std::size_t bytes(const Criteria& criteria);

}  // namespace solidus::criteria
