#include "base/log.hpp"

#include <gtest/gtest.h>

namespace solidus {
namespace {

/// Takes the printed lines for the length of a test.
class Log : public ::testing::Test {
 protected:
  void SetUp() override {
    log::clear_warnings();
    log::set_sink([this](log::Level, std::string_view text) { lines_.emplace_back(text); });
  }
  void TearDown() override {
    log::set_sink({});
    log::set_level(log::Level::info);
    log::clear_warnings();
  }
  std::vector<std::string> lines_;
};

TEST_F(Log, PrintsMessagesFromItsLevelUp) {
  log::debug("not shown");
  log::info("{} nodes", 4);
  log::set_level(log::Level::warn);
  log::info("not shown");
  log::set_level(log::Level::debug);
  log::debug("shown");
  EXPECT_EQ(lines_, (std::vector<std::string>{"4 nodes", "shown"}));
}

TEST_F(Log, CollectsEachWarningOnceEvenWhenSilent) {
  log::set_level(log::Level::silent);
  log::warn("left the range at {} K", 900);
  log::warn("left the range at {} K", 900);
  log::warn("another");
  EXPECT_TRUE(lines_.empty());
  EXPECT_EQ(log::warnings(), (std::vector<std::string>{"left the range at 900 K", "another"}));
}

}  // namespace
}  // namespace solidus
