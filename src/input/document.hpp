/// A text file of the user as a tree of values, each with its place in the file. TOML behind it
/// (docs/guide/case_file.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "system/errors.hpp"

namespace solidus {

/// One value: text, whole number, number, truth value, list or table. Tables keep the order of the file.
class Value {
 public:
  struct Entry;
  using List = std::vector<Value>;
  using Entries = std::vector<Entry>;

  Value();
  Value(const char* text);     // NOLINT: defaults are written as plain literals
  Value(std::string text);     // NOLINT
  Value(bool truth);           // NOLINT
  Value(int number);           // NOLINT
  Value(std::int64_t number);  // NOLINT
  Value(double number);        // NOLINT
  /// A list of values, `Value::list({0, -1, 0})`.
  static Value list(std::initializer_list<Value> items = {});

  bool is_text() const { return std::holds_alternative<std::string>(data_); }
  bool is_integer() const { return std::holds_alternative<std::int64_t>(data_); }
  bool is_number() const { return is_integer() || std::holds_alternative<double>(data_); }
  bool is_boolean() const { return std::holds_alternative<bool>(data_); }
  bool is_list() const { return std::holds_alternative<List>(data_); }
  bool is_table() const { return std::holds_alternative<Entries>(data_); }

  /// The content; the type must be right (std::bad_variant_access otherwise: our bug).
  const std::string& text() const { return std::get<std::string>(data_); }
  std::int64_t integer() const { return std::get<std::int64_t>(data_); }
  double number() const;
  bool boolean() const { return std::get<bool>(data_); }
  const List& items() const { return std::get<List>(data_); }
  List& items() { return std::get<List>(data_); }
  const Entries& entries() const { return std::get<Entries>(data_); }
  Entries& entries() { return std::get<Entries>(data_); }

  /// The value of a key of this table; null when there is none or this is no table.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  /// Sets or adds a key of this table.
  Value& set(std::string_view key, Value value);

  /// Describes the value for messages: `the text "1 s"`, `the number 3`, `a list of 2 values`, `a table`.
  std::string describe() const;

  SourceLocation where;    ///< of the value
  bool laid_over = false;  ///< it took the place of an inherited value (a variant, --set)
  bool written_inline =
      false;  ///< a table written { like = "this" }: one value, replaced as a whole by a variant

 private:
  std::variant<std::string, std::int64_t, double, bool, List, Entries> data_;
};

struct Value::Entry {
  std::string key;
  SourceLocation where;  ///< of the key
  Value value;
};

// Out of the class, where Entry is complete.
inline Value::Value() : data_(Entries{}) {}
inline Value::Value(const char* text) : data_(std::string(text)) {}
inline Value::Value(std::string text) : data_(std::move(text)) {}
inline Value::Value(bool truth) : data_(truth) {}
inline Value::Value(int number) : data_(std::int64_t{number}) {}
inline Value::Value(std::int64_t number) : data_(number) {}
inline Value::Value(double number) : data_(number) {}

/// Reads a TOML file. Throws InputError with the place for a missing, unreadable, empty, binary or malformed
/// file, for numbers that are not finite, and for dates (no key takes one).
Value load_document(const std::filesystem::path& path);
/// The same from memory; `name` stands for the file in messages.
Value parse_document(std::string_view text, const std::string& name);
/// One value as on the right of an equals sign; anything that is no TOML value is text (`--set time.step=0.5
/// s`).
Value parse_value(std::string_view text, const std::string& name);
/// Writes a table as a TOML document that load_document reads back to the same values.
std::string to_toml(const Value& table);

}  // namespace solidus
