/// Stages in whole runs: switches of conditions and contact, cycles, restart inside a stage, two processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "case_folder.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::CaseRun;
using solidus::testing::Columns;
using solidus::testing::read_text;
using ::testing::HasSubstr;

/// A plate on a block: pressed by 10 MPa, pushed by 2 mm, let go, lifted and brought back without contact.
const std::string k_strokes = R"(title = "A plate on a block, three strokes"
stage = [
  { name = "press",   duration = "1 s", steps = 4 },
  { name = "slide",   duration = "1 s", steps = 4 },
  { name = "release", duration = "1 s", steps = 2 },
  { name = "return",  duration = "1 s", steps = 2 },
]
cycle = [{ name = "strokes", stages = ["press", "slide", "release", "return"], repeat = 3 }]

[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "10 mm"]
upper = ["40 mm", "5 mm"]
lower_divisions = [8, 2]
upper_divisions = [8, 1]
gap = "0.1 mm"
[time]
[mechanics]
tolerance = 1e-9

[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "20 degC"
[[body]]
name = "upper"
material = "steel_mould"
initial_temperature = "20 degC"

[[mechanical_condition]]
name = "ground"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "flat"
group = "upper_y_max"
kind = "plane"
stages = ["press", "slide", "release"]
[[mechanical_condition]]
name = "force rises"
group = "upper_y_max"
kind = "pressure"
pressure = { of = "time", points = [["0 s", "0 MPa"], ["1 s", "10 MPa"]] }
time = "stage"
stages = "press"
[[mechanical_condition]]
name = "force holds"
group = "upper_y_max"
kind = "pressure"
pressure = "10 MPa"
stages = "slide"
[[mechanical_condition]]
name = "no push"
group = "upper_y_max"
kind = "displacement"
ux = "0 mm"
relative = true
stages = ["press", "release"]
[[mechanical_condition]]
name = "push"
group = "upper_y_max"
kind = "displacement"
ux = { of = "time", points = [["0 s", "0 mm"], ["1 s", "2 mm"]] }
relative = true
time = "stage"
stages = "slide"
[[mechanical_condition]]
name = "lift and back"
group = "upper_y_max"
kind = "displacement"
ux = { of = "time", points = [["0 s", "0 mm"], ["1 s", "-2 mm"]] }
uy = { of = "time", points = [["0 s", "0 mm"], ["0.5 s", "5 mm"], ["1 s", "0 mm"]] }
relative = true
time = "stage"
stages = "return"

[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
stages = ["press", "slide", "release"]

[[probe]]
name = "ux"
kind = "point"
field = "displacement"
component = "x"
point = ["20 mm", "15.1 mm"]
unit = "mm"
[[probe]]
name = "uy"
kind = "point"
field = "displacement"
component = "y"
point = ["20 mm", "15.1 mm"]
unit = "mm"
)";

const solidus::testing::CaseFolder k_here("stages");

/// The value of a column at the end of a stage of a cycle.
double at_end(const Columns& c, const std::string& column, int stage, int cycle) {
  double value = NAN;
  for (std::size_t i = 0; i < c.at("time[s]").size(); ++i)
    if (c.at("stage[1]")[i] == stage && c.at("cycle[1]")[i] == cycle) value = c.at(column)[i];
  return value;
}

TEST(Stages, SwitchLoadsSupportsAndContact) {
  const CaseRun r = k_here.run("strokes", k_strokes);
  ASSERT_TRUE(r.finished) << r.reason;
  ASSERT_EQ(r.history.at("time[s]").size(), 37u);
  for (int cycle = 1; cycle <= 3; ++cycle) {
    // 10 MPa on 40 mm by one metre; the gap of 0.1 mm and the penetration are the tolerance of the lever arm.
    EXPECT_NEAR(at_end(r.history, "contact_force[N]", 1, cycle), 400e3, 1e-3) << cycle;
    EXPECT_NEAR(at_end(r.history, "contact_force[N]", 2, cycle), 400e3, 1e-3) << cycle;
    EXPECT_NEAR(at_end(r.history, "contact_force[N]", 3, cycle), 0, 1e-3) << cycle;
    EXPECT_EQ(at_end(r.history, "contact_force[N]", 4, cycle), 0) << cycle;
    EXPECT_EQ(at_end(r.history, "closed_fraction[1]", 4, cycle), 0) << cycle;
    EXPECT_NEAR(at_end(r.history, "ux[mm]", 1, cycle), 0, 1e-12) << cycle;
    EXPECT_NEAR(at_end(r.history, "ux[mm]", 2, cycle), 2, 1e-12) << cycle;
    EXPECT_NEAR(at_end(r.history, "ux[mm]", 4, cycle), 0, 1e-12) << cycle;
    EXPECT_NEAR(at_end(r.history, "uy[mm]", 4, cycle), at_end(r.history, "uy[mm]", 3, cycle), 1e-12) << cycle;
    EXPECT_NEAR(at_end(r.history, "uy[mm]", 2, cycle), at_end(r.history, "uy[mm]", 2, 1), 1e-9) << cycle;
  }
  const std::vector<double>& uy = r.history.at("uy[mm]");
  EXPECT_NEAR(uy[11] - uy[10], 5, 1e-12);  // in the air
}

TEST(Stages, AToolIsLiftedAndBackInOneStep) {
  const CaseRun r = k_here.run("one_step", k_strokes, {"stage.return.steps=1", "stage.release.steps=1"});
  ASSERT_TRUE(r.finished) << r.reason;
  // One step more a cycle than asked for: it ends where the path of the tool bends.
  EXPECT_EQ(r.history.at("time[s]").size(), 34u);
  EXPECT_NEAR(at_end(r.history, "ux[mm]", 4, 3), 0, 1e-12);
  EXPECT_NEAR(at_end(r.history, "contact_force[N]", 2, 3), 400e3, 1e-3);
}

TEST(Stages, ARunGoesOnInsideAStageWithTheSameBits) {
  k_here.expect_exact_restart("inside_slide", k_strokes, 18);
  k_here.expect_exact_restart("inside_return", k_strokes, 23);
}

TEST(Stages, ARunGoesOnBetweenStagesWithTheSameBits) {
  k_here.expect_exact_restart("between", k_strokes, 16);
}

TEST(Stages, ARunGoesOnInsideAStageWithTheSameBitsOfATwoStepMethodAndAdaptiveSteps) {
  k_here.expect_exact_restart("two_step", k_strokes, 18,
                              {"mechanics.integration=bdf2", "body.lower.material=aluminium_99_7"});
  k_here.expect_exact_restart("adaptive", k_strokes, 20, {"time.adaptive=true"});
}

TEST(Stages, InertiaGoesOnThroughThem) {
  for (const char* method : {"backward_euler", "generalised_alpha"}) {
    const CaseRun r = k_here.run(method, k_strokes, {std::string("dynamics.method=") + method});
    ASSERT_TRUE(r.finished) << r.reason;
    EXPECT_NEAR(at_end(r.history, "ux[mm]", 2, 3), 2, 1e-12);
  }
}

/// The same plate, pressed and dragged over the block, which lets it through from 0.2 ms on.
const std::string k_let_go = R"(title = "A plate whose block goes"
stage = [
  { name = "press", duration = "0.2 ms", steps = 20 },
  { name = "gone",  duration = "0.1 ms", steps = 10 },
]
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "10 mm"]
upper = ["40 mm", "5 mm"]
lower_divisions = [8, 2]
upper_divisions = [8, 1]
[time]
[coupling]
scheme = "isentropic"
[mechanics]
tolerance = 1e-10
[heat]
tolerance = 1e-12
[dynamics]
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "20 degC"
[[body]]
name = "upper"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "ground"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "force"
group = "upper_y_max"
kind = "pressure"
pressure = "100 MPa"
[[mechanical_condition]]
name = "drag"
group = "upper_y_max"
kind = "traction"
traction = ["60 MPa", "0 MPa"]
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
stages = "press"
[contact.heat]
conductance = "1000 W/m2/K"
gap_law = "constant"
)";

