/// The verbs that Python does: plot, compare, study.
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
  CLI::App *plot_, *compare_, *study_;
  std::string folder_, other_, plots_, output_, jobs_;
  bool no_plots_ = false, restart_ = false, dry_run_ = false;
};

}  // namespace solidus::app
