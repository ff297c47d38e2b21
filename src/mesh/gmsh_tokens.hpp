/// The tokens of a Gmsh script, as Gmsh's own scanner finds them (Gmsh 4.8, Parser/Gmsh.l).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "system/errors.hpp"

namespace solidus::mesh {

struct GmshToken {
  enum class Kind { word, number, string, symbol, end };
  Kind kind = Kind::end;
  std::string_view text;  ///< of a string without its quotes
  SourceLocation where;

  bool is(std::string_view symbol_or_word) const { return kind != Kind::string && text == symbol_or_word; }
};

/// Splits a script into tokens; the last one is of the kind `end`.
///
/// Where Gmsh skips a branch, a loop or a macro it looks for the closing word also inside strings, and it
/// comes back to a macro or a loop at the start of a line, even within a comment. Text that would then be
/// taken for something else is refused: InputError.
/// @param text  is kept by the caller as long as the tokens
std::vector<GmshToken> gmsh_tokens(std::string_view text, const std::string& path);

}  // namespace solidus::mesh
