/// Colours on a terminal, for warnings and errors. https://no-color.org is heeded.
#pragma once

#include <string>
#include <string_view>

namespace solidus {

enum class Colour { bold, red, green };

/// Whether the descriptor is a terminal that understands control sequences. False where mpirun has started
/// the process, to which it gives a terminal of its own wherever its output goes, unless trust_terminal().
bool is_terminal(int descriptor);

/// From here on the descriptors are those of the user, although mpirun has started the process.
void trust_terminal();

/// Whether colours may be written to this file descriptor: is_terminal(), and NO_COLOR is not set (to
/// anything but an empty text).
bool has_colours(int descriptor);

/// The text in bold letters of this colour where `wanted`; else as it is.
std::string painted(std::string_view text, Colour colour, bool wanted);

}  // namespace solidus
