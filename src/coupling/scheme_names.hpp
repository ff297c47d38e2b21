/// Names of coupling schemes for advice: those that describe themselves so, the added ones too.
#pragma once

#include <functional>
#include <string>

#include "coupling/scheme_kind.hpp"

namespace solidus::coupling {

/// The schemes, with the options that they have by default, whose traits are the wanted ones: "\"a\" or
/// \"b\"".
std::string names_of_schemes(const std::function<bool(const SchemeTraits&)>& wanted);

}  // namespace solidus::coupling
