#include "input/place_spec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input/key_docs.hpp"
#include "input/keys.hpp"

namespace solidus {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Film {
  Function h, start;
};

Section<Film> keys() {
  Section<Film> s("film", "A film.");
  s.function("h", &Film::h, "W/m2/K")
      .of({Argument::time})
      .anywhere()
      .at_least(0)
      .initially("1 W/m2/K")
      .doc("h.");
  s.function("start", &Film::start, "K")
      .anywhere(Key::Place::position)
      .positive()
      .initially("300 K")
      .doc("T.");
  return s;
}

Film read(const std::string& text) {
  return keys().read(parse_document(text, "case.toml"));
}

auto message(const std::string& text) {
  return ThrowsMessage<InputError>(AllOf(HasSubstr("case.toml:1"), HasSubstr(text)));
}

TEST(PlaceSpec, AFormulaHasConstantsWithUnitsAndAUnitOfItsValue) {
  const Film film = read(
      R"~(h = { formula = "h0*(z - v*t < 0.1)", constants = { v = "2.5 mm/s", h0 = 3 }, unit = "kW/m2/K" })~");
  ASSERT_NE(film.h.place, nullptr);
  EXPECT_EQ(film.h.place->kind, PlaceSpec::Kind::formula);
  EXPECT_EQ(film.h.place->unit(3), 3000);
  EXPECT_EQ(film.h.place->formula->value(std::array{0.0, 0.0, 0.11, 0.0, 3.0}), 0);
  EXPECT_EQ(film.h.place->formula->value(std::array{0.0, 0.0, 0.11, 0.0, 5.0}), 3);
}

TEST(PlaceSpec, APlaceMovesWithAVelocity) {
  const Film film = read(R"(h = { file = "a.csv", moving = ["0 mm/s", "-2 mm/s"], outside = "error" })");
  EXPECT_EQ(film.h.place->kind, PlaceSpec::Kind::points);
  EXPECT_DOUBLE_EQ(film.h.place->velocity[1], -0.002);
  EXPECT_TRUE(film.h.place->outside_is_error);
}

TEST(PlaceSpec, AFieldNamesItsFileItsFieldAndItsBody) {
  const Film film =
      read(R"(start = { file = "a.vtu", field = "T", unit = "degC", length_unit = "mm", body = 1 })");
  EXPECT_EQ(film.start.place->kind, PlaceSpec::Kind::field);
  EXPECT_EQ(film.start.place->unit(0), 273.15);
  EXPECT_EQ(film.start.place->length, 0.001);
  EXPECT_EQ(film.start.place->body, 1);
}

TEST(PlaceSpec, SaysWhatIsWrong) {
  EXPECT_THAT([] { read(R"(h = { formula = "3*q" })"); }, message("'q' is not known at character 3"));
  EXPECT_THAT([] { read(R"(h = { formula = "3*(x" })"); }, message("the formula of 'h'"));
  EXPECT_THAT([] { read(R"(h = { formula = "x", constants = { x = 1 } })"); },
              message("a constant cannot be called 'x'"));
  EXPECT_THAT([] { read(R"(h = { formula = "x", constants = { sin = 1 } })"); },
              message("a constant cannot be called 'sin'"));
  EXPECT_THAT([] { read(R"(h = { formula = "a", constants = { a = "1 parrot" } })"); }, message("parrot"));
  EXPECT_THAT([] { read(R"(h = { formula = "x", points = [[0, 1]] })"); }, message("unknown key 'points'"));
  EXPECT_THAT([] { read(R"(h = { formula = "x", file = "a.csv" })"); }, message("both a formula and a file"));
  EXPECT_THAT([] { read(R"(h = { formula = "x", unit = "K" })"); }, message("'unit' of 'h'"));
  EXPECT_THAT([] { read(R"(h = { formula = "x", moving = ["1 mm/s", 2] })"); }, message("has no unit"));
  EXPECT_THAT([] { read(R"(h = { formula = "x", moving = "1 mm/s" })"); }, message("a velocity"));
  EXPECT_THAT([] { read(R"(h = { file = "a.txt" })"); }, message("no file of points or of a field"));
  EXPECT_THAT([] { read(R"(h = { file = "a.vtu" })"); }, message("which field"));
  EXPECT_THAT([] { read(R"(h = { file = "a.csv", outside = "zero" })"); }, message("unknown 'outside'"));
  EXPECT_THAT([] { read(R"(start = { formula = "300 + t" })"); }, message("has no time"));
  EXPECT_THAT([] { read(R"(start = { file = "a.csv", moving = ["1 mm/s", "0 mm/s"] })"); },
              message("cannot move"));
}

TEST(PlaceSpec, IsExplained) {
  EXPECT_THAT(explain(keys().info(), "h"),
              AllOf(HasSubstr("constant or table of time, or function of position and time"),
                    HasSubstr("formula = \"...\", unit = \"W/m2/K\"")));
  EXPECT_THAT(explain(keys().info(), "start"), HasSubstr("constant or function of position"));
  EXPECT_THAT(json_schema(keys().info(), "Film"), HasSubstr("\"formula\": {\"type\": \"string\"}"));
}

}  // namespace
}  // namespace solidus
