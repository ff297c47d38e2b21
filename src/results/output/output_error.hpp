/// Errors of writing results, and functions that make every process throw if one fails.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "system/errors.hpp"

namespace solidus::results {

/// A file or folder of the results cannot be written (full disk, no permission). The user can solve it, hence
/// an InputError: "results/x/history.csv: cannot write: No space left on device".
class OutputError : public InputError {
 public:
  OutputError(const std::string& path, const std::string& what, const std::string& advice = {});
};

/// A value for a result file is infinite or not a number. Nothing of that file is written.
class NotFiniteError : public std::runtime_error {
 public:
  /// @param field "field 'temperature'"
  /// @param where "node 12 at (0.01, 0.02, 0)"
  NotFiniteError(const std::string& field, const std::string& where);
};

/// As solidus::run_collectively() of common_failure.hpp; the InputError of another process is an OutputError
/// here. Collective.
void run_collectively(const std::function<void()>& work);

/// Runs `work` on process 0; if it throws there, every process throws. Collective.
void on_first_process(const std::function<void()>& work);

}  // namespace solidus::results
