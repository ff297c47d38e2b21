/// Quantities with units, by UDUNITS-2: text or numbers of the user -> the unit the code computes in, and
/// back for display.
///
/// The expected unit names the dimension and the scale at once ("W/m2/K", "K", "1"). Any unit of the same
/// dimension is accepted, in ASCII ("N/mm2", "degC", "percent") or UTF-8 ("N/mm²", "°C", "%"). Reading input
/// happens on one thread; UDUNITS is not thread-safe.
#pragma once

#include <string>
#include <string_view>

namespace solidus::units {

/// "20 degC" is 293.15 K as a temperature, but 20 K as a temperature difference.
enum class Temperature { absolute, difference };

/// A number and the unit behind it, "2.3 N/mm/s/K" -> {2.3, "N/mm/s/K"}; "3" has the empty unit, "1.2e-5 /K"
/// the unit "1/K".
struct Quantity {
  double value;
  std::string unit;
};

/// Throws std::invalid_argument when the text does not begin with a finite number.
Quantity split_quantity(std::string_view text);

/// Reads "670 degC" with the expected unit "K" as 943.15.
/// Throws std::invalid_argument, with the expected dimension and an example of what is accepted, when the
/// text is not a number with a unit, the unit is unknown, or the dimension is another one. A bare number is
/// accepted where the expected unit is "1".
double parse_quantity(std::string_view text, std::string_view expected_unit,
                      Temperature kind = Temperature::absolute);

/// Reads a quantity of any dimension that the program knows, in the SI unit of that dimension: "2.5 mm/s" is
/// 0.0025, "600 degC" 873.15, "3" 3. Throws std::invalid_argument as parse_quantity does.
double si_quantity(std::string_view text);

/// The same for a number whose unit is elsewhere (tables with one unit).
double convert(double value, std::string_view unit, std::string_view expected_unit,
               Temperature kind = Temperature::absolute);

/// y = scale * x + offset: convert() for many numbers, and in the other direction for display.
struct Conversion {
  double scale = 1, offset = 0;
  double operator()(double x) const { return scale * x + offset; }
};
Conversion conversion(std::string_view unit, std::string_view expected_unit,
                      Temperature kind = Temperature::absolute);

/// From the unit the code computes in to a unit for display: `to_display(293.15, "K", "degC")` is 20.
double to_display(double value, std::string_view internal_unit, std::string_view display_unit,
                  Temperature kind = Temperature::absolute);

/// True when `unit` can be read and has the dimension of `expected_unit`.
bool compatible(std::string_view unit, std::string_view expected_unit);

/// Returns the quantity that a unit measures, for messages and the manual: "K" -> "a temperature", "Pa" -> "a
/// stress or pressure".
std::string dimension_name(std::string_view expected_unit);

/// A text that parse_quantity accepts for the expected unit: "K" -> "20 degC".
std::string example(std::string_view expected_unit);

}  // namespace solidus::units
