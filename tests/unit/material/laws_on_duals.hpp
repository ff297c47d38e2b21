/// The laws with their derivatives in six strains, compiled once for all tests (laws_on_duals.cpp).
#pragma once

#include "dual.hpp"
#include "material/derivatives/isentropic.hpp"

namespace solidus::material::test {

using Ad = Dual<double, 6>;  ///< by the components of strain

}  // namespace solidus::material::test
