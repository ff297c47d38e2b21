// Slips in a material card of one's own, in moulds and in steps, each named; the card itself gives none.
#include <fstream>
#include <string>
#include <vector>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* k_card = R"(title = "Own"
density = "2800 kg/m3"
conductivity = "150 W/m/K"
specific_heat = { argument_unit = "degC", unit = "J/kg/K", points = [[20, 880], [640, 1100]] }
poisson_ratio = 0.33
young_modulus = { argument_unit = "degC", unit = "GPa", points = [[20, 71], [530, 38]] }
expansion = "2.3e-5 1/K"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "388 kJ/kg"
volume_change = -0.058
[phase_change.fraction]
kind = "linear"
solidus = "507 degC"
liquidus = "642 degC"
[plasticity]
isotropic_hardening = "none"
rate_dependence = "perzyna"
flow_stress = { argument_unit = "degC", unit = "MPa", points = [[20, 130], [300, 62], [507, 8]] }
rate_exponent = 5
drag_stress = "10 MPa"
viscosity = { argument_unit = "degC", unit = "Pa s", points = [[300, 9.3e7], [400, 3e9], [544, 2.3e8]] }
)";

class CardsTest : public FindingsTest {
 protected:
  std::vector<std::string> said_of_card(const std::string& card) const {
    std::ofstream(folder_ / "own.toml") << card;
    return said_of(changed(deforming(), "\"aluminium_alsi7mg\"", "\"own.toml\""));
  }
};

TEST_F(CardsTest, NumbersThatFitNoMetalOfItsDensityAndLiquidusAreNamed) {
  EXPECT_THAT(said_of_card(k_card), IsEmpty());
  const std::vector<Slip> slips = {
      {"[[20, 880], [640, 1100]]", "[[20, 210], [640, 263]]", "0.588 MJ/m3/K at 20 degC"},
      {"[[20, 880], [640, 1100]]", "[[20, 8800], [640, 11000]]", "24.6 MJ/m3/K at 20 degC"},
      {"2800 kg/m3", "7800 kg/m3", "6.86 MJ/m3/K at 20 degC"},
      {"150 W/m/K", "15 W/m/K", "aluminium and magnesium conduct 50 to 240 W/m/K"},
      {"2.3e-5", "2.3e-6", "expansion of 2.3e-06 1/K at most, with a liquidus of 915.1 K"},
      {"[[20, 71], [530, 38]]", "[[20, 10.3], [530, 5.5]]", "a young_modulus of 10.3 GPa at 20 degC"},
      {"[[20, 71], [530, 38]]", "[[20, 710], [530, 380]]", "a young_modulus of 710 GPa at 20 degC"},
      {"-0.058", "-0.00058", "'solidification' changes the volume by -0.058 %"},
      {"388 kJ/kg", "776 kJ/kg", "2.37 MJ/m3 for each kelvin"},
      {"\"Pa s\"", "\"MPa s\"", "at its solidus a rate of 0.001 1/s adds"},
      {"[plasticity]", "[casting]\ncoherency_fraction = 0.01\n[plasticity]",
       "it carries load from 1 % solid on"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of_card(changed(k_card, slip.what, slip.with)), Contains(HasSubstr(slip.said)))
        << slip.with;
}

TEST_F(CardsTest, AMouldOfAnAlloyIsNamedByItsRole) {
  const std::string mould = changed(k_casting, "\"steel_mould\"", "\"aluminium_alsi7mg\"\nrole = \"mould\"");
  const std::vector<std::string> said = said_of(mould);
  EXPECT_THAT(said, Contains(HasSubstr("the mould 'lower' is of 'aluminium_alsi7mg', which melts from 5")));
  EXPECT_THAT(said, Not(Contains(HasSubstr("nothing freezes"))));
}

TEST_F(CardsTest, ARiserThatIsColdOrDoesNotFreezeIsNamed) {
  const std::string cold = changed(k_casting, "\"steel_mould\"", "\"aluminium_alsi7mg\"\nrole = \"riser\"");
  EXPECT_THAT(said_of(cold), Contains(HasSubstr("the riser 'lower' starts solid at 200 degC")));
  EXPECT_THAT(said_of(changed(k_casting, "\"steel_mould\"", "\"steel_mould\"\nrole = \"riser\"")),
              Contains(HasSubstr("the riser 'lower' is of 'steel_mould', which does not freeze")));
  EXPECT_THAT(
      said_of(changed(k_casting, "end = \"10 min\"", "until = \"solid\"\nend = \"10 min\"\nadaptive = true") +
              "\n"),
      IsEmpty());
  EXPECT_THAT(said_of(changed(changed(k_casting, "end = \"10 min\"", "until = \"solid\"\nend = \"10 min\""),
                              "\"700 degC\"", "\"700 K\"")),
              Contains(HasSubstr("'upper' starts at 427 degC, and 'aluminium_alsi7mg' is liquid from 61")));
}

TEST_F(CardsTest, SandThatIsThinOrNeverYieldsIsNamed) {
  const std::string sand = changed(k_casting, "\"steel_mould\"", "\"green_sand\"\nrole = \"mould\"");
  const std::string wide =
      changed(sand, "end = \"10 min\"\nstep = \"1 s\"", "end = \"2 h\"\nstep = \"1 s\"\nadaptive = true");
  EXPECT_THAT(
      said_of(changed(changed(wide, "lower = [\"40 mm\", \"20 mm\"]", "lower = [\"40 mm\", \"150 mm\"]"),
                      "lower_divisions = [8, 4]", "lower_divisions = [8, 30]")),
      IsEmpty());
  EXPECT_THAT(said_of(wide), Contains(HasSubstr("the mould 'lower' of 'green_sand' is 20 mm thick")));
  std::ofstream(folder_ / "own_sand.toml")
      << "title = \"Sand\"\ndensity = \"1500 kg/m3\"\nconductivity = \"0.7 W/m/K\"\n"
         "specific_heat = \"1100 J/kg/K\"\npoisson_ratio = 0.3\nyoung_modulus = \"200 MPa\"\n"
         "expansion = \"1e-5 1/K\"\n";
  EXPECT_THAT(said_of(changed(deforming(), "\"steel_mould\"", "\"own_sand.toml\"")),
              Contains(HasSubstr("deforms with a young_modulus of 200 MPa and never yields")));
}

TEST_F(CardsTest, StepsThatAreTooLongForTheFreezingAreNamed) {
  const auto stepped = [](const std::string& keys) {
    return changed(k_casting, "step = \"1 s\"", "step = \"1 s\"\nadaptive = true\n" + keys);
  };
  EXPECT_THAT(said_of(stepped("max_step = \"1 min\"\nmin_step = \"0.1 s\"")), IsEmpty());
  EXPECT_THAT(said_of(stepped("max_step = \"1 h\"")),
              Contains(HasSubstr("time.max_step of 60 min limits nothing: the whole run takes 10 min")));
  EXPECT_THAT(said_of(changed(stepped("min_step = \"24 s\""), "step = \"1 s\"", "step = \"24 s\"")),
              Contains(HasSubstr("steps of 24 s at least")));
  EXPECT_THAT(said_of(changed(stepped(""), "step = \"1 s\"", "step = \"2 min\"")),
              Contains(HasSubstr("the first step is 2 min")));
}

}  // namespace
