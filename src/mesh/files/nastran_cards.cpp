// MSC Nastran Quick Reference Guide, "Format of Bulk Data Entries".
#include "mesh/files/nastran_cards.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

namespace solidus::mesh {

namespace {

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string capitals(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

/// Tabulators go to the next column that begins a field.
std::string without_tabulators(std::string_view line) {
  std::string result;
  for (const char c : line)
    if (c == '\t')
      result.append(8 - result.size() % 8, ' ');
    else
      result += c;
  return result;
}

class Cards {
 public:
  Cards(const std::function<void(const NastranCard&)>& card,
        const std::function<void(std::string_view)>& comment)
      : card_(card), comment_(comment) {}

  void read(const std::string& path) {
    in_bulk_ = !has_begin_bulk(path);
    read_file(path, 0);
    finish();
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    throw InputError(at_, what, allowed);
  }

  /// Before BEGIN BULK come the executive and the case control.
  static bool has_begin_bulk(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
      const std::string text = capitals(without_blanks(line));
      if (text.starts_with("BEGIN") && text.find("BULK") != std::string::npos) return true;
    }
    return false;
  }

  void read_file(const std::string& path, int depth) {
    // An include that is not there is an error at the line that asks for it.
    std::ifstream file(path);
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error) || !file) fail("there is no file '" + path + "'");
    // Includes are bounded, so that files that include each other end.
    if (depth > 20) fail("INCLUDE goes around in circles");
    if (++n_files_ > 1000) fail("INCLUDE asks for more than 1 000 files");
    const SourceLocation outer = at_;
    at_ = {path, 0, 0};
    std::string line;
    while (!ended_ && std::getline(file, line)) {
      ++at_.line;
      if (line.find('\0') != std::string::npos) fail("this is not a text file");
      // Comments may hold the names that preprocessors give to properties.
      const std::size_t dollar = line.find('$');
      if (dollar != std::string::npos) {
        comment_(std::string_view(line).substr(dollar + 1));
        line.resize(dollar);
      }
      take(without_tabulators(line), depth);
    }
    at_ = outer;
  }

  void take(const std::string& line, int depth);
  void add_fields(std::string_view line, bool large);
  void finish() {
    if (pending_) card_(*pending_);
    pending_.reset();
  }

  const std::function<void(const NastranCard&)>& card_;
  const std::function<void(std::string_view)>& comment_;
  SourceLocation at_;
  int n_files_ = 0;
  bool in_bulk_ = true, ended_ = false;
  std::optional<NastranCard> pending_;
};

void Cards::take(const std::string& line, int depth) {
  // A deck is read line by line. An entry may go on over several lines, so it is kept until one that begins
  // again.
  const std::string_view text = without_blanks(line);
  if (text.empty()) return;
  const std::string begin = capitals(text.substr(0, 12));
  // Included files and the beginning and end of the bulk data come first; what is before the bulk is for
  // the solver.
  if (begin.starts_with("INCLUDE") && text.size() > 8 && (text[7] == ' ' || text[7] == '\'')) {
    finish();
    std::string name(without_blanks(text.substr(7)));
    std::erase_if(name, [](char c) { return c == '\'' || c == '"'; });
    const std::string beside = (std::filesystem::path(at_.file).parent_path() / name).string();
    return read_file(beside, depth + 1);
  }
  if (begin.starts_with("BEGIN")) {
    if (capitals(text).find("SUPER") != std::string::npos)
      fail("superelements (BEGIN SUPER) are not read here", "one bulk of nodes and elements");
    in_bulk_ = true;
    return;
  }
  if (!in_bulk_) return;
  if (begin.starts_with("ENDDATA")) {
    ended_ = true;
    return;
  }
  // Fields are separated by commas, or are eight columns wide (sixteen with an asterisk).
  const bool is_free = line.find(',') != std::string::npos;
  const std::string_view first =
      without_blanks(is_free ? std::string_view(line).substr(0, line.find(','))
                             : std::string_view(line).substr(0, std::min<std::size_t>(8, line.size())));
  if (first.starts_with('='))
    fail("entries that repeat the one before ('=') make nodes or elements in a way that is not read here",
         "each node and element with an entry of its own");
  // A line that begins with a blank, a plus or an asterisk continues the entry; missing fields up to the end
  // of its line are empty.
  if (first.empty() || first[0] == '+' || first[0] == '*') {
    if (!pending_) fail("a line goes on with an entry that has not begun");
    while (pending_->fields.size() % (first.starts_with('*') ? 4 : 8) != 0) pending_->fields.emplace_back();
    add_fields(line, first.starts_with('*'));
    return;
  }
  finish();
  std::string name = capitals(first);
  const bool large = name.ends_with('*');
  if (large) name.pop_back();
  pending_.emplace(NastranCard{std::string(without_blanks(name)), {}, at_});
  add_fields(line, large);
}

void Cards::add_fields(std::string_view line, bool large) {
  // Free format: fields between commas.
  const std::size_t most = large ? 4 : 8;
  std::vector<std::string>& fields = pending_->fields;
  if (const auto comma = line.find(','); comma != std::string_view::npos) {
    line.remove_prefix(comma + 1);
    for (std::size_t n = 0; n < most; ++n) {
      const auto next = line.find(',');
      fields.emplace_back(without_blanks(line.substr(0, next)));
      if (next == std::string_view::npos) return;
      line.remove_prefix(next + 1);
    }
    // What is behind the last field names the line that goes on.
    if (const std::string_view rest = without_blanks(line);
        rest.find(',') != std::string_view::npos && rest[0] != '+' && rest[0] != '*')
      fail("a line has more than " + std::to_string(most) + " fields behind its name");
    return;
  }
  // Fixed format: eight columns for each field, sixteen in the long form.
  const std::size_t width = large ? 16 : 8;
  for (std::size_t n = 0; n < most; ++n) {
    const std::size_t from = 8 + n * width;
    if (from >= line.size()) return;
    fields.emplace_back(without_blanks(line.substr(from, width)));
  }
}

}  // namespace

void NastranCard::fail(const std::string& what, const std::string& allowed) const {
  throw InputError(at, what, allowed);
}

GlobalIndex NastranCard::integer(std::size_t i, GlobalIndex without) const {
  if (!has(i)) return without;
  const std::string& text = fields[i];
  GlobalIndex value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(name + ": '" + text + "' is no whole number");
  return value;
}

double NastranCard::real(std::size_t i, double without) const {
  if (!has(i)) return without;
  // "1.5-3" is 1.5e-3, "1.5D2" is 150.
  std::string text;
  for (const char c : fields[i]) {
    const bool sign_of_power = (c == '+' || c == '-') && !text.empty() && text.back() != 'E';
    if (sign_of_power) text += 'E';
    if (c == 'd' || c == 'D' || c == 'e')
      text += 'E';
    else if (c != '+')
      text += c;
  }
  // All of the field must be a number, and a finite one.
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    fail(name + ": '" + fields[i] + "' is no number");
  return value;
}

void read_nastran_cards(const std::string& path, const std::function<void(const NastranCard&)>& card,
                        const std::function<void(std::string_view)>& comment) {
  Cards(card, comment).read(path);
}

}  // namespace solidus::mesh
