/// The declared command line, without the library that parses it: completion and the manual page are
/// generated from it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace solidus::app {

struct OptionInfo {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional argument none
  std::string value;               ///< its value: "CASE", "FOLDER", "KEY=VALUE" ...; of a flag empty
  std::string doc;
  bool required = false, many = false;
  bool positional() const { return names.empty(); }
};

struct VerbInfo {
  std::string name, doc;
  std::vector<OptionInfo> options;  ///< those of the program itself are not repeated
  std::vector<VerbInfo> verbs;      ///< below it, as `import` of `materials import`, with their whole names
};

struct CommandTree {
  std::string doc, footer;
  std::vector<OptionInfo> options;  ///< in front of every verb or behind it
  std::vector<VerbInfo> verbs;
};

CommandTree command_tree(const CLI::App& program);

}  // namespace solidus::app
