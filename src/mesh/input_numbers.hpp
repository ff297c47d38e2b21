/// Numbers of elements and nodes beyond one process: those in the input, for messages and for tables that
/// outlive a run, and those over all processes.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <vector>

#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::mesh {

class Packer;
class Unpacker;

/// A list of numbers from 0 on. Each takes 4 bytes until one comes that needs 8; then all take 8. A mesh of
/// tetrahedra has five to six elements a node, and hardly a file numbers them beyond 2^31.
class InputNumbers {
 public:
  InputNumbers() = default;
  InputNumbers(std::initializer_list<GlobalIndex> numbers);
  /// Takes what pack() put.
  explicit InputNumbers(Unpacker& message);

  void push_back(GlobalIndex number);
  void reserve(std::size_t n) { is_wide() ? wide_.reserve(n) : narrow_.reserve(n); }
  /// New entries are 0.
  void resize(std::size_t n) { is_wide() ? wide_.resize(n) : narrow_.resize(n); }
  void clear();

  GlobalIndex operator[](std::size_t i) const { return is_wide() ? wide_[i] : narrow_[i]; }
  std::size_t size() const { return is_wide() ? wide_.size() : narrow_.size(); }
  bool empty() const { return size() == 0; }
  bool is_wide() const { return !wide_.empty(); }
  std::size_t bytes() const { return narrow_.size() * sizeof(Index) + wide_.size() * sizeof(GlobalIndex); }
  /// Puts all into a message, with as many bytes each as they take here.
  void pack(Packer& message) const;
  /// Numbers start … start + n − 1, with 8 bytes each.
  std::vector<GlobalIndex> part(std::size_t start, std::size_t n) const;

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = GlobalIndex;
    using difference_type = std::ptrdiff_t;
    using pointer = const GlobalIndex*;
    using reference = GlobalIndex;

    Iterator() = default;
    Iterator(const InputNumbers* numbers, std::size_t i) : numbers_(numbers), i_(i) {}
    GlobalIndex operator*() const { return (*numbers_)[i_]; }
    Iterator& operator++() {
      ++i_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++i_;
      return before;
    }
    Iterator operator+(std::ptrdiff_t n) const { return {numbers_, i_ + as_size(n)}; }
    bool operator==(const Iterator& other) const { return i_ == other.i_; }

   private:
    const InputNumbers* numbers_ = nullptr;
    std::size_t i_ = 0;
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }

  friend bool operator==(const InputNumbers& a, const InputNumbers& b);

 private:
  std::vector<Index> narrow_;      ///< empty if one number needs 8 bytes
  std::vector<GlobalIndex> wide_;  ///< else empty
};

}  // namespace solidus::mesh
