#include "mutation.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace solidus::fuzz {

std::string Mutation::next() {
  std::string text = corpus_[below(corpus_.size())];
  for (std::size_t n = 1 + below(8); n > 0; --n) damage(text);
  if (text.size() > k_longest) text.resize(k_longest);
  return text;
}

void Mutation::damage(std::string& text) {
  if (text.empty()) {
    text.push_back(static_cast<char>(below(256)));
    return;
  }
  const std::size_t at = below(text.size());
  const std::size_t length = std::min(text.size() - at, 1 + below(below(4) == 0 ? 2000 : 16));
  switch (below(8)) {
    case 0:
      text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1U << below(8)));
      return;
    case 1:
      text[at] = static_cast<char>(below(256));
      return;
    case 2:
      text.erase(at, length);
      return;
    case 3:
      text.insert(below(text.size()), text.substr(at, length));
      return;
    case 4:
      text.resize(at);
      return;
    case 5:
      if (!words_.empty()) text.insert(at, words_[below(words_.size())]);
      return;
    case 6:
      replace_number(text);
      return;
    default:
      splice(text);
  }
}

void Mutation::replace_number(std::string& text) {
  constexpr std::array<std::string_view, 14> k_numbers = {
      "0",  "-1",   "1e308", "-1e308", "1e-308", "nan",        "inf",
      "65", "1e99", "256",   "65536",  "0.5",    "4294967296", "9223372036854775807"};
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto from = static_cast<std::ptrdiff_t>(below(text.size()));
  const auto first = std::find_if(text.begin() + from, text.end(), is_digit);
  const auto last = std::find_if_not(first, text.end(), is_digit);
  text.replace(first, last, k_numbers[below(k_numbers.size())]);
}

void Mutation::splice(std::string& text) {
  const std::string& other = corpus_[below(corpus_.size())];
  if (other.empty()) return;
  const std::size_t from = below(other.size());
  text.insert(below(text.size()), other, from, 1 + below(std::min<std::size_t>(other.size() - from, 4000)));
}

}  // namespace solidus::fuzz
