/// One line at a time: keywords are split at commas and signs of equality, data at commas, with the number
/// of the line for messages.
#include "mesh/files/abaqus_deck.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace solidus::mesh {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> pieces(std::string_view line) {
  std::vector<std::string> parts;
  while (true) {
    const auto comma = line.find(',');
    parts.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

const std::string* AbaqusKeyword::find(const std::string& parameter) const {
  const auto p = parameters.find(parameter);
  return p == parameters.end() ? nullptr : &p->second;
}

const std::string& AbaqusKeyword::required(const std::string& parameter) const {
  const std::string* value = find(parameter);
  if (value == nullptr || value->empty()) throw InputError(at, "*" + name + " needs " + parameter + "=…");
  return *value;
}

AbaqusKeyword parse_abaqus_keyword(std::string_view line, const SourceLocation& at) {
  AbaqusKeyword keyword;
  keyword.at = at;
  const auto parts = pieces(line.substr(1));
  if (parts.empty()) return keyword;
  // "*END  PART" is "*END PART".
  for (const char c : upper(parts[0]))
    if (c != ' ' || (!keyword.name.empty() && keyword.name.back() != ' ')) keyword.name += c;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto equals = parts[i].find('=');
    const std::string_view value =
        equals == std::string::npos ? std::string_view{} : std::string_view(parts[i]).substr(equals + 1);
    keyword.parameters[upper(std::string(trimmed(std::string_view(parts[i]).substr(0, equals))))] =
        trimmed(value);
  }
  return keyword;
}

void AbaqusLine::fail(const std::string& what, const std::string& allowed) const {
  throw InputError(at, what, allowed);
}

GlobalIndex AbaqusLine::integer(std::size_t i) const {
  if (i >= parts.size())
    fail("the line ends after " + std::to_string(parts.size()) + " values, before the whole number " +
         std::to_string(i + 1));
  const std::string& text = parts[i];
  const std::size_t sign = text.starts_with("+") ? 1 : 0;
  GlobalIndex value = 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) fail("'" + text + "' is no whole number");
  constexpr GlobalIndex k_largest = 10'000'000'000;  // sums and multiples of numbers stay in range
  if (value > k_largest || value < -k_largest) fail("the number " + text + " is larger than ten digits");
  return value;
}

GlobalIndex AbaqusLine::integer(std::size_t i, GlobalIndex without) const {
  return has(i) ? integer(i) : without;
}

double AbaqusLine::real(std::size_t i, double without) const {
  if (!has(i)) return without;
  std::string text = parts[i];
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
  const std::size_t sign = text.starts_with("+") ? 1 : 0;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    fail("'" + text + "' is no number");
  return value;
}

