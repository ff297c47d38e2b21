// ISO 10303-21 and -41 for STEP, IGES 5.3, section 2.2.4.3, for IGES.
#include "mesh/files/file_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

#include "input/units.hpp"
#include "mesh/files/file_format.hpp"

namespace solidus::mesh {

namespace {

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

/// What stands in the brackets behind a word.
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

/// Parameters of the global section, of which strings are "4HINCH".
std::vector<std::string> iges_parameters(const std::string& path) {
  std::ifstream file(path);
  std::string line, text;
  while (std::getline(file, line) && text.size() < 100'000) {
    if (line.size() < 73) break;
    if (line[72] == 'G')
      text += line.substr(0, 72);
    else if (line[72] != 'S')
      break;
  }
  std::vector<std::string> parameters;
  char separator = ',', end = ';';
  std::string word;
  for (std::size_t i = 0; i < text.size(); ++i) {
    // A number and an H, and as many letters as the number says.
    if (text[i] == 'H' && !word.empty() && word.find_first_not_of("0123456789") == std::string::npos &&
        word.size() < 6) {
      const auto n = static_cast<std::size_t>(std::stoi(word));
      word = text.substr(i + 1, n);
      i += n;
      if (parameters.empty() && n == 1) separator = word[0];
      if (parameters.size() == 1 && n == 1) end = word[0];
      continue;
    }
    if (text[i] == separator || text[i] == end) {
      parameters.push_back(word);
      word.clear();
      if (text[i] == end) break;
    } else if (text[i] != ' ') {
      word += text[i];
    }
  }
  return parameters;
}

std::optional<LengthUnit> iges_unit(const std::string& path) {
  const std::vector<std::string> parameters = iges_parameters(path);
  constexpr std::size_t k_flag = 13, k_name = 14;  // the fourteenth and the fifteenth
  if (parameters.size() <= k_flag) return std::nullopt;
  static const std::map<std::string, LengthUnit> known = {
      {"1", {"inch", 0.0254}}, {"2", {"mm", 1e-3}},     {"4", {"ft", 0.3048}},   {"5", {"mile", 1609.344}},
      {"6", {"m", 1}},         {"7", {"km", 1e3}},      {"8", {"mil", 2.54e-5}}, {"9", {"um", 1e-6}},
      {"10", {"cm", 0.01}},    {"11", {"uin", 2.54e-8}}};
  static const std::map<std::string, std::string> named = {
      {"INCH", "1"}, {"IN", "1"},  {"MM", "2"}, {"FT", "4"},  {"MI", "5"},  {"M", "6"},
      {"KM", "7"},   {"MIL", "8"}, {"UM", "9"}, {"CM", "10"}, {"UIN", "11"}};
  // The flag names the unit, 3 that the name does.
  std::string flag = parameters[k_flag];
  if (flag.empty()) flag = "1";  // the default of the format
  if (flag == "3" && parameters.size() > k_name) {
    const auto found = named.find(parameters[k_name]);
    if (found == named.end()) return std::nullopt;
    flag = found->second;
  }
  const auto found = known.find(flag);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

bool is_regular(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

}  // namespace

std::optional<LengthUnit> unit_of_file(const std::string& path) {
  if (!is_regular(path)) return std::nullopt;
  switch (file_format(path)) {
    case FileFormat::step:
      return step_unit(path);
    case FileFormat::iges:
      return iges_unit(path);
    default:
      return std::nullopt;
  }
}

double metres_of_unit(const std::string& path, const std::string& told, const std::string& otherwise,
                      const SourceLocation& where) {
  if (!told.empty() && !units::compatible(told, "m"))
    throw InputError(where, fmt::format("'{}' is no unit of length", told), "\"mm\", \"m\", \"inch\", ...");
  std::optional<LengthUnit> own;
  bool in_mm = false;
  try {
    own = unit_of_file(path);
    const FileFormat format = is_regular(path) ? file_format(path) : FileFormat::gmsh_mesh;
    in_mm = format == FileFormat::step || format == FileFormat::iges;
  } catch (const InputError&) {  // NOLINT: the reader says what is wrong with the file
  }
  constexpr double k_mm = 1e-3;
  // What the file says, which the user must not contradict; else what the user says, else mm for geometries
  // of CAD.
  if (!own) return units::convert(1, !told.empty() ? told : in_mm ? "mm" : otherwise, "m");
  if (!told.empty()) {
    constexpr double k_rounding = 1e-5;
    if (const double metres = units::convert(1, told, "m");
        !(std::abs(metres / own->metres - 1) < k_rounding))
      throw InputError(
          where,
          fmt::format("the unit '{}' contradicts the file '{}', which says itself that its lengths are in {}",
                      told, path, own->name),
          own->metres > 0 ? fmt::format("no unit, or \"{}\"", own->name) : "no unit");
  }
  return k_mm;
}

}  // namespace solidus::mesh
