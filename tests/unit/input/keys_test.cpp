#include "input/keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace solidus {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

enum class Rule { closed, open };
struct Inner {
  int count = 0;
};
struct Condition {
  std::string name, kind;
  std::optional<double> temperature;
  Function film;
};
struct Options {
  std::string title;
  Rule rule = Rule::closed;
  double tolerance = 0, step = 0;
  std::optional<double> cap;
  std::vector<double> times;
  std::array<double, 3> direction{};
  bool adaptive = false;
  Inner inner;
  std::optional<Inner> extra;
  std::vector<Condition> conditions;
  std::vector<Inner> risers;
  std::map<std::string, Inner> changes;
  SourceLocation where;
};

Section<Options> declaration() {
  Section<Inner> inner("inner", "Something inside.");
  inner.key("count", &Inner::count).initially(2).range(1, 10).doc("How many.");
  Section<Condition> condition("condition", "A condition.");
  condition.key("name", &Condition::name).doc("Name.");
  condition.key("kind", &Condition::kind).choices({"temperature", "film"}).doc("Kind.");
  condition.quantity("temperature", &Condition::temperature, "K").positive().when("kind", {"temperature"});
  condition.function("film", &Condition::film, "W/m2/K")
      .of({Argument::time, Argument::temperature})
      .at_least(0)
      .when("kind", {"film"});

  Section<Options> s("", "The whole.");
  s.key("title", &Options::title).doc("What the case is about.");
  s.choice("rule", &Options::rule, {{"closed", Rule::closed, "at the nodes"}, {"open", Rule::open, "Gauss"}})
      .initially("closed");
  s.key("tolerance", &Options::tolerance).initially(1e-3).positive();
  s.quantity("step", &Options::step, "s").initially("1 s").positive();
  s.quantity("cap", &Options::cap, "Pa");
  s.quantity("times", &Options::times, "s").initially(Value::list());
  s.key("direction", &Options::direction).initially(Value::list({0, -1, 0}));
  s.key("adaptive", &Options::adaptive).initially(true);
  s.section("inner", &Options::inner, inner);
  s.section("extra", &Options::extra, inner);
  s.sections("condition", &Options::conditions, condition);
  s.sections("riser", &Options::risers, inner).or_one();
  s.named_sections("change", &Options::changes, inner);
  s.place(&Options::where);
  return s;
}

Options read(const std::string& text) {
  return declaration().read(parse_document(text, "case.toml"));
}

