/// [[rigid_surface]]: what it means and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "setup/admissible.hpp"
#include "setup/contact_input.hpp"
#include "setup/mesh_input.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using contact::RigidSurface;
using test::refusal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string k_plane = "shape = \"plane\"\npoint = [\"0 mm\", \"10 mm\"]\nnormal = [0, -2]\n";
const std::string k_roll = "shape = \"cylinder\"\npoint = [\"0 mm\", \"30 mm\"]\nradius = \"20 mm\"\n";
const std::string k_ball = "shape = \"sphere\"\npoint = [\"0 mm\", \"30 mm\"]\nradius = \"20 mm\"\n";
const std::string k_solid_roll =
    "shape = \"cylinder\"\npoint = [\"0 mm\", \"0 mm\", \"30 mm\"]\nradius = \"20 mm\"\n";
const std::string k_solid_ball =
    "shape = \"sphere\"\npoint = [\"0 mm\", \"0 mm\", \"30 mm\"]\nradius = \"20 mm\"\n";

/// A block in mechanics, and a tool on its top.
/// @param pair further keys of the contact
CaseSpec with_tool(const std::string& tool, const std::string& pair = "",
                   const std::string& kind = "plane_strain", const std::string& physics = "mechanics",
                   const std::string& master = "tool") {
  const bool solid = kind == "solid";
  const std::string sliding =
      pair.find("formulation") == std::string::npos ? "formulation = \"large_sliding\"\n" : "";
  return case_keys().read(parse_document(
      "title = \"A tool\"\n[analysis]\nkind = \"" + kind + "\"\nphysics = \"" + physics +
          "\"\n[mesh]\nshape = \"block\"\nelement = \"" + (solid ? "hex8" : "quad4") + "\"\n[mesh.block]\n" +
          (solid ? "size = [\"10 mm\", \"10 mm\", \"10 mm\"]\ndivisions = [1, 1, 1]\n"
                 : "size = [\"10 mm\", \"10 mm\"]\ndivisions = [1, 1]\n") +
          "[time]\nend = \"2 s\"\nstep = \"1 s\"\n[[body]]\nname = \"block\"\nmaterial = \"a\"\n"
          "initial_temperature = \"300 K\"\n[[rigid_surface]]\nname = \"tool\"\n" +
          tool + "[[contact]]\nname = \"press\"\nslave = \"" + (solid ? "z_max" : "y_max") +
          "\"\nmaster = \"" + master + "\"\n" + sliding + pair,
      "case.toml"));
}

RigidSurface surface(const std::string& tool, const std::string& kind = "plane_strain") {
  const CaseSpec spec = with_tool(tool, "", kind);
  EXPECT_EQ(refusal(spec), "");
  return setup::contact_specs(spec)[0].rigid_master.value();
}

