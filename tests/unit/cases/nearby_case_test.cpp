/// Cases next to a case: what is changed, and that the changes are ones the case file takes.
#include "cases/nearby_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_keys.hpp"
#include "cases/overrides.hpp"

namespace solidus::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* k_head = R"(title = "A bar"
[analysis]
kind = "plane_strain"
)";
constexpr const char* k_block = R"([mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [5, 1]
)";
constexpr const char* k_body = R"([[body]]
name = "bar"
material = "a"
initial_temperature = "600 K"
)";
constexpr const char* k_fixed = "[time]\nend = \"10 s\"\nstep = \"1 s\"\n";

Value document(const std::string& mesh, const std::string& time) {
  return parse_document(k_head + mesh + time + k_body, "case.toml");
}

/// The case with the overrides laid over it.
CaseSpec beside(Value document, const NearbyCase& how) {
  for (const std::string& change : how.overrides) apply_override(document, change);
  CaseSpec spec;
  case_keys().assign(spec, document);
  return spec;
}

TEST(LongerSteps, AreTwiceAsLongWhereTheyAreFixed) {
  const Value given = document(k_block, k_fixed);
  const NearbyCase how = longer_steps(case_keys().read(given), 1e-6);
  EXPECT_EQ(beside(given, how).time.step, 2.0);
}

TEST(LongerSteps, MayCommitFourTimesTheErrorWhereTheyAreChosen) {
  const Value given =
      document(k_block, std::string(k_fixed) + "adaptive = true\ntemperature_error = \"0.5 K\"\n");
  const CaseSpec made = beside(given, longer_steps(case_keys().read(given), 3e-6));
  EXPECT_EQ(made.time.temperature_error, 2.0);
  EXPECT_DOUBLE_EQ(*made.time.displacement_error, 12e-6);
  // Both follow the error of the displacement.
  EXPECT_FALSE(made.time.solid_fraction_change);
  EXPECT_FALSE(made.time.skin_change);
  EXPECT_EQ(made.time.step, 1.0);
  EXPECT_EQ(made.time.max_step, 20.0);
  EXPECT_EQ(made.output.every, 10.0);  // no step ends early for an output
}

TEST(LongerSteps, LetTwiceTheSharesChangeThatAreGiven) {
  const Value given = document(
      k_block, std::string(k_fixed) + "adaptive = true\nskin_change = 0.04\nsolid_fraction_change = 0.1\n");
  const CaseSpec made = beside(given, longer_steps(case_keys().read(given), 3e-6));
  EXPECT_EQ(made.time.skin_change, 0.08);
  EXPECT_EQ(made.time.solid_fraction_change, 0.2);
}

TEST(LongerSteps, AreThoseOfTheStages) {
  const Value given =
      document(k_block,
               "[time]\nstep = \"1 s\"\n[[stage]]\nname = \"a\"\nduration = \"9 s\"\nstep = \"2 s\"\n"
               "[[stage]]\nname = \"b\"\nduration = \"9 s\"\nsteps = 9\n");
  const CaseSpec made = beside(given, longer_steps(case_keys().read(given), 0));
  EXPECT_EQ(made.stages[0].step, 4.0);
  EXPECT_EQ(made.stages[1].steps, 4);
}

TEST(LongerSteps, HaveNoMeaningWithoutTime) {
  EXPECT_THAT(longer_steps(case_keys().read(document(k_block, "[time]\nsteady = true\n")), 0).why_not,
              HasSubstr("steady"));
}

TEST(CoarserMesh, HasHalfTheDivisions) {
  const Value given = document(k_block, k_fixed);
  EXPECT_THAT(beside(given, coarser_mesh(case_keys().read(given), false)).mesh.block->divisions,
              ElementsAre(3, 1));
}

TEST(CoarserMesh, HasLargerElementsWhereTheCaseSaysHowLarge) {
  const Value given = document(
      "[mesh]\nfile = \"part.step\"\n[[mesh.size]]\nbody = \"part\"\nsize = \"4 mm\"\n"
      "smallest = \"2 mm\"\nacross = 2.0\n[[mesh.layers]]\nname = \"sand\"\nsurface = \"s\"\n"
      "body = \"part\"\nfirst = \"1 mm\"\n",
      k_fixed);
  const CaseSpec made = beside(given, coarser_mesh(case_keys().read(given), true));
  EXPECT_DOUBLE_EQ(made.mesh.sizes[0].size, 8e-3);
  EXPECT_DOUBLE_EQ(*made.mesh.sizes[0].smallest, 4e-3);
  EXPECT_DOUBLE_EQ(made.mesh.sizes[0].across, 1);
  EXPECT_DOUBLE_EQ(*made.mesh.layers[0].first, 2e-3);
}

TEST(CoarserMesh, OfAGeometryHasAFactorOnTheSizesThatItGivesItself) {
  const Value plane = document("[mesh]\nfile = \"part.geo\"\nsize_factor = 0.5\n", k_fixed);
  EXPECT_DOUBLE_EQ(beside(plane, coarser_mesh(case_keys().read(plane), true)).mesh.size_factor, 1);
}

TEST(CoarserMesh, CannotBeMadeOfAMesh) {
  const Value given = document("[mesh]\nfile = \"part.inp\"\n", k_fixed);
  EXPECT_THAT(coarser_mesh(case_keys().read(given), false).why_not, HasSubstr("mesh.refine = 1"));
}

}  // namespace
}  // namespace solidus::cases
