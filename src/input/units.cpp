/// Text is split into number and unit, the unit is converted by UDUNITS, and an error says what the key
/// expects.
#include "input/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "numbers/index_casts.hpp"

namespace solidus::units {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// The unit database, read once (a few milliseconds), and the units met so far.
class Database {
 public:
  static Database& instance() {
    static Database database;
    return database;
  }

  /// Null when the text is not a unit.
  const ut_unit* find(std::string_view text) {
    const auto found = units_.find(text);
    if (found != units_.end()) return found->second.get();
    const std::string key(text);
    std::string trimmed = key;  // UDUNITS takes neither blanks around a unit nor a leading slash
    trimmed.erase(0, trimmed.find_first_not_of(" \t"));
    trimmed.erase(trimmed.find_last_not_of(" \t") + 1);
    if (!trimmed.empty() && trimmed.front() == '/') trimmed.insert(0, 1, '1');
    return units_.emplace(key, Unit(ut_parse(system_.get(), trimmed.c_str(), UT_UTF8))).first->second.get();
  }

 private:
  Database() {
    ut_set_error_message_handler(ut_ignore);  // the library never prints
    system_.reset(ut_read_xml(nullptr));
    if (!system_)
      throw std::runtime_error("the unit database of UDUNITS-2 cannot be read (package libudunits2-data)");
  }

  std::unique_ptr<ut_system, FreeSystem> system_;
  std::map<std::string, Unit, std::less<>> units_;  // after system_: freed before it
};

struct Dimension {
  const char *unit, *name, *example;
};

/// The dimensions that the case and material files use.
constexpr std::array k_dimensions{
    Dimension{"1", "a number without dimension", "0.3"},
    Dimension{"m", "a length", "15 mm"},
    Dimension{"m2", "an area", "2 cm2"},
    Dimension{"s", "a time", "90 s"},
    Dimension{"rad", "an angle", "30 degree"},
    Dimension{"K", "a temperature", "20 degC"},
    Dimension{"kg", "a mass", "2 kg"},
    Dimension{"kg/m3", "a density", "7800 kg/m3"},
    Dimension{"m3/kg", "a volume of gas per mass", "0.15 cm3/(100 g)"},
    Dimension{"m/s", "a velocity", "10 mm/s"},
    Dimension{"m/s2", "an acceleration", "9.81 m/s2"},
    Dimension{"N", "a force", "3.92 kN"},
    Dimension{"Pa", "a stress or pressure", "210 GPa"},
    Dimension{"N/m", "a force per length", "10 N/mm"},
    Dimension{"N/m3", "a stiffness per area or force per volume", "500 N/mm3"},
    Dimension{"Pa s", "a viscosity", "100 Pa s"},
    Dimension{"J", "an energy", "12 kJ"},
    Dimension{"W", "a power", "1 kW"},
    Dimension{"J/kg", "an energy per mass", "395 kJ/kg"},
    Dimension{"J/kg/K", "a specific heat", "500 J/kg/K"},
    Dimension{"J/m3", "an energy per volume", "1e9 J/m3"},
    Dimension{"W/m/K", "a thermal conductivity", "45 W/m/K"},
    Dimension{"W/m2/K", "a heat transfer coefficient", "2.3 N/mm/s/K"},
    Dimension{"W/m2", "a heat flux", "10 kW/m2"},
    Dimension{"W/m3", "a heat source per volume", "1e6 W/m3"},
    Dimension{"W/m", "a power per length", "2 kW/m"},
    Dimension{"m2/s", "a diffusivity", "50 mm2/s"},
    Dimension{"K/m", "a temperature gradient", "2 K/mm"},
    Dimension{"1/K", "an expansion coefficient", "1.2e-5 1/K"},
    Dimension{"1/s", "a rate", "0.01 1/s"},
    Dimension{"K/s", "a cooling rate", "2 K/s"},
};

const Dimension* find_dimension(std::string_view unit) {
  const auto* found = std::find_if(k_dimensions.begin(), k_dimensions.end(),
                                   [&](const Dimension& d) { return unit == d.unit; });
  return found == k_dimensions.end() ? nullptr : found;
}

std::string expectation(std::string_view expected_unit) {
  return "expected " + dimension_name(expected_unit) + ", for example \"" + example(expected_unit) + "\"";
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t") == std::string_view::npos;
}

/// Data sheets write W/mK and W/m2 K for W/(m K) and W/(m2 K). UDUNITS reads the one as watt per millikelvin,
/// the other as a product with kelvin. Returns the unit with brackets where that has the dimension of the
/// expected one, as a sentence for a message, else nothing.
std::string advice_on_brackets(std::string_view unit, std::string_view expected_unit) {
  const std::size_t slash = unit.find('/');
  if (slash == std::string_view::npos) return {};
  std::string_view divisor = unit.substr(slash + 1);
  if (divisor.find_first_of("/()") != std::string_view::npos) return {};
  for (const std::string_view kelvin : {"K", "degC", "\u00b0C"}) {
    if (!divisor.ends_with(kelvin)) continue;
    std::string_view rest = divisor.substr(0, divisor.size() - kelvin.size());
    rest = rest.substr(0, rest.find_last_not_of(" .*") + 1);
    const std::string meant =
        fmt::format("{}/({} {})", unit.substr(0, slash), rest, kelvin == "K" ? kelvin : "degC");
    if (!rest.empty() && compatible(meant, expected_unit))
      return fmt::format("; what follows the slash needs brackets: \"{}\"", meant);
  }
  return {};
}

}  // namespace

