#include "results/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace solidus::results {
namespace {

coupling::StepRecord step(int number, double time) {
  coupling::StepRecord record;
  record.number = number;
  record.time = time;
  record.dt = 1;
  record.reason = "as asked";
  record.heat = {2, 2, 3e-10, 0};
  record.mechanics = {1, 1, 4e-4, 0};
  record.solid_fraction = 0.432;
  record.energy.stored_heat = 0.001;
  record.energy.heat_exchanged = 10;
  record.contacts = {{61, 70, 0, 0}};
  return record;
}

struct ProgressText : ::testing::Test {
  double now = 100;
  std::ostringstream out;
  ProgressOptions options() {
    ProgressOptions o;
    o.end = 90;
    o.clock = [this] { return now; };
    return o;
  }
};

TEST_F(ProgressText, IsOneLineAStepWithAllThatMatters) {
  Progress progress(out, options());
  progress.begin();
  out.str({});
  now += 2;  // two seconds for 9 of 90: 18 are left
  progress.step(step(9, 9));
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.find('\033'), std::string::npos) << "no control sequences outside a terminal";
  for (const char* piece : {" 9 ", "3.0e-10", "4.0e-04", "43.2 %", "61/70", "1.0e-04", "18 s", "as asked"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << " in: " << text;
}

TEST_F(ProgressText, OfARunUntilAllIsSolidTheTimeLeftFollowsTheMelt) {
  ProgressOptions o = options();
  o.until_solid = true;
  o.terminal = true;
  Progress progress(out, o);
  progress.begin();
  now += 2;
  coupling::StepRecord record = step(9, 9);  // a tenth of the longest time, half of the melt
  record.solid_fraction = 0.5;
  progress.step(record);
  EXPECT_NE(out.str().find("50 %  2.0 s left"), std::string::npos) << out.str();
  out.str({});
  record.solid_fraction = 1;
  record.time = 20;
  progress.step(record);
  EXPECT_NE(out.str().find("0 ms  as asked"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("100 %"), std::string::npos) << out.str();
}

TEST_F(ProgressText, ARunUntilAllIsSolidThatGoesOnCountsFromWhereItBegan) {
  ProgressOptions o = options();
  o.until_solid = true;
  o.start = 30;
  Progress progress(out, o);
  progress.begin();
  coupling::StepRecord record = step(31, 31);
  record.solid_fraction = 0.6;
  progress.step(record);
  out.str({});
  now += 4;
  record.solid_fraction = 0.7;  // a quarter of what was left
  record.time = 32;
  progress.step(record);
  EXPECT_NE(out.str().find("12 s  as asked"), std::string::npos) << out.str();
}

TEST_F(ProgressText, HeaderAndLinesLineUp) {
  Progress progress(out, options());
  progress.begin();
  progress.step(step(9, 9));
  const std::string text = out.str();
  const std::size_t line = text.find('\n') + 1;
  EXPECT_EQ(text.find("why this step"), text.find("as asked") - line);
}

TEST_F(ProgressText, OmitsColumnsOfPhysicsThatIsNotThere) {
  ProgressOptions o = options();
  o.mechanics = o.contact = o.melting = false;
  Progress progress(out, o);
  progress.begin();
  progress.step(step(9, 9));
  EXPECT_EQ(out.str().find("61/70"), std::string::npos);
  EXPECT_EQ(out.str().find("mech"), std::string::npos);
  EXPECT_EQ(out.str().find("43.2"), std::string::npos);
}

TEST_F(ProgressText, SaysHowOftenAndWhyAStepWasCut) {
  Progress progress(out, options());
  auto record = step(9, 9);
  record.rejected = 2;
  record.rejection = "heat: no convergence in 25 iterations";
  progress.step(record);
  EXPECT_NE(out.str().find("(2 rejected: heat: no convergence in 25 iterations)"), std::string::npos);
  record.shortened = 1;
  record.rejection = "temperature error";
  progress.step(record);
  EXPECT_NE(out.str().find("(2 rejected, 1 shortened: temperature error)"), std::string::npos);
  record.rejected = 0;
  progress.step(record);
  EXPECT_NE(out.str().find("(1 shortened: temperature error)"), std::string::npos);
}

TEST_F(ProgressText, DrawsABarOnATerminalAndTakesItAway) {
  ProgressOptions o = options();
  o.terminal = true;
  o.width = 10;
  Progress progress(out, o);
  progress.begin();
  progress.step(step(45, 45));
  EXPECT_NE(out.str().find("[=====     ]  50 %"), std::string::npos) << out.str();
  progress.end("finished");
  EXPECT_NE(out.str().find("\r\033[Kfinished after 0 ms\n"), std::string::npos) << out.str();
}

TEST(DurationText, IsShort) {
  EXPECT_EQ(duration_text(0.0125), "12 ms");
  EXPECT_EQ(duration_text(2.34), "2.3 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
}

}  // namespace
}  // namespace solidus::results
