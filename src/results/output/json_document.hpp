/// A JSON document built in code and written as text (summary.json). Objects keep the order of insertion.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace solidus::results {

class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;

  Json() : value_(Object{}) {}
  Json(bool value) : value_(value) {}
  Json(std::integral auto value) : value_(static_cast<std::int64_t>(value)) {}
  Json(double value) : value_(value) {}
  Json(const char* value) : value_(std::string(value)) {}
  Json(std::string value) : value_(std::move(value)) {}
  Json(Array value) : value_(std::move(value)) {}

  /// Adds a member to an object.
  Json& add(std::string key, Json value);
  /// Indented text. Throws NotFiniteError naming the member for a number JSON cannot hold.
  std::string text() const;

 private:
  void append(std::string& out, int depth, const std::string& key) const;
  std::variant<bool, std::int64_t, double, std::string, Array, Object> value_;
};

}  // namespace solidus::results