namespace {

// In the order of the alphabet, for a search by halves. Constraints such as *TIE, *EQUATION and *COUPLING
// are not among them: they join meshes, and who reads the mesh alone loses them.
constexpr std::array k_silent{"AMPLITUDE",
                              "ASSEMBLY",
                              "BASE MOTION",
                              "BEAM GENERAL SECTION",
                              "BEAM SECTION",
                              "BOUNDARY",
                              "BUCKLE",
                              "CFLUX",
                              "CLOAD",
                              "CONDUCTIVITY",
                              "CONTACT",
                              "CONTACT CONTROLS",
                              "CONTACT DAMPING",
                              "CONTACT FILE",
                              "CONTACT INCLUSIONS",
                              "CONTACT INITIALIZATION ASSIGNMENT",
                              "CONTACT OUTPUT",
                              "CONTACT PAIR",
                              "CONTACT PRINT",
                              "CONTACT PROPERTY ASSIGNMENT",
                              "CONTROLS",
                              "COUPLED TEMPERATURE-DISPLACEMENT",
                              "CREEP",
                              "CYCLIC HARDENING",
                              "DAMAGE EVOLUTION",
                              "DAMAGE INITIATION",
                              "DAMPING",
                              "DEFORMATION PLASTICITY",
                              "DENSITY",
                              "DEPVAR",
                              "DFLUX",
                              "DIAGNOSTICS",
                              "DLOAD",
                              "DSFLUX",
                              "DSLOAD",
                              "DYNAMIC",
                              "EL FILE",
                              "EL PRINT",
                              "ELASTIC",
                              "ELEMENT OUTPUT",
                              "END ASSEMBLY",
                              "END INSTANCE",
                              "END PART",
                              "END STEP",
                              "ENERGY FILE",
                              "ENERGY OUTPUT",
                              "ENERGY PRINT",
                              "EXPANSION",
                              "FIELD",
                              "FILE FORMAT",
                              "FILE OUTPUT",
                              "FILM",
                              "FILM PROPERTY",
                              "FILTER",
                              "FLUID CONSTANTS",
                              "FREQUENCY",
                              "FRICTION",
                              "GAP",
                              "GAP CONDUCTANCE",
                              "GAP HEAT GENERATION",
                              "GAP RADIATION",
                              "HEADING",
                              "HEAT GENERATION",
                              "HEAT TRANSFER",
                              "HOURGLASS STIFFNESS",
                              "HYPERELASTIC",
                              "HYPERFOAM",
                              "INCIDENT WAVE",
                              "INELASTIC HEAT FRACTION",
                              "INITIAL CONDITIONS",
                              "LATENT HEAT",
                              "MATERIAL",
                              "MEMBRANE SECTION",
                              "MODAL DAMPING",
                              "MODAL DYNAMIC",
                              "MONITOR",
                              "NO COMPRESSION",
                              "NODE FILE",
                              "NODE OUTPUT",
                              "NODE PRINT",
                              "ORIENTATION",
                              "OUTPUT",
                              "PERMEABILITY",
                              "PHYSICAL CONSTANTS",
                              "PLASTIC",
                              "POTENTIAL",
                              "PREPRINT",
                              "PRINT",
                              "RADIATE",
                              "RATE DEPENDENT",
                              "RESTART",
                              "SECTION CONTROLS",
                              "SECTION FILE",
                              "SECTION PRINT",
                              "SFILM",
                              "SHELL GENERAL SECTION",
                              "SHELL SECTION",
                              "SOLID SECTION",
                              "SPECIFIC GAS CONSTANT",
                              "SPECIFIC HEAT",
                              "SRADIATE",
                              "STATIC",
                              "STEADY STATE DYNAMICS",
                              "STEP",
                              "SURFACE BEHAVIOR",
                              "SURFACE INTERACTION",
                              "SURFACE PROPERTY ASSIGNMENT",
                              "TEMPERATURE",
                              "TIME POINTS",
                              "TRANSFORM",
                              "TRANSVERSE SHEAR STIFFNESS",
                              "UNCOUPLED TEMPERATURE-DISPLACEMENT",
                              "USER MATERIAL",
                              "USER OUTPUT VARIABLES",
                              "VALUES AT INFINITY",
                              "VARIABLE MASS SCALING",
                              "VIEWFACTOR",
                              "VISCO",
                              "VISCOUS"};
constexpr auto k_by_alphabet = [](const char* a, const char* b) {
  return std::string_view(a) < std::string_view(b);
};
static_assert(std::is_sorted(k_silent.begin(), k_silent.end(), k_by_alphabet));

constexpr std::array k_unread{"ADAPTIVE MESH CONTROLS",
                              "IMPORT",
                              "IMPORT ELSET",
                              "IMPORT NSET",
                              "NMAP",
                              "PARAMETER",
                              "PARAMETER DEPENDENCE",
                              "PARAMETER TABLE",
                              "REFLECTION",
                              "SUBSTRUCTURE GENERATE",
                              "SYMMETRIC MODEL GENERATION"};
static_assert(std::is_sorted(k_unread.begin(), k_unread.end(), k_by_alphabet));

}  // namespace

bool says_nothing_of_mesh(const std::string& keyword) {
  return std::binary_search(k_silent.begin(), k_silent.end(), keyword.c_str(), k_by_alphabet);
}

bool makes_mesh_unread(const std::string& keyword) {
  return std::binary_search(k_unread.begin(), k_unread.end(), keyword.c_str(), k_by_alphabet);
}

}  // namespace solidus::mesh
