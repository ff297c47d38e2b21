/// TOML is converted to a tree in which every value knows its place in the file, and written back in the
/// same form.
#include "input/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "input/toml_limits.hpp"
#include "system/input_file.hpp"

namespace solidus {

namespace {

SourceLocation location(const toml::source_region& region, const std::string& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

void check_text(const std::string& text, const SourceLocation& where) {
  if (printable(text) != text)
    throw InputError(where, "the text holds a control character", "letters, line ends and tabs");
}

/// A copy of a TOML node with its places.
Value convert(const toml::node& node, const std::string& file, int depth = 0) {
  const SourceLocation where = location(node.source(), file);
  // Nesting is bounded, as every level is a call of this function.
  if (depth > 2 * k_most_key_parts) throw InputError(where, "tables are nested too deep in tables");
  Value result;
  // Each kind of node has its own conversion; tables and lists go down into their items.
  if (const auto* table = node.as_table()) {
    for (const auto& [key, child] : *table) {
      check_text(std::string(key.str()), location(key.source(), file));
      result.entries().push_back(
          {std::string(key.str()), location(key.source(), file), convert(child, file, depth + 1)});
    }
    // toml++ sorts by name; the user's order reads better in messages and in the resolved case.
    std::stable_sort(result.entries().begin(), result.entries().end(), [](const auto& a, const auto& b) {
      return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
    });
    result.written_inline = table->is_inline();
  } else if (const auto* list = node.as_array()) {
    result = Value::list();
    for (const auto& child : *list) result.items().push_back(convert(child, file, depth + 1));
  } else if (const auto* text = node.as_string()) {
    check_text(text->get(), where);
    result = Value(text->get());
  } else if (const auto* integer = node.as_integer()) {
    result = Value(std::int64_t{integer->get()});
  } else if (const auto* number = node.as_floating_point()) {
    // TOML allows infinity and NaN, but no key does.
    if (!std::isfinite(number->get())) throw InputError(where, "the number is not finite", "a finite number");
    result = Value(number->get());
  } else if (const auto* truth = node.as_boolean()) {
    result = Value(truth->get());
  } else {
    throw InputError(where, "found a date or time, which no key takes",
                     "a duration or an instant is written as text with its unit: \"90 s\"");
  }
  result.where = where;
  return result;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  // Only characters that TOML does not take as they are become escape sequences.
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string bare_or_quoted(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

std::string inline_toml(const Value& value) {
  if (value.is_text()) return quoted(value.text());
  if (value.is_boolean()) return value.boolean() ? "true" : "false";
  if (value.is_integer()) return fmt::format("{}", value.integer());
  if (value.is_number()) {
    std::string number = fmt::format("{}", value.number());
    if (number.find_first_of(".e") == std::string::npos) number += ".0";
    // A number without a point or exponent would be read as an integer again.
    return number;
  }
  // Lists and tables are written in one line, their items by the same rules.
  std::string result;
  if (value.is_list()) {
    for (const Value& item : value.items()) result += (result.empty() ? "" : ", ") + inline_toml(item);
    return "[" + result + "]";
  }
  for (const auto& [key, where, item] : value.entries())
    result += (result.empty() ? "" : ", ") + bare_or_quoted(key) + " = " + inline_toml(item);
  return result.empty() ? "{}" : "{ " + result + " }";
}

bool is_list_of_sections(const Value& value) {
  return value.is_list() && !value.items().empty() &&
         std::all_of(value.items().begin(), value.items().end(),
                     [](const Value& item) { return item.is_table() && !item.written_inline; });
}

void write_section(const Value& table, const std::string& path, std::string& out) {
  const auto deferred = [](const Value& v) {
    return (v.is_table() && !v.written_inline) || is_list_of_sections(v);
  };
  // Plain keys come first, as TOML would count them to the section above them otherwise.
  for (const auto& [key, where, value] : table.entries())
    if (!deferred(value)) out += fmt::format("{} = {}\n", bare_or_quoted(key), inline_toml(value));
  // Tables and lists of tables follow as sections, under their whole path.
  for (const auto& [key, where, value] : table.entries()) {
    if (!deferred(value)) continue;
    const std::string inner = (path.empty() ? "" : path + ".") + bare_or_quoted(key);
    if (value.is_table()) {
      out += fmt::format("\n[{}]\n", inner);
      write_section(value, inner, out);
    } else {
      for (const Value& item : value.items()) {
        out += fmt::format("\n[[{}]]\n", inner);
        write_section(item, inner, out);
      }
    }
  }
}

}  // namespace

Value Value::list(std::initializer_list<Value> items) {
  Value value;
  value.data_ = List(items);
  return value;
}

double Value::number() const {
  if (const auto* whole = std::get_if<std::int64_t>(&data_)) return static_cast<double>(*whole);
  return std::get<double>(data_);
}

const Value* Value::find(std::string_view key) const {
  const auto* table = std::get_if<Entries>(&data_);
  if (!table) return nullptr;
  const auto found = std::find_if(table->begin(), table->end(), [&](const Entry& e) { return e.key == key; });
  return found == table->end() ? nullptr : &found->value;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(std::as_const(*this).find(key));
}

Value& Value::set(std::string_view key, Value value) {
  if (Value* old = find(key)) return *old = std::move(value);
  SourceLocation at = value.where;
  entries().push_back({std::string(key), std::move(at), std::move(value)});
  return entries().back().value;
}

std::string Value::describe() const {
  if (is_table()) return "a table";
  if (is_list()) return fmt::format("a list of {} value{}", items().size(), items().size() == 1 ? "" : "s");
  if (is_text()) return "the text " + quoted(text());
  return (is_boolean() ? "" : "the number ") + inline_toml(*this);
}

Value parse_document(std::string_view text, const std::string& name) {
  // What no parser should see is refused before.
  if (text.find('\0') != std::string_view::npos)
    throw InputError({name, 0, 0}, "this is not a text file", "a TOML text file in UTF-8");
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw InputError({name, 0, 0}, "the file is empty", "a TOML text file");
  check_key_lengths(text, name);
  try {
    return convert(toml::parse(text, name), name);
  } catch (const toml::parse_error& error) {
    throw InputError(location(error.source(), name), std::string(error.description()), "TOML 1.0 in UTF-8");
  }
}

Value load_document(const std::filesystem::path& path) {
  return parse_document(read_text_file(path, {path.string(), 0, 0}), path.string());
}

Value parse_value(std::string_view text, const std::string& name) {
  const std::string line = fmt::format("value = {}", text);
  // Text is what the argument is if it cannot be read as a value.
  Value result(std::string{text});
  check_key_lengths(line, name);
  try {
    const toml::table table = toml::parse(line, name);
    if (table.size() == 1) result = convert(*table.get("value"), name);
  } catch (const toml::parse_error&) {  // NOLINT: not TOML, so it is plain text
  }
  // Places inside a command-line argument say nothing to a user; the argument itself does.
  const auto forget = [&name](auto& self, Value& value) -> void {
    value.where = {name, 0, 0};
    if (value.is_list())
      for (Value& item : value.items()) self(self, item);
    if (value.is_table())
      for (auto& entry : value.entries()) {
        entry.where = value.where;
        self(self, entry.value);
      }
  };
  forget(forget, result);
  return result;
}

std::string to_toml(const Value& table) {
  std::string out;
  write_section(table, "", out);
  return out;
}

}  // namespace solidus
