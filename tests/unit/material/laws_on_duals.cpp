#include "laws_on_duals.hpp"

namespace solidus::material {

template Viscoplastic::Response<test::Ad> Viscoplastic::update(const Properties<test::Ad>&,
                                                               const State<test::Ad>&, const Sym<test::Ad>&,
                                                               double) const;
template Isentropic::Response<test::Ad> Isentropic::update(const Properties<test::Ad>&,
                                                           const State<test::Ad>&, const Sym<test::Ad>&,
                                                           double) const;

}  // namespace solidus::material
