#include "material/viscoplastic.hpp"

namespace solidus::material {

template return_mapping::Solution<double> return_mapping::solve_power_rate(
    const return_mapping::Problem<double>&, const return_mapping::Yield<double>&);
template return_mapping::Solution<Lane> return_mapping::solve_power_rate(const return_mapping::Problem<Lane>&,
                                                                         const return_mapping::Yield<Lane>&);
template return_mapping::Solution<double> return_mapping::solve_rate_law(
    const return_mapping::Problem<double>&, const return_mapping::Yield<double>&);
template return_mapping::Solution<Lane> return_mapping::solve_rate_law(const return_mapping::Problem<Lane>&,
                                                                       const return_mapping::Yield<Lane>&);

template Viscoplastic::Response<double> Viscoplastic::update(const Properties<double>&, const State<double>&,
                                                             const Sym<double>&, double) const;
template Viscoplastic::Response<Lane> Viscoplastic::update(const Properties<Lane>&, const State<Lane>&,
                                                           const Sym<Lane>&, double) const;

}  // namespace solidus::material
