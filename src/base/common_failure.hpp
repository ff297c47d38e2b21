/// Failures that all processes share: none waits for one that gave up, and none calls by another name what
/// happened to it.
#pragma once

#include <functional>
#include <string>

namespace solidus {

/// Throws what another process's InputError becomes here; its argument is the message of that one.
using ThrowInputError = std::function<void(const std::string& message)>;

/// Runs `work` on every process. Where it throws anywhere, every process throws: the failing ones their own
/// exception, the others what the lowest failing process met, an InputError (by `throw_input_error`, if
/// given), std::bad_alloc, or std::runtime_error for anything else. Collective.
void together(const std::function<void()>& work, const ThrowInputError& throw_input_error = {});

/// Runs `work` on process 0 alone, and fails as together() does. Collective.
void on_first_process(const std::function<void()>& work, const ThrowInputError& throw_input_error = {});

}  // namespace solidus
