/// Numbers take 32 bits each until one does not fit; then all of them become wide.
#include "mesh/input_numbers.hpp"

#include <algorithm>
#include <limits>

#include "mesh/message.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

bool fits(GlobalIndex number) {
  return number >= std::numeric_limits<Index>::min() && number <= std::numeric_limits<Index>::max();
}

}  // namespace

InputNumbers::InputNumbers(std::initializer_list<GlobalIndex> numbers) {
  for (const GlobalIndex number : numbers) push_back(number);
}

InputNumbers::InputNumbers(Unpacker& message)
    : narrow_(message.vector<Index>()), wide_(message.vector<GlobalIndex>()) {}

void InputNumbers::pack(Packer& message) const {
  message.put(narrow_);
  message.put(wide_);
}

void InputNumbers::push_back(GlobalIndex number) {
  if (!is_wide() && fits(number)) {
    narrow_.push_back(as_index(number));
    return;
  }
  if (!is_wide()) {
    wide_.assign(narrow_.begin(), narrow_.end());
    narrow_ = {};
  }
  wide_.push_back(number);
}

void InputNumbers::clear() {
  narrow_.clear();
  wide_.clear();
}

std::vector<GlobalIndex> InputNumbers::part(std::size_t start, std::size_t n) const {
  std::vector<GlobalIndex> numbers(n);
  for (std::size_t i = 0; i < n; ++i) numbers[i] = (*this)[start + i];
  return numbers;
}

bool operator==(const InputNumbers& a, const InputNumbers& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

}  // namespace solidus::mesh
