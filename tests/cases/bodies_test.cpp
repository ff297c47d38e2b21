/// Bodies that only conduct heat and bodies that leave, in whole runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "case_folder.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::at;
using solidus::testing::CaseRun;
using solidus::testing::read_text;
using ::testing::HasSubstr;

const solidus::testing::CaseFolder k_here("bodies");

/// A number of summary.json.
double summary(const std::string& name, const std::string& key) {
  const std::string text = read_text(k_here.root() / name / "summary.json");
  const std::size_t found = text.find("\"" + key + "\":");
  return found == std::string::npos ? NAN : std::strtod(text.c_str() + found + key.size() + 3, nullptr);
}

double mechanical_bytes(const std::string& name) {
  const std::string text = read_text(k_here.root() / name / "summary.json");
  const std::string key = "\"mechanics\":";
  const std::size_t found = text.find(key, text.find("tables[bytes]"));
  return found == std::string::npos ? NAN : std::strtod(text.c_str() + found + key.size(), nullptr);
}

/// A mould that neither expands nor yields, so that only its heat is felt.
const std::string k_stiff_sand = R"(title = "Sand of no expansion"
[density]
value = "1600 kg/m3"
[conductivity]
value = "0.8 W/m/K"
[specific_heat]
value = "1100 J/kg/K"
[young_modulus]
value = "2000 GPa"
[poisson_ratio]
value = 0.0
[expansion]
value = "0 1/K"
)";
/// A hot block in a sand box, of which it is a part without a gap: conforming, symmetric on the left and
/// below.
const std::string k_box = R"(
s = 0.005;
Point(1) = {0, 0, 0, s}; Point(2) = {0.02, 0, 0, s}; Point(3) = {0.05, 0, 0, s};
Point(4) = {0, 0.01, 0, s}; Point(5) = {0.02, 0.01, 0, s};
Point(6) = {0, 0.03, 0, s}; Point(7) = {0.05, 0.03, 0, s};
Line(1) = {1, 2}; Line(2) = {2, 5}; Line(3) = {5, 4}; Line(4) = {4, 1};
Line(5) = {2, 3}; Line(6) = {3, 7}; Line(7) = {7, 6}; Line(8) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8, -3, -2}; Plane Surface(2) = {2};
Physical Surface("part") = {1}; Physical Surface("sand") = {2};
Physical Curve("interface") = {2, 3}; Physical Curve("left") = {4, 8}; Physical Curve("below") = {1, 5};
Physical Curve("sand_outside") = {6, 7};
)";
/// The part cools in the box, then in air.
const std::string k_shake_out = R"(title = "Shake-out"
stage = [
  { name = "cool", duration = "200 s", step = "20 s" },
  { name = "air", duration = "100 s", step = "10 s" },
]
[analysis]
kind = "plane_strain"
[mesh]
file = "box.geo"
[time]
[mechanics]
tolerance = 1e-9
simplices = "displacement"
[[body]]
name = "part"
material = "aluminium_99_7"
initial_temperature = "600 degC"
[[body]]
name = "sand"
material = "stiff_sand.toml"
initial_temperature = "20 degC"
stages = "cool"
[[thermal_condition]]
name = "air"
group = "interface"
kind = "film"
coefficient = "200 W/m2/K"
ambient = "20 degC"
stages = "air"
[[thermal_condition]]
name = "outside"
group = "sand_outside"
kind = "film"
coefficient = "20 W/m2/K"
ambient = "20 degC"
[[mechanical_condition]]
name = "left"
group = "left"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "below"
group = "below"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "box"
group = "sand_outside"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[probe]]
name = "T_part"
kind = "mean"
field = "temperature"
group = "part"
unit = "degC"
[[probe]]
name = "T_sand"
kind = "point"
field = "temperature"
point = ["40 mm", "20 mm"]
body = "sand"
unit = "degC"
[[probe]]
name = "T_highest"
kind = "maximum"
field = "temperature"
group = "below"
unit = "degC"
[[probe]]
name = "sxx"
kind = "maximum"
field = "stress"
component = "xx"
group = "part"
unit = "MPa"
[[probe]]
name = "ux"
kind = "point"
field = "displacement"
component = "x"
point = ["20 mm", "2 mm"]
body = "part"
unit = "mm"
)";

class Bodies : public ::testing::Test {
 protected:
  void SetUp() override {
    k_here.write("stiff_sand.toml", k_stiff_sand);
    k_here.write("box.geo", k_box);
  }
};

/// Defect of the energy audit of a finished run, as a share of the heat moved.
double defect(const std::string& name) {
  return summary(name, "relative_energy_defect");
}

