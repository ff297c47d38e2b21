/// Checks that this processor has the instructions that the compiler has used: a binary built for one machine
/// ends on another with SIGILL, without a message.
#pragma once

namespace solidus::app {

/// Sets of instructions as bits, in the order of instruction_names().
using Instructions = unsigned;

/// Lists the instruction sets that the compiler was allowed to use where the program was built.
extern const Instructions k_built_for;

/// Lists those that the processor which runs this program has.
Instructions instructions_here();
/// The names of a set, up to a null.
const char* const* instruction_names();

}  // namespace solidus::app
