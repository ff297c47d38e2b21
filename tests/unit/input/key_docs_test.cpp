#include "input/key_docs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace solidus {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Change {
  double latent_heat = 0;
};
struct Sample {
  double step = 0;
  std::string kind;
  Function film;
  std::map<std::string, Change> changes;
};

Section<Sample> declaration() {
  Section<Change> change("change", "A phase change.");
  change.quantity("latent_heat", &Change::latent_heat, "J/kg").positive().doc("Released on cooling.");
  Section<Sample> s("", "A sample file.");
  s.quantity("step", &Sample::step, "s").initially("1 s").positive().doc("The step.");
  s.key("kind", &Sample::kind).choices({"a", "b"}).doc("Which.");
  s.function("film", &Sample::film, "W/m2/K")
      .of({Argument::time})
      .when("kind", {"a"})
      .doc("Film | coefficient.");
  s.named_sections("change", &Sample::changes, change);
  return s;
}

TEST(KeyDocs, ExplainTellsTypeUnitDefaultRangeAndMeaning) {
  EXPECT_THAT(explain(declaration().info(), "step"), AllOf(HasSubstr("The step."), HasSubstr("quantity [s]"),
                                                           HasSubstr("\"1 s\""), HasSubstr("> 0 s")));
  EXPECT_THAT(explain(declaration().info(), "film"),
              AllOf(HasSubstr("table of time"), HasSubstr("only with kind = a")));
  EXPECT_THAT(explain(declaration().info(), "change.melting.latent_heat"), HasSubstr("Released on cooling"));
  EXPECT_THAT(explain(declaration().info(), "change"), HasSubstr("[change.NAME]"));
  EXPECT_THAT(explain(declaration().info(), ""), AllOf(HasSubstr("A sample file"), HasSubstr("latent_heat")));
}

TEST(KeyDocs, ExplainOfAnUnknownPathNamesTheNearest) {
  try {
    explain(declaration().info(), "setp");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'step'"));
  }
}

TEST(KeyDocs, AKeyWithoutItsSectionIsFoundByItsLastWord) {
  try {
    explain(declaration().info(), "latent_heat");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'change.NAME.latent_heat'?"));
  }
}

TEST(KeyDocs, TheSchemaListsEveryKeyAndNoOther) {
  const std::string schema = json_schema(declaration().info(), "sample");
  EXPECT_THAT(schema,
              AllOf(HasSubstr("\"step\""), HasSubstr("\"latent_heat\""),
                    HasSubstr("\"enum\": [\"a\", \"b\"]"), HasSubstr("\"additionalProperties\": false")));
}

TEST(KeyDocs, TheManualHasARowForEveryKey) {
  const std::string manual = reference_manual(declaration().info(), "Sample");
  EXPECT_THAT(manual, AllOf(HasSubstr("| `step` | quantity [s] | `\"1 s\"` |"), HasSubstr("`[change.NAME]`"),
                            HasSubstr("Film \\| coefficient")));
}

struct Ends {
  std::optional<Change> first, last;
};

TEST(KeyDocs, TheManualShowsOnceWhatSeveralKeysHaveInCommon) {
  Section<Change> change("change", "A phase change.");
  change.quantity("latent_heat", &Change::latent_heat, "J/kg").doc("Released on cooling.");
  Section<Ends> ends("ends", "Both ends.");
  ends.section("first", &Ends::first, change).doc("The first one.");
  ends.section("last", &Ends::last, change).doc("The last one.");
  struct Whole {
    Ends ends;
  };
  Section<Whole> whole("", "A file.");
  whole.section("ends", &Whole::ends, ends);
  const std::string manual = reference_manual(whole.info(), "Sample");
  EXPECT_THAT(manual, AllOf(HasSubstr("| `first` | table, keys below | none | The first one. |"),
                            HasSubstr("| `last` | table, keys below | none | The last one. |"),
                            HasSubstr("## `[ends.KEY]`"), Not(HasSubstr("[ends.first]"))));
  const std::size_t at = manual.find("Released on cooling.");
  EXPECT_NE(at, std::string::npos);
  EXPECT_EQ(manual.find("Released on cooling.", at + 1), std::string::npos);
}

}  // namespace
}  // namespace solidus
