#include "material/derivatives/isentropic_impl.hpp"

namespace solidus::material {

template Isentropic::Properties<double> Isentropic::properties_at(const double&, const double&,
                                                                  const PhaseState<double>&) const;
template Isentropic::Properties<Lane> Isentropic::properties_at(const Lane&, const Lane&,
                                                                const PhaseState<Lane>&) const;
template Viscoplastic::Properties<Jet<double>> Isentropic::at_temperature(const Properties<double>&,
                                                                          const double&) const;
template Viscoplastic::Properties<Jet<Lane>> Isentropic::at_temperature(const Properties<Lane>&,
                                                                        const Lane&) const;
template Lane Isentropic::entropy(const Properties<Lane>&, const Sym<Lane>&, const State<Lane>&) const;
template double Isentropic::entropy(const Properties<double>&, const Sym<double>&,
                                    const State<double>&) const;
template Isentropic::Response<double> Isentropic::update(const Properties<double>&, const State<double>&,
                                                         const Sym<double>&, const TimeStep&) const;
template Isentropic::Response<Lane> Isentropic::update(const Properties<Lane>&, const State<Lane>&,
                                                       const Sym<Lane>&, const TimeStep&) const;

}  // namespace solidus::material
