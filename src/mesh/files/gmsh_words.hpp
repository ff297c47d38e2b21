/// Words of Gmsh's language, classified for the check of scripts (mesh/files/gmsh_script.hpp).
#pragma once

#include <string_view>

namespace solidus::mesh {

/// Returns the reason why a word is never allowed, a phrase that follows "the script would "; nullptr for
/// other words.
const char* forbidden_reason(std::string_view word);
/// Whether Gmsh's grammar has the word, and it can do nothing but make geometry, sizes, groups and numbers.
bool is_harmless_keyword(std::string_view word);
/// Whether a word that is no keyword may be before another word, a number or a text: attributes of
/// constants, laws of transfinite lines, commands that only mesh. Everything else written so is a command.
bool may_precede_operand(std::string_view word);
/// Types of size fields that compute and read nothing.
bool is_harmless_field(std::string_view type);
/// Plugins that compute on views and on the mesh in memory.
bool is_harmless_plugin(std::string_view name);
/// Options: all of mesh and geometry, and a few of the category General.
bool is_harmless_option(std::string_view category, std::string_view name);
/// Whether a word is the name of a category of options.
bool is_option_category(std::string_view word);

}  // namespace solidus::mesh
