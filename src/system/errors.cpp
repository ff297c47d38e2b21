/// How an error becomes the text that the user reads.
#include "system/errors.hpp"

#include <utility>

namespace solidus {

std::string SourceLocation::text() const {
  std::string text = file;
  if (line > 0) {
    text += (text.empty() ? "line " : ":") + std::to_string(line);
    if (column > 0) text += ":" + std::to_string(column);
  }
  return text;
}

namespace {

std::string message(const SourceLocation& where, const std::string& what, const std::string& allowed) {
  std::string text = where.text();
  if (!text.empty()) text += ": ";
  text += what;
  if (!allowed.empty()) text += "\n  " + allowed;
  return text;
}

}  // namespace

InputError::InputError(SourceLocation where, std::string what, std::string allowed)
    : std::runtime_error(message(where, what, allowed)), where_(std::move(where)) {}

StepRejected::StepRejected(std::string reason, std::string where, Failure failure)
    : std::runtime_error(reason), where_(std::move(where)), failure_(failure) {
  append(reason);
}

void StepRejected::append(const std::string& text) {
  reason_ += text;
  message_ = where_.empty() ? reason_ : reason_ + "; " + where_;
}

}  // namespace solidus
