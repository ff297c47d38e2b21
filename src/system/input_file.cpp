/// A file is checked for being there, readable and of a sensible size before it is read.
#include "system/input_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace solidus {

void require_readable(const std::filesystem::path& file, const SourceLocation& where, double most) {
  // Each reason why a file cannot be read has its own message: it does not exist, is a folder, a device, too
  // large, or not permitted.
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  // Messages that name the file already say `this` in its place.
  const std::string name = where.file == file.string() ? "this" : "'" + file.string() + "'";
  if (!std::filesystem::exists(status))
    throw InputError(
        where, name == "this" ? "there is no such file" : name + " cannot be read: there is no such file");
  if (std::filesystem::is_directory(status)) throw InputError(where, name + " is a folder, not a file");
  if (!std::filesystem::is_regular_file(status))
    throw InputError(where, name + " is no regular file but a device, a pipe or a socket",
                     "a file on a disk: what a device or a pipe gives may never end");
  // Size before rights: reading a huge file would end in the same message too late.
  const auto size = static_cast<double>(std::filesystem::file_size(file, error));
  if (size > most)
    throw InputError(where, fmt::format("{} has {:.0f} MB", name == "this" ? "the file" : name, size / 1e6),
                     fmt::format("at most {:.0f} MB", most / 1e6));
  if (::access(file.c_str(), R_OK) != 0)
    throw InputError(where, name == "this" ? "the file cannot be read" : name + " cannot be read",
                     "a readable file; check its permissions");
}

std::string read_text_file(const std::filesystem::path& file, const SourceLocation& where) {
  require_readable(file, where);
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  std::error_code error;
  if (!in && !std::filesystem::is_empty(file, error)) throw InputError(where, "the file cannot be read");
  return content.str();
}

namespace {

/// Number of bytes of the character that begins at i, by UTF-8 (RFC 3629, table of section 4 but for the
/// narrower second bytes); 0: none does.
std::size_t length_of_character(const std::string& text, std::size_t i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  const std::size_t length = lead < 0x80                    ? 1
                             : lead >= 0xc2 && lead <= 0xdf ? 2
                             : lead >= 0xe0 && lead <= 0xef ? 3
                             : lead >= 0xf0 && lead <= 0xf4 ? 4
                                                            : 0;
  if (i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return 0;
  return length;
}

}  // namespace

std::string printable(std::string text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t length = length_of_character(text, i);
    const bool second_set = length == 2 && c == 0xc2 && static_cast<unsigned char>(text[i + 1]) <= 0x9f;
    if (length == 0 || second_set || (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f) text[i] = '?';
    if (second_set) text[i + 1] = '?';
    i += std::max<std::size_t>(length, 1);
  }
  return text;
}

}  // namespace solidus
