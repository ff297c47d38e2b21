/// Conductances from tables of the gap (monograph table 7.9) or of the pressure, one for all temperatures or
/// several, linear between them: h(x), h(x, Θ_g) [W/(m² K)].
#pragma once

#include <fmt/format.h>

#include "contact/interface/table_family.hpp"
#include "contact/laws/contact_law.hpp"
#include "contact/laws/gap_law.hpp"

namespace solidus::contact {

/// The part that both laws share.
struct Tabulated {
  std::optional<Table> table{};  ///< for all temperatures; absent: those of [[contact.heat.at]]
  TableFamily family;            ///< set by take()

  bool of_temperature() const { return family.of_temperature(); }
  std::vector<double> temperatures() const { return family.temperatures(); }
  LawConductance at(double x, double temperature) const {
    const auto h = family.at(x, temperature);
    if (!(h.value > 0)) return {};  // a linear extrapolation may cross zero
    return {h.value, h.by_argument, h.by_temperature, h.mixed};
  }

 protected:
  std::optional<Objection> read(std::vector<TableAt> tables, const char* law_key, const char* key) {
    if (table && !tables.empty())
      return Objection{fmt::format("'{}' is given both for all temperatures and in [[contact.heat.at]]", key),
                       "one of them"};
    if (!table && tables.empty())
      return Objection{fmt::format("{} = \"table\" needs '{}'", law_key, key),
                       "a table, here or for some temperatures in [[contact.heat.at]]"};
    std::vector<double> at;
    std::vector<Table> values;
    for (TableAt& one : tables) {
      if (!at.empty() && !(one.temperature > at.back()))
        return Objection{fmt::format("the temperatures of '{}' do not increase", key),
                         "the sections [[contact.heat.at]] from cold to hot"};
      at.push_back(one.temperature);
      values.push_back(std::move(one.table));
    }
    family = table ? TableFamily(*table) : TableFamily(std::move(at), std::move(values));
    if (!(family.min_value() >= 0))
      return Objection{fmt::format("'{}' holds a negative conductance", key), "zero or more"};
    return std::nullopt;
  }
};

struct TableGap : Tabulated {
  static constexpr std::string_view name = "table", doc = "a table of the gap";
  static void keys(Section<TableGap>& s) {
    s.function("gap_conductance", &TableGap::gap_conductance, "W/m2/K")
        .of({Argument::gap})
        .at_least(0)
        .doc("Conductance as a table of the gap; it starts at the conductance of contact without pressure.");
  }
  std::optional<Table> gap_conductance{};  ///< h(g), g >= 0

  std::optional<Objection> take(std::vector<TableAt> tables) {
    table = gap_conductance;
    return read(std::move(tables), "gap_law", "gap_conductance");
  }
  /// Beyond these gaps `check` says something [m]; the narrowest is less than roughness.
  static constexpr double k_widest = 0.05, k_narrowest = 2e-6;
  std::vector<Remark> remarks(std::string_view contact) const {
    std::vector<Remark> remarks;
    if (!gap_conductance || gap_conductance->constant()) return remarks;
    if (const double gap = gap_conductance->x().back(); gap > k_widest)
      remarks.push_back(
          {false,
           fmt::format("'gap_conductance' of the contact '{}' goes up to a gap of {:g} mm", contact,
                       1e3 * gap),
           "castings shrink off their moulds by less than some millimetres; is argument_unit right?"});
    if (const double gap = gap_conductance->x().back(); gap < k_narrowest)
      remarks.push_back(
          {false,
           fmt::format("'gap_conductance' of the contact '{}' ends at a gap of {:g} mm", contact, 1e3 * gap),
           "castings shrink off their moulds by 0.01 to some millimetres; is argument_unit right?"});
    if (const double closed = gap_conductance->y().front(), open = gap_conductance->y().back();
        open > 1.01 * closed)
      remarks.push_back(
          {false,
           fmt::format("'gap_conductance' of the contact '{}' rises with the gap, from {:g} to {:g} "
                       "W/m2/K",
                       contact, closed, open),
           "an open gap conducts less than a closed one; are the points in their order?"});
    return remarks;
  }
};

struct TableContact : Tabulated {
  static constexpr std::string_view name = "table", doc = "a table of the pressure";
  static constexpr bool beside_gas = false;
  static void keys(Section<TableContact>& s) {
    s.function("contact_conductance", &TableContact::contact_conductance, "W/m2/K")
        .of({Argument::pressure})
        .at_least(0)
        .doc("Conductance as a table of the pressure; at zero pressure it is that of a gap of zero.");
  }
  std::optional<Table> contact_conductance{};  ///< h(t_N)

  std::optional<Objection> take(std::vector<TableAt> tables) {
    table = contact_conductance;
    return read(std::move(tables), "contact_law", "contact_conductance");
  }
  /// Beyond these pressures `check` says something [Pa]: under a few centimetres of metal; in a forging.
  static constexpr double k_least_usual = 1e3, k_most_usual = 1e10;
  std::vector<Remark> remarks(std::string_view contact) const {
    if (!contact_conductance || contact_conductance->constant()) return {};
    const double pressure = contact_conductance->x().back();
    if (pressure >= k_least_usual && pressure <= k_most_usual) return {};
    return {{false,
             fmt::format("'contact_conductance' of the contact '{}' ends at a pressure of {:g} MPa", contact,
                         1e-6 * pressure),
             "castings press with 0.001 to 100 MPa on their moulds; is argument_unit right?"}};
  }
};

}  // namespace solidus::contact
