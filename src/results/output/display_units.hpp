/// Units in which the answers of a run are printed. Files hold SI, or the unit that their header says.
#pragma once

#include <string>

namespace solidus::results {

struct DisplayUnits {
  std::string length = "mm", temperature = "degC", stress = "MPa";  ///< as UDUNITS reads them
};

}  // namespace solidus::results
