/// Variants of a case in one file: what they are laid over, what they share, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "setup/case_file.hpp"
#include "setup/case_layers.hpp"
#include "system/errors.hpp"

namespace solidus::cases {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A folder with a case and its variants, of its own for each test.
class CaseVariants : public ::testing::Test {
 protected:
  CaseVariants()
      : folder_(fs::temp_directory_path() /
                (std::string("solidus_case_variants_") +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("case.toml", R"(title = "A block cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "5 mm"]
divisions = [4, 2]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "block"
material = "steel"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "cooling"
group = "x_max"
kind = "film"
coefficient = "100 W/m2/K"
ambient = "20 degC"
)");
  }
  ~CaseVariants() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string name(const std::string& variant) const { return folder_.string() + ":" + variant; }
  static std::string error(const std::string& path) {
    try {
      setup::load_case(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no InputError";
  }
  fs::path folder_;
};

constexpr const char* k_variants = R"([part.slow]
time.end = "40 s"
[part.slower]
include = ":slow"
time.step = "2 s"
[[part.iron.body]]
name = "block"
material = "iron.toml"

[variant.slow_iron]
include = [":slower", ":iron"]
title = "Slow iron"
[variant.coarse]
include = ":slow_iron"
mesh.block.divisions = [2, 1]
[variant]
plain = {}
)";

TEST_F(CaseVariants, AVariantLiesWithItsPartsOverTheCaseBesideIt) {
  write("variants.toml", k_variants);
  const setup::Case c = setup::load_case(name("slow_iron"));
  EXPECT_EQ(c.spec.title, "Slow iron");
  EXPECT_DOUBLE_EQ(*c.spec.time.end, 40);
  EXPECT_DOUBLE_EQ(*c.spec.time.step, 2);
  EXPECT_EQ(c.spec.bodies[0].material, (folder_ / "iron.toml").string()) << "seen from the file of variants";
  EXPECT_EQ(c.file, folder_ / "case.toml");
  EXPECT_EQ(c.variant, "slow_iron");
  EXPECT_TRUE(c.spec.include.empty());
  EXPECT_THAT(c.toml(), HasSubstr("case.toml:slow_iron\n"));
}

TEST_F(CaseVariants, AFileServesAsWellAsItsFolderAndAVariantMayIncludeAnother) {
  write("variants.toml", k_variants);
  const setup::Case c = setup::load_case((folder_ / "case.toml").string() + ":coarse", {"time.end=50 s"});
  EXPECT_EQ(c.spec.title, "Slow iron");
  EXPECT_DOUBLE_EQ(*c.spec.time.end, 50) << "--set lies over the variant";
  EXPECT_DOUBLE_EQ(*c.spec.time.step, 2);
  EXPECT_THAT(c.toml(), HasSubstr("divisions = [2, 1]"));
}

TEST_F(CaseVariants, AVariantThatChangesNothingIsTheCase) {
  write("variants.toml", k_variants);
  EXPECT_EQ(to_toml(setup::load_case(name("plain")).document), to_toml(setup::load_case(folder_).document));
}

TEST_F(CaseVariants, AreListedInTheirOrderWithTheirTitles) {
  EXPECT_TRUE(setup::variants_beside(folder_ / "case.toml").empty());
  write("variants.toml", k_variants);
  std::vector<std::string> found;
  for (const setup::VariantInfo& variant : setup::variants_beside(folder_ / "case.toml"))
    found.push_back(variant.name + "=" + variant.title);
  EXPECT_THAT(found, ElementsAre("slow_iron=Slow iron", "coarse=", "plain="));
}

TEST_F(CaseVariants, AnUnknownVariantIsRefusedWithTheNearestName) {
  EXPECT_THAT(error(name("slow")),
              AllOf(HasSubstr("there is no variant 'slow'"), HasSubstr("variants.toml")));
  write("variants.toml", k_variants);
  EXPECT_THAT(error(name("slow_irn")),
              AllOf(HasSubstr("there is no variant 'slow_irn'"), HasSubstr("did you mean 'slow_iron'?")));
  EXPECT_THAT(error((folder_ / "slow_iron.toml").string()),
              AllOf(HasSubstr("there is no such file"), HasSubstr(name("slow_iron"))))
      << "the name of a file that would be a variant";
  EXPECT_THAT(error(folder_.string() + "_else:slow_iron"), HasSubstr("there is no such file or folder"));
}

TEST_F(CaseVariants, MistakesNameTheFileOfVariantsAndTheLine) {
  write("variants.toml", "[variant.a]\ntime.step = \"2 kg\"\n");
  EXPECT_THAT(error(name("a")), HasSubstr("variants.toml:2:13"));
  write("variants.toml", "[part.quick]\n[variant.a]\ninclude = \":quik\"\n");
  EXPECT_THAT(error(name("a")), AllOf(HasSubstr("variants.toml:3:11: there is no part 'quik'"),
                                      HasSubstr("did you mean 'quick'?")));
  write("variants.toml", "[variants.a]\n");
  EXPECT_THAT(error(name("a")),
              AllOf(HasSubstr("has no key 'variants'"), HasSubstr("did you mean 'variant'?")));
  write("variants.toml", "variant.a = 3\n");
  EXPECT_THAT(error(name("a")), AllOf(HasSubstr("'variant.a' is"), HasSubstr("a section")));
  write("variants.toml",
        "[part.x]\ninclude = \":y\"\n[part.y]\ninclude = \":x\"\n[variant.a]\ninclude = \":x\"\n");
  EXPECT_THAT(error(name("a")), HasSubstr("included by itself"));
  write("variants.toml", "[variant.a]\ncolour = 3\n");
  EXPECT_THAT(error(name("a")), HasSubstr("variants.toml:2:1: unknown key 'colour'"));
}

TEST_F(CaseVariants, AColonInTheNameOfAFileIsNoVariant) {
  write("variants.toml", k_variants);
  std::ifstream in(folder_ / "case.toml");
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  write("at 12:30.toml", text);
  EXPECT_EQ(setup::load_case(folder_ / "at 12:30.toml").variant, "");
}

}  // namespace
}  // namespace solidus::cases
