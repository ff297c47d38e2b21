/// Castings that cannot go on, each for another physical reason, which the run names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "case_folder.hpp"

namespace solidus {
namespace {

using ::testing::AllOf;
using testing::CaseFolder;
using ::testing::HasSubstr;
using ::testing::Not;

const CaseFolder k_here("stopped_physics");

/// The contact of both bodies, through a gap of gas where it opens.
const std::string k_contact = R"([[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.03 W/m/K"
)";

/// A block of 40 mm by 20 mm on a plate that is held below.
/// @param head   keys and tables above those of the bodies
/// @param body   further keys of the block
/// @param plate  further keys of the plate
std::string on_a_plate(const std::string& head, const std::string& body, const std::string& plate = "") {
  return "title = \"A block on a plate\"\n" + head + R"(
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
gravity = "9.81 m/s2"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "10 mm"]
lower_divisions = [6, 2]
upper = ["40 mm", "20 mm"]
upper_divisions = [8, 4]
[[body]]
name = "upper"
)" + body +
         R"(
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "150 degC"
)" + plate +
         R"(
[[mechanical_condition]]
name = "table"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
)" + k_contact;
}

const std::string k_steel = "material = \"medium_carbon_steel\"\ninitial_temperature = \"500 degC\"\n",
                  k_time = "[time]\nend = \"100 s\"\nstep = \"2 s\"\n";

TEST(StoppedPhysics, ACastingThatIsShakenOutWithNothingToStandOnIsSaidToBeCarriedByNothing) {
  const std::string stages =
      "stage = [{ name = \"cool\", duration = \"20 s\" }, { name = \"air\", duration = \"20 s\" }]\n";
  const auto run = k_here.run(
      "shaken_out", on_a_plate(stages + "[time]\nstep = \"2 s\"\n", k_steel, "stages = \"cool\"\n"));
  EXPECT_FALSE(run.finished);
  // 0.8 l of steel of 7800 kg/m3 to a metre.
  EXPECT_THAT(run.reason,
              AllOf(HasSubstr("could not go on at t = 20 s"),
                    HasSubstr("reason: nothing carries body 'upper', which weighs 61."),
                    HasSubstr("and no contact is on it"), HasSubstr("a support against moving and turning")));
  for (const char* misleading : {"limit load", "max_iterations", "is every body held"})
    EXPECT_THAT(run.reason, Not(HasSubstr(misleading)));
}

TEST(StoppedPhysics, ACastingThatALoadLiftsOffItsPlateIsSaidToTouchItNowhere) {
  const auto run = k_here.run("lifted", on_a_plate(k_time, k_steel) + R"(
[[mechanical_condition]]
name = "crane"
group = "upper_y_max"
kind = "pressure"
pressure = { of = "time", points = [["0 s", "0 kPa"], ["100 s", "-4 kPa"]] }
)");
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(run.reason,
              AllOf(HasSubstr("reason: nothing carries body 'upper', which weighs 61."),
                    HasSubstr("none of its 24 contact points is closed"),
                    HasSubstr("a support against moving and turning"), Not(HasSubstr("limit load"))));
}

TEST(StoppedPhysics, ACastingThatSlidesOffAPlateIsSaidToBeFreeToSlide) {
  std::string sideways = on_a_plate(k_time, k_steel);
  sideways.insert(sideways.find("[mesh]"), "gravity_direction = [1, -1]\n");
  const auto run = k_here.run("slides", sideways);
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(
      run.reason,
      AllOf(HasSubstr("reason: body 'upper' is free to slide or to turn: contact alone holds it, without "
                      "friction: 24 of its 24 contact points were closed"),
            Not(HasSubstr("limit load"))));
}

TEST(StoppedPhysics, MeltThatNothingHoldsIsSaidToHaveRunOut) {
  const auto run = k_here.run("melt", R"(title = "Melt under a plate, by a wrong direction of gravity"
[analysis]
kind = "solid"
physics = "thermomechanical"
gravity = "9.81 m/s2"
gravity_direction = [0, 0, 1]
[mesh]
shape = "two_blocks"
element = "hex8"
[mesh.two_blocks]
lower = ["60 mm", "60 mm", "20 mm"]
lower_divisions = [2, 2, 1]
upper = ["60 mm", "60 mm", "30 mm"]
upper_divisions = [3, 3, 2]
[time]
end = "10 min"
step = "2 s"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "690 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "150 degC"
[[mechanical_condition]]
name = "table"
group = "lower_z_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
uz = "0 mm"
)" + k_contact);
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(run.reason, AllOf(HasSubstr("reason: the melt of 'upper' has run out: by t = "),
                                HasSubstr("mould, a support or a plane of symmetry hold it"),
                                Not(HasSubstr("limit load"))));
}

TEST(StoppedPhysics, ACastingThatIsPressedBeyondItsStrengthIsSaidToBeAtItsLimitLoad) {
  const auto run = k_here.run("pressed", on_a_plate(k_time, k_steel) + R"(
[[mechanical_condition]]
name = "press"
group = "upper_y_max"
kind = "pressure"
pressure = { of = "time", points = [["0 s", "0 MPa"], ["100 s", "10 GPa"]] }
)");
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(run.reason, AllOf(HasSubstr("reason: body 'upper' is at its limit load: "),
                                HasSubstr("beyond its limit load a body that yields has no equilibrium"),
                                Not(HasSubstr("nothing carries"))));
}

TEST(StoppedPhysics, ACoolingThatTakesMoreHeatThanThereIsIsSaidWithItsPlaceAndBothTemperatures) {
  const auto run = k_here.run("quenched", on_a_plate(k_time, k_steel) + R"(
[[thermal_condition]]
name = "spray"
group = "upper_y_max"
kind = "flux"
flux = "-20 MW/m2"
)");
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(run.reason, AllOf(HasSubstr("reason: more heat is taken than there is: "),
                                HasSubstr("of body 'upper' goes from "), HasSubstr(" K in a try of "),
                                HasSubstr("fluxes and sources at that place")));
}

TEST(StoppedPhysics, HeatThroughAContactThatDoesNotSettleIsComparedWithWhatItsSurfaceStores) {
  std::string chill = on_a_plate(k_time + "min_step = \"2 s\"\n[heat]\nmax_iterations = 1\n",
                                 "material = \"aluminium_alsi7mg\"\ninitial_temperature = \"700 degC\"\n");
  const std::string conductance = "2000 W/m2/K";
  chill.replace(chill.find(conductance), conductance.size(), "1e6 W/m2/K");
  const auto run = k_here.run("conducts", chill);
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(run.reason, AllOf(HasSubstr("reason: heat through contact 'interface' does not come to rest: "),
                                HasSubstr("times in a step what its surface stores"),
                                HasSubstr("conductance and gap law of contact 'interface'")));
}

}  // namespace
}  // namespace solidus
