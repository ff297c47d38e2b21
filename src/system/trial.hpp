/// Runs a function in a process of its own first, so that a library that crashes or hangs on what it is given
/// takes nothing with it.
#pragma once

#include <functional>
#include <string>

namespace solidus::trial {

/// Notes which part of the work begins.
using Note = std::function<void(const std::string& part)>;
/// The work that is tried.
using Work = std::function<void(const Note& note)>;

/// Runs `work` in a copy of this process. An exception is no fault: the program meets it itself. The work
/// must not communicate with other processes.
/// @param seconds  it may take
/// @return what went wrong, with the part in which it did: a signal, an end of the process, no end in time;
///         empty: it came to an end of its own
std::string fault_of(const Work& work, double seconds);

}  // namespace solidus::trial
