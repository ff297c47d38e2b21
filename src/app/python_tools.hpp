/// Verbs that run in Python: pictures, comparisons and studies (python/ of the repository,
/// share/solidus/python of an installed program).
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "app/exit_code.hpp"

namespace solidus::app {

/// The Python that runs modules: what SOLIDUS_PYTHON names, else /usr/bin/python3.
std::string python_program();

/// Runs a module with that Python and waits for it; what it prints goes where ours goes. The module's exit
/// code is the program's: 0 or 1, 2 for its 22, and 130 after Ctrl-C. Throws InputError where there is no
/// such Python or no module.
ExitCode run_python(const std::string& module, const std::vector<std::string>& arguments);

/// The arguments of a module: those that were given.
class PythonArguments {
 public:
  PythonArguments(std::initializer_list<std::string> words) : words_(words) {}
  /// With the sign between them: a value may begin with a dash.
  void add(const std::string& name, const std::string& value) {
    if (!value.empty()) words_.push_back(name + "=" + value);
  }
  void flag(const char* name, bool wanted) {
    if (wanted) words_.emplace_back(name);
  }
  const std::vector<std::string>& words() const { return words_; }

 private:
  std::vector<std::string> words_;
};

}  // namespace solidus::app
