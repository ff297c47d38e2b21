/// All units that people read in another form than SI has them.
#pragma once

#include <span>

#include "quantities/quantity.hpp"

namespace solidus::quantities {

struct UnitRow {
  std::string_view si;
  ShownUnit shown;
};

std::span<const UnitRow> shown_units();

}  // namespace solidus::quantities
