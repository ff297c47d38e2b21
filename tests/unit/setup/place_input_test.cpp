#include "setup/place_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../cases/small_case.hpp"

namespace solidus::setup {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The coefficient of a film of the small case.
Function film(const std::string& coefficient) {
  return test::bar_case(R"([[thermal_condition]]
name = "film"
group = "x_max"
kind = "film"
ambient = "300 K"
coefficient = )" + coefficient)
      .thermal_conditions.front()
      .coefficient;
}

double value(const std::string& coefficient, const Position& x, double time,
             AnalysisKind kind = AnalysisKind::plane_strain, const cases::StageRun* stage = nullptr) {
  double result = 0;
  place_function(film(coefficient), stage == nullptr ? cases::TimeOrigin::run : cases::TimeOrigin::stage,
                 stage, kind)
      .values(std::span(&x, 1), time, std::span(&result, 1));
  return result;
}

TEST(PlaceInput, CoordinatesAreThoseOfTheAnalysis) {
  EXPECT_EQ(value(R"({ formula = "x + 2*y" })", {3, 5, 0}, 0), 13);
  EXPECT_EQ(value(R"({ formula = "r + 2*z" })", {3, 5, 0}, 0, AnalysisKind::axisymmetric), 13);
  EXPECT_EQ(value(R"({ formula = "x + 2*y" })", {3, 5, 0}, 0, AnalysisKind::axisymmetric), 13);
  EXPECT_EQ(value(R"({ formula = "x + 2*y + 3*z" })", {3, 5, 7}, 0, AnalysisKind::solid), 34);
  EXPECT_THAT(
      [] { value(R"({ formula = "x + z" })", {}, 0); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("case.toml"), HasSubstr("uses z"), HasSubstr("x, y, t"))));
  EXPECT_THAT([] { value(R"({ formula = "r" })", {}, 0, AnalysisKind::solid); },
              ThrowsMessage<InputError>(HasSubstr("uses r")));
}

TEST(PlaceInput, APlaceThatMovesIsSeenFromWhereItStarted) {
  const std::string zone =
      R"({ formula = "x > 1 ? 5 : 0", unit = "kW/m2/K", moving = ["0.5 m/s", "0 m/s"] })";
  EXPECT_EQ(value(zone, {1.5, 0, 0}, 0.5), 5000);
  EXPECT_EQ(value(zone, {1.5, 0, 0}, 1.5), 0);
  EXPECT_THAT(
      [] { value(R"({ formula = "1", moving = ["0.5 m/s", "0 m/s"] })", {}, 0, AnalysisKind::solid); },
      ThrowsMessage<InputError>(HasSubstr("'moving' of 'coefficient' has 2 components")));
}

TEST(PlaceInput, TimeIsThatOfTheStageAndHeldAtItsEnd) {
  cases::StageSpec stage;
  stage.duration = 4;
  const cases::StageRun run{&stage, 1, 0, 10, 14};
  EXPECT_EQ(value(R"({ formula = "t" })", {}, 11, AnalysisKind::plane_strain, &run), 1);
  EXPECT_EQ(value(R"({ formula = "t" })", {}, 14.5, AnalysisKind::plane_strain, &run), 4);
}

TEST(PlaceInput, AValueThatIsNotAllowedIsNamedWithPlaceAndTime) {
  EXPECT_THAT(
      [] {
        value(R"({ formula = "1/x" })", {0, 2, 0}, 3);
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("case.toml:22"),
                                      HasSubstr("'coefficient' is not finite at (0, 2) m, t = 3 s"),
                                      HasSubstr("division by zero"))));
  EXPECT_THAT(
      [] { value(R"~({ formula = "10*(1 - t)" })~", {}, 2); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("'coefficient' is -10 W/m2/K"), HasSubstr("at least 0"))));
}

TEST(PlaceInput, PointsOfAFileOutsideOfWhichIsTheNearestOrAnError) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "place_input_points.csv";
  std::ofstream(path) << "x[mm],t[s],h[W/m2/K]\n0,0,10\n100,0,20\n0,10,30\n100,10,40\n";
  EXPECT_DOUBLE_EQ(value("{ file = \"" + path.string() + "\" }", {0.05, 9, 0}, 5), 25);
  EXPECT_DOUBLE_EQ(value("{ file = \"" + path.string() + "\" }", {0.2, 9, 0}, 20), 40);
  EXPECT_THAT(
      [&] {
        value("{ file = \"" + path.string() + "\", outside = \"error\" }", {0.2, 9, 0}, 5);
      },
      ThrowsMessage<InputError>(HasSubstr("outside of the points")));
  std::ofstream(path) << "z[mm],h[W/m2/K]\n0,10\n100,20\n";
  EXPECT_THAT([&] { value("{ file = \"" + path.string() + "\" }", {}, 0); },
              ThrowsMessage<InputError>(HasSubstr("has a column z")));
  EXPECT_DOUBLE_EQ(value("{ file = \"" + path.string() + "\" }", {0, 0.05, 0}, 0, AnalysisKind::axisymmetric),
                   15);
  std::filesystem::remove(path);
}

TEST(PlaceInput, AnInitialTemperatureHasAPlaceButNoTime) {
  cases::CaseSpec spec = test::bar_case();
  EXPECT_EQ(spec.bodies[0].initial_temperature.table.value(0), 600);
  EXPECT_EQ(spec.bodies[0].initial_temperature.place, nullptr);
}

}  // namespace
}  // namespace solidus::setup
