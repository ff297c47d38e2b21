#include "coupling/contact_work.hpp"

namespace solidus::coupling {

ContactWork::ContactWork(const Phases& phases) : phases_(phases), stored_(stored()) {
  for (const contact::ContactPair* pair : phases.contacts)
    begin_.emplace_back(pair->penetration().begin(), pair->penetration().end());
  last_ = begin_;
}

double ContactWork::stored() const {
  double energy = 0;
  for (const contact::ContactPair* pair : phases_.contacts) energy += pair->sums({}).energy;
  return energy;
}

void ContactWork::add(double share, double factor) {
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const contact::ContactPair& pair = *phases_.contacts[i];
    work_ += factor * pair.work(last_[i], share);
    last_[i].assign(pair.penetration().begin(), pair.penetration().end());
  }
}

void ContactWork::restart(double carried) {
  for (std::size_t i = 0; i < last_.size(); ++i)
    for (std::size_t p = 0; p < last_[i].size(); ++p)
      last_[i][p] = begin_[i][p] + carried * (last_[i][p] - begin_[i][p]);
}

void ContactWork::book(EnergyAudit& energy) const {
  energy.contact = stored() - stored_;
  energy.numerical += work_ - energy.contact;
}

}  // namespace solidus::coupling
