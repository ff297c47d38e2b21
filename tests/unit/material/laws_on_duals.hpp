/// The laws with their derivatives in six strains, compiled once for all tests (laws_on_duals.cpp).
#pragma once

#include "dual.hpp"
#include "material/isentropic.hpp"

namespace solidus::material {

namespace test {
using Ad = Dual<double, 6>;  ///< by the components of strain
}

extern template Viscoplastic::Response<test::Ad> Viscoplastic::update(const Properties<test::Ad>&,
                                                                      const State<test::Ad>&,
                                                                      const Sym<test::Ad>&, double) const;
extern template Isentropic::Response<test::Ad> Isentropic::update(const Properties<test::Ad>&,
                                                                  const State<test::Ad>&,
                                                                  const Sym<test::Ad>&, double) const;

}  // namespace solidus::material
