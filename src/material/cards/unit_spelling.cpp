/// Spellings of data sheets become spellings of UDUNITS: characters first, then symbols with their powers,
/// at last factors of units that UDUNITS does not know.
#include "material/cards/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

namespace solidus::material {

namespace {

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// Raised digits and signs, dots and degrees of UTF-8 as ASCII: "10⁻⁶/K" is "10^-6/K".
std::string in_ascii(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> k_raised{{{"⁰", "0"},
                                                                                    {"¹", "1"},
                                                                                    {"²", "2"},
                                                                                    {"³", "3"},
                                                                                    {"⁴", "4"},
                                                                                    {"⁵", "5"},
                                                                                    {"⁶", "6"},
                                                                                    {"⁷", "7"},
                                                                                    {"⁸", "8"},
                                                                                    {"⁹", "9"}}};
  // Signs first, so that a raised minus stays with its digit.
  replace_all(text, "⁻", "^-");
  for (const auto& [raised, plain] : k_raised) {
    replace_all(text, std::string("^-") + std::string(raised), "^-" + std::string(plain));
    replace_all(text, raised, "^" + std::string(plain));
  }
  for (const char* dot : {"·", "⋅", "×", "•"}) replace_all(text, dot, "*");
  replace_all(text, "−", "-");
  for (const char* micro : {"µ", "μ"}) replace_all(text, micro, "u");
  for (const char* degree : {"°", "º"}) replace_all(text, degree, "deg");
  replace_all(text, "**", "^");
  replace_all(text, "deg ", "deg");
  return text;
}

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '%' || c == '\'';
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::string lower(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small;
}

/// Takes powers of ten of six, whatever their sign, and signs of multiplication next to them out of the unit
/// of an expansion. Returns whether there was one.
bool take_millionths(std::string& unit) {
  for (const char* power : {"10^-6", "10^6", "10e-6", "10E-6", "1e-6", "1E-6", "1.0e-6", "1e6", "1E6",
                            "1E-06", "1e-06", "10-6", "10e6", "10E6", "ppm", "PPM", "E-6", "e-6"}) {
    const auto at = unit.find(power);
    if (at == std::string::npos) continue;
    unit.erase(at, std::char_traits<char>::length(power));
    for (const char* sign : {" x ", " X ", "x ", " x", "*"})
      if (const auto there = unit.find(sign); there != std::string::npos && there <= at + 1 &&
                                              (there == 0 || there + 3 >= unit.size() || unit[there] == ' '))
        unit.erase(there, std::char_traits<char>::length(sign));
    while (!unit.empty() && (unit.front() == ' ' || unit.front() == 'x' || unit.front() == '*'))
      unit.erase(unit.begin());
    while (!unit.empty() && (unit.back() == ' ' || unit.back() == 'x' || unit.back() == '*')) unit.pop_back();
    if (unit.starts_with("/")) unit.insert(0, "1");
    return true;
  }
  return false;
}

struct Factor {
  std::string symbol;
  int power;
};

/// What UDUNITS calls a symbol, and how many of that it is.
struct Known {
  std::string_view symbol, udunits;
  double times = 1;
};
constexpr double k_rankine = 5.0 / 9.0;  // [K]
constexpr std::array<Known, 40> k_known{{{"c", "K"},
                                         {"degc", "K"},
                                         {"celsius", "K"},
                                         {"degk", "K"},
                                         {"kelvin", "K"},
                                         {"deg", "K"},
                                         {"f", "K", k_rankine},
                                         {"degf", "K", k_rankine},
                                         {"fahrenheit", "K", k_rankine},
                                         {"r", "K", k_rankine},
                                         {"degr", "K", k_rankine},
                                         {"rankine", "K", k_rankine},
                                         {"lbm", "lb"},
                                         {"lbs", "lb"},
                                         {"lb", "lb"},
                                         {"btu", "Btu"},
                                         {"psi", "psi"},
                                         {"ksi", "psi", 1e3},
                                         {"msi", "psi", 1e6},
                                         {"hr", "hour"},
                                         {"sec", "s"},
                                         {"inch", "in"},
                                         {"cc", "cm3"},
                                         {"mole", "mol"},
                                         {"joule", "J"},
                                         {"watt", "W"},
                                         {"gram", "g"},
                                         {"grams", "g"},
                                         {"gm", "g"},
                                         {"kgm", "kg"},
                                         {"cal", "cal"},
                                         {"kcal", "kcal"},
                                         {"gpa", "GPa"},
                                         {"kpa", "kPa"},
                                         {"microns", "um"},
                                         {"micron", "um"},
                                         {"microinch", "in", 1e-6},
                                         {"uin", "in", 1e-6},
                                         {"ton", "t"},
                                         {"tonne", "t"}}};

/// Symbols with their powers. All behind the first slash is below it, unless it has a sign of its own.
std::vector<Factor> factors_of(const std::string& unit) {
  std::vector<Factor> factors;
  bool below = false;
  // One symbol with its power after the other.
  for (std::size_t i = 0; i < unit.size();) {
    if (unit[i] == '/') {
      below = true;
      ++i;
      continue;
    }
    if (!is_letter(unit[i])) {
      if (is_digit(unit[i]) && !(unit[i] == '1' && (i + 1 == unit.size() || !is_digit(unit[i + 1]))))
        return {};  // a number that is no 1
      ++i;
      continue;
    }
    // The letters of the symbol, then what may be between it and its power: brackets and a
    // caret.
    std::size_t end = i;
    while (end < unit.size() && is_letter(unit[end])) ++end;
    std::string symbol = unit.substr(i, end - i);
    std::size_t at = end;
    while (at < unit.size() && (unit[at] == ')' || unit[at] == '^' || unit[at] == '(')) ++at;
    int power = 1;
    const bool sign = at < unit.size() && (unit[at] == '-' || unit[at] == '+');
    const std::size_t first = at + (sign ? 1 : 0);
    // A digit behind a blank or a bracket alone is none of this symbol.
    const bool attached = at == end || unit.substr(end, at - end).find('^') != std::string::npos;
    // A power that is attached belongs to the symbol, with its sign.
    if (attached && first < unit.size() && is_digit(unit[first])) {
      std::from_chars(unit.data() + first, unit.data() + unit.size(), power);
      if (sign && unit[at] == '-') power = -power;
      end = first;
      while (end < unit.size() && is_digit(unit[end])) ++end;
    }
    // Below the slash powers count down.
    if (below && power > 0) power = -power;
    // "mK" below a slash, and "W/mC" and "kgK", are two units.
    if (below && symbol.size() > 1 &&
        (symbol.back() == 'K' || symbol == "mC" || symbol == "gC" || symbol == "kgC")) {
      factors.push_back({symbol.substr(0, symbol.size() - 1), -1});
      symbol = symbol.substr(symbol.size() - 1);
    }
    if (const auto degree = symbol.find("deg"); below && degree != std::string::npos && degree > 0) {
      factors.push_back({symbol.substr(0, degree), -1});
      symbol = symbol.substr(degree);
    }
    factors.push_back({symbol, power});
    i = end;
  }
  return factors;
}

/// The same unit for UDUNITS and the number of them that one is.
std::pair<std::string, double> for_udunits(const std::string& unit) {
  std::string text;
  double times = 1;
  const std::vector<Factor> factors = factors_of(unit);
  if (factors.empty()) return {unit, 1};
  // Symbols that UDUNITS lacks are replaced, with their factor; a power multiplies the factor as
  // often.
  for (const Factor& f : factors) {
    std::string symbol = f.symbol;
    int power = f.power;
    const std::string small = lower(symbol);
    const auto known = std::ranges::find(k_known, std::string_view(small), &Known::symbol);
    if (known != k_known.end()) {
      for (int i = 0; i < std::abs(power); ++i) times *= power > 0 ? known->times : 1 / known->times;
      symbol = known->udunits;
      if (symbol == "cm3") symbol = "cm", power *= 3;
    }
    text += fmt::format("{}{}{}", text.empty() ? "" : " ", symbol, power == 1 ? "" : std::to_string(power));
  }
  return {text, times};
}

/// A temperature with its zero; nothing for what is none.
std::optional<std::string> scale_of_temperature(const std::string& unit) {
  std::string small = lower(unit);
  std::erase_if(small, [](char c) { return c == ' ' || c == '.' || c == '_'; });
  if (small == "c" || small == "degc" || small == "celsius" || small == "degreesc" || small == "degcelsius")
    return "degC";
  if (small == "f" || small == "degf" || small == "fahrenheit") return "degF";
  if (small == "k" || small == "degk" || small == "kelvin") return "K";
  return std::nullopt;
}

}  // namespace

bool take_mole(std::string& unit) {
  const std::string original = unit;
  unit = in_ascii(unit);
  // Brackets around the mole may go: what is below the slash stays below.
  if (unit.find("(mol") != std::string::npos || unit.find("mol)") != std::string::npos)
    std::erase_if(unit, [](char c) { return c == '(' || c == ')'; });
  for (const char* mole : {"/mole", "/mol", " mol-1", " mol^-1", "*mol-1", ".mol-1", " mol", "*mol", ".mol"})
    if (const auto at = unit.find(mole); at != std::string::npos) {
      unit.erase(at, std::char_traits<char>::length(mole));
      // What stood next to it below the slash is still below.
      if (at < unit.size() && std::string_view("-.* ").find(unit[at]) != std::string_view::npos &&
          at + 1 < unit.size() && is_letter(unit[at + 1]) && mole[0] == '/')
        unit[at] = '/';
      else if (at < unit.size() && is_letter(unit[at]) && mole[0] == '/')
        unit.insert(at, "/");
      return true;
    }
  unit = original;
  return false;
}

units::Conversion conversion_of_spelling(std::string_view given, std::string_view expected) {
  std::string unit = in_ascii(std::string(given));
  // A column of temperatures: scales with an offset are told apart from differences.
  if (expected == "K") {
    const std::string small = lower(unit);
    if (small == "r" || small == "degr" || small == "rankine") return {k_rankine, 0};
    if (const auto scale = scale_of_temperature(unit))
      return units::conversion(*scale, expected, units::Temperature::absolute);
  }
  if (expected == "1" && unit.find('%') != std::string::npos)
    return units::conversion("percent", expected, units::Temperature::absolute);
  // All else is a factor: per cent, parts in a million, spellings of data sheets.
  double times = 1;
  if (expected == "1/K" && take_millionths(unit)) times = 1e-6;
  const auto [text, factor] = for_udunits(unit);
  try {
    units::Conversion conversion = units::conversion(text, expected, units::Temperature::difference);
    conversion.scale *= times * factor;
    return conversion;
  } catch (const std::invalid_argument&) {
    // In the words of the file, with what was expected; should UDUNITS read these they are right as they are.
    units::Conversion conversion = units::conversion(given, expected, units::Temperature::difference);
    return conversion;
  }
}

}  // namespace solidus::material
