/// The template of the law is compiled here for the number types of the program.
#include "material/viscoplastic_impl.hpp"

namespace solidus::material {

Viscoplastic::Viscoplastic(const Material& material)
    : material_(&material),
      flow_(material.flow ? &*material.flow : nullptr),
      recalls_(flow_ != nullptr && kinematic_law(flow_->kinematic).recalls()),
      linear_rate_(flow_ != nullptr && flow_->linear_rate()),
      powered_rate_(flow_ != nullptr && flow_->powered_rate()) {}

template return_mapping::Solution<double> return_mapping::solve_power_rate(
    const return_mapping::Problem<double>&, const return_mapping::Yield<double>&);
template return_mapping::Solution<Lane> return_mapping::solve_power_rate(const return_mapping::Problem<Lane>&,
                                                                         const return_mapping::Yield<Lane>&);
template return_mapping::Solution<double> return_mapping::solve_rate_law(
    const return_mapping::Problem<double>&, const return_mapping::Yield<double>&);
template return_mapping::Solution<Lane> return_mapping::solve_rate_law(const return_mapping::Problem<Lane>&,
                                                                       const return_mapping::Yield<Lane>&);

template Viscoplastic::Properties<double> Viscoplastic::properties_at(const double&, const double&,
                                                                      const PhaseState<double>&) const;
template Viscoplastic::Properties<Lane> Viscoplastic::properties_at(const Lane&, const Lane&,
                                                                    const PhaseState<Lane>&) const;
template Viscoplastic::Properties<Jet<double>> Viscoplastic::properties_at(
    const Jet<double>&, const Jet<double>&, const PhaseState<Jet<double>>&) const;
template Viscoplastic::Properties<Jet<Lane>> Viscoplastic::properties_at(const Jet<Lane>&, const Jet<Lane>&,
                                                                         const PhaseState<Jet<Lane>>&) const;

template Viscoplastic::Shear<double> Viscoplastic::shear(const PointProperties<double>&, double) const;
template Viscoplastic::Shear<Lane> Viscoplastic::shear(const PointProperties<Lane>&, double) const;
template Sym<double> Viscoplastic::loading(const Properties<double>&, const State<double>&,
                                           const Sym<double>&, double) const;
template Sym<Lane> Viscoplastic::loading(const Properties<Lane>&, const State<Lane>&, const Sym<Lane>&,
                                         double) const;

template Viscoplastic::Response<double> Viscoplastic::update(const Properties<double>&, const State<double>&,
                                                             const Sym<double>&, const TimeStep&) const;
template Viscoplastic::Response<Lane> Viscoplastic::update(const Properties<Lane>&, const State<Lane>&,
                                                           const Sym<Lane>&, const TimeStep&) const;

}  // namespace solidus::material
