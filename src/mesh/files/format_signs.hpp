/// Signs in the first bytes of a file that several formats ask for.
#pragma once

#include <string_view>

namespace solidus::mesh {

inline bool is_text(std::string_view head) {
  return head.find('\0') == std::string_view::npos;
}

inline std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

}  // namespace solidus::mesh
