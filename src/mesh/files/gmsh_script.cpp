/// The tokens of a script are passed once, and each word is judged by what is around it; a file that is
/// included is checked in the same way.
#include "mesh/files/gmsh_script.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "mesh/files/file_format.hpp"
#include "mesh/files/gmsh_tokens.hpp"
#include "mesh/files/gmsh_words.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

namespace fs = std::filesystem;
using Kind = GmshToken::Kind;

constexpr const char* k_trust =
    "geometry, mesh sizes and groups; --trust-geo runs a script that you trust as you trust a program";

[[noreturn]] void refuse(const GmshToken& token, const std::string& what,
                         const std::string& allowed = k_trust) {
  throw InputError(token.where, what, allowed);
}

std::string in_quotes(std::string_view text) {
  return "'" + std::string(text) + "'";
}

/// A script with all the files that it includes.
class ScriptCheck {
 public:
  explicit ScriptCheck(const std::string& path) : folder_(fs::weakly_canonical(path).parent_path()) {}

  void check(const std::string& path);

 private:
  static constexpr std::size_t k_most_files = 100;

  void check_word(std::size_t i);
  void check_operand(std::size_t i);
  void check_option(std::size_t i);
  void check_field(std::size_t i);
  void check_plugin(std::size_t i);
  void check_output(std::size_t i);
  void check_file(std::size_t i);

  const GmshToken& at(std::size_t i) const { return tokens_[std::min(i, tokens_.size() - 1)]; }
  /// Behind the bracket that closes the one at `i`; `i` itself where there is none.
  std::size_t behind_bracket(std::size_t i) const;

  fs::path folder_;
  std::set<fs::path> seen_;
  std::string path_;
  std::vector<GmshToken> tokens_;
};

void ScriptCheck::check(const std::string& path) {
  const fs::path canonical = fs::weakly_canonical(path);
  if (!seen_.insert(canonical).second) return;
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string text = content.str();

  const std::string outer_path = std::exchange(path_, path);
  std::vector<GmshToken> outer = std::exchange(tokens_, gmsh_tokens(text, path));
  for (std::size_t i = 0; i + 1 < tokens_.size(); ++i)
    if (tokens_[i].kind == Kind::word) check_word(i);
  tokens_ = std::move(outer);
  path_ = outer_path;
}

std::size_t ScriptCheck::behind_bracket(std::size_t i) const {
  if (!at(i).is("(") && !at(i).is("[")) return i;
  int depth = 0;
  for (std::size_t k = i; at(k).kind != Kind::end; ++k) {
    if (at(k).is("(") || at(k).is("[")) ++depth;
    if ((at(k).is(")") || at(k).is("]")) && --depth == 0) return k + 1;
  }
  return i;
}

void ScriptCheck::check_word(std::size_t i) {
  const GmshToken& word = at(i);
  if (word.is("Exit") || word.is("Abort"))
    refuse(word, in_quotes(word.text) + " in the script would end the program",
           "a script that goes to its end");
  if (const char* reason = forbidden_reason(word.text))
    refuse(word, "the script would " + std::string(reason) + ": " + in_quotes(word.text));
  if (word.is("Printf") || word.is("Error") || word.is("Warning")) check_output(i);
  if (word.is("Field")) check_field(i);
  if (word.is("Plugin")) check_plugin(i);
  if (is_option_category(word.text)) check_option(i);
  if (!is_harmless_keyword(word.text)) check_operand(i);
}

// Checks a word that Gmsh may read as a value: it is then before a symbol; two words, or a word and a
// text, are a command.
void ScriptCheck::check_operand(std::size_t i) {
  const GmshToken &word = at(i), &next = at(i + 1);
  if (next.kind == Kind::symbol || next.kind == Kind::end || next.is("In")) return;
  if (i > 0 && (at(i - 1).is("Macro") || at(i - 1).is("Function"))) return;  // its name
  if (word.is("Include") || word.is("Merge")) return check_file(i);
  const bool view = word.is("View") && next.kind == Kind::string && at(i + 2).is("{");
  if (!view && !may_precede_operand(word.text))
    refuse(word,
           "the script has the command " + in_quotes(word.text) + ", which is none of geometry and mesh");
}

