/// The keys of a spread and the rules that a width of uncertainty obeys.
#include "material/spread.hpp"

#include <fmt/format.h>

namespace solidus::material {

namespace {

Section<Spread> declared_keys() {
  Section<Spread> s("spread", "A spread: relative, factor or shift, and its source.");
  s.key("relative", &Spread::relative)
      .range(0, 0.9)
      .doc("Half width of the range that holds 95 % of the values, as a share of the value: 0.05 is 5 %.");
  s.key("factor", &Spread::factor)
      .range(1, 100)
      .doc(
          "95 % of the values lie between the value divided and the value multiplied by it, evenly in the "
          "logarithm.");
  s.quantity("shift", &Spread::shift, "K")
      .difference()
      .range(0, 500)
      .doc("Half width of the range that holds 95 % of the temperatures.");
  s.key("source", &Spread::source)
      .initially("")
      .doc("Where the range is published, or what it is estimated from.");
  s.key("estimate", &Spread::estimate)
      .initially(false)
      .doc("True: the range is not published with the value, but typical of such data.");
  s.place(&Spread::where);
  return s;
}

}  // namespace

const Section<Spread>& spread_keys() {
  static const Section<Spread> keys = declared_keys();
  return keys;
}

void check_spread(const Spread& spread, bool of_temperature, const std::string& what) {
  // One width of the kind that fits the quantity, and where it comes from.
  const int given =
      int{spread.relative.has_value()} + int{spread.factor.has_value()} + int{spread.shift.has_value()};
  const char* const allowed = of_temperature ? "{ shift = \"5 K\", estimate = true }, for example"
                                             : "{ relative = 0.05, source = \"…\" } or { factor = 1.5, … }";
  // Exactly one width; temperatures have theirs in kelvin, everything else as a share or a factor.
  if (given != 1)
    throw InputError(spread.where,
                     fmt::format("the spread of {} has {}", what,
                                 given == 0 ? "no width" : "more than one of relative, factor and shift"),
                     allowed);
  if (of_temperature != spread.shift.has_value())
    throw InputError(spread.where,
                     of_temperature
                         ? fmt::format("{} is a temperature, and its spread one in kelvin", what)
                         : fmt::format("{} is no temperature, and its spread no shift in kelvin", what),
                     allowed);
  // A width without a source is allowed only where it is called an estimate.
  if (spread.source.empty() && !spread.estimate)
    throw InputError(spread.where, fmt::format("the spread of {} says not where it comes from", what),
                     "a 'source', or estimate = true");
}

std::string spread_text(const Spread& spread) {
  if (spread.relative) return fmt::format("{:.3g} %", 100 * *spread.relative);
  if (spread.factor) return fmt::format("a factor of {:.3g}", *spread.factor);
  return fmt::format("{:.3g} K", spread.shift.value_or(0));
}

}  // namespace solidus::material