// The mean over the first step without contact holds half of its last force: the work of that is booked.
TEST(Stages, ContactThatIsSwitchedOffKeepsTheFirstLawWithInertia) {
  for (const char* method : {"backward_euler", "trapezoidal", "generalised_alpha"})
    for (const bool friction : {false, true}) {
      std::vector<std::string> overrides{std::string("dynamics.method=") + method};
      if (friction) overrides.push_back("contact.faces.friction.coefficient=0.3");
      const CaseRun r =
          k_here.run(std::string("let_go_") + method + (friction ? "_rough" : ""), k_let_go, overrides);
      ASSERT_TRUE(r.finished) << r.reason;
      const std::vector<double>&defect = r.history.at("energy_defect[J]"), &work = r.history.at("work[J]"),
            &force = r.history.at("contact_force[N]");
      ASSERT_EQ(defect.size(), 31u);
      EXPECT_GT(force[20], 1e5) << method;
      EXPECT_EQ(force[21], 0) << method;
      EXPECT_GT(work.back(), 100) << method;
      for (std::size_t i = 0; i < defect.size(); ++i)
        EXPECT_LT(std::abs(defect[i]), 1e-7 * work.back())
            << method << (friction ? " with friction, row " : ", row ") << i;
    }
}

TEST(Stages, MoreCyclesMakeAFinishedRunLonger) {
  const std::string file = k_here.write("longer.toml", k_strokes);
  const auto go = [&](const std::string& repeat, bool restart) {
    solidus::run::RunOptions options;
    options.folder = k_here.root() / "longer";
    options.restart = restart;
    const auto c = solidus::setup::load_case(file, {"cycle.strokes.repeat=" + repeat});
    return solidus::run::run_case(c, options).finished;
  };
  ASSERT_TRUE(go("1", false));
  ASSERT_TRUE(go("2", true));
  EXPECT_EQ(solidus::testing::read_csv(k_here.root() / "longer/history.csv").at("time[s]").back(), 8);
}

