/// Exit codes of the program (docs/guide/command_line.md).
#pragma once

namespace solidus::app {

enum ExitCode { k_done = 0, k_bad_input = 1, k_cannot_continue = 2, k_our_bug = 3, k_interrupted = 130 };

}  // namespace solidus::app
