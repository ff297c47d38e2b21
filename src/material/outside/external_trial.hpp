/// Runs a function in a process of its own first, so that a library that crashes or hangs takes nothing with
/// it.
#pragma once

#include <functional>
#include <string>

namespace solidus::material {

/// Calls it with what to note before each of its parts.
using Trial = std::function<void(const std::function<void(const std::string& part)>& note)>;

/// Runs `trial` in a copy of this process, with exceptions as its own affair.
/// @param seconds  it may take
/// @return what went wrong, with the part in which it did: a signal, an end of the process, no end in time;
///         empty: it came to an end of its own
std::string fault_of(const Trial& trial, double seconds);

}  // namespace solidus::material
