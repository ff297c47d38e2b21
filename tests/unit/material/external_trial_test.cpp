#include "material/outside/external_trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>

namespace {

using solidus::material::fault_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Note = std::function<void(const std::string& part)>;

constexpr double k_time_limit = 60;  // [s]

TEST(Trial, WorkThatEndsHasNoFaultAndChangesNothingHere) {
  int n = 0;
  EXPECT_THAT(fault_of([&n](const Note&) { n = 1; }, k_time_limit), IsEmpty());
  EXPECT_EQ(n, 0);
}

TEST(Trial, AnExceptionIsForTheProgram) {
  EXPECT_THAT(fault_of([](const Note&) { throw std::runtime_error("no"); }, k_time_limit), IsEmpty());
}

TEST(Trial, ACrashIsNamedWithThePartInWhichItCame) {
  EXPECT_THAT(fault_of(
                  [](const Note& note) {
                    note("opening");
                    note("reading 'temperature'");
                    std::raise(SIGSEGV);
                  },
                  k_time_limit),
              AllOf(HasSubstr("crashed (signal 11"), HasSubstr("while reading 'temperature'")));
}

TEST(Trial, AnEndOfTheProcessIsAFault) {
  EXPECT_THAT(fault_of(
                  [](const Note& note) {
                    note("loading");
                    std::exit(0);
                  },
                  k_time_limit),
              HasSubstr("it ended the process while loading"));
}

TEST(Trial, WorkWithoutEndIsEnded) {
  EXPECT_THAT(fault_of(
                  [](const Note& note) {
                    note("waiting");
                    while (true) ::pause();
                  },
                  0.2),
              HasSubstr("it came to no end within 0.2 s while waiting"));
}

}  // namespace
