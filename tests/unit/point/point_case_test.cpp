/// Point files: what is read, what is refused, and that examples and reference page are those of the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "input/key_docs.hpp"
#include "samples.hpp"

namespace solidus::point {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string but(const std::string& what, const std::string& with) {
  return changed(k_point_file, what, with);
}

TEST(PointFile, GivesTheDurationFromTargetAndRate) {
  const PointCase c = read_point(k_point_file);
  ASSERT_EQ(c.curves.size(), 1u);
  EXPECT_EQ(c.curves[0].name, "history");
  const History h = run(c.curves[0].material, c.curves[0].program);
  EXPECT_EQ(h.records.size(), 11u);
  EXPECT_NEAR(h.records.back().time, 10, 1e-12);
  EXPECT_NEAR(h.records.back().strain[0], 0.01, 1e-15);
  EXPECT_NEAR(h.records.back().stress[1], 0, 1);  // [Pa]
}

TEST(PointFile, RepeatsSegmentsAsCycles) {
  const PointCase c = read_point(k_point_file + R"([[segment]]
strain = -0.01
strain_rate = "1e-3 1/s"
[[segment]]
kind = "repeat"
last = 2
times = 3
)");
  ASSERT_EQ(c.curves[0].program.segments.size(), 8u);
  EXPECT_EQ(*c.curves[0].program.segments[6].components[0].target, 0.01);
}

TEST(PointFile, CurvesChangeRateTemperatureAndMaterial) {
  const PointCase c = read_point(k_point_file + R"([[curve]]
name = "hot"
temperature = "500 degC"
[[curve]]
name = "fast"
strain_rate = "10 percent/s"
material = "nodular_iron"
)");
  ASSERT_EQ(c.curves.size(), 2u);
  EXPECT_DOUBLE_EQ(c.curves[0].program.options.temperature, 773.15);
  EXPECT_DOUBLE_EQ(c.curves[0].program.options.strain_reference, 773.15);
  EXPECT_DOUBLE_EQ(*c.curves[1].program.segments[0].components[0].rate, 0.1);
  EXPECT_EQ(c.curves[1].material.name, "nodular_iron");
}

struct Wrong {
  const char* name;
  std::string text;
  std::vector<std::string> phrases;
};
void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.name;
}

const std::string k_strain = "strain = 0.01\n", k_rate = "strain_rate = \"1e-3 1/s\"\n";

