/// A case whose mesh is a STEP file: bodies and surfaces by number, by box and by the names that the program
/// gives. And cases that `solidus new` makes of STEP files.
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "case_run.hpp"
#include "mesh/making/kept_mesh.hpp"
#include "mesh/making/meshing_ways.hpp"
#include "new_case/new_case.hpp"

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A hot pin on a cold plate, apart: each has its own face where they meet.
const std::string k_case = R"(title = "A hot pin on a plate"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
file = "pin.step"
unit = "mm"
element_size = "2 mm"
[[mesh.group]]
name = "plate"
kind = "body"
numbers = [1]
[[mesh.group]]
name = "below"
lowest = ["0 mm", "0 mm", "0 mm"]
highest = ["20 mm", "10 mm", "0 mm"]
[[mesh.group]]
name = "under the pin"
numbers = [7]
[[mesh.group]]
name = "on the plate"
numbers = [10]
[time]
end = "2 s"
step = "1 s"
[[body]]
name = "plate"
material = "steel_mould"
initial_temperature = "20 degC"
[[body]]
name = "pin"
group = "body_2"
material = "steel_mould"
initial_temperature = "500 degC"
[[contact]]
name = "foot"
surfaces = ["under the pin", "on the plate"]
penalty = "1e12 N/m3"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "constant"
[[thermal_condition]]
name = "cold"
group = "below"
kind = "temperature"
temperature = "20 degC"
[[probe]]
name = "T_pin"
kind = "mean"
field = "temperature"
group = "body_2"
unit = "degC"
)";

fs::path root() {
  return fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "step";
}

void write_files(const std::string& text) {
  fs::create_directories(root());
  std::ofstream(root() / "pin.toml") << text;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("pin on plate");
  const int plate = gmsh::model::occ::addBox(0, 0, 0, 20, 10, 5);
  const int pin = gmsh::model::occ::addCylinder(10, 5, 5, 0, 0, 8, 3);
  gmsh::vectorpair all;
  std::vector<gmsh::vectorpair> map;
  gmsh::model::occ::fragment({{3, plate}}, {{3, pin}}, all, map);
  gmsh::model::occ::synchronize();
  gmsh::write((root() / "pin.step").string());
  gmsh::finalize();
}

TEST(StepCase, RunsWithContactBetweenItsBodies) {
  write_files(k_case);
  const auto r = solidus::testing::run((root() / "pin.toml").string(), "step/pin");
  ASSERT_TRUE(r.finished) << r.reason;
  EXPECT_LT(r.history.at("T_pin[degC]").back(), 490);
  EXPECT_GT(std::abs(r.history.at("contact_heat[W]").back()), 1);
}

TEST(StepCase, SaysWhichSurfacesThereAre) {
  std::string text = k_case;
  text.replace(text.find("numbers = [10]"), 14, "numbers = [12]");
  write_files(text);
  try {
    solidus::testing::run((root() / "pin.toml").string(), "step/pin");
    ADD_FAILURE();
  } catch (const solidus::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the group 'on the plate': the geometry has no surface 12"));
  }
}

/// A box of 60 x 40 x 40 mm with a closed cavity of 20 mm.
std::filesystem::path hollow_box() {
  fs::create_directories(root());
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("hollow box");
  const int box = gmsh::model::occ::addBox(0, 0, 0, 60, 40, 40);
  const int cavity = gmsh::model::occ::addBox(10, 10, 10, 20, 20, 20);
  gmsh::vectorpair all;
  std::vector<gmsh::vectorpair> map;
  gmsh::model::occ::cut({{3, box}}, {{3, cavity}}, all, map);
  gmsh::model::occ::synchronize();
  gmsh::write((root() / "hollow.step").string());
  gmsh::finalize();
  return root() / "hollow.step";
}

