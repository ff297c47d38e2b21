/// Shapes in STEP files (.step), and the unit that they name: ISO 10303-21 and -41.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>

#include "mesh/files/file_format.hpp"
#include "mesh/files/format_signs.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return is_text(head) && head.find("ISO-10303-21") != std::string_view::npos;
}

/// Statements of the data section that speak of units: text by number, without blanks outside of strings.
std::map<long, std::string> unit_statements(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  std::map<long, std::string> found;
  std::string statement;
  bool in_string = false;
  // A statement that speaks of a unit has a number before its sign of equality.
  const auto end_statement = [&] {
    const bool of_units = statement.find("UNIT") != std::string::npos;
    if (of_units && statement.starts_with('#')) {
      long number = 0;
      const auto [end, error] =
          std::from_chars(statement.data() + 1, statement.data() + statement.size(), number);
      if (error == std::errc{} && *end == '=') found[number] = std::string(end + 1);
    }
    statement.clear();
  };
  // Statements end at a semicolon; outside of strings comments and blanks are left out.
  for (std::size_t i = 0; i < all.size(); ++i) {
    const char c = all[i];
    // A quote switches between text and code; two in a row switch twice, as the format means them.
    if (c == '\'') in_string = !in_string;
    if (!in_string && c == '/' && i + 1 < all.size() && all[i + 1] == '*') {
      const std::size_t close = all.find("*/", i + 2);
      i = close == std::string::npos ? all.size() : close + 1;
      continue;
    }
    if (!in_string && c == ';') {
      end_statement();
      continue;
    }
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (in_string || !blank) statement += c;
  }
  return found;
}

/// The numbers that a text refers to: "(#1,#2)".
std::vector<long> references(const std::string& text) {
  std::vector<long> all;
  for (std::size_t at = text.find('#'); at != std::string::npos; at = text.find('#', at + 1)) {
    long number = 0;
    if (std::from_chars(text.data() + at + 1, text.data() + text.size(), number).ec == std::errc{})
      all.push_back(number);
  }
  return all;
}

/// What is in the brackets behind a word.
std::string arguments_of(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word + "(");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + word.size() + 1;
  int depth = 1;
  std::size_t end = begin;
  for (; end < text.size() && depth > 0; ++end) depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
  return text.substr(begin, end - begin - (depth == 0 ? 1 : 0));
}

std::optional<LengthUnit> step_length_unit(const std::map<long, std::string>& statements, long number,
                                           int depth = 0) {
  // A unit of STEP is an SI unit with a prefix, or is converted from another one, which is looked up in the
  // same way; the depth ends circles.
  const auto found = statements.find(number);
  // An SI unit is a prefix and METRE.
  constexpr int k_deepest = 10;
  if (found == statements.end() || depth > k_deepest) return std::nullopt;
  const std::string& text = found->second;
  if (text.find("LENGTH_UNIT(") == std::string::npos) return std::nullopt;
  if (const std::string si = arguments_of(text, "SI_UNIT"); !si.empty()) {
    struct Prefix {
      const char *step, *sign;
      double factor;
    };
    constexpr std::array<Prefix, 9> k_prefixes{{{".KILO.", "k", 1e3},
                                                {".HECTO.", "h", 1e2},
                                                {".DECA.", "da", 10},
                                                {".DECI.", "d", 0.1},
                                                {".CENTI.", "c", 0.01},
                                                {".MILLI.", "m", 1e-3},
                                                {".MICRO.", "u", 1e-6},
                                                {".NANO.", "n", 1e-9},
                                                {"$", "", 1}}};
    if (si.find(".METRE.") == std::string::npos) return std::nullopt;
    for (const Prefix& prefix : k_prefixes)
      if (si.starts_with(prefix.step)) return LengthUnit{std::string(prefix.sign) + "m", prefix.factor};
    return std::nullopt;
  }
  // A unit that is converted names a measure: a number of base units, which multiply.
  const std::string conversion = arguments_of(text, "CONVERSION_BASED_UNIT");
  const std::vector<long> measure = references(conversion);
  if (measure.empty() || !statements.contains(measure[0])) return std::nullopt;
  const std::string& factor = statements.at(measure[0]);
  const std::string value = arguments_of(factor, "LENGTH_MEASURE");
  double number_of = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number_of);
  const std::vector<long> base = references(factor);
  if (error != std::errc{} || !(number_of > 0) || base.empty()) return std::nullopt;
  const auto of_base = step_length_unit(statements, base.back(), depth + 1);
  if (!of_base) return std::nullopt;
  // Its name is given in quotes and capitals.
  std::string name = conversion.substr(0, conversion.find(','));
  std::erase(name, '\'');
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return LengthUnit{name, number_of * of_base->metres};
}

std::optional<LengthUnit> step_unit(const std::string& path) {
  const std::map<long, std::string> statements = unit_statements(path);
  std::vector<LengthUnit> units;
  for (const auto& [number, text] : statements)
    for (const long unit : references(arguments_of(text, "GLOBAL_UNIT_ASSIGNED_CONTEXT")))
      if (const auto length = step_length_unit(statements, unit))
        if (std::ranges::find(units, length->metres, &LengthUnit::metres) == units.end())
          units.push_back(*length);
  if (units.empty()) return std::nullopt;
  if (units.size() == 1) return units[0];
  std::string names;
  for (const LengthUnit& unit : units) names += (names.empty() ? "" : " and ") + unit.name;
  return LengthUnit{names, 0};  // the kernel converts each part by its own
}

}  // namespace

FileFormat format_step() {
  return {.name = "STEP",
          .place = 30,
          .endings = {".step", ".STEP", ".stp", ".STP"},
          .begins = &begins,
          .begins_with = "'ISO-10303-21'",
          .told = ".step",
          .holds = FileHolds::shapes,
          .by_gmsh = true,
          .unit = &step_unit,
          .in_mm = true};
}

}  // namespace solidus::mesh
