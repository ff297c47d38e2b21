/// Contact conduction by a power of the pressure (monograph 3.49, in addition to the gas):
///
///   h = h_open(0, Θ_g) + h_co (t_N/H_e)^ε   for ε > 0
///   h = h_co                                for ε = 0
///
/// Symbols: t_N contact pressure [Pa], h_co [W/(m² K)] from body to body, H_e Vickers hardness [Pa], ε a
/// number.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "contact/laws/contact_law.hpp"

namespace solidus::contact {

/// The key of the hardness, which several laws have.
template <class Law>
void hardness_key(Section<Law>& s) {
  s.quantity("hardness", &Law::hardness, "Pa")
      .positive()
      .doc("Hardness H_e of 3.49, needed with an exponent; of 3.48, needed with spots and gas.");
}

struct PowerContact {
  static constexpr std::string_view name = "power",
                                    doc =
                                        "the conductance, or with an exponent h_open(0) + conductance (p / "
                                        "hardness)^exponent (3.49)";
  double conductance = 0;            ///< h_co [W/(m² K)]
  double exponent = 0;               ///< ε
  std::optional<double> hardness{};  ///< H_e [Pa], needed when the exponent is not zero

  static void keys(Section<PowerContact>& s) {
    s.quantity("conductance", &PowerContact::conductance, "W/m2/K")
        .positive()
        .doc("h_co, from body to body: of touching bodies, and of the gap law at a gap of zero.");
    s.key("exponent", &PowerContact::exponent)
        .initially(0.0)
        .range(0, 2)
        .doc(
            "Exponent of h = h_open(0) + h_co (p / hardness)^exponent where the bodies touch (3.49); zero: "
            "h_co.");
    hardness_key(s);
  }

  bool beside_gas() const { return exponent > 0; }
  std::optional<double> without_pressure() const { return conductance; }
  LawConductance at(double pressure, double) const {
    if (exponent == 0) return {conductance, 0, 0, 0};
    if (!(pressure > 0)) return {};
    const double h = conductance * std::pow(pressure / *hardness, exponent);
    return {h, exponent * h / pressure, 0, 0};
  }

  std::optional<Objection> objection() const {
    if (!(conductance >= 0)) return Objection{"the conductance of an interface is negative", "zero or more"};
    if (!(exponent >= 0)) return Objection{"the exponent of contact conduction is negative", "zero or more"};
    if (exponent > 0 && !(hardness && *hardness > 0))
      return Objection{"pressure-dependent conduction (exponent above zero) needs the hardness",
                       "a hardness above zero"};
    return std::nullopt;
  }
  /// Beyond these numbers `check` says something [W/(m² K)], [Pa].
  static constexpr double k_least_usual = 20, k_most_usual = 1e6, k_most_possible = 1e8;
  static constexpr double k_softest = 1e5, k_hardest = 1e11;
  std::vector<Remark> remarks(std::string_view contact) const {
    std::vector<Remark> remarks;
    if (conductance < k_least_usual || conductance > k_most_usual)
      remarks.push_back(
          {conductance > k_most_possible,
           fmt::format("the contact '{}' conducts {:g} W/m2/K where it is closed", contact, conductance),
           "usual are 100 to 50000 W/m2/K between casting and mould"});
    if (exponent > 0 && hardness && (*hardness < k_softest || *hardness > k_hardest))
      remarks.push_back({false,
                         fmt::format("the softer side of the contact '{}' has a hardness of {:g} MPa",
                                     contact, 1e-6 * *hardness),
                         "usual are 10 MPa of hot metal to 10 GPa of hardened steel"});
    return remarks;
  }
};

}  // namespace solidus::contact
