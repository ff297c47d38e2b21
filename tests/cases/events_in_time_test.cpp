/// Pulses between two steps, and loads smaller than the elements or faster than the steps: heat and strain
/// are those of the functions in the case file (docs/guide/time_steps.md, docs/guide/places.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "case_folder.hpp"
#include "restarted_run.hpp"

namespace solidus {
namespace {

using testing::CaseFolder;
using testing::CaseRun;

const std::string k_metal = R"(title = "metal"
density = "7800 kg/m3"
conductivity = "30 W/m/K"
specific_heat = "600 J/kg/K"
)";

/// A bar of 20 mm with 2 mm² of skin at its end.
std::string bar(const std::string& time, const std::string& flux) {
  return R"(title = "A bar"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "2 mm"]
divisions = [40, 1]
[time]
)" + time +
         R"(
[[body]]
name = "block"
material = "m.toml"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "load"
group = "x_min"
kind = "flux"
flux = )" +
         flux + R"(
[[probe]]
name = "T"
field = "temperature"
kind = "mean"
group = "block"
unit = "degC"
)";
}

const std::string k_fixed = "end = \"200 s\"\nstep = \"1 s\"", k_adaptive = k_fixed + "\nadaptive = true";
const std::string k_pulse =
    "{ of = \"time\", argument_unit = \"s\", unit = \"W/m2\", points = [[0, 0], [53.3, 0], [53.301, 1e6], "
    "[54.3, 1e6], [54.301, 0], [1000, 0]] }";

std::string points(const std::vector<std::array<double, 2>>& table) {
  std::ostringstream text;
  text.precision(17);
  text << "{ of = \"time\", argument_unit = \"s\", unit = \"W/m2\", points = [";
  for (std::size_t i = 0; i < table.size(); ++i)
    text << (i > 0 ? ", [" : "[") << table[i][0] << ", " << table[i][1] << "]";
  text << "] }";
  return text.str();
}

class EventsInTime : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_.root());
    folder_.write("m.toml", k_metal);
  }
  CaseRun run(const std::string& name, const std::string& text,
              const std::vector<std::string>& overrides = {}) const {
    CaseRun result = folder_.run(name, text, overrides);
    EXPECT_TRUE(result.finished) << result.reason;
    return result;
  }
  static double heat_in(const CaseRun& run) { return run.history.at("heat_in[J]").back(); }
  CaseFolder folder_{"events_in_time"};
};

TEST_F(EventsInTime, APulseOfASecondBringsItsHeatWhateverTheSteps) {
  for (const std::string& time : {k_fixed, k_adaptive, std::string("end = \"200 s\"\nstep = \"7 s\"")}) {
    const CaseRun pulse = run("pulse", bar(time, k_pulse));
    EXPECT_NEAR(heat_in(pulse), 2000, 1e-6) << time;
    EXPECT_NEAR(pulse.history.at("T[degC]").back(), 200 + 2000 / (7800 * 600 * 40e-6), 1e-6);
  }
}

TEST_F(EventsInTime, FixedStepsEndAtThePointsOfATableAndGoOnFromThere) {
  const std::vector<double> times = run("fixed", bar(k_fixed, k_pulse)).steps.at("time[s]");
  for (const double point : {53.3, 53.301, 54.3, 54.301, 55.301})
    EXPECT_NE(std::ranges::find_if(times, [&](double t) { return std::abs(t - point) < 1e-9; }), times.end())
        << point;
}

TEST_F(EventsInTime, APulseShorterThanTheSmallestStepBringsItsHeat) {
  const std::string pulse =
      points({{0, 0}, {53.3, 0}, {53.3 + 1e-7, 1e9}, {53.3 + 2e-7, 1e9}, {53.3 + 3e-7, 0}, {1000, 0}});
  for (const std::string& time : {k_fixed, k_adaptive}) {
    const CaseRun short_pulse = run("short", bar(time, pulse));
    EXPECT_NEAR(heat_in(short_pulse), 0.002 * 1e9 * 2e-7, 1e-6) << time;
    EXPECT_GT(*std::ranges::min_element(short_pulse.steps.at("dt[s]")), 0.9 / 1024);
  }
}

TEST_F(EventsInTime, TwentyPulsesOfAFormulaBringTheirHeat) {
  const std::string pulses = R"~({ formula = "1e6*(t-10*rint(t/10-0.5)<1)", unit = "W/m2" })~";
  for (const std::string& time : {k_fixed, k_adaptive})
    EXPECT_NEAR(heat_in(run("pulses", bar(time, pulses))), 40000, 1) << time;
}

TEST_F(EventsInTime, AConditionOfTimeInAFormulaOfPlaceIsMet) {
  const std::string pulse = R"~({ formula = "1e6*(t>53.3 && t<54.3)*(1+0*y)", unit = "W/m2" })~";
  for (const std::string& time : {k_fixed, k_adaptive})
    EXPECT_NEAR(heat_in(run("placed", bar(time, pulse))), 2000, 0.1) << time;
}

