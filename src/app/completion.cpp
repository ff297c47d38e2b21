/// One script for each shell from the same declarations, in the shell's own quoting.
#include "app/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

using Words = std::vector<std::string>;

/// Candidates for the value of an option or an argument: words, or files or folders that the shell looks for.
struct Candidates {
  enum class Kind { none, words, files, folders } kind = Kind::none;
  Words words;
  bool assigns = false;  ///< words are followed by '='
};

Candidates candidates(const std::string& value, const CommandTree& tree, const KnownWords& known) {
  // The placeholder of the value in the help says which completions may follow: keys, materials, verbs, or
  // files.
  using Kind = Candidates::Kind;
  if (value == "KEY") return {Kind::words, known.keys};
  if (value == "KEY=VALUE") return {Kind::words, known.keys, true};
  if (value == "NAME") return {Kind::words, known.materials};
  if (value == "SHELL") return {Kind::words, completed_shells()};
  if (value == "LEVEL") return {Kind::words, {"debug", "info", "warn", "silent"}};
  if (value == "VERB") {
    Words verbs;
    for (const VerbInfo& verb : tree.verbs) verbs.push_back(verb.name);
    return {Kind::words, verbs};
  }
  if (value == "FOLDER" || value == "OTHER_FOLDER") return {Kind::folders, {}};
  if (value == "CASE" || value == "FILE") return {Kind::files, {}};
  return {};
}

