/// Colours on a terminal, for warnings and errors. https://no-color.org is heeded.
#pragma once

#include <string>
#include <string_view>

namespace solidus {

enum class Colour { bold, red, green };

/// Whether colours may be written to this file descriptor: it is a terminal that is not "dumb", NO_COLOR is
/// not set (to anything but an empty text), and mpirun has not started the process.
bool has_colours(int descriptor);

/// The text in bold letters of this colour where `wanted`; else as it is.
std::string painted(std::string_view text, Colour colour, bool wanted);

}  // namespace solidus
