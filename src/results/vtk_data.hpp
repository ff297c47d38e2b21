/// The data section of a VTK XML file: arrays in zlib blocks, and the XML that describes them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace solidus::results {

/// VTK's name of a number type.
template <class T>
constexpr std::string_view vtk_type();
template <>
constexpr std::string_view vtk_type<double>() {
  return "Float64";
}
template <>
constexpr std::string_view vtk_type<std::int64_t>() {
  return "Int64";
}
template <>
constexpr std::string_view vtk_type<std::int32_t>() {
  return "Int32";
}
template <>
constexpr std::string_view vtk_type<std::uint8_t>() {
  return "UInt8";
}

/// Text with the characters that XML reserves replaced.
std::string xml_text(std::string_view text);

/// What names an array: `name`, `components` per tuple, `unit` (may be empty).
struct ArrayHead {
  std::string name;
  int components = 1;
  std::string unit = {};
};

/// The names of the components of a symmetric tensor (VTK's order and ours are the same), else nothing; and
/// the unit, as attributes and children of <DataArray> or <PDataArray>.
std::string array_attributes(const ArrayHead& head, std::string_view type);
std::string array_information(const ArrayHead& head);

/// Collects arrays: add() compresses the values and returns the <DataArray> element that refers to them.
class AppendedData {
 public:
  template <class T>
  std::string add(const ArrayHead& head, const std::vector<T>& values) {
    return add_bytes(head, vtk_type<T>(), std::as_bytes(std::span<const T>(values)));
  }
  /// Everything added so far; offsets in the XML count from its start.
  const std::string& bytes() const { return bytes_; }

 private:
  std::string add_bytes(const ArrayHead& head, std::string_view type, std::span<const std::byte> values);
  std::string bytes_;
};

}  // namespace solidus::results
