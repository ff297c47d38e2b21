/// The text is checked before muParser sees it, since that accepts what would be a slip: an assignment, or
/// a comparison of equality.
#include "input/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "input/keys.hpp"
#include "numbers/index_casts.hpp"

namespace solidus {

struct Formula::Parser {
  mu::Parser parser;
  std::vector<double> values;  ///< of the variables, to which the parser is bound
};

namespace {

constexpr const char* k_symbols = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

/// Describes an error of muParser in the words of this program.
std::string problem(const mu::ParserError& error, const std::vector<std::string>& names) {
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN || error.GetCode() == mu::ecINVALID_NAME) {
    const std::string found = error.GetToken();
    return fmt::format("'{}' is not known at character {}; {}", found, error.GetPos() + 1,
                       one_of(names, found));
  }
  return error.GetMsg();
}

/// muParser would assign: "t = 3" for "t == 3".
bool assigns(const std::string& text) {
  for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i)) {
    const bool compares = i > 0 && std::string("<>!").find(text[i - 1]) != std::string::npos;
    const bool twice = i + 1 < text.size() && text[i + 1] == '=';
    if (!compares && !twice) return true;
    i += twice ? 2 : 1;
  }
  return false;
}

/// The length of the comparison that begins at a character; zero: none does.
std::size_t comparison_at(const std::string& text, std::size_t i) {
  const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
  if (c == '<' || c == '>') return next == '=' ? 2 : 1;
  return (c == '=' || c == '!') && next == '=' ? 2 : 0;
}

/// Whether an operand of a comparison ends before this character: what binds less than a comparison does.
bool ends_operand(char c) {
  return std::string("<>=!?:&|,").find(c) != std::string::npos;
}

/// The end of an operand, from a comparison on to the right (`step` 1) or to the left (−1).
std::size_t operand_end(const std::string& text, std::size_t from, int step) {
  const char opens = step > 0 ? '(' : ')', closes = step > 0 ? ')' : '(';
  int depth = 0;
  std::size_t i = from;
  for (; i < text.size(); i += static_cast<std::size_t>(step)) {  // below zero it wraps round to the end
    if (text[i] == opens) ++depth;
    if (text[i] == closes && --depth < 0) break;
    if (depth == 0 && ends_operand(text[i])) break;
  }
  return i;
}

}  // namespace

std::vector<std::unique_ptr<const Formula>> Formula::comparisons() const {
  std::vector<std::unique_ptr<const Formula>> found;
  // Each comparison reaches from the operand before its sign to the one behind it and is a formula of its
  // own.
  for (std::size_t i = 0; i < text_.size(); ++i) {
    const std::size_t length = comparison_at(text_, i);
    if (length == 0) continue;
    const std::size_t begin = i == 0 ? 0 : operand_end(text_, i - 1, -1) + 1;
    const std::size_t end = operand_end(text_, i + length, 1);
    i += length - 1;
    try {
      found.push_back(
          std::make_unique<const Formula>(text_.substr(begin, end - begin), variables_, constants_));
    } catch (const std::invalid_argument&) {
      continue;  // not one that is complete by itself
    }
  }
  return found;
}

std::vector<std::string> Formula::functions() {
  std::vector<std::string> names;
  const mu::Parser parser;
  for (const auto& function : parser.GetFunDef()) names.push_back(function.first);
  return names;
}

bool Formula::is_name(const std::string& text) {
  const std::vector<std::string> taken = functions();
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         text.find_first_not_of(k_symbols) == std::string::npos && text != "pi" && text != "e" &&
         std::find(taken.begin(), taken.end(), text) == taken.end();
}

Formula::Formula(std::string text, const std::vector<std::string>& variables, const Constants& constants)
    : text_(std::move(text)),
      variables_(variables),
      constants_(constants),
      uses_(variables.size(), 0),
      parser_(std::make_unique<Parser>()) {
  // Names are what a formula may use: its variables, constants of the case, and functions. Assignments are
  // refused, because they would change a variable.
  if (assigns(text_))
    throw std::invalid_argument("the formula assigns a value by '='; to compare, write '=='");
  mu::Parser& parser = parser_->parser;
  std::vector<std::string> names = variables;
  for (const auto& constant : constants) names.push_back(constant.first);
  // muParser is set up without its own constants and postfix operators; an evaluation at zero finds what
  // parsing alone does not.
  try {
    parser.DefineNameChars(k_symbols);
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    for (const auto& [name, value] : constants) parser.DefineConst(name, value);
    parser_->values.assign(variables.size(), 0.0);
    for (std::size_t i = 0; i < variables.size(); ++i) parser.DefineVar(variables[i], &parser_->values[i]);
    parser.ClearPostfixOprt();
    parser.EnableOptimizer(true);
    parser.SetExpr(text_);
    parser.Eval();
    if (parser.GetNumResults() != 1)
      throw std::invalid_argument(
          fmt::format("the formula gives {} values, not one", parser.GetNumResults()));
    // The variables that occur are noted, so that a formula without time is known to be steady.
    for (const auto& used : parser.GetUsedVar())
      uses_[as_size(std::find(variables.begin(), variables.end(), used.first) - variables.begin())] = 1;
  } catch (const mu::ParserError& error) {
    for (const std::string& function : functions()) names.push_back(function);
    throw std::invalid_argument(problem(error, names));
  }
}

Formula::~Formula() = default;

double Formula::value(std::span<const double> variables) const {
  assert(variables.size() == parser_->values.size());
  std::copy(variables.begin(), variables.end(), parser_->values.begin());
  return parser_->parser.Eval();
}

}  // namespace solidus
