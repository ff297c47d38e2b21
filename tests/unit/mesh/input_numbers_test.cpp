#include "mesh/input_numbers.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "mesh/message.hpp"

namespace solidus::mesh {
namespace {

constexpr GlobalIndex k_beyond = GlobalIndex{1} << 40;

TEST(InputNumbers, TakeFourBytesUntilOneNeedsEight) {
  InputNumbers numbers = {7, 2147483647};
  EXPECT_EQ(numbers.bytes(), 8U);
  numbers.push_back(k_beyond);
  EXPECT_EQ(numbers.bytes(), 24U);
  numbers.push_back(3);
  EXPECT_EQ(numbers.part(0, 4), (std::vector<GlobalIndex>{7, 2147483647, k_beyond, 3}));
  EXPECT_EQ(numbers.part(1, 2), (std::vector<GlobalIndex>{2147483647, k_beyond}));
}

TEST(InputNumbers, GoThroughAMessage) {
  for (const InputNumbers& numbers : {InputNumbers{}, InputNumbers{1, 5}, InputNumbers{k_beyond, 5}}) {
    Packer packer;
    numbers.pack(packer);
    const std::vector<char> bytes = std::move(packer).buffer();
    Unpacker unpacker(bytes);
    const InputNumbers back(unpacker);
    EXPECT_EQ(back, numbers);
    EXPECT_EQ(back.bytes(), numbers.bytes());
  }
}

TEST(InputNumbers, StartAnewWithFourBytes) {
  InputNumbers numbers = {k_beyond, 5};
  EXPECT_FALSE(numbers == InputNumbers({1, 5}));
  numbers.clear();
  numbers.push_back(5);
  EXPECT_EQ(numbers, InputNumbers({5}));
  EXPECT_EQ(numbers.bytes(), 4U);
}

}  // namespace
}  // namespace solidus::mesh