TEST(NewCase, OfAHollowPartHasAMouldACoreARiserAndRunsBothWays) {
  solidus::new_case::NewCaseOptions options;
  options.geometry = hollow_box();
  options.alloy = "aluminium_alsi7mg";
  options.riser = true;
  options.symmetry = "y";
  options.fineness = 0.5;
  options.folder = root() / "hollow";
  fs::remove_all(options.folder);
  const solidus::new_case::NewCaseReport report = solidus::new_case::make_new_case(options);
  EXPECT_THAT(report.text, HasSubstr("core"));
  using solidus::cases::Physics;
  for (const Physics physics : {Physics::heat, Physics::thermomechanical}) {
    const solidus::setup::Case c =
        solidus::setup::load_case(report.file, {"time.end=\"3 s\"", "time.step=\"1 s\""}, physics);
    ASSERT_EQ(c.spec.bodies.size(), 4U);
    EXPECT_EQ(c.spec.mechanical_conditions.size(), physics == Physics::heat ? 0U : 2U);  // symmetry
    solidus::run::RunOptions run;
    run.folder = root() / (physics == Physics::heat ? "hollow_heat" : "hollow_coupled");
    const solidus::run::RunResult result = solidus::run::run_case(c, run);
    EXPECT_TRUE(result.finished) << result.reason;
  }
  const solidus::run::CheckedRun checked =
      solidus::run::check_run(solidus::setup::load_case(report.file, {}, Physics::heat));
  double metal = 0, riser = 0;
  for (const auto& body : checked.overview.bodies) {
    if (body.name == "core") {
      EXPECT_NEAR(body.volume, 4e-6, 1e-10);  // half of the cavity
    }
    if (body.name == "casting") metal = body.volume;
    if (body.name == "riser") riser = body.volume;
  }
  EXPECT_NEAR(metal, (96e-6 - 8e-6) / 2, 1e-10);
  // It stands on the plane of symmetry. Its foot is sunk into the part by 0.05 diameters.
  const auto cylinder = solidus::setup::load_case(report.file, {}, Physics::heat).spec.mesh.risers.at(0);
  EXPECT_EQ(cylinder.foot[1], 0.02);
  const double half = std::numbers::pi / 8 * cylinder.diameter * cylinder.diameter * cylinder.height;
  EXPECT_GT(riser, 0.85 * half);
  EXPECT_LT(riser, half);
  EXPECT_THROW(solidus::new_case::make_new_case(options), solidus::InputError);  // there is a case already
}

/// Two balls of 40 mm on a thin bar, 120 mm apart along y.
std::filesystem::path dumbbell() {
  fs::create_directories(root());
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("dumbbell");
  namespace occ = gmsh::model::occ;
  const int left = occ::addSphere(0, -60, 0, 20), right = occ::addSphere(0, 60, 0, 20),
            bar = occ::addCylinder(0, -60, 0, 0, 120, 0, 8);
  gmsh::vectorpair all;
  std::vector<gmsh::vectorpair> map;
  occ::fuse({{3, left}}, {{3, right}, {3, bar}}, all, map);
  occ::synchronize();
  gmsh::write((root() / "dumbbell.step").string());
  gmsh::finalize();
  return root() / "dumbbell.step";
}

TEST(NewCase, WhereAPartIsThickestBesideThePlaneOfSymmetryEachHalfHasARiser) {
  solidus::new_case::NewCaseOptions options;
  options.geometry = dumbbell();
  options.alloy = "aluminium_alsi7mg";
  options.riser = true;
  options.symmetry = "y";
  options.fineness = 0.6;
  options.folder = root() / "dumbbell";
  fs::remove_all(options.folder);
  const solidus::new_case::NewCaseReport report = solidus::new_case::make_new_case(options);
  // Where exactly is a matter of the mesh, and so of the version of Gmsh.
  const std::string before = "the part is thickest ";
  const std::size_t found = report.text.find(before);
  ASSERT_NE(found, std::string::npos) << report.text;
  EXPECT_NEAR(std::stod(report.text.substr(found + before.size())), 60, 0.5);
  EXPECT_THAT(report.text, HasSubstr(" mm off the plane of symmetry: there is a riser on each half"));
  const solidus::setup::Case c = solidus::setup::load_case(report.file, {}, solidus::cases::Physics::heat);
  const solidus::cases::RiserBlockSpec& riser = c.spec.mesh.risers.at(0);
  EXPECT_NEAR(riser.foot[1], -0.06, 1e-3);
  EXPECT_GT(std::abs(riser.foot[1]), 0.5 * riser.diameter);
}

TEST(NewCase, MeshesNearlyTheSameInTheWayThatWasBestBefore) {
  namespace mesh = solidus::mesh;
  const mesh::MeshSource source{hollow_box().string(), 1e-3};
  mesh::KeptMesh kept;
  mesh::mesh_casting(source, {}, 0.15);
  ASSERT_TRUE(kept.search().way);
  EXPECT_EQ(kept.search().way->number, 0);
  EXPECT_GT(kept.search().way->quality, 0.15);
  mesh::CastingGeometry finer;
  finer.sizes = {{"body_1", 8e-3, 4e-3}};
  kept.search().way = mesh::KeptMesh::Way{2, 0.3, false, {}};
  mesh::mesh_casting(source, finer, 0.14);
  EXPECT_EQ(kept.search().way->number, 2);
  // A quality that no way gave before is not looked for in all of them again.
  kept.search().way = mesh::KeptMesh::Way{1, 0.1, true, {}};
  mesh::mesh_casting(source, {}, 1);
  EXPECT_EQ(kept.search().way->number, 1);
}