Words option_names(const std::vector<OptionInfo>& options) {
  Words names;
  for (const OptionInfo& option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// Options of a verb, and the named ones of those below it that it has not.
std::vector<OptionInfo> options_of(const VerbInfo& verb) {
  std::vector<OptionInfo> all = verb.options;
  for (const VerbInfo& below : verb.verbs)
    for (const OptionInfo& option : options_of(below)) {
      const Words taken = option_names(all);
      const bool there = std::any_of(option.names.begin(), option.names.end(), [&](const std::string& name) {
        return std::find(taken.begin(), taken.end(), name) != taken.end();
      });
      if (!there && !option.positional()) all.push_back(option);
    }
  return all;
}

/// Options of a verb and those of the program.
std::vector<OptionInfo> options_with(const VerbInfo& verb, const CommandTree& tree) {
  std::vector<OptionInfo> all = options_of(verb);
  for (const OptionInfo& option : tree.options) {
    const Words taken = option_names(all);
    const bool there = std::any_of(option.names.begin(), option.names.end(), [&](const std::string& name) {
      return std::find(taken.begin(), taken.end(), name) != taken.end();
    });
    if (!there) all.push_back(option);
  }
  return all;
}

/// In single quotes for a shell; none of ours needs more than this.
std::string quoted(std::string text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// --- bash
// ---------------------------------------------------------------------------------------------------

std::string bash_action(const Candidates& c) {
  using Kind = Candidates::Kind;
  switch (c.kind) {
    case Kind::words:
      return fmt::format("_solidus_words {}{}", quoted(fmt::format("{}", fmt::join(c.words, " "))),
                         c.assigns ? " =" : "");
    case Kind::files:
      return "_solidus_files -f";
    case Kind::folders:
      return "_solidus_files -d";
    case Kind::none:
      break;
  }
  return ":";
}

std::string bash(const CommandTree& tree, const KnownWords& known) {
  // The script is made of the tree of verbs and options that the command line itself has, so that it cannot
  // differ from it. It finds the verb among the words before the cursor.
  std::string out = R"(# Completion of solidus for bash; written by `solidus completion bash`.
_solidus_words() {
  COMPREPLY=($(compgen -W "$1" -S "${2-}" -- "$cur"))
  [[ -z ${2-} ]] || compopt -o nospace
}
_solidus_files() {
  compopt -o filenames
  COMPREPLY=($(compgen "$1" -- "$cur"))
}
_solidus() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verb='' word
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case $word in
)";
  // The first word that is a verb decides for all that follows.
  const Candidates verbs = candidates("VERB", tree, known);
  out += fmt::format("      {}) verb=$word; break ;;\n    esac\n  done\n  case $verb in\n",
                     fmt::join(verbs.words, "|"));
  // For each verb: what follows an option that takes a value, the options where a dash was typed, and the
  // first positional argument otherwise.
  for (const VerbInfo& verb : tree.verbs) {
    const std::vector<OptionInfo> options = options_with(verb, tree);
    out += fmt::format("    {})\n      case $prev in\n", verb.name);
    for (const OptionInfo& option : options)
      if (!option.positional() && !option.value.empty())
        out += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"),
                           bash_action(candidates(option.value, tree, known)));
    // Options after a dash, with those that all verbs have.
    out += "      esac\n";
    out += fmt::format("      if [[ $cur == -* ]]; then _solidus_words {}; return; fi\n",
                       quoted(fmt::format("{}", fmt::join(option_names(options), " "))));
    for (const OptionInfo& option : options)
      if (option.positional()) {
        out += "      " + bash_action(candidates(option.value, tree, known)) + "\n";
        break;
      }
    out += "      ;;\n";
  }
  // Before any verb: verbs and general options.
  Words first = verbs.words;
  for (const std::string& name : option_names(tree.options)) first.push_back(name);
  return out + fmt::format("    *) _solidus_words {} ;;\n  esac\n}}\ncomplete -F _solidus solidus\n",
                           quoted(fmt::format("{}", fmt::join(first, " "))));
}

// --- zsh
// ----------------------------------------------------------------------------------------------------

/// A description inside of [...].
std::string zsh_doc(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_action(const Candidates& c) {
  using Kind = Candidates::Kind;
  switch (c.kind) {
    case Kind::words:
      return c.assigns ? fmt::format("{{compadd -S = -- {}}}", fmt::join(c.words, " "))
                       : fmt::format("({})", fmt::join(c.words, " "));
    case Kind::files:
      return "_files";
    case Kind::folders:
      return "_files -/";
    case Kind::none:
      break;
  }
  return " ";
}

std::string zsh_spec(const OptionInfo& option, const std::string& name, const CommandTree& tree,
                     const KnownWords& known) {
  const std::string value =
      option.value.empty() ? ""
                           : ":" + option.value + ":" + zsh_action(candidates(option.value, tree, known));
  if (option.positional()) return quoted((option.required ? ":" : "::") + value.substr(1));
  return quoted("*" + name + "[" + zsh_doc(option.doc) + "]" + value);
}

std::string zsh(const CommandTree& tree, const KnownWords& known) {
  // Built like that for bash, with the descriptions that zsh shows.
  std::string out =
      "#compdef solidus\n# Completion of solidus for zsh; written by `solidus completion zsh`.\n"
      "_solidus() {\n  local verb='' word\n  for word in ${words[2,CURRENT-1]}; do\n"
      "    case $word in\n";
  out += fmt::format("      {}) verb=$word; break ;;\n    esac\n  done\n  case $verb in\n",
                     fmt::join(candidates("VERB", tree, known).words, "|"));
  // Every option of the verb, and its positional arguments by their kind.
  for (const VerbInfo& verb : tree.verbs) {
    out += fmt::format("    {})\n      _arguments '1:verb: '", verb.name);
    for (const OptionInfo& option : options_with(verb, tree)) {
      for (const std::string& name : option.names)
        out += " \\\n        " + zsh_spec(option, name, tree, known);
      if (option.positional()) out += " \\\n        " + zsh_spec(option, "", tree, known);
    }
    out += "\n      ;;\n";
  }
  // In front of a verb all verbs are offered with what they do.
  out += "    *)\n      local -a verbs=(\n";
  for (const VerbInfo& verb : tree.verbs)
    out += "        " + quoted(verb.name + ":" + zsh_doc(verb.doc)) + "\n";
  out += "      )\n      _describe verb verbs\n      _arguments";
  for (const OptionInfo& option : tree.options)
    for (const std::string& name : option.names) out += " \\\n        " + zsh_spec(option, name, tree, known);
  // Found by its name in fpath the file is the function; read with `source` it declares it.
  return out +
         "\n      ;;\n  esac\n}\nif [[ ${funcstack[1]} == _solidus ]]; then _solidus \"$@\"; else compdef "
         "_solidus solidus; fi\n";
}

// --- fish
// ---------------------------------------------------------------------------------------------------

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string fish_arguments(const Candidates& c) {
  using Kind = Candidates::Kind;
  switch (c.kind) {
    case Kind::words: {
      Words words = c.words;
      if (c.assigns)
        for (std::string& word : words) word += "=";
      return " -f -a " + fish_quoted(fmt::format("{}", fmt::join(words, " ")));
    }
    case Kind::files:
      return " -F";
    case Kind::folders:
      return " -f -a '(__fish_complete_directories)'";
    case Kind::none:
      break;
  }
  return "";
}

std::string fish_option(const OptionInfo& option, const std::string& condition, const CommandTree& tree,
                        const KnownWords& known) {
  std::string out = "complete -c solidus" + condition;
  for (const std::string& name : option.names)
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.value.empty()) {
    if (!option.positional()) out += " -r";
    out += fish_arguments(candidates(option.value, tree, known));
  }
  return out + " -d " + fish_quoted(option.doc) + "\n";
}

std::string fish(const CommandTree& tree, const KnownWords& known) {
  std::string out =
      "# Completion of solidus for fish; written by `solidus completion fish`.\n"
      "complete -c solidus -f\n";
  for (const VerbInfo& verb : tree.verbs)
    out += fmt::format("complete -c solidus -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                       fish_quoted(verb.doc));
  for (const OptionInfo& option : tree.options) out += fish_option(option, "", tree, known);
  for (const VerbInfo& verb : tree.verbs)
    for (const OptionInfo& option : options_of(verb))
      if (std::find(option.names.begin(), option.names.end(), "--help") == option.names.end())
        out +=
            fish_option(option, fmt::format(" -n '__fish_seen_subcommand_from {}'", verb.name), tree, known);
  return out;
}

}  // namespace

const std::vector<std::string>& completed_shells() {
  static const std::vector<std::string> shells = {"bash", "zsh", "fish"};
  return shells;
}

std::string completion(const CommandTree& tree, const KnownWords& words, const std::string& shell) {
  if (shell == "bash") return bash(tree, words);
  if (shell == "zsh") return zsh(tree, words);
  if (shell == "fish") return fish(tree, words);
  throw InputError({}, fmt::format("there is no completion for the shell '{}'", shell),
                   one_of(completed_shells(), shell));
}

}  // namespace solidus::app
