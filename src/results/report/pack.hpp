/// Numbers of a report as text: 16-bit values, byte planes, deflate, base64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace solidus::results {

/// The kind of bytes, which determines the fastest setting of deflate: noise contains only runs (50 times as
/// fast as a search for strings, and no larger), masks repeat from moment to moment.
enum class Bytes { mixed, noise, mask };

/// The text of a <script> block: raw deflate (RFC 1951) in base64 (RFC 4648).
std::string packed_text(std::string_view bytes, Bytes like = Bytes::mixed);

/// Integers in zigzag code, which is small for either sign, with their four bytes in four planes: if most are
/// small, most planes are zero.
std::string small_bytes(std::span<const std::int32_t> values);
/// The same for the differences between successive numbers.
std::string rising_bytes(std::span<const std::int32_t> values);

/// Double precision in eight planes of bytes, little endian.
std::string double_bytes(std::span<const double> values);

/// Values in words of 16 bits: value = low + (high − low) q / k_steps, rounded to the nearest.
///
/// With moments k and places i the word is r = q_{k,i} − q_{k−1,i} − q_{k,i−1} + q_{k−1,i−1}, the deviation
/// from a prediction by the neighbour in space and the previous moment, in zigzag code and in two planes.
/// Places without a value are those where `mask` is one; their r is zero.
struct Packed16 {
  double low = 0, high = 0;  ///< of the existing values [unit of the values]
  bool any = false;          ///< there is at least one value
  bool uniform = false;      ///< all values exist and equal `low`
  std::string words;         ///< empty if there is none or they are uniform
  std::string mask;          ///< one byte per value; empty if all exist
};
/// Number of steps that a page can show; more would only add noise to its size. 0.08 K in a range of 1300 K.
inline constexpr int k_steps = 16383;
/// @param moments  [moment][place], all of the same length; entries that are not finite are missing values
Packed16 pack16(const std::vector<std::vector<float>>& moments);

/// Collects the blocks of a report.
class Blocks {
 public:
  /// Returns the number of the block: equal bytes are stored only once.
  int add(const std::string& bytes, Bytes like = Bytes::mixed);
  const std::vector<std::string>& texts() const { return texts_; }
  std::size_t size() const { return size_; }  ///< [byte] of text

 private:
  std::vector<std::string> texts_;
  std::unordered_map<std::string, int> number_;  ///< of a text
  std::size_t size_ = 0;
};

}  // namespace solidus::results
