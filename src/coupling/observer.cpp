#include "coupling/observer.hpp"

#include <algorithm>
#include <utility>

namespace solidus::coupling {

EnergyAudit& EnergyAudit::operator+=(const EnergyAudit& next) {
  stored_heat += next.stored_heat;
  structural += next.structural;
  contact += next.contact;
  kinetic += next.kinetic;
  friction += next.friction;
  frictional_heat += next.frictional_heat;
  numerical += next.numerical;
  work += next.work;
  unbalanced += next.unbalanced;
  heat_in += next.heat_in;
  entropy_in += next.entropy_in;
  heat_exchanged += next.heat_exchanged;
  viscous_dissipation += next.viscous_dissipation;
  plastic_dissipation += next.plastic_dissipation;
  plastic_work += next.plastic_work;
  bodies += next.bodies;
  inelastic_entropy += next.inelastic_entropy;
  return *this;
}

StabilityAudit& StabilityAudit::operator+=(const StabilityAudit& next) {
  mechanical += next.mechanical;
  thermal += next.thermal;
  entropy += next.entropy;
  frictional_entropy += next.frictional_entropy;
  tolerance += next.tolerance;
  return *this;
}

StepEffort& StepEffort::operator+=(const StepEffort& next) {
  const StepEffort first = std::move(*this);
  *this = next;
  const auto add = [](PhaseEffort& sum, const PhaseEffort& before) {
    sum.iterations = std::max(sum.iterations, before.iterations);
    sum.hardest = std::max(sum.hardest, before.hardest);
    sum.linear_iterations += before.linear_iterations;
    sum.residual = std::max(sum.residual, before.residual);
    sum.seconds += before.seconds;
  };
  add(heat, first.heat);
  add(mechanics, first.mechanics);
  coupling_iterations = std::max(coupling_iterations, first.coupling_iterations);
  energy += first.energy;
  stability += first.stability;
  least_dissipation = std::min(least_dissipation, first.least_dissipation);
  largest_dissipation = std::max(largest_dissipation, first.largest_dissipation);
  return *this;
}

}  // namespace solidus::coupling
