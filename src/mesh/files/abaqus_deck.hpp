/// Lines of Abaqus and CalculiX decks: keywords with their parameters, and the data behind them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "numbers/types.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

std::string upper(std::string text);

/// Without blanks and quotes around it.
std::string_view trimmed(std::string_view text);

/// Pieces between commas. An empty piece at the end, behind a comma that continues the line, is left out.
std::vector<std::string> pieces(std::string_view line);

struct AbaqusKeyword {
  std::string name;                               ///< upper case, without the star
  std::map<std::string, std::string> parameters;  ///< names in upper case
  SourceLocation at;

  bool has(const std::string& parameter) const { return parameters.contains(parameter); }
  /// Null where there is no such parameter.
  const std::string* find(const std::string& parameter) const;
  /// Throws InputError where the parameter is missing or empty.
  const std::string& required(const std::string& parameter) const;
};
AbaqusKeyword parse_abaqus_keyword(std::string_view line, const SourceLocation& at);

/// A line of data, for as long as the line before it and its place are kept.
struct AbaqusLine {
  const SourceLocation& at;
  std::vector<std::string> parts;

  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const;
  /// Numbers by their position in the line. Without a default they must be there. Throw InputError.
  GlobalIndex integer(std::size_t i) const;
  GlobalIndex integer(std::size_t i, GlobalIndex without) const;
  double real(std::size_t i, double without = 0) const;
  bool has(std::size_t i) const { return i < parts.size() && !parts[i].empty(); }
};

/// Whether a keyword says nothing of nodes, elements, sets and surfaces: materials, steps, loads, output.
bool says_nothing_of_mesh(const std::string& keyword);

/// Whether a keyword makes or moves nodes or elements in a way that is not read.
bool makes_mesh_unread(const std::string& keyword);

}  // namespace solidus::mesh
