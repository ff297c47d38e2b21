#include <algorithm>
#include <iterator>

#include "quantities/shown_units.hpp"

namespace solidus::quantities {

namespace {

constexpr UnitRow k_units[] = {
    {"1", {"1", ""}},
    {"K", {"degC", "°C", 1, -273.15}},
    {"m", {"mm", "mm", 1e3}},
    {"Pa", {"MPa", "MPa", 1e-6}},
    {"W/m2", {"kW/m2", "kW/m²", 1e-3}},
    {"W/m2/K", {"W/m2/K", "W/(m² K)"}},
    {"W/m3", {"kW/m3", "kW/m³", 1e-3}},
    {"m3", {"cm3", "cm³", 1e6}},
    {"m/s", {"mm/s", "mm/s", 1e3}},
    {"m/s2", {"m/s2", "m/s²"}},
    {"K/m", {"K/mm", "K/mm", 1e-3}},
    {"J/m2", {"J/m2", "J/m²"}},
    {"J/m3/K", {"J/m3/K", "J/(m³ K)"}},
};

constexpr UnitName k_names[] = {
    {"1", "", "Share"},
    {"%", "%", "Share"},
    {"percent", "%", "Share"},
    {"s", "s", "Time"},
    {"degC", "°C", "Temperature"},
    {"K", "K", "Temperature"},
    {"K/s", "K/s", "Cooling rate"},
    {"K/m", "K/m", "Gradient"},
    {"K/mm", "K/mm", "Gradient"},
    {"m", "m", "Length"},
    {"mm", "mm", "Length"},
    {"um", "µm", "Length"},
    {"m2", "m²", "Area"},
    {"m3", "m³", "Volume"},
    {"cm3", "cm³", "Volume"},
    {"m/s", "m/s", "Velocity"},
    {"mm/s", "mm/s", "Velocity"},
    {"kg", "kg", "Mass"},
    {"N", "N", "Force"},
    {"kN", "kN", "Force"},
    {"N m", "N m", "Moment"},
    {"Pa", "Pa", "Stress"},
    {"MPa", "MPa", "Stress"},
    {"J", "J", "Energy"},
    {"kJ", "kJ", "Energy"},
    {"J/K", "J/K", "Entropy"},
    {"W", "W", "Heat flow"},
    {"W/m2", "W/m²", "Heat flux"},
    {"kW/m2", "kW/m²", "Heat flux"},
    {"W/m3", "W/m³", "Power density"},
    {"kW/m3", "kW/m³", "Power density"},
    {"W/m2/K", "W/(m² K)", "Conductance"},
};

}  // namespace

std::span<const UnitRow> shown_units() {
  return k_units;
}

std::span<const UnitName> unit_names() {
  return k_names;
}

ShownUnit shown_unit(std::string_view si) {
  const auto* const found = std::find_if(std::begin(k_units), std::end(k_units),
                                         [&](const UnitRow& known) { return known.si == si; });
  return found != std::end(k_units) ? found->shown : ShownUnit{si, si};
}

}  // namespace solidus::quantities
