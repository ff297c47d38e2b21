#include "criteria/criteria.hpp"

#include <cassert>

#include "system/processes.hpp"

namespace solidus::criteria {

Criteria::NodalPhases Criteria::phases_of(const Moment& moment) const {
  if (phase_ == nullptr) return {};
  return {phase_->solid_fraction(moment.heat), phase_->plateau_share(moment.heat)};
}

State Criteria::initial(const Moment& start) const {
  const NodalPhases phases = phases_of(start);
  const Moment whole = phases.of(start);
  State state;
  for (const auto& criterion : list_) state.records.push_back(criterion->initial(whole));
  return state;
}

void Criteria::step(const Moment& old, const Moment& next, State& state) {
  assert(state.records.size() == list_.size());
  const double start = processes::wall_time();
  const NodalPhases before = phases_time_ == old.time ? std::move(phases_) : phases_of(old);
  phases_ = phases_of(next);
  phases_time_ = next.time;
  const Moment from = before.of(old), to = phases_.of(next);
  for (std::size_t i = 0; i < list_.size(); ++i) list_[i]->step(from, to, state.records[i]);
  seconds_ += processes::wall_time() - start;
}

std::vector<FieldInfo> Criteria::fields() const {
  std::vector<FieldInfo> all;
  for (const auto& criterion : list_)
    for (const FieldInfo& field : criterion->fields()) all.push_back(field);
  return all;
}

void Criteria::fill(const Moment& now, const State& state, std::span<const std::span<double>> values) const {
  assert(state.records.size() == list_.size());
  const NodalPhases phases = phases_of(now);
  const Moment whole = phases.of(now);
  std::size_t first = 0;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const std::size_t n = list_[i]->fields().size();
    list_[i]->fill(whole, state.records[i], values.subspan(first, n));
    first += n;
  }
}

std::vector<Finding> Criteria::findings(const State& state) const {
  std::vector<Finding> all;
  for (std::size_t i = 0; i < list_.size(); ++i)
    for (const Finding& finding : list_[i]->findings(state.records[i])) all.push_back(finding);
  return all;
}

std::size_t Criteria::bytes() const {
  std::size_t bytes = 0;
  for (const auto& criterion : list_) bytes += criterion->bytes();
  return bytes;
}

}  // namespace solidus::criteria
