/// Words for the members of a quantity, as files and pages write them.
#pragma once

#include <string_view>

#include "quantities/quantity.hpp"

namespace solidus::quantities {

std::string_view name(Group group);
std::string_view name(Rank rank);
std::string_view name(Place place);
std::string_view name(Written written);
std::string_view name(Extreme extreme);
std::string_view name(Colours colours);

}  // namespace solidus::quantities
