/// The criteria of a run as one list: each call goes to all of them, in the order in which they are
/// declared.
#include "criteria/criteria.hpp"

#include <cassert>

#include "system/processes.hpp"

namespace solidus::criteria {

Criteria::NodalFractions Criteria::phases_of(const CriterionInput& moment) const {
  if (phase_ == nullptr) return {};
  return {phase_->states().solid_fraction(moment.heat), phase_->states().plateau_share(moment.heat)};
}

Criteria::NodalFractions Criteria::present(const CriterionInput& moment) const {
  NodalFractions all = phases_of(moment);
  if (wear_) all.wear = wear_();
  return all;
}

CriteriaState Criteria::initial(const CriterionInput& start) const {
  const NodalFractions phases = present(start);
  const CriterionInput whole = phases.of(start);
  CriteriaState state;
  for (const auto& criterion : list_) state.records.push_back(criterion->initial(whole));
  return state;
}

CriteriaState Criteria::restart(const CriteriaState& before, const CriterionInput& start) const {
  assert(before.records.size() == list_.size());
  const NodalFractions phases = phases_of(start);
  const CriterionInput whole = phases.of(start);
  CriteriaState state;
  for (std::size_t i = 0; i < list_.size(); ++i)
    state.records.push_back(list_[i]->restart(before.records[i], whole));
  return state;
}

CriteriaState Criteria::next_shot(const CriteriaState& before, const CriterionInput& start) const {
  assert(before.records.size() == list_.size());
  const NodalFractions phases = phases_of(start);
  const CriterionInput whole = phases.of(start);
  CriteriaState state;
  for (std::size_t i = 0; i < list_.size(); ++i)
    state.records.push_back(list_[i]->next_shot(before.records[i], whole));
  return state;
}

void Criteria::step(const CriterionInput& old, const CriterionInput& next, CriteriaState& state) {
  assert(state.records.size() == list_.size());
  const double start = processes::wall_time();
  const NodalFractions before = phases_of(old), after = present(next);
  const CriterionInput from = before.of(old), to = after.of(next);
  for (std::size_t i = 0; i < list_.size(); ++i) list_[i]->step(from, to, state.records[i]);
  seconds_ += processes::wall_time() - start;
}

std::vector<const quantities::Quantity*> fields_of(const Criteria& criteria) {
  std::vector<const quantities::Quantity*> all;
  for (const auto& criterion : criteria.each())
    for (const quantities::Quantity* field : criterion->fields()) all.push_back(field);
  return all;
}

void Criteria::fill(const CriterionInput& now, const CriteriaState& state,
                    std::span<const std::span<double>> values) const {
  assert(state.records.size() == list_.size());
  const NodalFractions phases = phases_of(now);
  const CriterionInput whole = phases.of(now);
  std::size_t first = 0;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const std::size_t n = list_[i]->fields().size();
    list_[i]->fill(whole, state.records[i], values.subspan(first, n));
    first += n;
  }
}

std::vector<CriterionResult> findings_of(const Criteria& criteria, const CriteriaState& state) {
  std::vector<CriterionResult> all;
  for (std::size_t i = 0; i < criteria.each().size(); ++i)
    for (const CriterionResult& finding : criteria.each()[i]->findings(state.records[i]))
      all.push_back(finding);
  return all;
}

void Criteria::replace(Criteria by) {
  list_ = std::move(by.list_);
  for (const auto& criterion : list_) criterion->know_plates(plates_);
}

void Criteria::know_plates(std::span<const PlateTimes> plates) {
  plates_.assign(plates.begin(), plates.end());
  for (const auto& criterion : list_) criterion->know_plates(plates);
}

std::size_t bytes(const Criteria& criteria) {
  std::size_t total = 0;
  for (const auto& criterion : criteria.each()) total += criterion->bytes();
  return total;
}

}  // namespace solidus::criteria
