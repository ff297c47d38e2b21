/// A tree that is built in order and written once.
#include "results/output/json_document.hpp"

#include <fmt/format.h>

#include <cmath>

#include "numbers/index_casts.hpp"
#include "results/output/csv.hpp"
#include "results/output/output_error.hpp"

namespace solidus::results {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace

Json& Json::add(std::string key, Json value) {
  std::get<Object>(value_).emplace_back(std::move(key), std::move(value));
  return *this;
}

std::string Json::text() const {
  std::string out;
  append(out, 0, {});
  return out + "\n";
}

void Json::append(std::string& out, int depth, const std::string& key) const {
  // Lines of members, and the one of the closing bracket, are indented by two blanks a level.
  const std::string line = "\n" + std::string(as_size(2 * (depth + 1)), ' ');
  const std::string last = "\n" + std::string(as_size(2 * depth), ' ');
  // By the kind of value; members of lists and objects go deeper by one level.
  if (const auto* flag = std::get_if<bool>(&value_)) {
    out += *flag ? "true" : "false";
  } else if (const auto* whole = std::get_if<std::int64_t>(&value_)) {
    out += fmt::format("{}", *whole);
  } else if (const auto* number = std::get_if<double>(&value_)) {
    // JSON has no infinity; such a number is a failure that should be seen.
    if (!std::isfinite(*number)) throw NotFiniteError("member '" + key + "' of summary.json", {});
    out += number_text(*number);
  } else if (const auto* string = std::get_if<std::string>(&value_)) {
    out += quoted(*string);
  } else if (const auto* array = std::get_if<Array>(&value_)) {
    out += "[";
    for (const Json& item : *array) {
      out += (&item == array->data() ? "" : ",") + line;
      item.append(out, depth + 1, key);
    }
    out += (array->empty() ? "" : last) + "]";
  } else {
    const auto& object = std::get<Object>(value_);
    out += "{";
    for (const auto& member : object) {
      out += (&member == object.data() ? "" : ",") + line + quoted(member.first) + ": ";
      member.second.append(out, depth + 1, key.empty() ? member.first : key + "." + member.first);
    }
    out += (object.empty() ? "" : last) + "}";
  }
}

}  // namespace solidus::results
