/// The page is written section by section in the language of man, with special characters escaped.
#include "app/manual_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "system/version.hpp"

namespace solidus::app {

namespace {

/// A text of the page: backslashes, hyphens and a full stop or quote that would begin a request.
std::string escaped(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_begins = c == '\n';
  }
  return out;
}

std::string option_entry(const OptionInfo& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back("\\fB" + escaped(name) + "\\fR");
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!option.value.empty()) head += (head.empty() ? "\\fI" : " \\fI") + escaped(option.value) + "\\fR";
  return ".TP\n" + head + "\n" + escaped(option.doc) + "\n";
}

std::string synopsis(const VerbInfo& verb) {
  std::string text = "\\fBsolidus " + escaped(verb.name) + "\\fR";
  bool options = false;
  for (const OptionInfo& option : verb.options) {
    options = options || !option.positional();
    if (!option.positional()) continue;
    const std::string name = "\\fI" + escaped(option.value) + "\\fR" + (option.many ? " ..." : "");
    text += option.required ? " " + name : " [" + name + "]";
  }
  return text + (options ? " [\\fIoptions\\fR]" : "");
}

/// Each verb, and behind it those below it.
std::vector<VerbInfo> with_those_below(const std::vector<VerbInfo>& verbs) {
  std::vector<VerbInfo> all;
  for (const VerbInfo& verb : verbs) {
    all.push_back(verb);
    for (const VerbInfo& below : with_those_below(verb.verbs)) all.push_back(below);
  }
  return all;
}

}  // namespace

std::string manual_page(const CommandTree& tree) {
  std::string out = fmt::format(".TH SOLIDUS 1 \"\" \"Solidus {}\" \"User commands\"\n", program_version());
  out += ".SH NAME\nsolidus \\- how a metal casting solidifies in its mould\n.SH SYNOPSIS\n";
  // The synopsis of every verb, then each with its options, in the order of the help.
  const std::vector<VerbInfo> verbs = with_those_below(tree.verbs);
  for (const VerbInfo& verb : verbs) out += synopsis(verb) + "\n.br\n";
  out +=
      ".SH DESCRIPTION\nA case is a text file (TOML) that names a mesh, bodies with their materials, what "
      "cools them, and the time.\n\\fBsolidus run\\fR computes temperatures, latent heat, stresses and the "
      "air gap between casting and mould, and leaves a folder of results.\n\\fBsolidus explain\\fR tells "
      "what every key of a case means.\n.SH VERBS\n";
  for (const VerbInfo& verb : verbs) {
    out += ".SS " + synopsis(verb) + "\n" + escaped(verb.doc) + ".\n";
    for (const OptionInfo& option : verb.options) out += option_entry(option);
  }
  // General options, then what the program itself does not know of: exit codes and variables.
  out += ".SH OPTIONS\n";
  for (const OptionInfo& option : tree.options) out += option_entry(option);
  out +=
      ".PP\nOptions of PETSc follow behind \\fB\\-\\-\\fR, for example: solidus run CASE \\-\\- "
      "\\-heat_ksp_monitor\n"
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nthe input is wrong\n.TP\n2\nthe simulation could not go on, "
      "or a signal stopped it; there is a checkpoint\n.TP\n3\na mistake in Solidus\n.TP\n130\nstopped by "
      "Ctrl\\-C; there is a checkpoint\n"
      ".SH ENVIRONMENT\n.TP\n\\fBSOLIDUS_MATERIALS\\fR\nfolders of materials, in front of the library, "
      "separated by colons\n.TP\n\\fBSOLIDUS_PYTHON\\fR\nthe Python with numpy and matplotlib that draws, "
      "/usr/bin/python3 by default\n.TP\n\\fBNO_COLOR\\fR\nany text: no colours on a terminal\n"
      ".SH SEE ALSO\nThe guide, the theory and the reference of all keys are in share/doc/solidus.\n";
  return out;
}

}  // namespace solidus::app
