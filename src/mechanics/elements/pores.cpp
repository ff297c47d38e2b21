/// The arrays of a body's pores, which only a melt needs whose viscosity the program has chosen.
#include "mechanics/elements/pores.hpp"

#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

Pores::Pores(const material::Material& material, Index n_batches)
    : tension_(material.casting.pore_tension),
      critical_pressure_drop_(material.casting.critical_pressure_drop),
      coherency_(material.casting.coherency_fraction) {
  if (!material.chooses_viscosity()) return;
  for (PackVector<Lane>* values : {&softness_, &threshold_, &held_, &full_})
    values->resize(as_size(n_batches), Lane(0.0));
}

std::size_t Pores::bytes() const {
  return (softness_.capacity() + threshold_.capacity() + held_.capacity() + full_.capacity()) * sizeof(Lane);
}

}  // namespace solidus::mechanics
