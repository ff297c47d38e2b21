#include "material/isentropic.hpp"

namespace solidus::material {

template double Isentropic::entropy(const Properties<double>&, const Sym<double>&,
                                    const State<double>&) const;
template Isentropic::Response<double> Isentropic::update(const Properties<double>&, const State<double>&,
                                                         const Sym<double>&, double) const;
template Isentropic::Response<Lane> Isentropic::update(const Properties<Lane>&, const State<Lane>&,
                                                       const Sym<Lane>&, double) const;

}  // namespace solidus::material
