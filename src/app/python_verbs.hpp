/// The verbs that Python does: plot, compare, study, uncertain, mcp.
#pragma once

#include <optional>
#include <string>

#include "app/verbs.hpp"

namespace CLI {
class App;
}

namespace solidus::app {

class PythonVerbs {
 public:
  /// Declares them. The object outlives the parsing.
  explicit PythonVerbs(CLI::App& program);
  PythonVerbs(const PythonVerbs&) = delete;
  PythonVerbs& operator=(const PythonVerbs&) = delete;

  /// Runs the verb that was asked for; nothing where it is none of these.
  std::optional<ExitCode> run() const;

 private:
  std::optional<ExitCode> run_uncertain() const;

  CLI::App *plot_, *compare_, *study_, *uncertain_, *mcp_;
  std::string folder_, other_, plots_, output_, jobs_, runs_, samples_, seed_;
  bool no_plots_ = false, restart_ = false, dry_run_ = false, one_sided_ = false, parameters_ = false,
       trust_files_ = false;
  CaseArguments uncertain_case_;
};

}  // namespace solidus::app