TEST(NewCase, LooksForTheBestWayWhenWhatWasEnoughIsNotEnoughAnyMore) {
  namespace mesh = solidus::mesh;
  const mesh::MeshSource source{hollow_box().string(), 1e-3};
  mesh::KeptMesh kept;
  kept.search().most_wanted = 0.01;
  const std::size_t nodes = mesh::mesh_casting(source, {}, 1).x.size();
  EXPECT_EQ(kept.search().way->number, 0);
  EXPECT_FALSE(kept.search().way->best_of_all);
  const double first = kept.search().way->quality;
  kept.search().most_wanted = 1;
  mesh::mesh_casting(source, {}, 1);
  EXPECT_TRUE(kept.search().way->best_of_all);
  EXPECT_TRUE(kept.search().way->number == 0 ? kept.search().way->quality == first
                                             : kept.search().way->quality > 1.1 * first);
  kept.search().most_wanted = 0.01;
  if (kept.search().way->number == 0) {
    EXPECT_EQ(mesh::mesh_casting(source, {}, 1).x.size(), nodes);
  }
}

TEST(NewCase, TheWayOfMeshingThatACaseNamesIsTheOnlyOne) {
  namespace mesh = solidus::mesh;
  const mesh::MeshSource source{hollow_box().string(), 1e-3};
  mesh::CastingGeometry geometry;
  geometry.only_way = 1;
  {
    mesh::KeptMesh kept;
    mesh::mesh_casting(source, geometry, 1);  // no mesh has this quality
    EXPECT_EQ(kept.search().way->number, 1);
  }
  geometry.only_way = static_cast<int>(mesh::solid_ways().size());
  EXPECT_THROW(mesh::mesh_casting(source, geometry), solidus::InputError);
}

/// A plate of 60 x 40 x 10 mm in a die of 100 x 80 x 50 mm with a bore of 10 mm along x, 13 mm below the
/// plate.
std::filesystem::path die_with_a_bore() {
  fs::create_directories(root());
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("die with a bore");
  namespace occ = gmsh::model::occ;
  const int plate = occ::addBox(20, 20, 25, 60, 40, 10), die = occ::addBox(0, 0, 0, 100, 80, 50),
            bore = occ::addCylinder(0, 40, 12, 100, 0, 0, 5);
  gmsh::vectorpair all;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{3, die}}, {{3, plate}}, all, map, -1, true, false);
  const gmsh::vectorpair hollow = all;
  occ::cut(hollow, {{3, bore}}, all, map);
  occ::synchronize();
  gmsh::write((root() / "die_with_a_bore.step").string());
  gmsh::finalize();
  return root() / "die_with_a_bore.step";
}

TEST(NewCase, ADrawnDieWithABoreHasWaterInItAndAirOutside) {
  solidus::new_case::NewCaseOptions options;
  options.geometry = die_with_a_bore();
  options.alloy = "aluminium_alsi7mg";
  options.process = "gravity_die";
  options.as = {"body_1=casting", "body_2=die"};
  options.fineness = 0.5;
  options.shots = 3;
  options.folder = root() / "die_with_a_bore";
  fs::remove_all(options.folder);
  const solidus::new_case::NewCaseReport report = solidus::new_case::make_new_case(options);
  EXPECT_THAT(report.text, HasSubstr("1 bore of 10 mm in "));
  EXPECT_THAT(report.text, HasSubstr("the outside of the die cooled by air alone"));
  EXPECT_THAT(report.text,
              Not(HasSubstr("W/m2/K outside the die take")));  // the lumped film of a die without
  const solidus::setup::Case c = solidus::setup::load_case(report.file, {}, solidus::cases::Physics::heat);
  const auto film_on = [&](const std::string& group) {
    for (const auto& condition : c.spec.thermal_conditions)
      if (condition.group == group) return condition;
    throw std::runtime_error("no film on " + group);
  };
  EXPECT_THAT(film_on("body_2_channel_1").name, HasSubstr("water"));
  EXPECT_THAT(film_on("body_2_free").name, HasSubstr("air"));
  const solidus::run::CheckedRun checked = solidus::run::check_run(c);
  EXPECT_GT(checked.overview.bodies.size(), 1U);
}

TEST(NewCase, SaysThatAPartIsNotSymmetric) {
  solidus::new_case::NewCaseOptions options;
  options.geometry = hollow_box();
  options.alloy = "aluminium_alsi7mg";
  options.symmetry = "x";
  options.folder = root() / "hollow_x";
  fs::remove_all(options.folder);
  try {
    solidus::new_case::make_new_case(options);
    ADD_FAILURE();
  } catch (const solidus::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("not symmetric in x"));
  }
}

}  // namespace
