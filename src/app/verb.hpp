/// A verb of the command line: it describes itself in its own file, by a class with its name, help and
/// options, and does what was asked for.
///
///   class Weigh final : public Verb {
///    public:
///     explicit Weigh(CLI::App& program) : Verb(program, "weigh", "Print what a case weighs") {
///       command().add_option("CASE", path_, "A case file")->required();
///     }
///     ExitCode run() override;
///
///    private:
///     std::string path_;
///   };
///   const AddVerb<Weigh> k_weigh;  // at namespace scope: help, completion and the manual page have it
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/exit_code.hpp"

namespace solidus::app {

class Verb {
 public:
  virtual ~Verb() = default;
  Verb(const Verb&) = delete;
  Verb& operator=(const Verb&) = delete;

  /// Whether the command line named it.
  bool asked_for() const { return command_.parsed(); }
  /// Does what the command line asked for, and prints on stdout, from process 0. Throws.
  virtual ExitCode run() = 0;

 protected:
  Verb(CLI::App& program, const std::string& name, const std::string& help)
      : program_(program), command_(*program.add_subcommand(name, help)) {}
  CLI::App& program() const { return program_; }
  CLI::App& command() const { return command_; }

 private:
  CLI::App& program_;
  CLI::App& command_;
};

using MakeVerb = std::unique_ptr<Verb> (*)(CLI::App& program);

/// All verbs, built in and added, in the order of the help.
std::vector<MakeVerb>& verbs();

template <class V>
std::unique_ptr<Verb> make_verb(CLI::App& program) {
  return std::make_unique<V>(program);
}

/// Adds a verb while the program starts, as an object at namespace scope.
template <class V>
struct AddVerb {
  AddVerb() { verbs().push_back(&make_verb<V>); }
};

}  // namespace solidus::app
