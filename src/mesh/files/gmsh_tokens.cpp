/// The scanner follows Gmsh's own rules for comments, strings, words and numbers, and refuses what could be
/// read in two ways.
#include "mesh/files/gmsh_tokens.hpp"

#include <algorithm>
#include <array>

namespace solidus::mesh {

namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// What else than a number of moderate width a '%' in a text asks for, which scripts use as formats of
/// numbers. Empty if nothing.
std::string unusual_format(std::string_view text) {
  for (std::size_t percent = text.find('%'); percent != std::string_view::npos;
       percent = text.find('%', percent + 1)) {
    if (text.substr(percent + 1).starts_with('%')) {
      ++percent;
      continue;
    }
    std::size_t end = text.find_first_not_of("-+ #.0123456789", percent + 1);
    if (end == std::string_view::npos) break;
    const std::string_view width = text.substr(percent, end - percent);
    constexpr std::ptrdiff_t k_most_digits = 4;  // "-12.10"
    const bool wide = std::count_if(width.begin(), width.end(), is_digit) > k_most_digits;
    const bool other = std::string_view("nspcaAhlLqjztSCmxXou*").find(text[end]) != std::string_view::npos;
    if (other || wide) return std::string(text.substr(percent, std::min<std::size_t>(end + 1 - percent, 12)));
  }
  return {};
}

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  std::vector<GmshToken> tokens() {
    while (at_ < text_.size()) step();
    add(GmshToken::Kind::end, at_, at_);
    return std::move(tokens_);
  }

 private:
  static constexpr std::size_t k_longest_string = 1000;  ///< within what Gmsh takes for one text

  char here(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  SourceLocation place(std::size_t at) const {
    return {path_, line_, static_cast<int>(at - line_start_) + 1};
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed = {}) const {
    throw InputError(place(at_), what, allowed);
  }

  void add(GmshToken::Kind kind, std::size_t begin, std::size_t end) {
    tokens_.push_back({kind, text_.substr(begin, end - begin), place(begin)});
    code_in_line_ = true;
  }

  void new_line() {
    ++at_;
    ++line_;
    line_start_ = at_;
    code_in_line_ = false;
  }

  void step() {
    // The first character tells what follows.
    const char c = here();
    if (c == '\n') return new_line();
    if (c == ' ' || c == '\t' || (c == '\r' && here(1) == '\n')) {
      ++at_;
    } else if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) {
      refuse("the script has a character that is neither text nor part of a comment or a string",
             "a text file with plain letters outside of comments");
    } else if (c == '/' && here(1) == '/') {
      line_comment();
    } else if (c == '/' && here(1) == '*') {
      block_comment();
    } else if (c == '"' || c == '\'') {
      string(c);
    } else if (is_letter(c)) {
      word();
    } else if (is_digit(c) || (c == '.' && is_digit(here(1)))) {
      number();
    } else {
      symbol();
    }
  }

  void check_return(char c) const {
    if (c == '\r' && here(1) != '\n')
      refuse("the script has a line that ends with a carriage return alone",
             "line ends as of Linux or Windows");
  }

  void line_comment() {
    for (; at_ < text_.size() && here() != '\n'; ++at_) check_return(here());
  }

  void block_comment() {
    // Behind code a comment of several lines would hide where the next statement begins.
    const std::size_t begin = at_;
    const bool behind_code = code_in_line_;
    for (at_ += 2; at_ < text_.size() && !(here() == '*' && here(1) == '/');) {
      check_return(here());
      if (here() != '\n') {
        ++at_;
        continue;
      }
      if (behind_code) {
        at_ = begin;
        refuse("a comment of several lines begins behind code",
               "a line of its own for the comment's beginning, or // in each line");
      }
      new_line();
    }
    if (at_ >= text_.size()) refuse("a comment has no end", "*/");
    at_ += 2;
  }

  void string(char quote) {
    // Texts are bounded in length, in one line, print plain numbers only and hold no marks that a simpler
    // reader could take for structure.
    const std::size_t begin = ++at_;
    for (; here() != quote || at_ >= text_.size(); ++at_)
      if (at_ >= text_.size() || static_cast<unsigned char>(here()) < 0x20)
        refuse("a text in quotes has no end in its line");
    const std::string_view content = text_.substr(begin, at_ - begin);
    if (content.size() > k_longest_string)
      refuse("a text in quotes is longer than " + std::to_string(k_longest_string) + " characters");
    if (const std::string bad = unusual_format(content); !bad.empty())
      refuse("the text in quotes would print with the format '" + bad + "'", "%g, %e, %f or %%");
    for (const std::string_view marks : {"/*", "*/", "//", "EndIf", "Else", "EndFor", "Return"})
      if (content.find(marks) != std::string_view::npos)
        refuse("a text in quotes holds '" + std::string(marks) + "', a mark of comments and blocks",
               "another text");
    add(GmshToken::Kind::string, begin, at_);
    ++at_;
  }

  void word() {
    const std::size_t begin = at_;
    while (is_letter(here()) || is_digit(here())) ++at_;
    add(GmshToken::Kind::word, begin, at_);
  }

  void number() {
    const std::size_t begin = at_;
    while (is_digit(here())) ++at_;
    if (here() == '.' && here(1) != '.') ++at_;
    while (is_digit(here())) ++at_;
    const std::size_t sign = here(1) == '+' || here(1) == '-' ? 1 : 0;
    if ((here() == 'e' || here() == 'E') && is_digit(here(1 + sign))) {
      at_ += 1 + sign;
      while (is_digit(here())) ++at_;
    }
    add(GmshToken::Kind::number, begin, at_);
  }

  void symbol() {
    static constexpr std::array<std::string_view, 17> k_long = {"...", "::", "||", "&&", "++", "--",
                                                                "==",  "!=", "<=", ">=", ">>", "<<",
                                                                "+=",  "-=", "*=", "/=", "//"};
    std::size_t length = 1;
    for (const std::string_view symbol : k_long)
      if (text_.substr(at_).starts_with(symbol)) {
        length = symbol.size();
        break;
      }
    const std::size_t begin = at_;
    add(GmshToken::Kind::symbol, begin, begin + length);
    at_ += length;
  }

  std::string_view text_;
  const std::string& path_;
  std::vector<GmshToken> tokens_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  bool code_in_line_ = false;  ///< whether this line has had a token
};

}  // namespace

std::vector<GmshToken> gmsh_tokens(std::string_view text, const std::string& path) {
  return Scanner(text, path).tokens();
}

}  // namespace solidus::mesh
