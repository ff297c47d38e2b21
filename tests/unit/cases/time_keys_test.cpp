/// The section [time]: what its keys must agree in, and what becomes of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cases/case_keys.hpp"
#include "setup/case_file.hpp"
#include "setup/time_input.hpp"

namespace solidus::cases {
namespace {

using ::testing::HasSubstr;

CaseSpec spec(const std::string& time, const std::string& physics = "thermomechanical") {
  return case_keys().read(
      parse_document("title = \"t\"\n[analysis]\nkind = \"plane_strain\"\nphysics = \"" + physics +
                         "\"\n[mesh]\nshape = \"block\"\nelement = \"quad4\"\n[mesh.block]\n"
                         "size = [\"1 m\", \"1 m\"]\ndivisions = [1, 1]\n[[body]]\nname = \"b\"\n"
                         "material = \"steel_mould\"\ninitial_temperature = \"20 degC\"\n"
                         "[time]\nend = \"10 s\"\nstep = \"1 s\"\n" +
                         time,
                     "case.toml"));
}

std::string error(const std::string& time, const std::string& physics = "thermomechanical") {
  try {
    setup::check_time(spec(time, physics));
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(TimeKeys, LimitsOfAdaptiveStepsMeanNothingWithoutThem) {
  for (const char* key :
       {"max_step = \"2 s\"", "temperature_error = \"1 K\"", "displacement_error = \"1 um\"",
        "solid_fraction_change = 0.2", "skin_change = 0.1", "error_control = \"doubling\""}) {
    const std::string text = error(key);
    EXPECT_THAT(text, HasSubstr("means nothing without adaptive = true")) << key;
    EXPECT_THAT(text, HasSubstr(std::string(key).substr(0, std::string(key).find(' ')))) << key;
    EXPECT_EQ(error(std::string("adaptive = true\n") + key), "no error") << key;
  }
}

TEST(TimeKeys, AnErrorThatNothingMeasuresIsRefused) {
  EXPECT_THAT(error("adaptive = true\nerror_control = \"none\"\ntemperature_error = \"1 K\""),
              HasSubstr("'temperature_error' means nothing with error_control = \"none\""));
}

TEST(TimeKeys, LimitsOfFieldsThatAreNotSolvedForAreRefused) {
  EXPECT_THAT(error("adaptive = true\ntemperature_error = \"1 K\"", "mechanics"), HasSubstr("without heat"));
  EXPECT_THAT(error("adaptive = true\nsolid_fraction_change = 0.1", "mechanics"), HasSubstr("without heat"));
  EXPECT_THAT(error("adaptive = true\ndisplacement_error = \"1 um\"", "heat"),
              HasSubstr("without mechanics"));
  EXPECT_THAT(error("adaptive = true\nskin_change = 0.1", "mechanics"), HasSubstr("without heat"));
  EXPECT_THAT(error("adaptive = true\nerror_control = \"none\"\nskin_change = 0.1"),
              HasSubstr("with error_control"));
  EXPECT_THAT(error("adaptive = true\nskin_change = 0.1", "heat"), HasSubstr("without mechanics"));
}

TEST(TimeKeys, SizesThatContradictEachOtherAreRefused) {
  EXPECT_THAT(error("min_step = \"2 s\""), HasSubstr("'min_step' is above 'step'"));
  EXPECT_THAT(error("adaptive = true\nmax_step = \"0.5 s\""), HasSubstr("'max_step' is below 'step'"));
}

TEST(TimeKeys, ADifferenceOfTemperatureIsNoTemperature) {
  const CaseSpec c = spec("adaptive = true\ntemperature_error = \"2 degC\"");
  EXPECT_DOUBLE_EQ(setup::time_options(c).step.limits.temperature, 2.0);
}

TEST(TimeKeys, WhatIsNotGivenHasItsDefault) {
  const CaseSpec c = spec("adaptive = true");
  const coupling::StepLimits limits = setup::time_options(c).step.limits;
  EXPECT_EQ(limits.control, coupling::ErrorControl::predictor);
  EXPECT_DOUBLE_EQ(limits.temperature, 1.0);
  EXPECT_DOUBLE_EQ(limits.solid_fraction, 0.1);
  EXPECT_DOUBLE_EQ(limits.skin, 0.03);
  EXPECT_DOUBLE_EQ(setup::time_options(spec("adaptive = true\nskin_change = 0.3")).step.limits.skin, 0.3);
  EXPECT_DOUBLE_EQ(setup::displacement_error(c.time, std::vector<double>{0.0, 0.2, 0.5}), 6e-5);
  EXPECT_GT(setup::displacement_error(c.time, std::vector<double>{0.0}), 1);  // heat alone
  EXPECT_DOUBLE_EQ(setup::displacement_error(spec("adaptive = true\ndisplacement_error = \"3 um\"").time,
                                             std::vector<double>{2.0}),
                   3e-6);
}

TEST(TimeKeys, TheShareOfASkinFollowsTheErrorOfTheDisplacement) {
  const std::vector<double> sections{0.1};  // a default of 30 micrometres
  const auto share = [&](const std::string& keys) {
    return setup::skin_change(spec("adaptive = true\n" + keys).time, sections);
  };
  EXPECT_DOUBLE_EQ(share(""), 0.03);
  EXPECT_DOUBLE_EQ(share("temperature_error = \"9 K\""), 0.03);
  EXPECT_DOUBLE_EQ(share("displacement_error = \"120 um\""), 0.06);
  EXPECT_DOUBLE_EQ(share("displacement_error = \"7.5 um\""), 0.015);
  EXPECT_DOUBLE_EQ(share("displacement_error = \"1 m\""), 0.5);
  EXPECT_DOUBLE_EQ(share("displacement_error = \"120 um\"\nskin_change = 0.05"), 0.05);
}

}  // namespace
}  // namespace solidus::cases
