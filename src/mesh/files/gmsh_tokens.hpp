/// The tokens of a Gmsh script, as Gmsh's own scanner finds them (Gmsh 4.8).
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
/// A text or a comment whose end Gmsh need not see at the same place is refused: InputError.
/// @param text  is kept by the caller as long as the tokens
std::vector<GmshToken> gmsh_tokens(std::string_view text, const std::string& path);

}  // namespace solidus::mesh