TEST_F(EventsInTime, AFilmThatIsOnForASecondGivesWhatAFineRunGives) {
  std::string film = bar(k_fixed, k_pulse);
  film.replace(film.find("kind = \"flux\""), 13, "kind = \"film\"\nambient = \"20 degC\"");
  film.replace(film.find("flux = {"), 8, "coefficient = {");
  film.replace(film.find("W/m2"), 4, "W/m2/K");
  while (film.find("1e6") != std::string::npos) film.replace(film.find("1e6"), 3, "1e3");
  const double fine = heat_in(run("film_fine", film, {"time.step=\"0.02 s\""}));
  EXPECT_LT(fine, -300);
  EXPECT_NEAR(heat_in(run("film", film)), fine, 0.02 * std::abs(fine));
  EXPECT_NEAR(heat_in(run("film_adaptive", film, {"time.adaptive=true"})), fine, 0.02 * std::abs(fine));
}

TEST_F(EventsInTime, AHundredThousandPointsBringTheirHeatInAFewSteps) {
  std::string table = "{ of = \"time\", argument_unit = \"s\", unit = \"W/m2\", points = [";
  for (int i = 0; i <= 100000; ++i)
    table += (i > 0 ? ", [" : "[") + std::to_string(i * 0.002) + ", " +
             std::to_string(1e5 * (1 + (i % 2 == 0 ? 0.002 : -0.002))) + "]";
  const CaseRun noisy = run("noisy", bar(k_adaptive, table + "] }"));
  EXPECT_NEAR(heat_in(noisy), 1e5 * 0.002 * 200, 1e-3);
  EXPECT_LT(noisy.steps.at("time[s]").size(), 100U);
}

TEST_F(EventsInTime, TablesWithTimesThatDifferByRoundingCostNoSlivers) {
  std::string two = bar(k_adaptive, points({{0, 0}, {50, 0}, {51, 1e6}, {52, 0}}));
  two += "[[thermal_condition]]\nname = \"other\"\ngroup = \"x_max\"\nkind = \"flux\"\nflux = " +
         points({{0, 0}, {50 + 1e-12, 0}, {51 + 1e-12, 1e6}, {52 - 1e-12, 0}}) + "\n";
  const CaseRun both = run("two", two);
  EXPECT_NEAR(heat_in(both), 4000, 1e-6);
  EXPECT_GT(*std::ranges::min_element(both.steps.at("dt[s]")), 1e-4);
}

TEST_F(EventsInTime, ATableThatBeginsLaterAndEndsAtTheEndOfTheRunIsMet) {
  const CaseRun late = run("late", bar(k_fixed, points({{100.5, 0}, {100.75, 1e6}, {101, 0}, {200, 1e5}})));
  EXPECT_NEAR(heat_in(late), 0.002 * (0.25e6 + 0.5 * 99 * 1e5), 1e-6);
  EXPECT_EQ(late.steps.at("time[s]").back(), 200);
}

TEST_F(EventsInTime, ARestartInAPulseGivesTheSameBits) {
  folder_.expect_exact_restart("restart", bar(k_adaptive, k_pulse), 14, {"output.checkpoint_every=1"});
  folder_.expect_exact_restart("restart_fixed", bar(k_fixed, k_pulse), 55, {"output.checkpoint_every=1"});
}

TEST_F(EventsInTime, AStageMeetsTheEventsOfItsOwnClock) {
  std::string staged = bar("step = \"1 s\"", points({{0, 0}, {3.3, 0}, {3.4, 1e6}, {3.5, 0}}));
  staged.replace(staged.find("kind = \"flux\""), 13, "kind = \"flux\"\ntime = \"stage\"");
  staged +=
      "[[stage]]\nname = \"one\"\nduration = \"10 s\"\n[[stage]]\nname = \"two\"\nduration = \"5.5 s\"\n";
  const CaseRun stages = run("stages", staged);
  EXPECT_NEAR(heat_in(stages), 2 * 0.002 * 1e5, 1e-6);
  for (const double point : {3.3, 3.4, 3.5, 13.3, 13.4, 13.5})
    EXPECT_NE(std::ranges::find_if(stages.steps.at("time[s]"),
                                   [&](double t) { return std::abs(t - point) < 1e-9; }),
              stages.steps.at("time[s]").end())
        << point;
}

TEST_F(EventsInTime, APullBetweenTwoStepsLeavesItsPlasticStrain) {
  folder_.write("steel.toml", k_metal + R"(young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "0 1/K"
[plasticity]
flow_stress = "200 MPa"
isotropic_hardening = "linear"
hardening_modulus = "2 GPa"
)");
  const std::string pull = R"(title = "Pull"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [2, 2]
[time]
end = "200 s"
step = "1 s"
adaptive = true
[[body]]
name = "block"
material = "steel.toml"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "sx"
group = "x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "sy"
group = "y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "pull"
group = "x_max"
kind = "displacement"
ux = { of = "time", argument_unit = "s", unit = "mm", points = [[0, 0], [53.2, 0], [53.5, 0.1], [53.8, 0], [200, 0]] }
[[probe]]
name = "peeq"
field = "equivalent_plastic_strain"
kind = "mean"
group = "block"
unit = "1"
)";
  EXPECT_NEAR(run("pull", pull).history.at("peeq[1]").back(), 0.0188, 2e-4);
  EXPECT_NEAR(run("pull_fixed", pull, {"time.adaptive=false"}).history.at("peeq[1]").back(), 0.0188, 2e-4);
}

