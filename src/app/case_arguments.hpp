/// Arguments that several verbs share: a case with changes of its keys, and what the user trusts.
#pragma once

#include <string>
#include <vector>

#include "setup/case_file.hpp"

namespace CLI {
class App;
}

namespace solidus::app {

struct CaseArguments {
  std::string path;  ///< a case file, or a folder with a case.toml; with :VARIANT one of its variants
  std::vector<std::string> set;  ///< "path=value"
  bool trust_script = false;     ///< run a .geo script whatever it says
  bool heat_only = false;        ///< heat alone, whatever the case says
  bool coupled = false;          ///< heat and mechanics, whatever the case says
};

/// CASE and --set.
void add_case(CLI::App& verb, CaseArguments& arguments);
/// --heat-only and --coupled.
void add_physics(CLI::App& verb, CaseArguments& arguments);
/// --trust-geo.
void add_trust(CLI::App& verb, bool& trust);
/// --trust-laws, which holds from the parsing on.
void add_trust_laws(CLI::App& verb);

/// A case as the command line changes it. Throws InputError.
setup::Case load_case(const CaseArguments& arguments);

/// Writes to stdout on process 0; says so when that is not possible (a full disk behind a redirection).
void print(const std::string& text);

}  // namespace solidus::app
