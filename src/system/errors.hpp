/// The three failures of Solidus: `assert` (our bug), `InputError` (the user's), `StepRejected` (physics).
#pragma once

#include <stdexcept>
#include <string>

namespace solidus {

/// A place in a file the user wrote. `line` and `column` count from one; zero means "the file as a whole".
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
  /// "file:line:column", without what is not known.
  std::string text() const;
};

/// Something in the user's input cannot be used. The program prints what() and exits with code 1.
class InputError : public std::runtime_error {
 public:
  /// @param where   the place in the input
  /// @param what    what was found, a full sentence: "unknown key 'initial_temprature' in [[body]]"
  /// @param allowed what would be accepted, and the nearest name if there is one; may be empty
  InputError(SourceLocation where, std::string what, std::string allowed = {});
  const SourceLocation& where() const { return where_; }

 private:
  SourceLocation where_;
};

/// The kinds of equations that had no solution when a step was rejected.
enum class Failure {
  other,
  heat,             ///< the balance of heat: its iteration did not converge
  temperature,      ///< the same, with a temperature at or below 0 K, or one that is not a number
  equilibrium,      ///< the balance of forces: its iteration did not converge
  linear_solver,    ///< the same, in one of its linear systems
  law,              ///< a constitutive law at some point
  multipliers,      ///< the augmentations of the augmented Lagrangian
  coupling,         ///< the phases, whose iteration did not converge
  divergence,       ///< the phases, whose iteration diverged
  another_solution  ///< temperatures do not follow from those at the start of the step
};

/// The physics of a step did not go through; the step is cut and tried again. Thrown on every process alike.
class StepRejected : public std::runtime_error {
 public:
  /// @param reason short, for steps.csv: "heat: no convergence in 25 iterations"
  /// @param where  the place with its state: "body 'part', element 1234: temperature 931.2 K, ..."; may be
  /// empty
  explicit StepRejected(std::string reason, std::string where = {}, Failure failure = Failure::other);
  const std::string& reason() const { return reason_; }
  const std::string& where() const { return where_; }
  Failure failure() const { return failure_; }
  /// Adds to the reason, for a handler that knows more and throws the same object again.
  void append(const std::string& text);
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string reason_, where_, message_;
  Failure failure_;
};

}  // namespace solidus