/// A spray of −1 MW/m² between two coordinates, on elements of 5 mm.
std::string spray(double from, double to) {
  std::ostringstream text;
  text << R"(title = "Spray"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["100 mm", "10 mm"]
divisions = [20, 4]
[time]
end = "1 s"
step = "0.1 s"
[[body]]
name = "block"
material = "m.toml"
initial_temperature = "400 degC"
[[thermal_condition]]
name = "spray"
group = "y_max"
kind = "flux"
flux = { formula = "-1e6*(x>)"
       << from << ")*(x<" << to << ")\", unit = \"W/m2\" }\n"
       << R"([[probe]]
name = "T"
field = "temperature"
kind = "mean"
group = "block"
unit = "degC"
)";
  return text.str();
}

TEST_F(EventsInTime, ASprayNarrowerThanAnElementTakesItsHeat) {
  for (const double width : {0.011, 0.004, 0.0001, 0.00001})
    EXPECT_NEAR(heat_in(run("spray", spray(0.0305, 0.0305 + width))), -1e6 * width, 1e4 * width) << width;
}

std::string laser(const std::string& kind, const std::string& divisions, const std::string& time,
                  const std::string& sigma) {
  const bool source = kind == "source";
  const std::string formula = source ? "2*P/((2*pi)^1.5*s^3)*exp(-((x-x0)^2+y^2+z^2)/(2*s^2))"
                                     : "P/(2*pi*s^2)*exp(-((x-x0)^2+y^2)/(2*s^2))";
  return R"(title = "Laser"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["40 mm", "20 mm", "10 mm"]
origin = ["0 mm", "-10 mm", "-10 mm"]
divisions = )" +
         divisions + "\n[time]\nend = \"30e-3 s\"\n" + time + R"(
[[body]]
name = "block"
material = "m.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "laser"
group = ")" +
         (source ? "block" : "z_max") + "\"\nkind = \"" + kind + "\"\n" + (source ? "power" : "flux") +
         " = { formula = \"" + formula + "\", constants = { P = 500.0, s = \"" + sigma +
         "\", x0 = \"5 mm\" }, unit = \"" + (source ? "W/m3" : "W/m2") +
         R"(", moving = ["1000 mm/s", "0 mm/s", "0 mm/s"] }
[[probe]]
name = "Tmax"
field = "temperature"
kind = "maximum"
group = "block"
unit = "degC"
)";
}

TEST_F(EventsInTime, AMovingSourceBringsItsPowerWhateverTheElements) {
  const std::string step = "step = \"1 ms\"";
  EXPECT_NEAR(heat_in(run("laser", laser("source", "[20, 10, 5]", step, "0.2 mm"))), 15, 0.15);
  EXPECT_NEAR(heat_in(run("beam", laser("flux", "[13, 7, 5]", step, "0.5 mm"))), 15, 0.15);
}

TEST_F(EventsInTime, AdaptiveStepsFollowAMovingSourceByItsOwnSize) {
  const CaseRun adaptive =
      run("track", laser("source", "[40, 20, 10]", "step = \"1 ms\"\nadaptive = true", "0.5 mm"));
  EXPECT_NEAR(heat_in(adaptive), 15, 0.15);
  EXPECT_LT(*std::ranges::max_element(adaptive.steps.at("dt[s]")), 0.6e-3);
}

TEST_F(EventsInTime, TwoProcessesTakeTheSameStepsAndGiveTheSameHeat) {
  const std::string file =
      folder_.write("two.toml", laser("source", "[12, 6, 3]", "step = \"1 ms\"\nadaptive = true", "1 mm"));
  const auto go = [&](int processes) {
    const std::string folder = (folder_.root() / ("on" + std::to_string(processes))).string();
    const testing::Outcome outcome = testing::shell(
        "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 "
        "mpirun -n " +
        std::to_string(processes) + " --bind-to none --oversubscribe '" SOLIDUS_BINARY_DIR "/solidus' run '" +
        file + "' --no-progress -o '" + folder + "'");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    return testing::read_csv(std::filesystem::path(folder) / "history.csv");
  };
  const testing::Columns one = go(1), two = go(2);
  ASSERT_EQ(one.at("time[s]").size(), two.at("time[s]").size());
  EXPECT_NEAR(one.at("heat_in[J]").back(), two.at("heat_in[J]").back(), 1e-6);
  EXPECT_NEAR(one.at("Tmax[degC]").back(), two.at("Tmax[degC]").back(), 1e-4);
}

}  // namespace
}  // namespace solidus
