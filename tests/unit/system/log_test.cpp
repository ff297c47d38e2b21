#include "system/log.hpp"

#include <gtest/gtest.h>

namespace solidus {
namespace {

/// Takes the printed lines for the length of a test.
class Log : public ::testing::Test {
 protected:
  void SetUp() override {
    logging::clear_warnings();
    logging::set_sink([this](logging::Level, std::string_view text) { lines_.emplace_back(text); });
  }
  void TearDown() override {
    logging::set_sink({});
    logging::set_level(logging::Level::info);
    logging::clear_warnings();
  }
  std::vector<std::string> lines_;
};

TEST_F(Log, PrintsMessagesFromItsLevelUp) {
  logging::debug("not shown");
  logging::info("{} nodes", 4);
  logging::set_level(logging::Level::warn);
  logging::info("not shown");
  logging::set_level(logging::Level::debug);
  logging::debug("shown");
  EXPECT_EQ(lines_, (std::vector<std::string>{"4 nodes", "shown"}));
}

TEST_F(Log, CollectsEachWarningOnceEvenWhenSilent) {
  logging::set_level(logging::Level::silent);
  logging::warn("left the range at {} K", 900);
  logging::warn("left the range at {} K", 900);
  logging::warn("another");
  EXPECT_TRUE(lines_.empty());
  EXPECT_EQ(logging::warnings(), (std::vector<std::string>{"left the range at 900 K", "another"}));
}

}  // namespace
}  // namespace solidus
