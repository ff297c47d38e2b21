/// A reader by recursive descent of bounded depth, with the place of every value in the file.
#include "input/json.hpp"

#include <charconv>
#include <limits>

#include "numbers/index_casts.hpp"

namespace solidus {
namespace {

constexpr int k_deepest = 64;

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
  }

  Value document() {
    Value value = next_value(0);
    skip_space();
    if (at_ < text_.size()) fail("there is more behind the end of the JSON");
    return value;
  }

 private:
  SourceLocation here() const { return {name_, line_, static_cast<int>(at_ - line_start_) + 1}; }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(here(), what, "JSON"); }

  void skip_space() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        line_start_ = at_ + 1;
      } else if (c != ' ' && c != '\t' && c != '\r') {
        return;
      }
      ++at_;
    }
  }
  char peek() {
    skip_space();
    if (at_ >= text_.size()) fail("the JSON ends too early");
    return text_[at_];
  }
  bool take(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  Value next_value(int depth) {
    if (depth > k_deepest) fail("the JSON is nested too deep");
    const char first = peek();
    const SourceLocation where = here();
    Value value;
    // The first character tells the kind of value.
    if (first == '{') {
      value = object(depth);
    } else if (first == '[') {
      value = list(depth);
    } else if (first == '"') {
      value = Value(text());
    } else if (take("true")) {
      value = Value(true);
    } else if (take("false")) {
      value = Value(false);
    } else {
      value = Value(number());
    }
    value.where = where;
    return value;
  }

  Value object(int depth) {
    Value value;
    ++at_;
    if (peek() == '}') return ++at_, value;
    // Members until the closing brace; a name may be given once.
    while (true) {
      if (peek() != '"') fail("expected the name of a member in quotes");
      const SourceLocation where = here();
      std::string key = text();
      if (value.find(key) != nullptr) throw InputError(where, "the member '" + key + "' is there twice");
      if (peek() != ':') fail("expected ':' behind the name of a member");
      ++at_;
      // The value of a member may be anything, one level deeper.
      Value member = next_value(depth + 1);
      value.entries().push_back({std::move(key), where, std::move(member)});
      const char c = peek();
      if (c != ',' && c != '}') fail("expected ',' or '}'");
      ++at_;
      if (c == '}') return value;
    }
  }

  Value list(int depth) {
    Value value = Value::list();
    ++at_;
    if (peek() == ']') return ++at_, value;
    while (true) {
      value.items().push_back(next_value(depth + 1));
      const char c = peek();
      if (c != ',' && c != ']') fail("expected ',' or ']'");
      ++at_;
      if (c == ']') return value;
    }
  }

  double number() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (take("null") || take("NaN")) return nan;
    if (take("Infinity")) return infinite;
    if (take("-Infinity")) return -infinite;
    double result = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), result);
    const char first = text_[at_];
    if (error != std::errc{} || !(first == '-' || (first >= '0' && first <= '9'))) fail("expected a value");
    at_ = as_size(end - text_.data());
    return result;
  }

  std::string text() {
    std::string result;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      const char c = text_[at_];
      if (static_cast<unsigned char>(c) < 0x20) fail("a text holds a control character or a line end");
      if (c != '\\') {
        result += c;
      } else {
        ++at_;
        escaped(result);
      }
    }
    if (at_ >= text_.size()) fail("a text has no end");
    ++at_;
    return result;
  }

  /// Appends the character behind a backslash; at_ ends on its last letter.
  void escaped(std::string& result) {
    constexpr std::string_view letters = "\"\\/bfnrt", meaning = "\"\\/\b\f\n\r\t";
    if (at_ >= text_.size()) fail("a text has no end");
    if (const auto known = letters.find(text_[at_]); known != std::string_view::npos) {
      result += meaning[known];
      return;
    }
    // An escape by number: four hexadecimal digits, written in UTF-8.
    unsigned code = 0;
    const char* const begin = text_.data() + at_ + 1;
    const bool room = text_[at_] == 'u' && at_ + 4 < text_.size();
    if (!room || std::from_chars(begin, begin + 4, code, 16).ptr != begin + 4)
      fail("a backslash is followed by a character that it cannot escape");
    at_ += 4;
    if (code < 0x80) {
      result += static_cast<char>(code);
    } else if (code < 0x800) {
      result += static_cast<char>(0xC0 | (code >> 6));
      result += static_cast<char>(0x80 | (code & 0x3F));
    } else {  // a half of a pair becomes what no text shows; names of columns have none
      result += static_cast<char>(0xE0 | (code >> 12));
      result += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
      result += static_cast<char>(0x80 | (code & 0x3F));
    }
  }

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

}  // namespace

Value parse_json(std::string_view text, const std::string& name) {
  return Reader(text, name).document();
}

}  // namespace solidus
