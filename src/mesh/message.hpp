/// Vectors of plain values packed into one buffer, to send a process its part of a mesh.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace solidus::mesh {

class Packer {
 public:
  /// Room for what is to come, so that the buffer does not grow by doubling.
  void reserve(std::size_t bytes) { buffer_.reserve(bytes); }
  template <class T>
  void put(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_size(v.size());
    append(v.data(), v.size() * sizeof(T));
  }
  /// A vector, value by value: put_size() of their number comes before the first one.
  template <class T>
  void put_values(const T* values, std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(values, n * sizeof(T));
  }
  void put(const std::string& s) {
    put_size(s.size());
    append(s.data(), s.size());
  }
  void put_size(std::size_t n) { append(&n, sizeof n); }
  std::vector<char> buffer() && { return std::move(buffer_); }

 private:
  void append(const void* p, std::size_t n) {
    const auto* c = static_cast<const char*>(p);
    buffer_.insert(buffer_.end(), c, c + n);
  }
  std::vector<char> buffer_;
};

class Unpacker {
 public:
  explicit Unpacker(const std::vector<char>& buffer) : buffer_(buffer) {}
  template <class T>
  std::vector<T> vector() {
    std::vector<T> v(size());
    take(v.data(), v.size() * sizeof(T));
    return v;
  }
  std::string string() {
    std::string s(size(), '\0');
    take(s.data(), s.size());
    return s;
  }
  std::size_t size() {
    std::size_t n = 0;
    take(&n, sizeof n);
    return n;
  }

 private:
  void take(void* p, std::size_t n) {
    assert(at_ + n <= buffer_.size());
    if (n > 0) std::memcpy(p, buffer_.data() + at_, n);
    at_ += n;
  }
  const std::vector<char>& buffer_;
  std::size_t at_ = 0;
};

}  // namespace solidus::mesh
