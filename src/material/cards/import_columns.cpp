/// From a table of a program to columns in SI: find each quantity's column, convert its unit, order the
/// rows by temperature, check fractions and enthalpy.
#include "material/cards/import_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "input/keys.hpp"
#include "input/units.hpp"
#include "material/cards/column_headers.hpp"
#include "material/cards/unit_spelling.hpp"

namespace solidus::material {
namespace {

using Column = ColumnTable::Column;

/// A quantity with the names that programs give its column, in small letters and without blanks.
struct Quantity {
  const char* name;
  const char* unit;
  bool unit_needed;
  std::vector<std::string> headers;
};

const std::array<Quantity, 10>& quantities() {
  // Each quantity of a card with its unit, whether units in a header are converted, and the headers under
  // which programs write it, in small letters and without blanks.
  static const std::array<Quantity, 10> all{{
      {"temperature", "K", true, {"t", "temp", "temperature", "temperatures"}},
      {"solid_fraction",
       "1",
       false,
       {"solidfraction", "fractionsolid", "fs", "massfractionofallsolidphases", "massfractionofsolid",
        "amountofallsolidphases", "volumefractionofallsolidphases", "molefractionofallsolidphases", "solid",
        "molefractionofsolid", "fractionofsolid", "massfractionsolid", "molefractionsolid"}},
      {"liquid_fraction",
       "1",
       false,
       {"liquidfraction", "fractionliquid", "fl", "liquid", "massfractionofliquid", "molefractionofliquid",
        "amountofliquid", "fractionofliquid", "massfractionliquid", "molefractionliquid"}},
      {"enthalpy",
       "J/kg",
       true,
       {"enthalpy", "h", "specificenthalpy", "heat", "totalheat", "enthalpyofsystem", "specificheatcontent",
        "heatpergram", "heatpermole", "totalenthalpy", "enthalpypergram", "enthalpypermole"}},
      {"specific_heat",
       "J/kg/K",
       true,
       {"specificheat", "specificheatcapacity", "cp", "heatcapacity", "apparentheatcapacity",
        "apparentspecificheat", "apparentheatcapacitypergram", "heatcapacitypergram",
        "effectivespecificheat"}},
      {"density", "kg/m3", true, {"density", "rho", "massdensity"}},
      {"conductivity", "W/m/K", true, {"conductivity", "thermalconductivity", "k", "lambda"}},
      {"young_modulus",
       "Pa",
       true,
       {"youngmodulus", "youngsmodulus", "modulusofelasticity", "young'smodulus", "elasticmodulus", "e"}},
      {"poisson_ratio", "1", false, {"poissonratio", "poissonsratio", "poisson'sratio", "nu"}},
      {"expansion",
       "1/K",
       true,
       {"expansion", "thermalexpansion", "thermalexpansioncoefficient", "linearexpansion",
        "averageexpansioncoefficient", "averageexpansioncoeff.", "averageexpansioncoeff",
        "expansioncoefficient", "coefficientofthermalexpansion", "cte", "alpha",
        "meancoefficientofthermalexpansion", "thermalexpansioncoeff.", "meanlinearexpansioncoefficient",
        "linearthermalexpansion"}},
  }};
  return all;
}

std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '_' && c != '-')
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// y = scale x + offset from the column's unit to the quantity's.
units::Conversion conversion_of(const Quantity& quantity, const Column& column, const ImportOptions& options,
                                const std::string& file) {
  const SourceLocation where{file, 0, 0};
  const std::string expected = quantity.unit;
  // A header without a unit will do for a fraction only: a unit that is guessed wrong is an error
  // that no one sees.
  if (column.unit.empty()) {
    if (!quantity.unit_needed) return {};
    // pycalphad's Scheil has kelvins without saying so.
    if (expected == "K" && column.name == "temperatures") return {};
    throw InputError(where, fmt::format("the column '{}' has no unit", column.header),
                     fmt::format("a header with a unit, '{} [{}]', or --column \"{}={}:{}\"", column.name,
                                 expected == "K" ? "C" : expected, quantity.name, column.header,
                                 expected == "K" ? "C" : expected));
  }
  // Values for each mole need the molar mass; only heat and capacity occur in that way.
  std::string unit = column.unit;
  const bool per_mole = take_mole(unit);
  if (per_mole && !options.molar_mass)
    throw InputError(where, fmt::format("the column '{}' is for each mole", column.header),
                     "--molar-mass \"27.1 g/mol\", or a table for each gram");
  const std::string of_mole = expected == "J/kg" ? "J" : expected == "J/kg/K" ? "J/K" : "";
  try {
    if (!per_mole || of_mole.empty()) return conversion_of_spelling(unit, expected);
    units::Conversion conversion = conversion_of_spelling(unit, of_mole);
    conversion.scale /= *options.molar_mass;
    return conversion;
  } catch (const std::invalid_argument& error) {
    throw InputError(where, fmt::format("the column '{}': {}", column.header, error.what()));
  }
}

/// The column of a quantity: the one that the user names, or the one with a known header.
const Column* find_column(const ColumnTable& table, const Quantity& quantity, const ImportOptions& options,
                          Column& renamed) {
  // The user may name a column with a unit behind a colon; a colon may also belong to the name.
  if (const auto given = options.columns.find(quantity.name); given != options.columns.end()) {
    std::string header = given->second, unit;
    const auto matches = [&](const Column& c) { return c.header == header || c.name == header; };
    auto found = std::find_if(table.columns.begin(), table.columns.end(), matches);
    if (const auto colon = header.rfind(':'); found == table.columns.end() && colon != std::string::npos) {
      unit = header.substr(colon + 1);
      header.resize(colon);
      found = std::find_if(table.columns.begin(), table.columns.end(), matches);
    }
    if (found == table.columns.end())
      throw InputError({table.file, 0, 0}, fmt::format("there is no column '{}'", header),
                       one_of(table.headers(), header));
    renamed = *found;
    if (!unit.empty()) renamed.unit = unit;
    return &renamed;
  }
  // Otherwise the first header that is known for the quantity.
  for (const Column& column : table.columns) {
    const HeaderParts parts = parts_of_header(column);
    if (std::find(quantity.headers.begin(), quantity.headers.end(), plain(parts.name)) ==
        quantity.headers.end())
      continue;
    renamed = column;
    renamed.name = parts.name;
    renamed.unit = parts.unit;
    return &renamed;
  }
  return nullptr;
}

void read_column(const Quantity& quantity, const Column& column, const ColumnTable& table,
                 const ImportOptions& options, ImportColumns& result) {
  const units::Conversion convert = conversion_of(quantity, column, options, table.file);
  std::vector<double> values;
  // Every row needs a number; temperature is kept apart from the other columns.
  for (std::size_t row = 0; row < column.values.size(); ++row) {
    if (!std::isfinite(column.values[row]))
      throw InputError(table.place(column, row), fmt::format("'{}' has no number here", column.header),
                       "a number in every row");
    values.push_back(convert(column.values[row]));
  }
  if (std::string(quantity.name) == "temperature") {
    result.temperature = std::move(values);
    result.lines = column.lines;
  } else {
    result.values[quantity.name] = std::move(values);
  }
  result.headers[quantity.name] = column.header;
}

/// Rising temperature; throws where the rows turn back.
void put_in_order(ImportColumns& c) {
  // All columns have one value for each temperature, and a temperature lies above absolute zero.
  auto& t = c.temperature;
  if (t.size() < 2) throw InputError({c.file, 0, 0}, "the table has fewer than two rows");
  for (const auto& [name, values] : c.values)
    if (values.size() != t.size())
      throw InputError({c.file, 0, 0},
                       fmt::format("the column '{}' has {} values, that of the temperature {}",
                                   c.headers[name], values.size(), t.size()),
                       "columns of equal length");
  // Tables of cooling fall, tables of heating rise: either is fine, a change of direction is not.
  const bool falling = t.front() > t.back();
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!(t[i] > 0))
      throw InputError(c.place(i), fmt::format("a temperature of {:.6g} K", t[i]), "above 0 K");
    if (i > 0 && (falling ? t[i] > t[i - 1] : t[i] < t[i - 1]))
      throw InputError(c.place(i),
                       fmt::format("the temperature {:.6g} K lies {} the one before, {:.6g} K", t[i],
                                   falling ? "above" : "below", t[i - 1]),
                       "temperatures that only rise or only fall from row to row");
  }
  if (!falling) return;
  // Falling tables are turned over together with their lines, so that messages name the right line.
  std::reverse(t.begin(), t.end());
  std::reverse(c.lines.begin(), c.lines.end());
  for (auto& [name, values] : c.values) std::reverse(values.begin(), values.end());
}