// CATEGORY.NAME or CATEGORY[i].NAME
void ScriptCheck::check_option(std::size_t i) {
  const std::size_t dot = behind_bracket(i + 1);
  if (!at(dot).is(".") || at(dot + 1).kind != Kind::word) return;
  if (!is_harmless_option(at(i).text, at(dot + 1).text))
    refuse(at(i), "the script sets or reads the option " +
                      in_quotes(std::string(at(i).text) + "." + std::string(at(dot + 1).text)));
}

// Field[i] = TYPE
void ScriptCheck::check_field(std::size_t i) {
  const std::size_t behind = behind_bracket(i + 1);
  if (behind == i + 1 || !at(behind).is("=") || at(behind + 1).kind != Kind::word) return;
  if (const std::string_view type = at(behind + 1).text; !forbidden_reason(type) && !is_harmless_field(type))
    refuse(at(behind + 1), "the script uses a size field of the type " + in_quotes(at(behind + 1).text));
}

// Plugin(NAME).OPTION
void ScriptCheck::check_plugin(std::size_t i) {
  if (!at(i + 1).is("(") || !is_harmless_plugin(at(i + 2).text))
    refuse(at(i), "the script uses the plugin " + in_quotes(at(i + 2).text));
}

// Printf(...) > "file"
void ScriptCheck::check_output(std::size_t i) {
  const std::size_t behind = behind_bracket(i + 1);
  if (behind == i + 1 || !at(behind).is(";"))
    refuse(at(i),
           "the script would write to a file: " + in_quotes(at(i).text) + " that does not end in ');'");
}

void ScriptCheck::check_file(std::size_t i) {
  const GmshToken &command = at(i), &name = at(i + 1);
  // A name that is computed could be anything, so only plain texts are allowed.
  if (name.kind != Kind::string || !at(i + 2).is(";"))
    refuse(command, in_quotes(command.text) + " needs the name of a file in quotes");
  const std::string wanted = (fs::path(path_).parent_path() / std::string(name.text)).string();
  // Links and dots are resolved first: a path that leaves the folder of the script is refused.
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(wanted, error);
  const fs::path relative = canonical.lexically_relative(folder_);
  if (error || relative.empty() || *relative.begin() == "..")
    refuse(name, "the script would read " + in_quotes(name.text) + ", which is outside of its folder",
           "a file in " + folder_.string() + "; or --trust-geo where you trust the script as a program");
  if (!fs::is_regular_file(canonical, error)) refuse(name, "there is no file " + in_quotes(name.text), "");
  if (seen_.size() >= k_most_files) refuse(name, "the script includes too many files", "at most 100");
  // A mesh or a geometry is opened by its format, a script is checked like the outer one.
  const std::string ending = canonical.extension().string();
  if (command.is("Merge") && ending != ".geo" && ending != ".pos") {
    file_format(wanted);
    refuse_options_file(wanted);
  } else {
    if (command.is("Merge")) refuse_options_file(wanted);
    // check() replaces the tokens while it works, and puts them back.
    check(wanted);
  }
}

}  // namespace

void refuse_options_file(const std::string& path) {
  std::error_code error;
  const std::string options = path + ".opt";
  if (fs::symlink_status(options, error).type() != fs::file_type::not_found)
    throw InputError(
        {options}, "Gmsh would run this file as a script with every mesh that it lies next to",
        "another name or place for it; --trust-geo runs a script that you trust as you trust a program");
}

void check_gmsh_script(const std::string& path) {
  ScriptCheck(path).check(path);
}

}  // namespace solidus::mesh
