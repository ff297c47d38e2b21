/// The data section of a VTK XML file: arrays in zlib blocks, and the XML that describes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/output/output_file.hpp"

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

/// Header of an array: `name`, `components` per tuple, `unit` (may be empty).
struct ArrayHead {
  std::string name;
  int components = 1;
  std::string unit = {};
  bool cylindrical = false;  ///< as Field::cylindrical
};

/// The names of the components of a symmetric tensor (VTK's order and ours are the same), else nothing; and
/// the unit, as attributes and children of <DataArray> or <PDataArray>.
std::string array_attributes(const ArrayHead& head, std::string_view type);
std::string array_information(const ArrayHead& head);

/// Collects arrays on disk: values are compressed and written as they come, so that no array is in memory.
class AppendedData {
 public:
  /// Must outlive this object.
  explicit AppendedData(SpoolFile& to) : to_(to) {}

  /// An array of n values, which `produce` hands one after the other to the function it is given.
  /// @return the <DataArray> element that refers to it; its offset counts from the start of the file
  template <class T, class F>
  std::string add(const ArrayHead& head, std::size_t n, const F& produce) {
    static_assert(k_block_bytes % sizeof(T) == 0, "a value lies in one block");
    const std::uint64_t offset = to_.size();
    begin(n * sizeof(T));
    produce([this](const T& value) {
      if (filled_ == k_block_bytes) write_block();
      std::memcpy(block_.data() + filled_, &value, sizeof value);
      filled_ += sizeof value;
    });
    end();
    return element(head, vtk_type<T>(), offset);
  }

 private:
  // Values are compressed in blocks of this size.
  static constexpr std::size_t k_block_bytes = std::size_t{1} << 17;

  void begin(std::size_t n_bytes);
  void write_block();
  void end();
  static std::string element(const ArrayHead& head, std::string_view type, std::uint64_t offset);

  SpoolFile& to_;
  std::vector<std::byte> block_ = std::vector<std::byte>(k_block_bytes), compressed_;
  std::size_t filled_ = 0;            ///< of the block
  std::size_t left_ = 0;              ///< bytes of the array that are not written yet
  std::uint64_t sizes_at_ = 0;        ///< where those of the array's blocks belong
  std::vector<std::uint64_t> sizes_;  ///< compressed
};

}  // namespace solidus::results