/// One row for each state: a row that repeats the one before is left out.
void drop_repeated_rows(ImportColumns& c) {
  // A state is told by temperature, fraction and enthalpy: at a jump two of its rows have one
  // temperature.
  std::size_t kept = 1;
  for (std::size_t i = 1; i < c.temperature.size(); ++i) {
    bool same = c.temperature[i] == c.temperature[kept - 1];
    for (const char* name : {"solid_fraction", "enthalpy"})
      same = same && (!c.has(name) || c.of(name)[i] == c.of(name)[kept - 1]);
    if (same) continue;
    c.temperature[kept] = c.temperature[i];
    c.lines[kept] = c.lines[i];
    for (auto& [name, values] : c.values) values[kept] = values[i];
    ++kept;
  }
  c.temperature.resize(kept);
  c.lines.resize(kept);
  for (auto& [name, values] : c.values) values.resize(kept);
}

constexpr double k_rounding = 1e-6;  ///< of a fraction, as programs print it

void check_fractions(ImportColumns& c) {
  const bool liquid = !c.has("solid_fraction");
  auto& values = c.values[liquid ? "liquid_fraction" : "solid_fraction"];
  // Fractions within rounding of 0 to 1, then that of the solid, which must not rise with temperature.
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < -k_rounding || values[i] > 1 + k_rounding)
      throw InputError(c.place(i),
                       fmt::format("a {} fraction of {:.9g}", liquid ? "liquid" : "solid", values[i]),
                       "0 to 1 (a column in per cent says so: [%])");
    values[i] = std::clamp(values[i], 0.0, 1.0);
  }
  if (liquid) {
    for (double& value : values) value = 1 - value;
    c.values["solid_fraction"] = std::move(values);
    c.headers["solid_fraction"] = c.headers["liquid_fraction"];
  }
  // From here on there is only the solid fraction.
  c.values.erase("liquid_fraction");
  auto& f = c.values["solid_fraction"];
  for (std::size_t i = 1; i < f.size(); ++i) {
    if (f[i] > f[i - 1] + k_rounding)
      throw InputError(
          c.place(i),
          fmt::format("the solid fraction {:.9g} at {:.6g} K is above that of the colder row, {:.9g}", f[i],
                      c.temperature[i], f[i - 1]),
          "a solid fraction that does not rise with temperature");
    f[i] = std::min(f[i], f[i - 1]);
  }
}