Quantity split_quantity(std::string_view text) {
  // Blanks and a plus in front are allowed, which the conversion of numbers does not take.
  std::string_view rest = text;
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  Quantity quantity{};
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), quantity.value);
  if (error != std::errc{} || !std::isfinite(quantity.value))
    throw std::invalid_argument("'" + std::string(text) + "' does not begin with a finite number");
  rest.remove_prefix(as_size(end - rest.data()));
  // A comma with digits behind it is the decimal mark of many countries, and no unit.
  if (rest.size() > 1 && rest.front() == ',' && rest[1] >= '0' && rest[1] <= '9') {
    std::string meant(text);
    meant[meant.find(',')] = '.';
    throw std::invalid_argument(fmt::format("'{}' has a comma; write a decimal point: '{}'", text, meant));
  }
  // What follows the number is the unit, without blanks around it.
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  quantity.unit = rest.substr(0, rest.find_last_not_of(" \t") + 1);
  // UDUNITS would take the rest of "1 500 K" for the unit of 500 kelvin.
  const auto digits = quantity.unit.find_first_not_of("0123456789.");
  if (digits != 0 && digits != std::string::npos && is_blank(quantity.unit.substr(digits, 1)))
    throw std::invalid_argument("'" + std::string(text) + "' holds two numbers");
  if (!quantity.unit.empty() && quantity.unit.front() == '/') quantity.unit.insert(0, 1, '1');
  return quantity;
}

Conversion conversion(std::string_view unit, std::string_view expected_unit, Temperature kind) {
  // The program's own unit must be known, or the source is wrong; the user's need not be.
  Database& database = Database::instance();
  const ut_unit* to = database.find(expected_unit);
  if (to == nullptr)
    throw std::logic_error("the unit '" + std::string(expected_unit) + "' in the program is wrong");
  const ut_unit* from = database.find(unit);
  if (from == nullptr)
    throw std::invalid_argument("'" + std::string(unit) + "' is not a known unit; " +
                                expectation(expected_unit) + advice_on_brackets(unit, expected_unit));
  // The ratio tells the dimension; ut_are_convertible() would also take a time for a frequency.
  const Unit ratio(ut_divide(from, to));
  if (!ratio || !ut_is_dimensionless(ratio.get()) || !ut_are_convertible(from, to)) {
    const std::string found =
        is_blank(unit) ? "a number without unit" : "the unit '" + std::string(unit) + "'";
    throw std::invalid_argument(found + " does not fit; " + expectation(expected_unit) +
                                advice_on_brackets(unit, expected_unit));
  }
  // The converter of the library, freed at the end of the scope.
  const std::unique_ptr<cv_converter, FreeConverter> converter(
      ut_get_converter(const_cast<ut_unit*>(from), const_cast<ut_unit*>(to)));
  // Temperatures have an offset; all other units are a factor.
  const double offset = cv_convert_double(converter.get(), 0.0);
  if (offset == 0) return {cv_convert_double(converter.get(), 1.0), 0.0};
  constexpr double far = 1LL << 40;  // far from zero the offset takes no digits from the scale
  const double scale =
      (cv_convert_double(converter.get(), far) - cv_convert_double(converter.get(), -far)) / (2 * far);
  return {scale, kind == Temperature::difference ? 0.0 : offset};
}

double convert(double value, std::string_view unit, std::string_view expected_unit, Temperature kind) {
  return conversion(unit, expected_unit, kind)(value);
}

double parse_quantity(std::string_view text, std::string_view expected_unit, Temperature kind) {
  Quantity quantity{};
  try {
    quantity = split_quantity(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(error.what()) + "; " + expectation(expected_unit));
  }
  const double value = convert(quantity.value, quantity.unit, expected_unit, kind);
  if (!std::isfinite(value))
    throw std::invalid_argument("'" + std::string(text) + "' is too large; " + expectation(expected_unit));
  return value;
}

double si_quantity(std::string_view text) {
  const Quantity quantity = split_quantity(text);
  for (const Dimension& dimension : k_dimensions)
    if (compatible(quantity.unit, dimension.unit)) return parse_quantity(text, dimension.unit);
  throw std::invalid_argument("'" + quantity.unit + "' is not a unit of a quantity that case files know");
}

double to_display(double value, std::string_view internal_unit, std::string_view display_unit,
                  Temperature kind) {
  return convert(value, internal_unit, display_unit, kind);
}

bool compatible(std::string_view unit, std::string_view expected_unit) {
  try {
    conversion(unit, expected_unit);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

std::string dimension_name(std::string_view expected_unit) {
  const Dimension* dimension = find_dimension(expected_unit);
  return dimension != nullptr ? dimension->name : "a quantity in " + std::string(expected_unit);
}

std::string example(std::string_view expected_unit) {
  const Dimension* dimension = find_dimension(expected_unit);
  return dimension != nullptr ? dimension->example : "1 " + std::string(expected_unit);
}

}  // namespace solidus::units
