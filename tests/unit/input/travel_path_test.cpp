/// Paths with times, from tables and from G-code.
#include "input/travel_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace solidus {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class TravelPathTest : public ::testing::Test {
 protected:
  TravelPath path(const std::string& text, int dimension = 3, double start = 0) {
    std::ofstream(path_) << text;
    return read_travel_path(path_, dimension, start, {"case.toml", 7, 3});
  }
  ~TravelPathTest() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("path_" + std::to_string(getpid()) + ".csv");
};

TEST_F(TravelPathTest, ATableIsReadInItsUnitsAndSwitches) {
  const TravelPath p =
      path("t[min],x[mm],y[mm],z[mm],on\n0,0,0,5,0.5\n1,60,0,5,0\n2,60,30,5,1\n3,0,30,5,0\n", 3, 10);
  EXPECT_DOUBLE_EQ(p.begin(), 10);
  EXPECT_DOUBLE_EQ(p.end(), 190);
  EXPECT_THAT(p.at(40), ElementsAre(0.03, 0, 0.005));
  EXPECT_EQ(p.on(40), 0.5);
  EXPECT_EQ(p.on(71), 0);
  EXPECT_EQ(p.on(131), 1);
  EXPECT_EQ(p.on(190), 0);
  EXPECT_EQ(p.on(9.9), 0);
  EXPECT_THAT(p.heading(80), ElementsAre(0, 1, 0));
  EXPECT_THAT(p.switches(), ElementsAre(10, 70, 130, 190));
  EXPECT_DOUBLE_EQ(p.fastest(0, 69), 0.001);
  EXPECT_EQ(p.fastest(75, 125), 0);  // it is off
}

TEST_F(TravelPathTest, APlaceThatIsHeldKeepsItsHeading) {
  const TravelPath p = path("t[s],x[m],y[m]\n0,0,0\n1,0,0\n2,1,0\n3,1,0\n", 2);
  for (const double t : {0.5, 1.5, 2.5}) EXPECT_THAT(p.heading(t), ElementsAre(1, 0, 0));
}

TEST_F(TravelPathTest, GCodeMovesWaitsAndSwitches) {
  const TravelPath p = parse_gcode(
      "%\nN10 G21 G90 (millimetres)\nG0 X10 Y0 Z1 F6000\nM3\nG1 X70 F60 ; a minute\nG4 S2\nM5\nG91\n"
      "G0 Y10 F600\nM4\nG1 X-60 F120\nM30\nG1 X99\n",
      "weld.nc", 5);
  // 60 mm at 60 mm/min, 2 s at rest, 10 mm at 600 mm/min with nothing on, 60 mm at 120 mm/min.
  EXPECT_DOUBLE_EQ(p.begin(), 5);
  EXPECT_DOUBLE_EQ(p.end(), 5 + 60 + 2 + 1 + 30);
  EXPECT_THAT(p.at(35), ElementsAre(0.04, 0, 0.001));
  EXPECT_EQ(p.on(66), 1);
  EXPECT_EQ(p.on(67.5), 0);
  EXPECT_EQ(p.on(70), 1);
  const Position end = p.at(1000);
  EXPECT_NEAR(end[0], 0.01, 1e-12);
  EXPECT_NEAR(end[1], 0.01, 1e-12);
}

TEST_F(TravelPathTest, WhatCannotBeReadIsToldByItsLine) {
  const auto gcode = [](const char* text) { return [=] { parse_gcode(text, "a.nc", 0); }; };
  EXPECT_THAT(gcode("G0 X0\nG1 X1 F0"),
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.nc:2"), HasSubstr("the feed is 0"))));
  EXPECT_THAT(gcode("G0 X0\nG2 X1 F9"), ThrowsMessage<InputError>(HasSubstr("G2 is not known")));
  EXPECT_THAT(gcode("G0 X0\nG1 X1"), ThrowsMessage<InputError>(HasSubstr("before any feed")));
  EXPECT_THAT(gcode("G0 X0\nG1 X1 E2 F9"), ThrowsMessage<InputError>(HasSubstr("E2 is not known")));
  EXPECT_THAT(gcode("G0 X0 (and on"), ThrowsMessage<InputError>(HasSubstr("comment")));
  EXPECT_THAT(gcode("G0 X"), ThrowsMessage<InputError>(HasSubstr("no word")));
  EXPECT_THAT(gcode("M3"), ThrowsMessage<InputError>(HasSubstr("moves nothing")));
  EXPECT_THAT([&] { path("t[s],x[m],y[m]\n0,0,0\n0,1,0\n", 2); },
              ThrowsMessage<InputError>(AllOf(HasSubstr(":3"), HasSubstr("0 s follows 0 s"))));
  EXPECT_THAT([&] { path("t[s],x[m],y[m],on\n0,0,0,2\n1,1,0,1\n", 2); },
              ThrowsMessage<InputError>(HasSubstr("'on' is 2")));
  EXPECT_THAT([&] { path("t[s],x[m],y[m]\n0,0,0\n1,1,0\n", 3); },
              ThrowsMessage<InputError>(HasSubstr("no column 'z'")));
  EXPECT_THAT([&] { path("t[s],x[kg],y[m]\n0,0,0\n1,1,0\n", 2); },
              ThrowsMessage<InputError>(HasSubstr("'x'")));
}

}  // namespace
}  // namespace solidus