/// Error message of reading or checking a tool.
std::string error(const std::string& tool, const std::string& kind = "plane_strain",
                  const std::string& pair = "", const std::string& physics = "mechanics") {
  try {
    return refusal(with_tool(tool, pair, kind, physics));
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(RigidSurfaceKeys, APlaneLooksAlongItsNormalAndMovesByItsTables) {
  const RigidSurface s =
      surface(k_plane +
              "uy = { of = \"time\", points = [[\"0 s\", \"0 mm\"], [\"2 s\", \"-4 mm\"]] }\n"
              "rotation = \"90 degree\"\n");
  EXPECT_EQ(s.shape, RigidSurface::Shape::plane);
  EXPECT_THAT(s.point, ElementsAre(0, 0.01, 0));
  EXPECT_THAT(s.direction, ElementsAre(0, -2, 0));
  EXPECT_DOUBLE_EQ(s.motion.translation[1].value(1), -2e-3);
  EXPECT_EQ(s.motion.translation[0].value(1), 0);
  EXPECT_DOUBLE_EQ(s.motion.angle.value(1), std::numbers::pi / 2);
  EXPECT_THAT(s.motion.centre, ElementsAre(0, 0.01, 0));
  EXPECT_THAT(s.motion.axis, ElementsAre(0, 0, 1));
}

TEST(RigidSurfaceKeys, ACylinderInPlaneStrainLiesAlongZ) {
  const RigidSurface s = surface(k_roll +
                                 "hollow = true\nrotation = \"1 rad\"\n"
                                 "rotation_centre = [\"5 mm\", \"0 mm\"]\n");
  EXPECT_EQ(s.shape, RigidSurface::Shape::cylinder);
  EXPECT_THAT(s.direction, ElementsAre(0, 0, 1));
  EXPECT_EQ(s.radius, 0.02);
  EXPECT_TRUE(s.hollow);
  EXPECT_THAT(s.motion.centre, ElementsAre(0.005, 0, 0));
}

TEST(RigidSurfaceKeys, ACylinderInASolidTurnsAboutItsAxisUnlessTold) {
  const std::string roll = k_solid_roll + "axis = [0, 3, 0]\nrotation = \"1 rad\"\n";
  EXPECT_THAT(surface(roll, "solid").direction, ElementsAre(0, 3, 0));
  EXPECT_THAT(surface(roll, "solid").motion.axis, ElementsAre(0, 3, 0));
  EXPECT_THAT(surface(roll + "rotation_axis = [1, 0, 0]\n", "solid").motion.axis, ElementsAre(1, 0, 0));
  EXPECT_EQ(surface(k_solid_ball + "uz = \"-1 mm\"\n", "solid").motion.translation[2].value(0), -1e-3);
}

TEST(RigidSurfaceKeys, AnAxisymmetricCylinderIsAShaftOrABore) {
  const RigidSurface shaft = surface(k_roll + "uz = \"1 mm\"\n", "axisymmetric");
  EXPECT_EQ(shaft.shape, RigidSurface::Shape::plane);
  EXPECT_THAT(shaft.point, ElementsAre(0.02, 0.03, 0));
  EXPECT_THAT(shaft.direction, ElementsAre(1, 0, 0));
  EXPECT_EQ(shaft.motion.translation[1].value(0), 1e-3);
  EXPECT_EQ(shaft.motion.translation[2].value(0), 0);
  EXPECT_THAT(surface(k_roll + "hollow = true\n", "axisymmetric").direction, ElementsAre(-1, 0, 0));
  EXPECT_EQ(surface(k_ball, "axisymmetric").shape, RigidSurface::Shape::sphere);
}

TEST(RigidSurfaceKeys, ShapesThatAreNoneAreRefused) {
  EXPECT_THAT(error("shape = \"plane\"\npoint = [\"0 mm\", \"0 mm\"]\nnormal = [0, 0]\n"),
              HasSubstr("no length"));
  EXPECT_THAT(error("shape = \"plane\"\npoint = [\"0 mm\", \"0 mm\"]\n"), HasSubstr("normal"));
  EXPECT_THAT(error("shape = \"plane\"\npoint = [\"0 mm\", \"0 mm\"]\nnormal = [0, 0, 1]\n"),
              HasSubstr("3 components"));
  EXPECT_THAT(error("shape = \"plane\"\npoint = [\"0 mm\"]\nnormal = [0, 1]\n"), HasSubstr("1 components"));
  EXPECT_THAT(error("shape = \"cylinder\"\npoint = [\"0 mm\", \"0 mm\"]\nradius = \"0 mm\"\n"),
              HasSubstr("above 0 m"));
  EXPECT_THAT(error("shape = \"cylinder\"\npoint = [\"0 mm\", \"0 mm\"]\n"), HasSubstr("radius"));
  EXPECT_THAT(error(k_plane + "radius = \"1 mm\"\n"), HasSubstr("radius"));
  EXPECT_THAT(error(k_roll + "axis = [0, 0, 1]\n"), HasSubstr("lies along z"));
  EXPECT_THAT(error(k_ball), HasSubstr("plane strain"));
  EXPECT_THAT(error(k_solid_roll, "solid"), HasSubstr("'axis'"));
  EXPECT_THAT(error("shape = \"sphere\"\npoint = [\"1 mm\", \"0 mm\"]\nradius = \"1 mm\"\n", "axisymmetric"),
              HasSubstr("axis of revolution"));
}

TEST(RigidSurfaceKeys, MotionsThatTheAnalysisDoesNotHaveAreRefused) {
  EXPECT_THAT(error(k_plane + "uz = \"1 mm\"\n"), HasSubstr("motion 'uz'"));
  EXPECT_THAT(error(k_ball + "ux = \"1 mm\"\n", "axisymmetric"), HasSubstr("motion 'ux'"));
  EXPECT_THAT(error(k_ball + "rotation = \"1 rad\"\n", "axisymmetric"), HasSubstr("motion 'rotation'"));
  EXPECT_THAT(error(k_ball + "uy = \"1 mm\"\nuz = \"1 mm\"\n", "axisymmetric"), HasSubstr("twice"));
  EXPECT_THAT(error(k_plane + "rotation_centre = [\"0 mm\", \"0 mm\"]\n"), HasSubstr("does not turn"));
  EXPECT_THAT(error(k_plane + "rotation = \"1 rad\"\nrotation_axis = [0, 0, 1]\n"), HasSubstr("it is z"));
  EXPECT_THAT(error(k_solid_ball + "rotation = \"1 rad\"\n", "solid"), HasSubstr("no axis"));
}

TEST(RigidSurfaceKeys, ContactsThatCannotWorkWithOneAreRefused) {
  EXPECT_THAT(error(k_plane, "plane_strain", "formulation = \"small_sliding\"\n"),
              HasSubstr("small sliding"));
  EXPECT_THAT(error(k_plane, "plane_strain", "smoothing = true\n"), HasSubstr("smoothing"));
  EXPECT_THAT(
      error(k_plane, "plane_strain", "[contact.heat]\nconductance = \"1 W/m2/K\"\ngap_law = \"constant\"\n",
            "thermomechanical"),
      HasSubstr("no temperature"));
  EXPECT_THAT(error(k_plane, "plane_strain", "[contact.friction]\ncoefficient = 0.1\n", "thermomechanical"),
              HasSubstr("none passes"));
  EXPECT_THAT(error(k_plane + "temperature = \"20 degC\"\n", "plane_strain", "", "thermomechanical"),
              HasSubstr("has a temperature"));
  EXPECT_THAT(error(k_plane, "plane_strain", "", "heat"), HasSubstr("no mechanics"));
  EXPECT_EQ(error(k_plane, "plane_strain", "", "thermomechanical"), "");
  EXPECT_EQ(error(k_plane, "plane_strain", "[contact.friction]\ncoefficient = 0.1\n"), "");
}

TEST(RigidSurfaceKeys, AToolThatMovesTakesTheProofOfStabilityAway) {
  const auto violations = [](const std::string& motion) {
    return setup::admissibility(with_tool(k_plane + motion, "", "plane_strain", "thermomechanical"))
        .violations;
  };
  EXPECT_THAT(violations(""), ElementsAre());
  EXPECT_THAT(violations("uy = \"-1 mm\"\n"), ElementsAre("the rigid surface 'tool' moves"));
  EXPECT_THAT(violations("rotation = \"1 rad\"\n"), ElementsAre("the rigid surface 'tool' moves"));
}

TEST(RigidSurfaceKeys, AToolWithATemperatureIsTheSurroundings) {
  const std::string heat = "[contact.heat]\nconductance = \"1 W/m2/K\"\ngap_law = \"constant\"\n";
  CaseSpec spec =
      with_tool(k_plane + "temperature = \"20 degC\"\n", heat, "plane_strain", "thermomechanical");
  EXPECT_EQ(setup::contact_specs(spec)[0].rigid_master->temperature->value(0), 293.15);
  EXPECT_EQ(setup::admissibility(spec).ambient_temperature, 293.15);
  EXPECT_TRUE(setup::admissibility(spec).holds());
  spec.coupling.ambient_temperature = 300;
  EXPECT_THAT(setup::admissibility(spec).violations,
              ElementsAre("the temperature of 'tool' is not the ambient one, 26.85 degC"));
}

TEST(RigidSurfaceKeys, NamesMustFit) {
  CaseSpec spec = with_tool(k_plane);
  EXPECT_NO_THROW(setup::raw_mesh(spec));
  spec.contacts[0].slave = "tool", spec.contacts[0].master = "y_max";
  EXPECT_THAT(refusal(spec), HasSubstr("where its slave may be"));
  const auto says = [](const CaseSpec& wrong) -> std::string {
    try {
      setup::raw_mesh(wrong);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(says(with_tool(k_plane, "", "plane_strain", "mechanics", "toll")),
              HasSubstr("did you mean 'tool'?"));
  spec = with_tool(k_plane, "", "plane_strain", "mechanics", "y_min");
  EXPECT_THAT(says(spec), HasSubstr("as its master"));
  spec.rigid_surfaces[0].name = "y_min";
  EXPECT_THAT(says(spec), HasSubstr("called like a group"));
}

}  // namespace
}  // namespace solidus::cases
