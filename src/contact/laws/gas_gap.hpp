/// Conduction through the gas in the gap (monograph 3.48, 3.50):
///
///   h = k_a/(g + k_a/h_o)       between smooth surfaces
///   h = k_a/(Y + c_g Θ_g)       between rough ones, Y the distance of their mean planes
///
/// Symbols: g gap [m], k_a [W/(m K)], h_o [W/(m² K)] of a gap of zero, c_g Θ_g [m] temperature jump, about
/// 1.3e-9 m/K × Θ_g of air at 1 bar. Validity: continuum and slip flow, no convection.
#pragma once

#include <fmt/format.h>

#include "contact/laws/constant_gap.hpp"

namespace solidus::contact {

struct GasGap {
  static constexpr std::string_view name = "gas",
                                    doc = "conduction through gas, k / (gap + k / open_conductance) (3.50)";
  double conductivity = 0;                   ///< k_a [W/(m K)]
  double temperature_jump = 0;               ///< c_g [m/K], between rough surfaces only
  std::optional<double> open_conductance{};  ///< h_o, between smooth surfaces only; absent: that of contact
  bool rough = false;                        ///< set by begin()

  static void keys(Section<GasGap>& s) {
    s.quantity("gas_conductivity", &GasGap::conductivity, "W/m/K")
        .positive()
        .doc("Conductivity of the gas in the gap.");
    s.quantity("temperature_jump", &GasGap::temperature_jump, "m/K")
        .initially("0 m/K")
        .at_least(0)
        .doc(
            "c_g of the gas between contact spots (3.48), which widens its gap by c_g x temperature; air "
            "1.3e-9 m/K.");
    open_conductance_key(s);
  }

  static constexpr bool fills_roughness = true;
  bool of_temperature() const { return rough && temperature_jump > 0; }
  LawConductance at(double distance, double temperature) const {
    if (!rough) {
      const double h = conductivity / (distance + conductivity / *open_conductance);
      return {h, -h * h / conductivity, 0, 0};
    }
    const double h = conductivity / (distance + temperature_jump * temperature);
    const double by_distance = -h * h / conductivity;
    return {h, by_distance, by_distance * temperature_jump,
            2 * by_distance * by_distance * temperature_jump / h};
  }

  std::optional<Objection> begin(const ContactSide& side) {
    rough = side.rough;
    if (temperature_jump != 0 && !rough)
      return Objection{"a temperature jump belongs to the gas between spots",
                       "contact_law = \"spots\" and gap_law = \"gas\"; or none"};
    if (!(conductivity > 0))
      return Objection{"the gap law 'gas' needs the conductivity of the gas", "above zero"};
    if (rough && open_conductance)
      return Objection{"the conductance of the gas between spots follows from their roughness",
                       "no open_conductance with contact_law = \"spots\" and gap_law = \"gas\""};
    if (!(temperature_jump >= 0))
      return Objection{"the temperature jump of the gas is negative", "zero or more"};
    if (!open_conductance) open_conductance = side.conductance.value_or(0);
    if (!rough && !(*open_conductance > 0))
      return Objection{"the gap law 'gas' needs a conductance at zero gap", "above zero"};
    return std::nullopt;
  }
  /// Beyond these numbers `check` says something [W/(m K)].
  static constexpr double k_least_usual = 0.005, k_most_usual = 0.6;
  std::vector<Remark> remarks(std::string_view contact) const {
    if (conductivity >= k_least_usual && conductivity <= k_most_usual) return {};
    return {{false, fmt::format("the gas in the gap of '{}' conducts {:g} W/m/K", contact, conductivity),
             "air conducts 0.03 to 0.1 W/m/K, hydrogen 0.2 to 0.6"}};
  }
};

}  // namespace solidus::contact
