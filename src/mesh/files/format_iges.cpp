/// Shapes in IGES files (.iges), and the unit that they name: IGES 5.3, section 2.2.4.3.
#include <fstream>
#include <map>

#include "mesh/files/file_format.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

/// Column 73 of an IGES line names its section: S (start), or C and B of the compressed and binary forms.
bool begins(std::string_view head) {
  return head.size() > 72 && (head[72] == 'S' || head[72] == 'C' || head[72] == 'B');
}

/// Parameters of the global section, of which strings are "4HINCH".
std::vector<std::string> iges_parameters(const std::string& path) {
  // Records have 80 columns, of which the 73rd tells the section: S is a title, G the global
  // section.
  std::ifstream file(path);
  std::string line, text;
  while (std::getline(file, line) && text.size() < 100'000) {
    if (line.size() < 73) break;
    if (line[72] == 'G')
      text += line.substr(0, 72);
    else if (line[72] != 'S')
      break;
  }
  // The first two parameters may redefine the separators, which are then used at once.
  std::vector<std::string> parameters;
  char separator = ',', end = ';';
  std::string word;
  for (std::size_t i = 0; i < text.size(); ++i) {
    // A number and an H, and as many letters as the number says.
    if (text[i] == 'H' && !word.empty() && word.find_first_not_of("0123456789") == std::string::npos &&
        word.size() < 6) {
      const auto n = as_size(std::stoi(word));
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
  // The unit is told by two parameters near the end of the section.
  const std::vector<std::string> parameters = iges_parameters(path);
  constexpr std::size_t k_flag = 13, k_name = 14;  // the fourteenth and the fifteenth
  if (parameters.size() <= k_flag) return std::nullopt;
  // Flags of the format with their lengths, and the names under which programs write them.
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

}  // namespace

FileFormat format_iges() {
  return {.name = "IGES",
          .place = 50,
          .endings = {".iges", ".IGES", ".igs", ".IGS"},
          .begins = &begins,
          .begins_with = "lines of 80 columns, the 73rd an 'S'",
          .holds = FileHolds::shapes,
          .by_gmsh = true,
          .unit = &iges_unit,
          .in_mm = true};
}

}  // namespace solidus::mesh
