#include "input/point_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace solidus {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class PointTableTest : public ::testing::Test {
 protected:
  PointTable table(const std::string& text, const std::string& column = {},
                   std::string_view unit = "W/m2/K") {
    std::ofstream(path_) << text;
    return PointTable(path_, column, unit, {"case.toml", 7, 3});
  }
  ~PointTableTest() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("points_" + std::to_string(getpid()) + ".csv");
};

TEST_F(PointTableTest, OneCoordinateIsInterpolatedLinearlyWhateverTheOrderOfLines) {
  const PointTable h = table("# measured\nz[mm],h[kW/m2/K]\n100,3\n0,1\n");
  EXPECT_THAT(h.coordinates(), ElementsAre("z"));
  EXPECT_DOUBLE_EQ(h.value(std::array{0.025}), 1500);
  EXPECT_DOUBLE_EQ(h.value(std::array{-1.0}), 1000);  // the nearest point
  EXPECT_FALSE(h.outside(std::array{0.1}));
  EXPECT_TRUE(h.outside(std::array{0.1001}));
}

TEST_F(PointTableTest, SemicolonsTabsDecimalCommasAndLineEndsOfWindowsAreRead) {
  const double wanted = table("z[mm],h[kW/m2/K]\n0.5,1.25\n100,3\n").value(std::array{0.0303});
  for (const std::string text :
       {"\xEF\xBB\xBFz[mm];h[kW/m2/K]\r\n0,5;1,25\r\n100;3,0\r\n",
        "z[mm]\th[kW/m2/K]\r\n0,5\t1,25\r\n100\t3\r\n", "z[mm],h[kW/m2/K]\r\n0.5,1.25\r\n100,3\r\n"})
    EXPECT_DOUBLE_EQ(table(text).value(std::array{0.0303}), wanted) << text;
  EXPECT_THAT([&] { table("z[mm];h[kW/m2/K]\n0;1,2,3\n"); },
              ThrowsMessage<InputError>(HasSubstr("'1,2,3' is no number")));
}

// The heading of history.csv.
TEST_F(PointTableTest, AColumnNamedTimeIsTheTime) {
  const PointTable h = table("time[min],T_wall[degC]\n0,20\n1,80\n", "T_wall", "K");
  EXPECT_THAT(h.coordinates(), ElementsAre("t"));
  EXPECT_DOUBLE_EQ(h.value(std::array{30.0}), 273.15 + 50);
  EXPECT_THAT([&] { table("time[s],t[s],h[W/m2/K]\n0,0,1\n"); },
              ThrowsMessage<InputError>(HasSubstr("two columns 't'")));
}

TEST_F(PointTableTest, AGridOfPlaceAndTimeIsLinearAlongEach) {
  std::string text = "x[m],y[m],t[s],v[1]\n";
  for (const double x : {0.0, 1.0, 3.0})
    for (const double y : {0.0, 2.0})
      for (const double t : {0.0, 10.0})
        text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(t) + "," +
                std::to_string(1 + x + 2 * y + 3 * t + x * y * t) + "\n";
  const PointTable v = table(text, "", "1");
  EXPECT_TRUE(v.grid());
  EXPECT_NEAR(v.value(std::array{2.0, 1.5, 4.0}), 1 + 2 + 3 + 12 + 12, 1e-12);
}

TEST_F(PointTableTest, ScatteredPointsKeepTheirValuesAndBounds) {
  std::string text = "x[m],y[m],v[1]\n";
  double low = 1e300, high = -1e300;
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 60; ++i) {
    const double x = std::fmod(0.618034 * i, 1.0), y = std::fmod(0.754878 * i, 1.0), v = x * x + y;
    points.push_back({x, y, v});
    text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(v) + "\n";
    low = std::min(low, v), high = std::max(high, v);
  }
  const PointTable v = table(text, "", "1");
  EXPECT_FALSE(v.grid());
  double sum = 0;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      const double x = 0.1 * i, y = 0.1 * j, found = v.value(std::array{x, y});
      EXPECT_GE(found, low);
      EXPECT_LE(found, high);
      sum += std::abs(found - (x * x + y));
    }
  EXPECT_LT(sum / 121, 0.08);
  for (const auto& [x, y, value] : points)
    EXPECT_NEAR(v.value(std::array{std::stod(std::to_string(x)), std::stod(std::to_string(y))}), value, 2e-6);
}

TEST_F(PointTableTest, ScatteredPointsOfSeveralTimesAreLinearInTime) {
  const PointTable v =
      table("x[m],y[m],t[s],v[1]\n0,0,0,1\n1,0,0,1\n0,1,0,1\n0,0,10,3\n1,0,10,3\n0.3,1,10,3\n0.7,1,10,3\n",
            "", "1");
  EXPECT_FALSE(v.grid());
  EXPECT_NEAR(v.value(std::array{0.4, 0.3, 5.0}), 2, 1e-12);
  EXPECT_NEAR(v.value(std::array{0.4, 0.3, 99.0}), 3, 1e-12);
}

TEST_F(PointTableTest, SaysWhatIsWrongAndInWhichLine) {
  const auto message = [](const std::string& text) { return ThrowsMessage<InputError>(HasSubstr(text)); };
  EXPECT_THAT([&] { table("z,h[W/m2/K]\n0,1\n"); }, message("the column 'z' has no unit"));
  EXPECT_THAT([&] { table("z[mm],h[K]\n0,1\n"); }, message("the column 'h'"));
  EXPECT_THAT([&] { table("h[W/m2/K]\n1\n"); }, message("no coordinate"));
  EXPECT_THAT([&] { table("z[mm],h[W/m2/K]\n0,one\n"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr(":2"), HasSubstr("'one' is no number"))));
  EXPECT_THAT([&] { table("z[mm],h[W/m2/K]\n0,1,2\n"); }, message("3 cells for 2 columns"));
  EXPECT_THAT([&] { table("z[mm],h[W/m2/K]\n0,1\n0,2\n"); }, message("two rows have the point"));
  EXPECT_THAT([&] { table("z[mm],a[W/m2/K],b[W/m2/K]\n0,1,2\n"); }, message("2 columns of values"));
  EXPECT_THAT([&] { table("z[mm],a[W/m2/K],b[W/m2/K]\n0,1,2\n", "c"); }, message("no column 'c'"));
  EXPECT_THAT([&] { table("z[mm],h[W/m2/K]\n"); }, message("no rows"));
  std::filesystem::remove(path_);
  EXPECT_THAT(
      [&] {
        PointTable(path_, "", "1", {"case.toml", 7, 3});
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("case.toml:7"), HasSubstr("cannot be read"))));
}

}  // namespace
}  // namespace solidus