std::string error(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

TEST(Keys, DefaultsFillWhatIsAbsent) {
  const Options o = read("title = \"t\"");
  EXPECT_EQ(o.rule, Rule::closed);
  EXPECT_EQ(o.step, 1.0);
  EXPECT_EQ(o.direction[1], -1.0);
  EXPECT_TRUE(o.adaptive);
  EXPECT_EQ(o.inner.count, 2);
  EXPECT_FALSE(o.extra.has_value());
  EXPECT_FALSE(o.cap.has_value());
}

TEST(Keys, QuantitiesArriveInSi) {
  const Options o = read(
      "title = \"t\"\nstep = \"2 min\"\ncap = \"3 N/mm2\"\ntimes = [\"1 s\", \"1 h\"]\n"
      "[[condition]]\nname = \"a\"\nkind = \"temperature\"\ntemperature = \"20 degC\"\n"
      "[[condition]]\nname = \"b\"\nkind = \"film\"\nfilm = { of = \"temperature\", argument_unit = "
      "\"degC\", unit = "
      "\"N/mm/s/K\", points = [[0, 1], [100, 2]], source = \"a book\", valid = [\"0 degC\", \"50 degC\"] }\n"
      "[change.melting]\ncount = 3");
  EXPECT_DOUBLE_EQ(o.step, 120.0);
  EXPECT_DOUBLE_EQ(*o.cap, 3e6);
  EXPECT_DOUBLE_EQ(o.times[1], 3600.0);
  EXPECT_DOUBLE_EQ(*o.conditions[0].temperature, 293.15);
  const Function& film = o.conditions[1].film;
  EXPECT_EQ(film.of, Argument::temperature);
  EXPECT_DOUBLE_EQ(film.table.value(323.15), 1500.0);
  EXPECT_EQ(film.source, "a book");
  EXPECT_DOUBLE_EQ((*film.valid)[1], 323.15);
  EXPECT_EQ(o.changes.at("melting").count, 3);
}

TEST(Keys, PointsMayCarryTheirOwnUnits) {
  const Options o = read(
      "title = \"t\"\n[[condition]]\nname = \"b\"\nkind = \"film\"\n"
      "film = { of = \"time\", points = [[\"0 s\", \"1 W/m2/K\"], [\"1 min\", \"3 W/m2/K\"]] }");
  EXPECT_DOUBLE_EQ(o.conditions[0].film.table.value(30.0), 2.0);
}

TEST(Keys, AnUnknownKeyIsReportedWithPlaceAllowedKeysAndNearestName) {
  EXPECT_THAT(
      error("title = \"t\"\n[inner]\n  cuont = 3\n"),
      AllOf(HasSubstr("case.toml:3:3: unknown key 'cuont' in [inner]"), HasSubstr("did you mean 'count'?")));
  EXPECT_THAT(error("title = \"t\"\n[[condition]]\nnmae = \"x\"\n"), HasSubstr("in [[condition]]"));
  EXPECT_THAT(error("title = \"t\"\n[change.a]\nx = 1\n"), HasSubstr("in [change.a]"));
}

TEST(Keys, WrongTypeUnitAndRangeSayWhatWasFoundAndWhatIsAllowed) {
  EXPECT_THAT(error("title = 3"), AllOf(HasSubstr("'title' is the number 3"), HasSubstr("text")));
  EXPECT_THAT(error("title = \"t\"\nstep = 1"), AllOf(HasSubstr("without a unit"), HasSubstr("\"")));
  EXPECT_THAT(error("title = \"t\"\nstep = \"1 kg\""), HasSubstr("case.toml:2:8: 'step'"));
  EXPECT_THAT(error("title = \"t\"\nstep = \"0 s\""),
              AllOf(HasSubstr("out of range"), HasSubstr("above 0 s")));
  EXPECT_THAT(error("title = \"t\"\nrule = \"clsed\""), HasSubstr("did you mean 'closed'"));
  EXPECT_THAT(error("title = \"t\"\nadaptive = 1"), HasSubstr("true or false"));
  EXPECT_THAT(error("title = \"t\"\n[inner]\ncount = 1.5"), HasSubstr("whole number"));
  EXPECT_THAT(error("title = \"t\"\n[inner]\ncount = 11"), HasSubstr("at least 1 and at most 10"));
  EXPECT_THAT(error("title = \"t\"\ndirection = [1, 2]"), HasSubstr("a list of 3 values"));
  EXPECT_THAT(error("title = \"t\"\n[condition]\nname = \"x\""), HasSubstr("[[condition]]"));
  EXPECT_THAT(error("title = \"t\"\ninner = 3"), HasSubstr("[inner] is the number 3"));
}

TEST(Keys, AMissingKeyIsNamedWithItsSection) {
  EXPECT_THAT(error("step = \"1 s\""),
              AllOf(HasSubstr("'title' is missing"), HasSubstr("What the case is about")));
  EXPECT_THAT(error("title = \"t\"\n[[condition]]\nname = \"x\"\nkind = \"film\"\n"),
              AllOf(HasSubstr("case.toml:2"), HasSubstr("'film' is missing in [[condition]]"),
                    HasSubstr("It is needed with kind = \"film\"")));
}

TEST(Keys, SectionsOfWhichOneIsUsualMayBeWrittenAsOne) {
  const auto risers = [](const std::string& text) {
    return declaration().read(parse_document("title = \"x\"\n" + text, "case.toml")).risers;
  };
  EXPECT_TRUE(risers("").empty());
  EXPECT_EQ(risers("[riser]\ncount = 3\n").at(0).count, 3);
  EXPECT_EQ(risers("[[riser]]\ncount = 3\n[[riser]]\n").size(), 2U);
  EXPECT_THROW(risers("riser = 3\n"), InputError);
  EXPECT_THROW(declaration().read(parse_document("title = \"x\"\n[condition]\nname = \"a\"\n", "case.toml")),
               InputError);
}

TEST(Keys, AKeyOfAnotherKindIsRefused) {
  EXPECT_THAT(error("title = \"t\"\n[[condition]]\nname = \"x\"\nkind = \"film\"\nfilm = \"1 "
                    "W/m2/K\"\ntemperature = \"1 K\""),
              AllOf(HasSubstr("'temperature' does not belong"), HasSubstr("kind = temperature")));
}

TEST(Keys, BrokenTablesAreReportedAtThePoint) {
  const std::string head = "title = \"t\"\n[[condition]]\nname = \"x\"\nkind = \"film\"\n";
  EXPECT_THAT(error(head + "film = { points = [[0, 1]] }"), HasSubstr("does not name its argument"));
  EXPECT_THAT(error(head + "film = { of = \"gap\", points = [[0, 1]] }"),
              HasSubstr("cannot be a function of 'gap'"));
  EXPECT_THAT(error(head + "film = { of = \"time\", points = [[0, 1]] }"), HasSubstr("without a unit"));
  EXPECT_THAT(
      error(head +
            "film = { of = \"time\", argument_unit = \"s\", unit = \"W/m2/K\", points = [[1, 1], [0, 1]] }"),
      AllOf(HasSubstr("point 2 of 'film'"), HasSubstr("time must increase")));
  EXPECT_THAT(
      error(head + "film = { of = \"time\", argument_unit = \"s\", unit = \"W/m2/K\", points = [[0, -1]] }"),
      HasSubstr("out of range"));
  EXPECT_THAT(error(head + "film = { value = \"1 W/m2/K\", points = [[0, 1]] }"), HasSubstr("both"));
  EXPECT_THAT(error(head + "film = { vlaue = \"1 W/m2/K\" }"), HasSubstr("did you mean 'value'"));
  EXPECT_THAT(error(head + "film = { of = \"time\", points = [] }"), HasSubstr("list of pairs"));
}

TEST(Keys, TheCompletedTableReadsToTheSameOptions) {
  const Section<Options> s = declaration();
  const Value complete = s.info().completed(parse_document("title = \"t\"\n[extra]", "case.toml"), "");
  const Options o = read(to_toml(complete));
  EXPECT_EQ(o.step, 1.0);
  EXPECT_EQ(o.extra->count, 2);
}

TEST(Keys, NearestNameForgivesTwoSlipsAndSwappedNeighbours) {
  const std::vector<std::string> names = {"initial_temperature", "material", "group"};
  EXPECT_EQ(nearest_name("initial_temprature", names), "initial_temperature");
  EXPECT_EQ(nearest_name("matreial", names), "material");
  EXPECT_EQ(nearest_name("penalty", names), "");
}

}  // namespace
}  // namespace solidus