std::vector<Wrong> wrong_files() {
  return {
      {"typo", but("steps", "step"), {"point.toml:7:1", "unknown key 'step' in [[segment]]", "'steps'"}},
      {"no_segment", "material = \"low_carbon_steel\"\n", {"there is no loading", "[[segment]]"}},
      {"no_duration", but(k_rate, ""), {"point.toml:4", "no duration", "both a target and a rate"}},
      {"duration_twice", but(k_rate, k_rate + "duration = \"1 s\"\n"), {"point.toml:4", "given twice"}},
      {"strain_and_stress", but(k_rate, k_rate + "stress = \"1 MPa\"\n"), {"more than one thing"}},
      {"nothing_loaded", but(k_strain + k_rate, "duration = \"1 s\"\n"), {"does not say what happens"}},
      {"already_there", but("0.01", "0"), {"point.toml:4", "takes no time"}},
      {"no_unit", but("\"1e-3 1/s\"", "1e-3"), {"point.toml:6:15", "without a unit"}},
      {"wrong_kind", but(k_strain, "kind = \"uniaxal\"\n" + k_strain), {"did you mean 'uniaxial'"}},
      {"component_of_another_kind",
       but(k_rate, k_rate + "strains = { xx = 0.1 }\n"),
       {"'strains' does not belong", "kind = components"}},
      {"two_answers_for_a_component",
       but(k_strain + k_rate,
           "kind = \"components\"\nduration = \"1 s\"\nstrains = { yy = 0.1 }\n"
           "hold_strain = [\"yy\"]\n"),
       {"more than one thing about yy"}},
      {"repeats_too_many",
       k_point_file + "[[segment]]\nkind = \"repeat\"\nlast = 3\ntimes = 1\n",
       {"the last 3 segments", "there are 1"}},
      {"unknown_material", but("low_carbon_steel", "low_carbon_stel"), {"low_carbon_steel"}},
      {"material_without_mechanics", but("low_carbon_steel", "green_sand"), {"no elastic properties"}},
      {"curve_twice",
       k_point_file + "[[curve]]\nname = \"a\"\n[[curve]]\nname = \"a\"\n",
       {"point.toml:10", "two curves named 'a'"}},
      {"curve_no_file_name", k_point_file + "[[curve]]\nname = \"../a\"\n", {"cannot be the name of a file"}},
      {"curve_without_effect",
       k_point_file + "[[curve]]\nname = \"a\"\nstress = \"1 MPa\"\n",
       {"stress changes nothing"}},
      {"no_measured_file",
       k_point_file + "[[curve]]\nname = \"a\"\nmeasured = \"none.csv\"\n",
       {"point.toml:8", "none.csv", "cannot be read"}},
      {"unknown_column",
       k_point_file + "[[picture]]\nfile = \"p\"\nx = \"time\"\ny = [\"stres_xx\"]\n",
       {"no column 'stres_xx'", "did you mean 'stress_xx'"}},
      {"picture_twice",
       k_point_file + "[[picture]]\nfile = \"overview\"\nx = \"time\"\ny = [\"von_mises\"]\n",
       {"point.toml:8", "two pictures named 'overview'"}},
      {"columns_of_two_units",
       k_point_file + "[[picture]]\nfile = \"p\"\nx = \"time\"\ny = [\"stress_xx\", \"temperature\"]\n",
       {"different units"}},
      {"temperature_of_an_adiabatic_point",
       "thermal = \"adiabatic\"\n" + but(k_rate, k_rate + "temperature = \"300 degC\"\n"),
       {"point.toml:5", "adiabatic"}},
  };
}

class WrongPointFile : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongPointFile, IsRefusedWithItsPlaceAndAdvice) {
  const std::string error = error_of(GetParam().text);
  for (const std::string& phrase : GetParam().phrases) EXPECT_THAT(error, HasSubstr(phrase));
}

INSTANTIATE_TEST_SUITE_P(PointFile, WrongPointFile, ::testing::ValuesIn(wrong_files()),
                         [](const auto& wrong) { return wrong.param.name; });

TEST(PointFile, TheExamplesAreReadAsTheyStand) {
  int examples = 0;
  const std::vector<fs::path> library = {SOLIDUS_SOURCE_DIR "/materials"};
  for (const auto& entry : fs::directory_iterator(SOLIDUS_SOURCE_DIR "/cases/point")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".toml" || name.starts_with("alsi7mg")) continue;  // materials
    EXPECT_NO_THROW(make_point_case(load_document(entry.path()), library)) << name;
    ++examples;
  }
  EXPECT_GE(examples, 5);
}

std::string whole_file(const std::string& path) {
  std::ifstream file(SOLIDUS_SOURCE_DIR "/" + path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// When this fails: solidus explain --point --manual > docs/reference/point_file.md
TEST(PointFile, TheReferenceManualIsThatOfTheDeclaration) {
  EXPECT_TRUE(whole_file("docs/reference/point_file.md") ==
              reference_manual(point_section().info(), "Reference: the point file"));
}

TEST(PointFile, TheExampleOfTheGuideIsOne) {
  const std::string text = whole_file("docs/guide/point.md");
  const std::size_t begin = text.find("```toml\n") + 8;
  const PointCase c = read_point(text.substr(begin, text.find("```", begin) - begin));
  for (const Curve& curve : c.curves) EXPECT_TRUE(run(curve.material, curve.program).finished);
}

}  // namespace
}  // namespace solidus::point
