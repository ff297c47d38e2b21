#include "criteria/criteria.hpp"

#include <mpi.h>

#include <cassert>

namespace solidus::criteria {

std::vector<double> Criteria::fraction_of(const Moment& moment) const {
  return phase_ == nullptr ? std::vector<double>{} : phase_->solid_fraction(moment.heat);
}

State Criteria::initial(const Moment& start) const {
  const std::vector<double> fraction = fraction_of(start);
  const Moment whole{start.time, start.heat, start.mechanics, fraction};
  State state;
  for (const auto& criterion : list_) state.records.push_back(criterion->initial(whole));
  return state;
}

void Criteria::step(const Moment& old, const Moment& next, State& state) {
  assert(state.records.size() == list_.size());
  const double start = MPI_Wtime();
  const std::vector<double> before = fraction_time_ == old.time ? std::move(fraction_) : fraction_of(old);
  fraction_ = fraction_of(next);
  fraction_time_ = next.time;
  const Moment from{old.time, old.heat, old.mechanics, before};
  const Moment to{next.time, next.heat, next.mechanics, fraction_};
  for (std::size_t i = 0; i < list_.size(); ++i) list_[i]->step(from, to, state.records[i]);
  seconds_ += MPI_Wtime() - start;
}

std::vector<FieldInfo> Criteria::fields() const {
  std::vector<FieldInfo> all;
  for (const auto& criterion : list_)
    for (const FieldInfo& field : criterion->fields()) all.push_back(field);
  return all;
}

void Criteria::fill(const Moment& now, const State& state, std::span<const std::span<double>> values) const {
  assert(state.records.size() == list_.size());
  const std::vector<double> fraction = fraction_of(now);
  const Moment whole{now.time, now.heat, now.mechanics, fraction};
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
