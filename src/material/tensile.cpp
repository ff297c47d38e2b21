/// A tensile test from the flow data alone: stress as a sum of flow stress, hardening and overstress.
#include "material/tensile.hpp"

#include <cmath>

#include "material/elasticity_impl.hpp"
#include "material/hardening.hpp"
#include "material/kinematic.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::material {
namespace {

/// X of dX = (K − r X) dξ, each step exact at the recall of its middle; exact where r is constant.
double back_stress(const Flow& flow, const FlowProperties<double>& p, double strain) {
  if (flow.kinematic == KinematicHardening::none) return 0;
  if (!kinematic_law(flow.kinematic).recalls()) return p.kinematic_modulus * strain;
  constexpr int k_steps = 64;
  const double step = strain / k_steps;
  double stress = 0;
  for (int i = 0; i < k_steps; ++i) {
    const double fall = kinematic_recall(flow.kinematic, p, (i + 0.5) * step).value * step;
    const double mean = fall > 0 ? -std::expm1(-fall) / fall : 1;  // of exp(−r ξ) over the step
    stress += (p.kinematic_modulus * step - fall * stress) * mean;
  }
  return stress;
}

}  // namespace

double tensile_stress(const Flow& flow, double strain, double temperature) {
  const auto properties = flow_properties_at(flow, temperature);
  return properties.flow_stress + hardening_stress(flow.isotropic, flow.curves, properties, strain).stress +
         back_stress(flow, properties, strain);
}

double tensile_overstress(const Flow& flow, double rate, double temperature) {
  if (flow.rate_independent()) return 0;
  // γ̇ = √(3/2) of the strain rate, and the stress √(3/2) of the deviator's norm.
  const double root = std::sqrt(1.5);
  return root * overstress(flow.rate_dependence, flow_properties_at(flow, temperature), root * rate).stress;
}

}  // namespace solidus::material
