// Slips in stages, in what holds the free skin of a casting, and in what its metal has left when it is hot.
#include <string>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

using StagesTest = FindingsTest;

TEST_F(StagesTest, AStageInWhichNothingCoolsIsNamed) {
  const std::string stages = changed(changed(k_casting, "end = \"10 min\"\n", ""), "[[contact]]", R"([[stage]]
name = "mould"
duration = "10 min"
[[stage]]
name = "air"
duration = "10 min"
[[contact]]
stages = ["mould"])");
  const std::string shaken =
      changed(changed(stages, "name = \"lower\"", "name = \"lower\"\nstages = [\"mould\"]"),
              "kind = \"film\"", "kind = \"film\"\nstages = [\"mould\"]");
  EXPECT_THAT(said_of(shaken), Contains(HasSubstr("nothing cools 'upper' in the stage 'air'")));
  const std::string cooled = shaken + R"(
[[thermal_condition]]
name = "free air"
group = "upper_bottom"
kind = "film"
stages = ["air"]
coefficient = "10 W/m2/K"
ambient = "20 degC"
)";
  EXPECT_THAT(said_of(cooled), Not(Contains(HasSubstr("nothing cools"))));
}

TEST_F(StagesTest, AFreeSkinThatIsHeldIsNamed) {
  const auto held = [](const std::string& motion) {
    return deforming() +
           "[[mechanical_condition]]\nname = \"top\"\ngroup = \"upper_y_max\"\nkind = "
           "\"displacement\"\n" +
           motion;
  };
  EXPECT_THAT(said_of(held("ux = \"0 mm\"\nuy = \"0 mm\"\n")),
              Contains(HasSubstr("'top' holds the surface 'upper_y_max' of 'upper', 33 % of its skin")));
  EXPECT_THAT(said_of(held("ux = \"0 mm\"\n")), Not(Contains(HasSubstr("'top' holds"))));
}

TEST_F(StagesTest, AMeltThatIsOpenBelowIsNamed) {
  // Held from the sides, as by friction, so that there is no message of its falling.
  const std::string sides = deforming() + R"(
[[mechanical_condition]]
name = "wall"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
)";
  EXPECT_THAT(said_of(sides), Not(Contains(HasSubstr("open below"))));
  EXPECT_THAT(said_of(changed(sides, "gravity = \"9.81 m/s2\"",
                              "gravity = \"9.81 m/s2\"\ngravity_direction = [0, 1]")),
              Contains(HasSubstr("the melt is open below, as gravity acts: 100 %")));
}

class HotMetalTest : public FindingsTest {
 protected:
  void write_own(const std::string& like, const std::string& further) const {
    std::ofstream(folder_ / "own.toml") << "title = \"Its own\"\nlike = \"" << like << "\"\n" << further;
  }
  std::string of_own() const {
    return changed(deforming(), "material = \"aluminium_alsi7mg\"", "material = \"own.toml\"");
  }
};

TEST_F(HotMetalTest, AStiffnessThatDoesNotFallIsNamed) {
  write_own("aluminium_alsi7mg", "young_modulus = \"70 GPa\"\n");
  EXPECT_THAT(said_of(of_own()),
              Contains(HasSubstr("a young_modulus of 70 GPa at 20 degC and of 70 GPa at its solidus")));
  write_own("aluminium_alsi7mg", "");
  EXPECT_THAT(said_of(of_own()), Not(Contains(HasSubstr("young_modulus"))));
}

TEST_F(HotMetalTest, ARateThatAddsNextToNothingIsNamed) {
  const std::string viscosity = R"([plasticity.viscosity]
argument_unit = "degC"
unit = "Pa s"
points = )";
  write_own("aluminium_almg5", viscosity + "[[300, 9.3], [400, 300], [460, 300], [550, 23], [629, 0.72]]\n");
  EXPECT_THAT(said_of(of_own()), Contains(HasSubstr("at its solidus a rate of 0.001 1/s adds")));
  write_own("aluminium_almg5",
            viscosity + "[[300, 9.3e7], [400, 3e9], [460, 3e9], [550, 2.3e8], [629, 7.2e6]]\n");
  EXPECT_THAT(said_of(of_own()), Not(Contains(HasSubstr("at its solidus a rate"))));
}

}  // namespace
