/// [filling] of a case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/document.hpp"

namespace solidus::cases {

/// How the metal comes into the mould (docs/guide/filling.md). The flow is computed by OpenFOAM.
struct FillingSpec {
  std::optional<std::string> gate;    ///< group of faces of the mesh, or a body that is cast; absent: gate_at
  std::vector<double> gate_at;        ///< a point on the skin of the metal [m]; empty: chosen
  std::optional<double> gate_width;   ///< of the square at gate_at [m]; absent: by the speed
  std::optional<double> time;         ///< from the first metal to the full mould [s]
  std::optional<double> rate;         ///< of the metal [kg/s]
  std::optional<double> head;         ///< of metal above the gate, which drives it in [m]
  std::vector<double> times;          ///< at which speed, pressure or tilt are given [s]
  std::vector<double> speed;          ///< in the gate at these times [m/s]
  std::vector<double> pressure;       ///< above the atmosphere in the gate at these times [Pa]
  std::vector<double> tilt;           ///< angle of the mould at these times, of its position at first [rad]
  std::vector<double> tilt_axis;      ///< about which it turns, three numbers
  std::optional<double> temperature;  ///< of the metal in the gate [K]; absent: that of the castings
  std::vector<std::string> vents;     ///< groups of faces; empty: the highest places
  int cells = 0;                      ///< of the cavity, about
  std::optional<double> cell_size;    ///< in place of `cells` [m]
  std::optional<std::string>
      result;  ///< folder of a filling that is done; absent: it is still to be computed
  SourceLocation where;
};

}  // namespace solidus::cases
