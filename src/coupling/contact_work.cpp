/// Energies of contact before and after a step are compared; what is neither stored nor dissipated by
/// friction is the dissipation of the integration in time.
#include "coupling/contact_work.hpp"

namespace solidus::coupling {

namespace {

/// Heat that a rigid master of given temperature gives in a step, and its entropy at that temperature.
/// @param into_bodies  heat of the pair's thermal term into the bodies [J]
void book_tool(const contact::ContactPair& pair, double into_bodies, const contact::InterfaceSums& friction,
               EnergyAudit& energy) {
  const std::optional<double> temperature =
      contact::tool_temperature(pair.parts().spec, pair.parts().end.time);
  if (!temperature) return;
  const double heat = into_bodies - (friction.dissipated - friction.stored);
  energy.heat_in += heat;
  energy.entropy_in += heat / *temperature;
}

}  // namespace

ContactWork::ContactWork(const Phases& phases) : phases_(phases), begin_(energy()) {}

ContactWork::Energy ContactWork::energy() const {
  Energy energy;
  for (const contact::ContactPair* pair : phases_.contacts) {
    const contact::ContactSums sums = contact::sums(pair->view(), {});
    energy.stored += sums.energy + (sums.work - sums.dissipation);
    energy.dissipated += sums.dissipation;
  }
  return energy;
}

void ContactWork::add(double share, double factor) {
  for (contact::ContactPair* pair : phases_.contacts) {
    const double rigid = contact::rigid_work(pair->view(), share);
    rigid_ += factor * rigid;
    work_ += factor * (contact::work(pair->view(), share) + rigid);
  }
}

void ContactWork::book(EnergyAudit& audit) const {
  const Energy now = energy();
  audit.contact = now.stored - begin_.stored;
  audit.friction = now.dissipated - begin_.dissipated;
  audit.numerical += work_ - audit.contact - audit.friction;
  audit.work += rigid_;
}

void book_interface(EnergyAudit& audit, bool mechanical) {
  const contact::InterfaceSums& sums = audit.interface;
  if (!mechanical) {  // the first law is that of the bodies' heat
    audit.frictional_heat = sums.dissipated - sums.stored;
    return;
  }
  audit.frictional_heat = sums.dissipated;
  audit.contact += sums.energy - sums.hardening;
  audit.numerical += sums.stored + sums.hardening - sums.energy;
}

void keep_heat_alone(EnergyAudit& energy) {
  energy.work = energy.contact = energy.kinetic = energy.numerical = energy.friction = 0;
}

void commit_contact_heat(const Phases& phases, std::span<const double> temperature,
                         std::span<const double> into_bodies, EnergyAudit& energy) {
  std::size_t term = 0;  // the thermal terms of the pairs come first
  for (contact::ContactPair* pair : phases.contacts) {
    const contact::InterfaceSums sums = pair->parts().heat.commit(temperature);
    energy.interface.add(sums);
    if (pair->parts().heat.term() != nullptr) book_tool(*pair, into_bodies[term++], sums, energy);
  }
}

}  // namespace solidus::coupling
