#include "heat/loads/impinging_jet.hpp"

#include <cmath>
#include <numbers>

namespace solidus::heat {

double reynolds(const ImpingingJet& jet, const ChannelFluid& fluid) {
  return 4 * jet.flow * fluid.density.value(jet.temperature) /
         (std::numbers::pi * jet.nozzle * fluid.viscosity.value(jet.temperature));
}

double area_ratio(const ImpingingJet& jet) {
  const double ratio = jet.nozzle / (2 * jet.radius);
  return ratio * ratio;
}

double film_coefficient(const ImpingingJet& jet, const ChannelFluid& fluid) {
  const double re = reynolds(jet, fluid), root = std::sqrt(area_ratio(jet));
  // The geometry, then the flow.
  const double of_place = 2 * root * (1 - 2.2 * root) / (1 + 0.2 * (jet.distance / jet.nozzle - 6) * root);
  const double of_flow = 2 * std::sqrt(re) * std::sqrt(1 + 0.005 * std::pow(re, 0.55));
  const double nusselt = of_place * of_flow * std::pow(fluid.prandtl(jet.temperature), 0.42);
  return nusselt * fluid.conductivity.value(jet.temperature) / jet.nozzle;
}

}  // namespace solidus::heat