void check_enthalpy(const ImportColumns& c) {
  if (!c.has("enthalpy")) return;
  const auto& h = c.of("enthalpy");
  for (std::size_t i = 1; i < h.size(); ++i)
    if (!(h[i] > h[i - 1]))
      throw InputError(
          c.place(i),
          fmt::format("the enthalpy {:.9g} J/kg at {:.6g} K is not above that of the colder row, "
                      "{:.9g} J/kg",
                      h[i], c.temperature[i], h[i - 1]),
          "an enthalpy that rises with temperature");
}

}  // namespace

std::vector<std::string> import_quantities() {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities()) names.emplace_back(quantity.name);
  return names;
}

ImportColumns import_columns(const ColumnTable& table, const ImportOptions& options) {
  // First the names that the user gives are checked, then each quantity looks for its column: the one that
  // was named, or one whose header it knows.
  for (const auto& [name, header] : options.columns) {
    const auto names = import_quantities();
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError({}, fmt::format("--column: there is no quantity '{}'", name), one_of(names, name));
  }
  ImportColumns result;
  result.file = table.file;
  for (const Quantity& quantity : quantities()) {
    Column renamed;
    if (const Column* column = find_column(table, quantity, options, renamed))
      read_column(quantity, *column, table, options, result);
  }
  // Columns that nothing uses are told, since one of them may have been meant.
  for (const Column& column : table.columns) {
    const bool taken = std::ranges::any_of(
        result.headers, [&](const auto& header) { return header.second == column.header; });
    if (!taken) result.unused.push_back(column.header);
  }
  const auto need = [&](const char* name, bool there) {
    if (!there)
      throw InputError({table.file, 0, 0}, fmt::format("the table has no column of the {}", name),
                       fmt::format("--column \"{}=HEADER\" with {}", name, one_of(table.headers())));
  };
  // Rows are put in order of temperature at last, repeated ones dropped, and fractions checked.
  need("temperature", !result.temperature.empty());
  need("solid_fraction", result.has("solid_fraction") || result.has("liquid_fraction"));
  put_in_order(result);
  drop_repeated_rows(result);
  check_fractions(result);
  check_enthalpy(result);
  return result;
}

}  // namespace solidus::material
