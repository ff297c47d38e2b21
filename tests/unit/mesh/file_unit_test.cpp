// Units of length that STEP and IGES files name. The boxes are of OpenCASCADE 7.6: 4 x 2 x 1 inch, and 0.1 m.
#include "mesh/files/file_unit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string k_units = std::string(SOLIDUS_SOURCE_DIR) + "/tests/unit/mesh/units/";

std::string write_unit_file(const std::string& name, const std::string& text) {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("units_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return (folder / name).string();
}

/// A STEP file of a context with one unit of length.
std::string step_with(const std::string& unit) {
  return write_unit_file("unit.step",
                         "ISO-10303-21;\nHEADER;\nFILE_NAME('LENGTH_UNIT; in a string');\nENDSEC;\nDATA;\n"
                         "/* #7 = SI_UNIT(.KILO.,.METRE.); */\n#1 = ( GEOMETRIC_REPRESENTATION_CONTEXT(3)\n"
                         "GLOBAL_UNIT_ASSIGNED_CONTEXT((#2,#3)) REPRESENTATION_CONTEXT('','') );\n" +
                             unit +
                             "#3 = ( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) );\nENDSEC;\n");
}

void expect_unit(const std::string& file, const std::string& name, double metres) {
  const auto unit = unit_of_file(file);
  ASSERT_TRUE(unit) << file;
  EXPECT_EQ(unit->name, name);
  EXPECT_NEAR(unit->metres, metres, 1e-12 * metres);
}

std::string complaint_of_unit(const std::string& file, const std::string& told) {
  try {
    metres_of_unit(file, told, "m", {"--unit"});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FileUnit, StepAndIgesNameTheirs) {
  expect_unit(k_units + "inch.step", "inch", 0.0254);
  expect_unit(k_units + "metre.step", "m", 1);
  expect_unit(k_units + "inch.igs", "inch", 0.0254);
  expect_unit(step_with("#2 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n"), "mm", 1e-3);
  expect_unit(step_with("#2 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.CENTI.,.METRE.) );\n"), "cm", 0.01);
  expect_unit(step_with("#2=(CONVERSION_BASED_UNIT('FOOT',#4)LENGTH_UNIT()NAMED_UNIT(#5));\n"
                        "#4=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.3048),#6);\n"
                        "#6=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"),
              "foot", 0.3048);
  EXPECT_FALSE(unit_of_file(step_with("")));
  EXPECT_FALSE(unit_of_file(write_unit_file("mesh.inp", "*NODE\n")));
}

TEST(FileUnit, OnesOfIgesAreFlagsOrNames) {
  const auto iges = [](const std::string& global) {
    std::string line = global;
    line.resize(72, ' ');
    return write_unit_file("unit.igs", std::string(72, ' ') + "S0000001\n" + line + "G      1\n");
  };
  const std::string head = "1H,,1H;,3Ha,b,3Hc;d,1H ,1H ,32,38,6,308,15,,1.,";
  expect_unit(iges(head + "2,2HMM,1,0.1;"), "mm", 1e-3);
  expect_unit(iges(head + "6,1HM,1,0.1;"), "m", 1);
  expect_unit(iges(head + "3,2HCM,1,0.1;"), "cm", 0.01);
}

TEST(FileUnit, OfAFileThatNamesItsOwnItIsNotAppliedAgain) {
  // The kernel hands lengths over in mm.
  for (const char* file : {"inch.step", "metre.step", "inch.igs"}) {
    EXPECT_DOUBLE_EQ(metres_of_unit(k_units + file, "", "m", {}), 1e-3) << file;
    EXPECT_THAT(complaint_of_unit(k_units + file, "foot"), AllOf(HasSubstr("contradicts"), HasSubstr(file)));
  }
  EXPECT_DOUBLE_EQ(metres_of_unit(k_units + "inch.step", "inch", "m", {}), 1e-3);
  EXPECT_DOUBLE_EQ(metres_of_unit(k_units + "metre.step", "m", "mm", {}), 1e-3);
  EXPECT_THAT(complaint_of_unit(k_units + "metre.step", "mm"), HasSubstr("its lengths are in m"));
}

TEST(FileUnit, OtherFilesHaveTheOneThatIsTold) {
  const std::string file = write_unit_file("mesh.inp", "*NODE\n");
  EXPECT_DOUBLE_EQ(metres_of_unit(file, "", "m", {}), 1);
  EXPECT_DOUBLE_EQ(metres_of_unit(file, "", "mm", {}), 1e-3);
  EXPECT_DOUBLE_EQ(metres_of_unit(file, "inch", "mm", {}), 0.0254);
  EXPECT_DOUBLE_EQ(metres_of_unit(step_with(""), "", "m", {}), 1e-3);
  EXPECT_DOUBLE_EQ(metres_of_unit(step_with(""), "cm", "m", {}), 0.01);
  EXPECT_THAT(complaint_of_unit(file, "foo"), HasSubstr("'foo' is no unit of length"));
}

TEST(FileUnit, ABoxOfFourInchesIsSoLong) {
  MeshSource source{k_units + "inch.step", metres_of_unit(k_units + "inch.step", "", "m", {}), 0.03};
  const RawMesh mesh = read_mesh(source);
  double longest = 0;
  for (const Point& x : mesh.x) longest = std::max(longest, x[0]);
  EXPECT_NEAR(longest, 0.1016, 1e-9);
}

}  // namespace
