/// Checks of a file that the user names, before it is opened.
#pragma once

#include <filesystem>
#include <string>

#include "system/errors.hpp"

namespace solidus {

/// No file of text that a person writes is larger, and no table of measurements.
inline constexpr double k_most_text = 64e6;   ///< [byte]
inline constexpr double k_most_field = 32e9;  ///< of a field file [byte]

/// Throws InputError where there is no such file, where it is a folder, a device or a pipe (reading those may
/// never end), where it is larger than `most` bytes, or where it may not be read.
/// @param where  for the message; the file itself, or the place that names it
void require_readable(const std::filesystem::path& file, const SourceLocation& where,
                      double most = k_most_text);

/// The whole content of such a file.
std::string read_text_file(const std::filesystem::path& file, const SourceLocation& where);

/// A text for the terminal: control characters, which could move its cursor or change its title, and bytes
/// that are no UTF-8 are shown as '?'. Line ends and tabs stay.
std::string printable(std::string text);

}  // namespace solidus
