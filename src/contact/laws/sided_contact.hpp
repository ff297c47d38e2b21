/// Contact conduction by a law for each side (monograph 3.45): h_1(t_N, Θ_g) from the slave to the interface,
/// h_2(t_N, Θ_g) from the interface to the master, tables of the pressure at one temperature or several.
///
///   Q_i = h_i (Θ_i − Θ_c),   1/h = 1/h_1 + 1/h_2,   s = h/h_1
///
/// h [W/(m² K)] from body to body and s are linear between two temperatures, as tables of the gap are, which
/// they must meet; s is the share of the resistance 1/h on the slave's side. Without heat that
/// is made or stored in the interface only h matters. Validity: h_i > 0.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/laws/contact_law.hpp"

namespace solidus::contact {

struct SidedContact {
  static constexpr std::string_view name = "sides",
                                    doc = "a table of the pressure for each side, h1 and h2 of 3.45";
  static constexpr bool beside_gas = false;

  /// Both tables at one temperature.
  struct At {
    std::optional<double> temperature;  ///< [K]; absent: at all
    Table slave, master;                ///< h_1, h_2 of t_N
  };
  std::vector<At> sides{};

  static void keys(Section<SidedContact>& s) {
    Section<At> at(
        "sides",
        "The conductances of both sides, for contact_law = \"sides\" (3.45): one section, or several "
        "from cold to hot, linear between their temperatures and constant outside.");
    at.quantity("temperature", &At::temperature, "K")
        .positive()
        .doc("Mean temperature of the two surfaces at which they hold; one section may leave it out.");
    at.function("slave_conductance", &At::slave, "W/m2/K")
        .of({Argument::pressure})
        .positive()
        .doc("h1 from the slave (of `surfaces`: the first) to the interface, as a table of the pressure.");
    at.function("master_conductance", &At::master, "W/m2/K")
        .of({Argument::pressure})
        .positive()
        .doc("h2 from the interface to the master.");
    s.sections("sides", &SidedContact::sides, at);
  }

  bool of_temperature() const { return sides.size() > 1; }
  std::vector<double> temperatures() const {
    std::vector<double> at;
    if (of_temperature())
      for (const At& one : sides) at.push_back(*one.temperature);
    return at;
  }

  LawConductance at(double pressure, double temperature) const {
    const Between b = between(temperature);
    const LawConductance cold = through(sides[b.cold], pressure), hot = through(sides[b.hot], pressure);
    const double rise = b.per_kelvin * (hot.value - cold.value),
                 bend = b.per_kelvin * (hot.slope - cold.slope);
    return {std::lerp(cold.value, hot.value, b.share), std::lerp(cold.slope, hot.slope, b.share), rise, bend};
  }
  /// s of 3.45.
  double slave_resistance(double pressure, double temperature) const {
    const Between b = between(temperature);
    const auto share = [&](const At& one) {
      const double slave = one.slave.value(pressure), master = one.master.value(pressure);
      return slave > 0 && master > 0 ? master / (slave + master) : 0.5;
    };
    return std::lerp(share(sides[b.cold]), share(sides[b.hot]), b.share);
  }
  /// The law with slave and master exchanged.
  SidedContact swapped() const {
    SidedContact law = *this;
    for (At& at : law.sides) std::swap(at.slave, at.master);
    return law;
  }

  std::optional<Objection> take(std::vector<TableAt> tables) {
    if (!tables.empty())
      return Objection{"[[contact.heat.at]] has 'contact_conductance', which needs contact_law = \"table\"",
                       "one of them"};
    if (sides.empty())
      return Objection{"contact_law = \"sides\" needs the conductances of both sides",
                       "a section [[contact.heat.sides]]"};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (!sides[i].temperature && sides.size() > 1)
        return Objection{"a section [[contact.heat.sides]] along with others has no temperature",
                         "a temperature in each, from cold to hot"};
      if (i > 0 && !(*sides[i].temperature > *sides[i - 1].temperature))
        return Objection{"the temperatures of [[contact.heat.sides]] do not increase", "from cold to hot"};
      if (!(std::min(sides[i].slave.min_value(), sides[i].master.min_value()) > 0))
        return Objection{"a conductance of [[contact.heat.sides]] is not above zero", "above zero"};
    }
    return std::nullopt;
  }

 private:
  /// The sections around a temperature, and where between them it is.
  struct Between {
    std::size_t cold = 0, hot = 0;
    double share = 0, per_kelvin = 0;
  };
  Between between(double temperature) const {
    std::size_t hot = 0;
    while (hot < sides.size() && sides.size() > 1 && *sides[hot].temperature <= temperature) ++hot;
    if (hot == 0 || hot == sides.size()) {
      const std::size_t nearest = hot == 0 ? 0 : hot - 1;
      return {nearest, nearest, 0, 0};
    }
    const double from = *sides[hot - 1].temperature, width = *sides[hot].temperature - from;
    return {hot - 1, hot, (temperature - from) / width, 1 / width};
  }
  /// h and ∂h/∂t_N at the temperature of a section.
  static LawConductance through(const At& at, double pressure) {
    const auto [one, one_slope] = at.slave.line(pressure);
    const auto [two, two_slope] = at.master.line(pressure);
    if (!(one > 0 && two > 0)) return {};
    const double h = one * two / (one + two), a = h / one, b = h / two;  // ∂h/∂h_1 = a², ∂h/∂h_2 = b²
    return {h, a * a * one_slope + b * b * two_slope, 0, 0};
  }
};

}  // namespace solidus::contact
