// Slips in the data of an alloy, and interface laws of other bodies.
#include <string>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The casting of a material that the case brings along.
std::string of_own(const std::string& casefile) {
  return changed(casefile, "material = \"aluminium_alsi7mg\"", "material = \"own.toml\"");
}

class DataTest : public FindingsTest {
 protected:
  void write_own(const std::string& further) const {
    std::ofstream(folder_ / "own.toml") << "title = \"Its own\"\nlike = \"aluminium_alsi7mg\"\n" << further;
  }
};

TEST_F(DataTest, ALatentHeatThatNoMetalHasForItsMeltingPointIsNamed) {
  const auto freezing = [](const std::string& latent_heat) {
    return "[[phase_change]]\nname = \"solidification\"\nsolidification = true\nlatent_heat = \"" +
           latent_heat +
           "\"\nvolume_change = -0.045\n"
           "fraction = { kind = \"linear\", solidus = \"577 degC\", liquidus = \"614 degC\" }\n";
  };
  write_own(freezing("389 kJ/kg"));
  EXPECT_THAT(said_of(of_own(k_casting)), IsEmpty());
  write_own(freezing("1040 kJ/kg"));  // of a litre
  EXPECT_THAT(said_of(of_own(k_casting)), Contains(HasSubstr("a latent heat of 1040 kJ/kg at 2685 kg/m3")));
  write_own(freezing("93 kJ/kg"));  // the number in cal/g
  EXPECT_THAT(said_of(of_own(k_casting)), Contains(HasSubstr("a latent heat of 93 kJ/kg")));
}

TEST_F(DataTest, AStrengthThatDoesNotFallIsNamed) {
  write_own(
      "[plasticity.flow_stress]\nvalue = \"75 MPa\"\n[plasticity.saturation_stress]\nvalue = \"150 MPa\"\n");
  EXPECT_THAT(said_of(of_own(deforming())),
              Contains(HasSubstr("a flow_stress of 75 MPa at 20 degC and of 75 MPa at its solidus")));
  EXPECT_THAT(said_of(of_own(k_casting)), IsEmpty()) << "heat alone has no strength";
}

TEST_F(DataTest, ArmsAndViscositiesInOtherUnitsAreNamed) {
  write_own("[casting]\narm_spacing = \"10 um\"\nmelt_viscosity = \"1.3 mPa s\"\n");
  EXPECT_THAT(said_of(of_own(k_casting)), IsEmpty());
  write_own("[casting]\narm_spacing = \"10 mm\"\nmelt_viscosity = \"1.3 mPa s\"\n");
  EXPECT_THAT(said_of(of_own(k_casting)), Contains(HasSubstr("secondary arms are 3.91e+04 um apart")));
  write_own("[casting]\narm_spacing = \"10 um\"\nmelt_viscosity = \"1.3 Pa s\"\n");
  EXPECT_THAT(said_of(of_own(k_casting)), Contains(HasSubstr("a melt_viscosity of 1.3e+03 mPa s")));
}

TEST_F(DataTest, AMeltThatIsStiffOrHasTheViscosityOfTheMetalIsNamed) {
  write_own("[twice_shear_viscosity]\nvalue = \"1e6 Pa s\"\n");
  EXPECT_THAT(said_of(of_own(deforming())), IsEmpty());
  write_own("[twice_shear_viscosity]\nvalue = \"2e-3 Pa s\"\n");
  EXPECT_THAT(said_of(of_own(deforming())),
              Contains(HasSubstr("a twice_shear_viscosity of 0.002 Pa s makes melt")));
  write_own("[twice_shear_viscosity]\nvalue = \"1e12 Pa s\"\n");
  EXPECT_THAT(said_of(of_own(deforming())), Contains(HasSubstr("it does not flow")));
  write_own("[twice_shear_viscosity]\nvalue = \"1e12 Pa s\"\nsource = \"a published case\"\n");
  EXPECT_THAT(said_of(of_own(deforming())), IsEmpty()) << "meant so";
}

TEST_F(DataTest, AnInterfaceLawOfOtherBodiesIsNamed) {
  std::string sand = changed(changed(k_casting, "\"steel_mould\"\ninitial_temperature = \"200 degC\"",
                                     "\"green_sand\"\ninitial_temperature = \"20 degC\""),
                             "end = \"10 min\"", "end = \"2 h\"");
  sand = sand.substr(0, sand.find("[[contact]]")) + "[[interface]]\nbodies = \"all\"\n";
  EXPECT_THAT(said_of(sand), IsEmpty());
  EXPECT_THAT(said_of(sand + "law = \"metal_in_die\"\n"),
              Contains(HasSubstr("the interface law 'metal_in_die'")));
  EXPECT_THAT(said_of(sand + "law = \"metal_in_sand\"\n"), IsEmpty());
  EXPECT_THAT(said_of(changed(sand, "\"green_sand\"", "\"steel_mould\"") + "law = \"metal_in_die\"\n"),
              IsEmpty());
}

}  // namespace
