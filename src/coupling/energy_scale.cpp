/// The largest of the heat exchanged, the mechanical energies, and a small part of the heat content.
#include "coupling/energy_scale.hpp"

#include <algorithm>
#include <cmath>

#include "heat/storage/nodal_enthalpy.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

double heat_content(const heat::ThermalPhase& phase, const heat::ThermalState& state) {
  double content = 0;
  const heat::NodalEnthalpy& storage = phase.storage();
  for (Index i = 0; i < phase.mesh().n_owned_nodes; ++i) {
    const double temperature = state.temperature[as_size(i)];
    content += storage.capacity(i, temperature) * temperature;
  }
  return parallel::global_sum(content);
}

double energy_scale(const EnergyAudit& sum, double heat_content) {
  // Heat that new bodies bring counts like the heat that was there at the start.
  const double at_hand = heat_content + std::abs(sum.bodies.poured);
  double scale = std::max(sum.heat_exchanged, k_at_rest * at_hand);
  for (const double energy :
       {sum.structural, sum.contact, sum.kinetic, sum.friction, sum.numerical, sum.work})
    scale = std::max(scale, std::abs(energy));
  return scale;
}

double relative_defect(const EnergyAudit& sum, double heat_content) {
  const double scale = energy_scale(sum, heat_content);
  return scale > 0 ? std::abs(sum.defect()) / scale : 0;
}

}  // namespace solidus::coupling
