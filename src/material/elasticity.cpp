#include "material/elasticity.hpp"

namespace solidus::material {

template PointProperties<double> properties_at(const Material&, const double&, const double&);
template PointProperties<Lane> properties_at(const Material&, const Lane&, const Lane&);
template PointProperties<double> properties_at(const Material&, const double&, const double&,
                                               const PhaseState<double>&);
template PointProperties<Lane> properties_at(const Material&, const Lane&, const Lane&,
                                             const PhaseState<Lane>&);
template PointDerivatives<double> derivatives_at(const Material&, const double&, const double&);
template PointDerivatives<Lane> derivatives_at(const Material&, const Lane&, const Lane&);
template PointCurvatures<double> curvatures_at(const Material&, const double&);
template PointCurvatures<Lane> curvatures_at(const Material&, const Lane&);

}  // namespace solidus::material
