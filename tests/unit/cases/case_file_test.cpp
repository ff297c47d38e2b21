#include "setup/case_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cases/case_keys.hpp"
#include "input/key_docs.hpp"
#include "material/cards/library.hpp"

namespace solidus::cases {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string k_block = R"(title = "A block cools"
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
)";

/// A folder of its own for each test.
class CaseFile : public ::testing::Test {
 protected:
  CaseFile() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / fmt_name(test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~CaseFile() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string fmt_name(const std::string& test) { return "solidus_case_file_" + test; }
  static std::string error(const fs::path& path, const std::vector<std::string>& set = {}) {
    try {
      setup::load_case(path, set);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no InputError";
  }
  fs::path folder_;
};

TEST_F(CaseFile, AFolderMeansItsCaseToml) {
  write("cooling/case.toml", k_block);
  const setup::Case c = setup::load_case(folder_ / "cooling");
  EXPECT_EQ(c.spec.title, "A block cools");
  EXPECT_EQ(c.spec.bodies[0].mesh_group(), "block");
  EXPECT_DOUBLE_EQ(c.spec.thermal_conditions[0].ambient.table.value(0), 293.15);
}

TEST_F(CaseFile, AVariantIsLaidOverTheCaseItIncludes) {
  write("cooling/case.toml", k_block);
  const fs::path variant =
      write("cooling/hot.toml",
            "include = \"case.toml\"\n[time]\nstep = \"2 s\"\n[[body]]\nname = \"block\"\n"
            "initial_temperature = \"300 degC\"\n[[thermal_condition]]\nname = \"other\"\n"
            "group = \"x_min\"\nkind = \"flux\"\nflux = \"1 W/m2\"\n");
  const setup::Case c = setup::load_case(variant);
  EXPECT_DOUBLE_EQ(*c.spec.time.step, 2);
  EXPECT_DOUBLE_EQ(*c.spec.time.end, 10);
  ASSERT_EQ(c.spec.bodies.size(), 1u);
  EXPECT_DOUBLE_EQ(c.spec.bodies[0].initial_temperature.table.value(0), 573.15);
  EXPECT_EQ(c.spec.thermal_conditions.size(), 2u);
}

TEST_F(CaseFile, AVariantThatChangesAKindDropsTheKeysOfTheOldOne) {
  write("case.toml", k_block);
  const fs::path variant = write("held.toml",
                                 "include = \"case.toml\"\n[[thermal_condition]]\nname = \"cooling\"\n"
                                 "kind = \"temperature\"\ntemperature = \"20 degC\"\n");
  const setup::Case c = setup::load_case(variant);
  EXPECT_EQ(c.spec.thermal_conditions[0].kind, ThermalConditionSpec::Kind::temperature);
  EXPECT_EQ(c.document.find("thermal_condition")->items()[0].find("ambient"), nullptr);
  EXPECT_THAT(error(write("both.toml",
                          "include = \"case.toml\"\n[[thermal_condition]]\nname = \"cooling\"\n"
                          "kind = \"temperature\"\ntemperature = \"20 degC\"\nambient = \"1 K\"\n")),
              HasSubstr("both.toml:6:11: 'ambient' does not belong"));
}

TEST_F(CaseFile, ErrorsPointToTheFileThatHoldsTheMistake) {
  write("case.toml", k_block);
  EXPECT_THAT(error(write("bad.toml", "include = \"case.toml\"\n[time]\nstep = \"2 kg\"\n")),
              HasSubstr("bad.toml:3:8"));
  write("case.toml", k_block + "colour = 3\n");
  EXPECT_THAT(error(write("good.toml", "include = \"case.toml\"\n")),
              HasSubstr("case.toml:24:1: unknown key 'colour'"));
}

TEST_F(CaseFile, IncludesInACircleAndMissingOnesAreRefused) {
  write("a.toml", "include = \"b.toml\"\n");
  EXPECT_THAT(error(write("b.toml", "include = \"a.toml\"\n")), HasSubstr("included by itself"));
  EXPECT_THAT(error(write("c.toml", "include = \"nowhere.toml\"\n")),
              AllOf(HasSubstr("c.toml:1:11"), HasSubstr("does not exist")));
}

TEST_F(CaseFile, OfSeveralIncludesTheLaterIsLaidOverTheEarlier) {
  write("case.toml", k_block);
  write("parts/slow.toml", "[time]\nend = \"40 s\"\nstep = \"2 s\"\n");
  write("parts/iron.toml", "[[body]]\nname = \"block\"\nmaterial = \"iron.toml\"\n[time]\nstep = \"4 s\"\n");
  const setup::Case c = setup::load_case(
      write("slow_iron.toml", "include = [\"case.toml\", \"parts/slow.toml\", \"parts/iron.toml\"]\n"));
  EXPECT_DOUBLE_EQ(*c.spec.time.end, 40);
  EXPECT_DOUBLE_EQ(*c.spec.time.step, 4);
  EXPECT_EQ(c.spec.bodies[0].material, (folder_ / "parts/iron.toml").string());
  EXPECT_TRUE(c.spec.include.empty());
}

TEST_F(CaseFile, TwoIncludesMayStartFromTheSameFile) {
  write("case.toml", k_block);
  write("a.toml", "include = \"case.toml\"\n[time]\nstep = \"2 s\"\n");
  write("b.toml", "include = \"case.toml\"\n[time]\nend = \"20 s\"\n");
  const setup::Case c = setup::load_case(write("c.toml", "include = [\"a.toml\", \"b.toml\"]\n"));
  EXPECT_DOUBLE_EQ(*c.spec.time.step, 1);  // b.toml as a whole, the step of case.toml in it, over a.toml
  EXPECT_DOUBLE_EQ(*c.spec.time.end, 20);
}

TEST_F(CaseFile, EveryPathOfAListOfIncludesIsChecked) {
  write("case.toml", k_block);
  EXPECT_THAT(error(write("missing.toml", "include = [\"case.toml\", \"nowhere.toml\"]\n")),
              AllOf(HasSubstr("missing.toml:1:25"), HasSubstr("does not exist")));
  EXPECT_THAT(error(write("circle.toml", "include = [\"case.toml\", \"circle.toml\"]\n")),
              HasSubstr("included by itself"));
  EXPECT_THAT(error(write("number.toml", "include = [\"case.toml\", 3]\n")),
              AllOf(HasSubstr("'include' is"), HasSubstr("a list of such paths")));
}

TEST_F(CaseFile, OverridesReachSectionsAndNamedListSections) {
  const fs::path file = write("case.toml", k_block);
  const setup::Case c =
      setup::load_case(file, {"time.step=0.5 s", "body.block.material=iron",
                              "thermal_condition.1.ambient=30 degC", "mesh.block.divisions=[8, 4]"});
  EXPECT_DOUBLE_EQ(*c.spec.time.step, 0.5);
  EXPECT_EQ(c.spec.bodies[0].material, "iron");
  EXPECT_DOUBLE_EQ(c.spec.thermal_conditions[0].ambient.table.value(0), 303.15);
  EXPECT_EQ(c.spec.mesh.block->divisions[0], 8);
}

TEST_F(CaseFile, BadOverridesAreReportedAsWritten) {
  const fs::path file = write("case.toml", k_block);
  EXPECT_THAT(error(file, {"time.setp=1 s"}),
              AllOf(HasSubstr("--set time.setp=1 s"), HasSubstr("did you mean 'step'")));
  EXPECT_THAT(error(file, {"time.step"}), HasSubstr("no assignment"));
  EXPECT_THAT(error(file, {"body.blokc.material=a"}), HasSubstr("did you mean 'block'"));
  EXPECT_THAT(error(file, {"time.step.x=1"}), HasSubstr("no 'x' in it"));
  EXPECT_THAT(error(file, {"time.step=2 K"}), HasSubstr("--set time.step=2 K"));
}

TEST_F(CaseFile, TheResolvedCaseReadsBackToTheSameCase) {
  const setup::Case first = setup::load_case(write("case.toml", k_block), {"time.step=0.5 s"});
  const setup::Case second = setup::load_case(write("again/case.toml", first.toml()));
  EXPECT_EQ(to_toml(first.document), to_toml(second.document));
  EXPECT_DOUBLE_EQ(*second.spec.time.step, 0.5);
}

TEST_F(CaseFile, PathsAreSeenFromTheFileTheyAreWrittenIn) {
  const std::string text =
      "title = \"m\"\n[analysis]\nkind = \"solid\"\nphysics = \"heat\"\n[mesh]\nfile = "
      "\"part.msh\"\n[time]\nsteady = "
      "true\n[[body]]\nname = \"part\"\nmaterial = \"own.toml\"\ninitial_temperature = \"20 degC\"\n";
  write("shared/case.toml", text);
  const setup::Case c = setup::load_case(write("study/variant.toml", "include = \"../shared/case.toml\"\n"));
  EXPECT_EQ(*c.spec.mesh.file, (folder_ / "shared/part.msh").string());
  EXPECT_EQ(c.spec.bodies[0].material, (folder_ / "shared/own.toml").string());
}

TEST_F(CaseFile, KeysThatContradictEachOtherAreRefused) {
  const fs::path file = write("case.toml", k_block);
  EXPECT_THAT(error(file, {"mesh.file=a.msh"}), HasSubstr("both a shape and a file"));
  EXPECT_THAT(error(file, {"mesh.element=hex8"}), HasSubstr("not for a two-dimensional analysis"));
  EXPECT_THAT(error(file, {"mesh.block.divisions=[2]"}), HasSubstr("2 lengths and 2 divisions"));
  EXPECT_THAT(error(file, {"time.step=20 s"}), HasSubstr("longer than the whole time"));
  EXPECT_THAT(error(file, {"time.max_step=20 s"}), HasSubstr("adaptive"));
  EXPECT_THAT(error(file, {"analysis.physics=mechanics"}), HasSubstr("no heat in this analysis"));
  EXPECT_THAT(error(file, {"analysis.gravity_direction=[0, 0]"}), HasSubstr("no length"));
}

std::string whole_file(const std::string& path) {
  std::ifstream file(SOLIDUS_SOURCE_DIR "/" + path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(CaseKeys, TheExampleOfTheGuideIsACase) {
  const std::string text = whole_file("docs/guide/case_file.md");
  const std::size_t begin = text.find("```toml\n") + 8;
  const CaseSpec spec =
      case_keys().read(parse_document(text.substr(begin, text.find("```", begin) - begin), "guide"));
  EXPECT_NO_THROW(setup::check_case(spec));
  EXPECT_EQ(spec.bodies[0].material, "steel_mould");
}

// When this fails: solidus explain [--material] --manual > docs/reference/case_file.md (material_file.md)
TEST(CaseKeys, TheReferenceManualsAreThoseOfTheDeclarations) {
  EXPECT_TRUE(whole_file("docs/reference/case_file.md") ==
              reference_manual(case_keys().info(), "Reference: the case file"));
  EXPECT_TRUE(whole_file("docs/reference/material_file.md") ==
              reference_manual(material::material_section().info(), "Reference: the material file"));
}

TEST(CaseKeys, EveryKeyIsExplained) {
  const std::function<void(const SectionInfo&, const std::string&)> walk = [&](const SectionInfo& info,
                                                                               const std::string& path) {
    EXPECT_FALSE(info.doc.empty()) << path;
    for (const Key& key : info.keys) {
      EXPECT_FALSE(key.doc_text.empty()) << path << "." << key.name;
      if (key.section) walk(*key.section, path + "." + key.name);
    }
  };
  walk(case_keys().info(), "case");
}

}  // namespace
}  // namespace solidus::cases
