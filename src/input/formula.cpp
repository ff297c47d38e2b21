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

}  // namespace

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
    : text_(std::move(text)), uses_(variables.size(), 0), parser_(std::make_unique<Parser>()) {
  if (assigns(text_))
    throw std::invalid_argument("the formula assigns a value by '='; to compare, write '=='");
  mu::Parser& parser = parser_->parser;
  std::vector<std::string> names = variables;
  for (const auto& constant : constants) names.push_back(constant.first);
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
    for (const auto& used : parser.GetUsedVar())
      uses_[static_cast<std::size_t>(std::find(variables.begin(), variables.end(), used.first) -
                                     variables.begin())] = 1;
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
