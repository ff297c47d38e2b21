/// The march through segments: control, cut steps, failures, liquids, energy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "material/melt.hpp"
#include "samples.hpp"

namespace solidus::point {
namespace {

using ::testing::HasSubstr;

/// The histories of a file's curves.
History history_of(const std::string& text) {
  const PointCase c = read_point(text);
  return run(c.curves[0].material, c.curves[0].program);
}

const std::string k_head = "material = \"low_carbon_steel\"\n";

TEST(PointRun, StrainsAndStressesAreWhatWasAskedFor) {
  const History h = history_of(k_head + R"([[segment]]
kind = "components"
duration = "10 s"
strains = { xx = 0.004, xy = 0.002 }
stresses = { zz = "30 MPa" }
hold_strain = ["yy"]
)");
  ASSERT_TRUE(h.finished) << h.reason;
  for (const MaterialPointRecord& r : h.records) {
    const double part = r.time / 10;
    EXPECT_NEAR(r.strain[0], 0.004 * part, 1e-15);
    EXPECT_NEAR(r.strain[1], 0, 1e-15);
    EXPECT_NEAR(r.strain[3], 0.002 * part, 1e-15);
    EXPECT_NEAR(r.stress[2], 30e6 * part, 0.1);
    for (const int free : {4, 5}) EXPECT_NEAR(r.stress[free], 0, 0.1);
  }
  EXPECT_GT(h.records.back().equivalent_plastic, 1e-3);
}

TEST(PointRun, BiaxialAndPlaneStrainLoadWhatTheySay) {
  const History biaxial =
      history_of(k_head + "[[segment]]\nkind = \"biaxial\"\nstrain = 0.01\nstrain_rate = \"1e-3 1/s\"\n");
  EXPECT_NEAR(biaxial.records.back().strain[1], 0.01, 1e-15);
  EXPECT_NEAR(biaxial.records.back().stress[0], biaxial.records.back().stress[1], 1);
  EXPECT_NEAR(biaxial.records.back().stress[2], 0, 1);
  const History plane = history_of(
      k_head + "[[segment]]\nkind = \"plane_strain\"\nstrain = 0.01\nstrain_rate = \"1e-3 1/s\"\n");
  EXPECT_NEAR(plane.records.back().strain[2], 0, 1e-15);
  EXPECT_NEAR(plane.records.back().stress[1], 0, 1);
}

TEST(PointRun, HoldingTheStrainRelaxesAndHoldingTheStressCreeps) {
  const std::string start =
      "material = \"aluminium_alsi7mg\"\ntemperature = \"450 degC\"\n[[segment]]\nstrain = 0.01\n"
      "strain_rate = \"0.1 1/s\"\n[[segment]]\nduration = \"100 s\"\nfirst_step = \"1 ms\"\nhold = ";
  const History relaxed = history_of(start + "\"strain\"\n"), crept = history_of(start + "\"stress\"\n");
  ASSERT_TRUE(relaxed.finished && crept.finished);
  const MaterialPointRecord &a = relaxed.records[50], &b = relaxed.records.back(), &c = crept.records.back();
  EXPECT_LT(b.stress[0], 0.8 * a.stress[0]);
  EXPECT_EQ(b.strain[0], a.strain[0]);
  EXPECT_NEAR(c.stress[0], a.stress[0], 1);
  EXPECT_GT(c.strain[0], 1.01 * a.strain[0]);
  EXPECT_NEAR(relaxed.records[51].time - a.time, 1e-3, 1e-9);
  EXPECT_NEAR(b.time, 100.1, 1e-9);
}

TEST(PointRun, AFreePointExpandsWithoutStress) {
  const History h =
      history_of(k_head +
                 "strain_reference = \"20 degC\"\ntemperature = \"100 degC\"\n[[segment]]\n"
                 "hold = \"stress\"\ntemperature = \"400 degC\"\ntemperature_rate = \"1 K/s\"\n");
  ASSERT_TRUE(h.finished);
  for (const MaterialPointRecord& r : h.records) {
    EXPECT_NEAR(r.strain[0], r.thermal_strain, 1e-12);
    EXPECT_NEAR(r.stress[0], 0, 0.1);
  }
  EXPECT_GT(h.records.front().thermal_strain, 5e-4);
  EXPECT_NEAR(h.records.back().time, 300, 1e-9);
}

// The modified shear modulus is zero in the liquid: nothing resists but the volume.
TEST(PointRun, ALiquidWithoutShearStiffnessIsNoObstacle) {
  const PointCase c = read_point(
      "material = \"aluminium_alsi7mg\"\ntemperature = \"700 degC\"\n[[segment]]\nhold = \"strain\"\n"
      "temperature = \"500 degC\"\nduration = \"100 s\"\n");
  material::Material m = c.curves[0].material;
  m.liquid_model = material::LiquidModel::modified_shear;
  const History h = run(m, c.curves[0].program);
  ASSERT_TRUE(h.finished) << h.reason;
  EXPECT_GT(h.records.back().stress[0], 1e6);
  EXPECT_NEAR(h.records.back().stress[1], 0, 1);
}

TEST(PointRun, AStressThatCannotBeCarriedStopsWithAdvice) {
  PointCase c = read_point(k_head + "[[segment]]\nstress = \"2000 MPa\"\nduration = \"1 s\"\nsteps = 20\n");
  material::Material m = c.curves[0].material;
  m.flow.emplace();
  m.flow->flow_stress = 200e6;
  const History h = run(m, c.curves[0].program);
  EXPECT_FALSE(h.finished);
  EXPECT_THAT(h.reason, HasSubstr("point.toml:2"));
  EXPECT_THAT(h.reason, HasSubstr("segment 1 stopped at 0.1 s"));
  EXPECT_THAT(h.reason, HasSubstr("prescribe the strain instead"));
  EXPECT_NEAR(h.records.back().stress[0], 200e6, 1e6);  // the history ends at the limit
}

TEST(PointRun, AShearStressOnALiquidStopsWithAdvice) {
  PointCase c = read_point(
      "material = \"aluminium_alsi7mg\"\ntemperature = \"700 degC\"\n[[segment]]\nkind = \"shear\"\n"
      "stress = \"1 MPa\"\nduration = \"1 s\"\n");
  material::Material m = c.curves[0].material;
  m.liquid_model = material::LiquidModel::modified_shear;
  const History h = run(m, c.curves[0].program);
  EXPECT_FALSE(h.finished);
  EXPECT_THAT(h.reason, HasSubstr("carries no shear"));
}

// A point has neither height nor section: a kilopascal stands for the head, 10 mm for the section.
TEST(PointRun, AMeltWithoutAViscosityHasThatOfABodyWithoutGravityWhateverTheStep) {
  for (const double seconds : {0.05, 0.1}) {
    const PointCase c = read_point(
        "material = \"aluminium_alsi7mg\"\ntemperature = \"700 degC\"\n[[segment]]\nkind = "
        "\"shear\"\nstrain = 0.01\nsteps = 1\nduration = \"" +
        std::to_string(seconds) + " s\"\n");
    const History h = run(c.curves[0].material, c.curves[0].program);
    ASSERT_TRUE(h.finished) << h.reason;
    const MaterialPointRecord& last = h.records.back();
    const double shear = std::abs(last.strain[3]) + std::abs(last.strain[4]) + std::abs(last.strain[5]);
    const double stress = std::abs(last.stress[3]) + std::abs(last.stress[4]) + std::abs(last.stress[5]);
    EXPECT_GT(shear, 0);
    const material::MeltModulus melt = material::melt_modulus(c.curves[0].material, 0, 0, 0);
    EXPECT_DOUBLE_EQ(melt.modulus, 10e3);
    EXPECT_NEAR(stress, melt.modulus * melt.time * shear / seconds, 1e-6 * stress) << seconds;
  }
}

TEST(PointRun, AnAdiabaticPointKeepsTheFirstLaw) {
  const History h = history_of(
      "material = \"aluminium_alsi7mg\"\nthermal = \"adiabatic\"\ntemperature = \"300 degC\"\n[[segment]]\n"
      "strain = 0.1\nstrain_rate = \"1 1/s\"\n[[segment]]\nstrain = 0.05\nstrain_rate = \"1 1/s\"\n");
  ASSERT_TRUE(h.finished) << h.reason;
  for (const MaterialPointRecord& r : h.records) EXPECT_NEAR(r.heat, 0, 1e-6 * (1e3 + r.work));
  EXPECT_GT(h.records.back().work, 1e6);
}

TEST(PointRun, EveryShownValueIsANumber) {
  const History h = history_of(k_point_file);
  for (const RecordColumn& column : columns())
    for (const MaterialPointRecord& r : h.records)
      EXPECT_TRUE(std::isfinite(column.shown(r))) << column.header();
  EXPECT_EQ(find_column("temperature")->header(), "temperature[degC]");
  EXPECT_NEAR(find_column("temperature")->shown(h.records[0]), 20, 1e-12);
}

}  // namespace
}  // namespace solidus::point
