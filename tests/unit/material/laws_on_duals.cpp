#include "laws_on_duals.hpp"

#include "material/derivatives/isentropic_impl.hpp"

namespace solidus::material {

template Isentropic::Properties<test::Ad> Isentropic::properties_at(const test::Ad&, const test::Ad&,
                                                                    const PhaseState<test::Ad>&) const;
template Viscoplastic::Properties<test::Ad> Viscoplastic::properties_at(const test::Ad&, const test::Ad&,
                                                                        const PhaseState<test::Ad>&) const;
template Viscoplastic::Response<test::Ad> Viscoplastic::update(const Properties<test::Ad>&,
                                                               const State<test::Ad>&, const Sym<test::Ad>&,
                                                               const TimeStep&) const;
template Isentropic::Response<test::Ad> Isentropic::update(const Properties<test::Ad>&,
                                                           const State<test::Ad>&, const Sym<test::Ad>&,
                                                           const TimeStep&) const;

}  // namespace solidus::material
