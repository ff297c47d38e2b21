/// The text is scanned line by line for keys with too many dots.
#include "input/toml_limits.hpp"

#include "system/errors.hpp"

namespace solidus {

namespace {

/// Behind the string that begins at `at`; the end of the text where it has no end.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool several_lines = text.substr(at).starts_with(three);
  for (std::size_t i = at + (several_lines ? 3 : 1); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\')
      ++i;
    else if (several_lines ? text.substr(i).starts_with(three) : text[i] == quote)
      return i + (several_lines ? 3 : 1);
    else if (!several_lines && text[i] == '\n')
      return i;
  }
  return text.size();
}

bool belongs_to_key(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ' ' || c == '\t';
}

}  // namespace

void check_key_lengths(std::string_view text, const std::string& name) {
  // Counts the parts of dotted keys without parsing; strings and comments are skipped, as their dots mean
  // nothing.
  int line = 1, parts = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (c == '"' || c == '\'') {
      // Line numbers go on within strings of several lines.
      const std::size_t end = behind_string(text, i);
      for (; i < end; ++i) line += text[i] == '\n' ? 1 : 0;
    } else {
      if (c == '.')
        ++parts;
      else if (!belongs_to_key(c))
        parts = 1;
      line += c == '\n' ? 1 : 0;
      ++i;
    }
    if (parts > k_most_key_parts)
      throw InputError({name, line, 0}, "a key has too many parts",
                       "at most " + std::to_string(k_most_key_parts) + ", with dots between them");
  }
}

}  // namespace solidus
