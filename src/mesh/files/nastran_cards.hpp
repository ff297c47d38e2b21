/// Entries of the bulk data of Nastran, in small, large and free fields.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "numbers/types.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

/// An entry with its continuation lines.
struct NastranCard {
  std::string name;                 ///< upper case, without the star of large fields
  std::vector<std::string> fields;  ///< behind the name, eight a line, without blanks
  SourceLocation at;

  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const;
  bool has(std::size_t i) const { return i < fields.size() && !fields[i].empty(); }
  /// Numbers by their field; blank ones are `without`. Throw InputError.
  GlobalIndex integer(std::size_t i, GlobalIndex without = 0) const;
  double real(std::size_t i, double without = 0) const;
};

/// Reads a file and those that INCLUDE names, up to ENDDATA.
/// @param card     takes each entry
/// @param comment  takes each line of comment, without the dollar
/// Throws InputError.
void read_nastran_cards(const std::string& path, const std::function<void(const NastranCard&)>& card,
                        const std::function<void(std::string_view)>& comment);

}  // namespace solidus::mesh