TEST_F(Bodies, ThatLeaveLetThePartSpringBackAndCoolInAir) {
  const CaseRun r = k_here.run("shake_out", k_shake_out);
  ASSERT_TRUE(r.finished) << r.reason;
  // Held by sand of 2000 GPa the part cannot shrink. Without it, it is what it would be in sand that had
  // never held it: it is elastic, and deformation hardly moves temperatures.
  const CaseRun free = k_here.run("free", k_shake_out, {"body.sand.physics=heat"});
  ASSERT_TRUE(free.finished) << free.reason;
  EXPECT_GT(at(r.history, "sxx[MPa]", 200), 100);
  EXPECT_LT(at(free.history, "sxx[MPa]", 200), 10);
  EXPECT_LT(std::abs(at(r.history, "ux[mm]", 200)), 0.1 * std::abs(at(free.history, "ux[mm]", 200)));
  for (const double time : {210.0, 300.0}) {
    EXPECT_LT(at(r.history, "sxx[MPa]", time), 10) << time;
    EXPECT_NEAR(at(r.history, "ux[mm]", time), at(free.history, "ux[mm]", time),
                0.01 * std::abs(at(free.history, "ux[mm]", time)))
        << time;
  }
  EXPECT_LT(at(r.history, "T_part[degC]", 300), at(r.history, "T_part[degC]", 200) - 100);
  EXPECT_EQ(at(r.history, "T_sand[degC]", 300), at(r.history, "T_sand[degC]", 210));
  EXPECT_LT(std::abs(defect("shake_out")), 1e-6);
  EXPECT_THAT(read_text(k_here.root() / "shake_out/fields/fields_00002.vtu"), HasSubstr("vtkGhostType"));
}

TEST_F(Bodies, LeaveBySchemesOfEveryKind) {
  for (const char* scheme : {"isothermal", "simultaneous", "block_iterative"}) {
    const CaseRun r = k_here.run(scheme, k_shake_out, {std::string("coupling.scheme=") + scheme});
    ASSERT_TRUE(r.finished) << scheme << ": " << r.reason;
    EXPECT_LT(at(r.history, "sxx[MPa]", 210), 10) << scheme;
    EXPECT_LT(std::abs(defect(scheme)), 1e-6) << scheme;
  }
}

// The bodies share nodes, at which each has a pressure.
TEST_F(Bodies, LeaveWithPressuresOfTheirOwn) {
  for (const char* scheme : {"isentropic", "simultaneous"})
    for (const char* sand : {"all", "heat"})
      for (const char* stabilisation : {"algebraic", "orthogonal"}) {
        const std::string name = std::string("pressure_") + scheme + "_" + sand + "_" + stabilisation;
        const std::vector<std::string> overrides{std::string("coupling.scheme=") + scheme,
                                                 "mechanics.simplices=mixed",
                                                 std::string("mechanics.stabilisation=") + stabilisation,
                                                 std::string("body.sand.physics=") + sand};
        const CaseRun r = k_here.run(name, k_shake_out, overrides);
        ASSERT_TRUE(r.finished) << name << ": " << r.reason;
        EXPECT_LT(at(r.history, "sxx[MPa]", 210), 10) << name;
        EXPECT_LT(std::abs(defect(name)), 1e-6) << name;
        k_here.expect_exact_restart(name + "_on", k_shake_out, 10, overrides);
      }
}

TEST_F(Bodies, GoOnWithTheSameBitsBeforeAtAndAfterTheyLeave) {
  k_here.expect_exact_restart("before", k_shake_out, 6);
  k_here.expect_exact_restart("at", k_shake_out, 10);
  k_here.expect_exact_restart("after", k_shake_out, 14);
  k_here.expect_exact_restart("conducting", k_shake_out, 14, {"body.sand.physics=heat"});
}

TEST_F(Bodies, ARunThatStopsRightAfterItWentOnKeepsWhatItsSummarySaid) {
  const std::string file = k_here.write("again.toml", k_shake_out);
  const auto stop = [&](bool restart, int steps) {
    solidus::run::RunOptions options;
    options.folder = k_here.root() / "again";
    options.restart = restart;
    int asked = 0;
    options.stop_asked = [&asked, steps] { return asked++ == steps; };
    EXPECT_FALSE(solidus::run::run_case(solidus::setup::load_case(file), options).finished);
    return summary("again", "sxx[MPa]");
  };
  const double stress = stop(false, 6);
  EXPECT_GT(stress, 1);
  EXPECT_EQ(stop(true, 0), stress);
}

