/// Names and numbers are taken out of each text; texts of one form that differ in names are told once, with
/// the names of the others behind.
#include "system/alike_texts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace solidus::logging {

namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

struct Text {
  std::string form;                ///< the text without its numbers and names
  std::vector<std::string> names;  ///< in single quotes, in their order
};

/// End of the name whose quote opens at `begin`; npos where that is an apostrophe or nothing closes it.
std::size_t end_of_name(const std::string& text, std::size_t begin) {
  if (begin > 0 && is_word(text[begin - 1])) return std::string::npos;
  for (std::size_t end = text.find('\'', begin + 1); end != std::string::npos; end = text.find('\'', end + 1))
    if (end + 1 == text.size() || !is_word(text[end + 1])) return end;
  return std::string::npos;
}

/// End of the number that begins with the digit at `begin`: digits, a point, an exponent.
std::size_t end_of_number(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  const auto digits = [&] {
    while (end < text.size() && (is_digit(text[end]) || text[end] == '.')) ++end;
  };
  digits();
  // An exponent belongs to the number only where digits follow.
  if (end < text.size() && text[end] == 'e') {
    const std::size_t sign = end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+') ? 1 : 0;
    if (end + 1 + sign < text.size() && is_digit(text[end + 1 + sign])) {
      end += 1 + sign;
      digits();
    }
  }
  return end;
}

Text read(const std::string& text) {
  // Two texts are alike if they differ in names and numbers alone: both are taken out here, and what is left
  // is the form.
  Text out;
  for (std::size_t i = 0; i < text.size();) {
    // A name is between two quotes; a quote without an end is text.
    if (text[i] == '\'') {
      if (const std::size_t end = end_of_name(text, i); end != std::string::npos) {
        out.names.push_back(text.substr(i, end + 1 - i));
        out.form += "''";
        i = end + 1;
        continue;
      }
    } else if (is_digit(text[i]) && (i == 0 || !is_word(text[i - 1]))) {
      out.form += '0';
      i = end_of_number(text, i);
      continue;
    }
    out.form += text[i++];
  }
  return out;
}

}  // namespace

std::vector<std::string> told_once(const std::vector<std::string>& texts) {
  struct Kind {
    Text first;
    std::string text;
    std::vector<std::string> others;  ///< names of the texts after the first
  };
  std::vector<Kind> kinds;
  // Texts of one form that differ in names alone are told once, with the names of the others behind.
  for (const std::string& text : texts) {
    Text now = read(text);
    const auto equal = [&](const Kind& k) { return k.text == text; };
    if (std::ranges::any_of(kinds, equal)) continue;
    const auto alike = [&](const Kind& k) { return k.first.form == now.form && k.first.names != now.names; };
    const auto kind = std::ranges::find_if(kinds, alike);
    if (kind == kinds.end()) {
      kinds.push_back({std::move(now), text, {}});
      continue;
    }
    // Names that both texts have, such as that of the mould next to each casting, are in the first one.
    std::vector<std::string> different;
    for (std::size_t n = 0; n < now.names.size(); ++n)
      if (now.names[n] != kind->first.names[n]) different.push_back(now.names[n]);
    const std::string other = fmt::format("{}", fmt::join(different, " with "));
    if (std::ranges::find(kind->others, other) == kind->others.end()) kind->others.push_back(other);
  }
  // Each kind with its first text, and the names of the others behind.
  std::vector<std::string> told;
  for (const Kind& k : kinds)
    told.push_back(k.others.empty() ? k.text
                                    : fmt::format("{}; likewise {}", k.text, fmt::join(k.others, ", ")));
  return told;
}

}  // namespace solidus::logging