/// A casting in a cold block; later out of it, in air.
const std::string k_ejection = R"(title = "Pour, cool, eject"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
upper = ["40 mm", "10 mm"]
lower_divisions = [4, 8]
upper_divisions = [4, 4]
[time]
step = "1 s"

[heat]
tolerance = 1e-9                        # means and processes are compared to 1e-6 K

[[stage]]
name = "pour"
duration = "2 s"
[[stage]]
name = "cool"
duration = "20 s"
[[stage]]
name = "eject"
duration = "30 s"
step = "3 s"

[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "20 degC"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "680 degC"

[[thermal_condition]]
name = "stream"
group = "upper_y_max"
kind = "temperature"
temperature = "680 degC"
stages = "pour"
[[thermal_condition]]
name = "air"
group = "upper_bottom"
kind = "film"
coefficient = "200 W/m2/K"
ambient = "20 degC"
stages = "eject"

[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
penalty = "1e13 N/m3"
stages = ["pour", "cool"]
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "constant"

[[probe]]
name = "T_mould"
kind = "mean"
field = "temperature"
group = "lower"
unit = "degC"
[[probe]]
name = "T_top"
kind = "maximum"
field = "temperature"
group = "upper"
unit = "degC"
)";

double at(const CaseRun& r, const std::string& name, double time) {
  return solidus::testing::at(r.history, name, time);
}

TEST(Stages, APartIsPouredCooledAndEjected) {
  const CaseRun r = k_here.run("ejection", k_ejection);
  ASSERT_TRUE(r.finished) << r.reason;
  EXPECT_NEAR(at(r, "T_top[degC]", 2), 680, 1e-9);
  EXPECT_GT(at(r, "heat_in[J]", 2), 0);                                // the stream holds its temperature
  EXPECT_NEAR(at(r, "heat_in[J]", 22), at(r, "heat_in[J]", 2), 1e-9);  // insulated but for the contact
  EXPECT_LT(at(r, "T_top[degC]", 22), 680);                            // and so let go
  EXPECT_GT(at(r, "contact_heat[W]", 22), 0);
  EXPECT_EQ(at(r, "contact_heat[W]", 25), 0);
  EXPECT_NEAR(at(r, "T_mould[degC]", 52), at(r, "T_mould[degC]", 22),
              1e-6);  // insulated, of constant capacity: it keeps its mean
  EXPECT_LT(at(r, "heat_in[J]", 52), at(r, "heat_in[J]", 22));
  // The stored heat equals the heat that came in, through all changes of stage.
  EXPECT_NEAR(at(r, "stored_heat[J]", 52), at(r, "heat_in[J]", 52), 1e-8 * at(r, "heat_exchanged[J]", 52));
  EXPECT_EQ(r.steps.at("time[s]").size(), 32u);
}

TEST(Stages, TwoProcessesAgree) {
  const CaseRun one = k_here.run("serial", k_strokes), hot = k_here.run("serial_hot", k_ejection);
  const auto two = [](const std::string& name, const std::string& c) {
    const fs::path folder = k_here.root() / name;
    const std::string command =
        "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
        "OMPI_ALLOW_RUN_AS_ROOT=1 "
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n 2 --bind-to none "
        "--oversubscribe '" SOLIDUS_BINARY_DIR "/solidus' run '" +
        k_here.write(name + std::string(".toml"), c) + "' -o '" + folder.string() + "' > '" +
        folder.string() + ".log' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_text(folder.string() + ".log");
    return solidus::testing::read_csv(folder / "history.csv");
  };
  const Columns strokes = two("parallel", k_strokes), ejection = two("parallel_hot", k_ejection);
  ASSERT_EQ(strokes.at("uy[mm]").size(), one.history.at("uy[mm]").size());
  for (std::size_t i = 0; i < one.history.at("uy[mm]").size(); ++i) {
    EXPECT_NEAR(strokes.at("uy[mm]")[i], one.history.at("uy[mm]")[i], 1e-9) << i;
    EXPECT_NEAR(strokes.at("contact_force[N]")[i], one.history.at("contact_force[N]")[i], 1e-2) << i;
  }
  for (std::size_t i = 0; i < hot.history.at("T_top[degC]").size(); ++i)
    EXPECT_NEAR(ejection.at("T_top[degC]")[i], hot.history.at("T_top[degC]")[i], 1e-6) << i;
}

}  // namespace
