/// Numbers become bytes that compress: differences, zigzag, planes of bytes, deflate, base64.
#include "results/report/pack.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

namespace solidus::results {

namespace {

std::string deflated(std::string_view bytes, Bytes like) {
  // The strategy of deflate follows from what the bytes look like.
  z_stream stream{};
  if (deflateInit2(&stream, like == Bytes::mask ? 9 : 6, Z_DEFLATED, -MAX_WBITS, 9,
                   like == Bytes::noise ? Z_RLE : Z_FILTERED) != Z_OK)
    throw std::bad_alloc();
  std::string out;
  std::vector<unsigned char> part(std::size_t{1} << 16);
  std::size_t taken = 0;
  int state = Z_OK;
  // Input and output go through the library in parts, as its counters are of 32 bits.
  while (state != Z_STREAM_END) {
    const std::size_t n = std::min<std::size_t>(bytes.size() - taken, std::size_t{1} << 30);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
    stream.avail_in = static_cast<uInt>(n);
    const int flush = taken + n == bytes.size() ? Z_FINISH : Z_NO_FLUSH;
    do {
      stream.next_out = part.data();
      stream.avail_out = static_cast<uInt>(part.size());
      state = deflate(&stream, flush);
      out.append(reinterpret_cast<const char*>(part.data()), part.size() - stream.avail_out);
    } while (stream.avail_out == 0);
    taken += n;
  }
  deflateEnd(&stream);
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = (group << 8U) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : k_digits[(group >> (18 - 6 * k)) & 63U];
  }
  return out;
}

template <class Word>
std::string planes(std::span<const Word> words) {
  std::string out(words.size() * sizeof(Word), '\0');
  for (std::size_t i = 0; i < words.size(); ++i)
    for (std::size_t k = 0; k < sizeof(Word); ++k)
      out[k * words.size() + i] = static_cast<char>((words[i] >> (8 * k)) & 0xff);
  return out;
}

/// 0, −1, 1, −2 … as 0, 1, 2, 3 …
template <class Word>
Word zigzag(Word difference) {
  const bool negative = (difference >> (8 * sizeof(Word) - 1)) != 0;
  return static_cast<Word>(static_cast<Word>(difference << 1U) ^
                           (negative ? std::numeric_limits<Word>::max() : Word{0}));
}

}  // namespace

std::string packed_text(std::string_view bytes, Bytes like) {
  return base64(deflated(bytes, like));
}

std::string small_bytes(std::span<const std::int32_t> values) {
  std::vector<std::uint32_t> words;
  words.reserve(values.size());
  for (const std::int32_t value : values) words.push_back(zigzag(static_cast<std::uint32_t>(value)));
  return planes<std::uint32_t>(words);
}

std::string rising_bytes(std::span<const std::int32_t> values) {
  std::vector<std::int32_t> differences;
  differences.reserve(values.size());
  std::uint32_t before = 0;
  for (const std::int32_t value : values) {
    const auto word = static_cast<std::uint32_t>(value);
    differences.push_back(static_cast<std::int32_t>(word - before));
    before = word;
  }
  return small_bytes(differences);
}

std::string double_bytes(std::span<const double> values) {
  std::vector<std::uint64_t> words;
  words.reserve(values.size());
  for (const double value : values) words.push_back(std::bit_cast<std::uint64_t>(value));
  return planes<std::uint64_t>(words);
}

Packed16 pack16(const std::vector<std::vector<float>>& moments) {
  // Values of all moments of one field and body are packed together. First the range is found, and whether
  // there are places without a value.
  Packed16 out;
  bool complete = true;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::vector<float>& moment : moments)
    for (const float value : moment) {
      complete = complete && std::isfinite(value);
      if (!std::isfinite(value)) continue;
      low = std::min(low, static_cast<double>(value));
      high = std::max(high, static_cast<double>(value));
    }
  out.any = low <= high;
  if (!out.any) return out;
  out.low = low;
  out.high = high;
  // A field that is the same everywhere needs no more than its value.
  out.uniform = complete && low == high;
  if (out.uniform) return out;
  // A value is counted in steps of the range, and told as the difference to what the moment before and the
  // neighbour in space foretell: small numbers, which compress well. Negative ones are mapped to positive.
  const double scale = high > low ? k_steps / (high - low) : 0;
  const std::size_t n = moments.front().size();
  std::vector<std::uint16_t> words, now(n), last(n, 0);
  words.reserve(n * moments.size());
  if (!complete) out.mask.reserve(n * moments.size());
  for (const std::vector<float>& moment : moments) {
    std::uint16_t beside = 0;  // q_{k,i−1} − q_{k−1,i−1}
    for (std::size_t i = 0; i < n; ++i) {
      const bool there = std::isfinite(moment[i]);
      const auto told = static_cast<std::uint16_t>(last[i] + beside);
      now[i] = there ? static_cast<std::uint16_t>(std::lround((static_cast<double>(moment[i]) - low) * scale))
                     : told;
      words.push_back(zigzag(static_cast<std::uint16_t>(now[i] - told)));
      beside = static_cast<std::uint16_t>(now[i] - last[i]);
      if (!complete) out.mask += there ? '\0' : '\1';
    }
    last.swap(now);
  }
  // The two bytes of the numbers go apart, since the higher ones are nearly all zero.
  out.words = planes<std::uint16_t>(words);
  return out;
}

int Blocks::add(const std::string& bytes, Bytes like) {
  std::string text = packed_text(bytes, like);
  const auto [found, is_new] = number_.try_emplace(text, static_cast<int>(texts_.size()));
  if (!is_new) return found->second;
  size_ += text.size();
  texts_.push_back(std::move(text));
  return found->second;
}

}  // namespace solidus::results
