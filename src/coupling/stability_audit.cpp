/// Energies and entropies of a step are joined to the functional of 2.24, with the increment of each phase
/// and the rounding that it may have.
#include "coupling/stability_audit.hpp"

#include <algorithm>

namespace solidus::coupling {

StabilityAudit stability_audit(const Phases& phases, const State& old, const State& trial,
                               const mechanics::StepDeformation& deformation, const StepEffort& effort,
                               Booking booking) {
  StabilityAudit r;
  if (!phases.audits_stability()) return r;
  const EnergyAudit& energy = effort.energy;
  const double ambient = *phases.ambient_temperature;
  const heat::EntropyChange stored = phases.heat->states().entropy_change(old.heat, trial.heat);
  const mechanics::StructuralChange structural =
      mechanics::structural_change(deformation, trial.heat.temperature);
  const contact::InterfaceSums& interface = energy.interface;
  r.entropy = stored.change + structural.entropy + interface.entropy;
  r.frictional_entropy = interface.plastic_entropy;

  const double outside =
      energy.kinetic + energy.contact - energy.work;  // changes in the mechanical phase only
  const double whole = energy.stored_heat + energy.structural + outside - ambient * r.entropy;
  if (booking == Booking::by_phase) {
    const mechanics::StructuralChange phase = mechanics::mechanical_change(deformation);
    const double later = interface.energy - interface.mechanical_energy;  // in the thermal phase
    r.mechanical = phase.energy + outside - later - ambient * (phase.entropy + interface.mechanical_entropy);
    r.thermal = whole - r.mechanical;
  } else {
    r.mechanical = whole;
  }

  // In both inequalities residuals are on the right (theory, 2 and 3); that of heat is weighted with
  // 1 − Θ_a/Θ, of magnitude below one. So does the energy that sub-scales of mixed elements give back: 𝓛 is
  // without their energy.
  constexpr double k_rounding = 1e-14;  // of each entropy that is a difference
  r.tolerance = std::max(0.0, energy.unbalanced) + std::max(0.0, -energy.numerical) +
                effort.heat.residual * energy.heat_exchanged + k_rounding * ambient * stored.magnitude +
                ambient * stored.behind;
  // A fraction that follows the temperature alone lets a phase change under pressure do work against it.
  // Heat of deformation arrives at nodes of another temperature than that of its point.
  r.tolerance += structural.transformed + ambient * structural.spread;
  return r;
}

}  // namespace solidus::coupling