// Sand of 2000 GPa against sand that stands still by definition: what is left of its yielding is the bound of
// the displacements, 1e-4 of the shrinkage, and temperatures feel displacements by the work of stresses
// alone.
TEST_F(Bodies, ThatOnlyConductGiveTheTemperaturesOfAMouldThatDoesNotMove) {
  // Contact instead of shared nodes: the part can shrink away from both.
  const std::string touching = R"(title = "A hot block on sand"
[analysis]
kind = "plane_strain"
gravity = "9.81 m/s2"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["60 mm", "30 mm"]
upper = ["60 mm", "20 mm"]
lower_divisions = [12, 8]
upper_divisions = [10, 4]
[time]
end = "100 s"
step = "10 s"
[mechanics]
tolerance = 1e-9
[[body]]
name = "lower"
material = "stiff_sand.toml"
initial_temperature = "20 degC"
[[body]]
name = "upper"
material = "aluminium_99_7"
initial_temperature = "600 degC"
[[contact]]
name = "faces"
surfaces = ["lower_top", "upper_bottom"]
penalty = "1e14 N/m3"
[contact.heat]
conductance = "500 W/m2/K"
gap_law = "gas"
open_conductance = "500 W/m2/K"
gas_conductivity = "0.06 W/m/K"
[[mechanical_condition]]
name = "symmetry"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "sand_sides"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "sand_below"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[thermal_condition]]
name = "sand_below"
group = "lower_y_min"
kind = "temperature"
temperature = "20 degC"
[[probe]]
name = "T"
kind = "mean"
field = "temperature"
group = "upper"
unit = "degC"
[[probe]]
name = "uy"
kind = "point"
field = "displacement"
component = "y"
point = ["60 mm", "50 mm"]
unit = "mm"
)";
  const CaseRun elastic = k_here.run("elastic", touching),
                rigid = k_here.run("rigid", touching, {"body.lower.physics=heat"});
  ASSERT_TRUE(elastic.finished && rigid.finished) << elastic.reason << rigid.reason;
  for (const double time : {10.0, 50.0, 100.0}) {
    EXPECT_NEAR(at(rigid.history, "T[degC]", time), at(elastic.history, "T[degC]", time), 1e-4) << time;
    EXPECT_NEAR(at(rigid.history, "uy[mm]", time), at(elastic.history, "uy[mm]", time), 1e-6) << time;
  }
  EXPECT_LT(std::abs(defect("rigid")), 1e-6);
  // The sand has 96 of 136 elements. Bytes of the phase's tables and matrix.
  EXPECT_LT(mechanical_bytes("rigid"), 0.6 * mechanical_bytes("elastic"));
}

TEST_F(Bodies, OnTwoProcessesAreTheSame) {
  const CaseRun r = k_here.run("serial", k_shake_out);
  ASSERT_TRUE(r.finished) << r.reason;
  const std::string file = k_here.write("parallel.toml", k_shake_out);
  // This program is one of MPI too: its environment would confuse mpirun.
  const std::string command =
      "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
      "OMPI_ALLOW_RUN_AS_ROOT=1 "
      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n 2 --bind-to none "
      "--oversubscribe '" SOLIDUS_BINARY_DIR "/solidus' run '" +
      file + "' -o '" + (k_here.root() / "parallel").string() + "' >/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto two = solidus::testing::read_csv(k_here.root() / "parallel/history.csv");
  for (const char* column : {"T_part[degC]", "T_highest[degC]", "sxx[MPa]", "ux[mm]"})
    for (const double time : {200.0, 210.0, 300.0})
      EXPECT_NEAR(at(two, column, time), at(r.history, column, time),
                  1e-6 * (1 + std::abs(at(r.history, column, time))))
          << column << " at " << time;
}

TEST_F(Bodies, ACheckpointIsOfTheBodiesThatWereThere) {
  ASSERT_TRUE(k_here.run("once", k_shake_out).finished);
  solidus::run::RunOptions options;
  options.folder = k_here.root() / "once";
  options.restart = true;
  try {
    solidus::run::run_case(
        solidus::setup::load_case(k_here.write("once.toml", k_shake_out), {"body.sand.physics=heat"}),
        options);
    ADD_FAILURE();
  } catch (const solidus::InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("'part, sand in cool', that of this case 'part, sand that only conducts in cool'"));
  }
}

TEST_F(Bodies, WhatNamesAStageInWhichItsBodyHasGoneIsRefused) {
  const std::string film = R"([[thermal_condition]]
name = "too late"
group = "sand_outside"
kind = "film"
coefficient = "20 W/m2/K"
ambient = "20 degC"
stages = ["cool", "air"]
)";
  EXPECT_THAT(k_here.refusal("too_late", k_shake_out + film),
              HasSubstr("the thermal condition 'too late' holds in the stage 'air', but its body has gone"));
}

}  // namespace
