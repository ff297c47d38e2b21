/// How the reports of two parts of a step become that of the whole.
#include "coupling/observer.hpp"

#include <algorithm>
#include <utility>

namespace solidus::coupling {

namespace {

/// Everything in an audit that adds up over the steps of a run, but for the heat of bodies.
struct AuditSum {
  double EnergyAudit::*value;
  bool flows;  ///< of the stages of a step too; the others are differences of energies at its ends
};
constexpr AuditSum k_audit_sums[] = {{&EnergyAudit::stored_heat, true},
                                     {&EnergyAudit::structural, false},
                                     {&EnergyAudit::contact, false},
                                     {&EnergyAudit::kinetic, false},
                                     {&EnergyAudit::friction, false},
                                     {&EnergyAudit::frictional_heat, false},
                                     {&EnergyAudit::numerical, true},
                                     {&EnergyAudit::work, true},
                                     {&EnergyAudit::unbalanced, true},
                                     {&EnergyAudit::heat_in, true},
                                     {&EnergyAudit::to_channels, true},
                                     {&EnergyAudit::entropy_in, true},
                                     {&EnergyAudit::heat_exchanged, true},
                                     {&EnergyAudit::viscous_dissipation, true},
                                     {&EnergyAudit::plastic_dissipation, true},
                                     {&EnergyAudit::plastic_work, true},
                                     {&EnergyAudit::inelastic_entropy, true},
                                     {&EnergyAudit::excess_work, true}};

}  // namespace

EnergyAudit& EnergyAudit::operator+=(const EnergyAudit& next) {
  for (const AuditSum& sum : k_audit_sums) this->*sum.value += next.*sum.value;
  bodies += next.bodies;
  return *this;
}

void EnergyAudit::add_first_stage(const EnergyAudit& first, double carried) {
  for (const AuditSum& sum : k_audit_sums)
    if (sum.flows) this->*sum.value += carried * first.*sum.value;
  interface.add(first.interface, carried);
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
  // The effort of two parts of a step is added as a user would: work and energies are summed, numbers that
  // say how hard a part was are the larger ones, and the fields of the later part hold.
  StepEffort first = std::move(*this);
  *this = next;
  const auto add = [](PhaseEffort& sum, const PhaseEffort& before) {
    sum.iterations = std::max(sum.iterations, before.iterations);
    sum.hardest = std::max(sum.hardest, before.hardest);
    sum.linear_iterations += before.linear_iterations;
    sum.residual = std::max(sum.residual, before.residual);
    sum.seconds += before.seconds;
  };
  // The flows of a part are only known where it was a thermal pass with stages.
  if (!fields.flows.known()) fields.flows = std::move(first.fields.flows);
  if (fields.reactions.empty()) fields.reactions = std::move(first.fields.reactions);
  add(heat, first.heat);
  add(mechanics, first.mechanics);
  coupling_iterations = std::max(coupling_iterations, first.coupling_iterations);
  energy += first.energy;
  stability += first.stability;
  // Conditions are the same ones in both parts.
  if (conditions.size() == first.conditions.size()) {
    for (std::size_t i = 0; i < conditions.size(); ++i) conditions[i].heat += first.conditions[i].heat;
    conditions_time += first.conditions_time;
  }
  if (channels.size() == first.channels.size())
    for (std::size_t i = 0; i < channels.size(); ++i) channels[i].heat += first.channels[i].heat;
  least_dissipation = std::min(least_dissipation, first.least_dissipation);
  largest_dissipation = std::max(largest_dissipation, first.largest_dissipation);
  return *this;
}

double StepEffort::power_of(const std::string& condition) const {
  double sum = 0;
  for (const heat::ConditionHeat& c : conditions)
    if (c.name == condition) sum += c.heat;
  return conditions_time > 0 ? sum / conditions_time : 0;
}

}  // namespace solidus::coupling
