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

/// A unit of fields, columns and answers, as people write it, and what it measures.
struct UnitName {
  std::string_view unit;      ///< as UDUNITS reads it: "m2"
  std::string_view text;      ///< "m²"; empty for a number
  std::string_view measures;  ///< of axes: "Area"
};

std::span<const UnitName> unit_names();

}  // namespace solidus::quantities
