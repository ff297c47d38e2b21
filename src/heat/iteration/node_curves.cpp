/// A node of one body reads the curve of its material, which gives temperature and potential in one
/// look-up; nodes of several bodies take sums.
#include "heat/iteration/node_curves.hpp"

namespace solidus::heat {

NodeCurves::NodeCurves(const NodalEnthalpy& storage, HeatSystem& system)
    : storage_(storage), system_(system) {
  for (std::size_t body = 0; body < storage.n_bodies(); ++body)
    curves_.emplace_back(storage.body_curve(static_cast<int>(body)),
                         system.parts().elements.nodal().of_body(static_cast<int>(body)));
}

StorageCurve::AtHeat NodeCurves::sum_at_heat(Index node, double heat) const {
  const NodalPotential& potential = system_.parts().elements.nodal();
  const NodalEnthalpy::Point at = storage_.point(node, heat);
  return {at.temperature, potential.value(node, at.temperature),
          at.slope * potential.slope(node, at.temperature)};
}

StorageCurve::AtPotential NodeCurves::sum_at_potential(Index node, double potential, double near) const {
  const double t = system_.parts().elements.nodal().temperature(node, potential, near);
  return {t, storage_.lower(node, t), storage_.upper(node, t), 0.0};
}

}  // namespace solidus::heat
