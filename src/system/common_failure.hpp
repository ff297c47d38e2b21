/// Failures that all processes share: if one process throws, all throw, so that none waits for a process that
/// has given up, and each reports its own exception.
#pragma once

#include <functional>
#include <string>

namespace solidus {

/// Throws in place of another process's InputError; its argument is the message of that one.
using ThrowInputError = std::function<void(const std::string& message)>;

/// Runs `work` on every process. If it throws on any of them, every process throws: the failing ones their
/// own exception, the others that of the lowest failing process, as an InputError (by `throw_input_error`, if
/// given), std::bad_alloc, or std::runtime_error for anything else. Collective.
void run_collectively(const std::function<void()>& work, const ThrowInputError& throw_input_error = {});

/// Runs `work` on process 0 alone, and fails as run_collectively() does. Collective.
void on_first_process(const std::function<void()>& work, const ThrowInputError& throw_input_error = {});

}  // namespace solidus
