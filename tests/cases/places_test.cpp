/// Conditions of place and time through the whole program: restart, two processes, fields of another run,
/// what it says of bad ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "case_folder.hpp"

namespace solidus {
namespace {

using ::testing::AllOf;
using testing::CaseFolder;
using testing::CaseRun;
using ::testing::HasSubstr;

const std::string k_block = R"(title = "A bar in a wandering spray"
[analysis]
kind = "axisymmetric"
physics = "heat"
[mesh]
shape = "block"
element = "tri3"
[mesh.block]
size = ["20 mm", "100 mm"]
divisions = [6, 30]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "block"
material = "aluminium_alsi7mg"
initial_temperature = { formula = "650 + 300*z", unit = "degC" }
[[probe]]
name = "T"
field = "temperature"
point = ["20 mm", "40 mm"]
unit = "degC"
[[probe]]
name = "T_mean"
kind = "mean"
field = "temperature"
group = "block"
unit = "degC"
[output]
times = ["10 s"]
)";

const std::string k_spray = R"~([[thermal_condition]]
name = "spray"
group = "x_max"
kind = "film"
ambient = { formula = "20 + 100*z", unit = "degC" }
factor = { formula = "exp(-((z - 0.02)/w)^2)", constants = { w = "15 mm" }, moving = ["0 mm/s", "4 mm/s"] }
[thermal_condition.coefficient]
of = "temperature"
argument_unit = "degC"
unit = "W/m2/K"
points = [[20, 2000], [600, 4000]]
[[thermal_condition]]
name = "table"
group = "y_max"
kind = "flux"
flux = { file = "flux.csv", moving = ["1 mm/s", "0 mm/s"] }
)~";

class Places : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_.root());
    folder_.write("flux.csv",
                  "# a scattered table\nr[mm],z[mm],t[s],q[kW/m2]\n0,100,0,-10\n20,100,0,-50\n"
                  "0,100,10,-30\n20,100,10,-80\n10,100,10,-40\n");
  }
  /// Output of the program, run from the shell on some processes, with its exit code in front.
  std::string run(const std::string& name, const std::string& text, int processes = 1,
                  const std::string& more = {}) const {
    const std::string file = folder_.write(name + ".toml", text);
    const std::string launcher =
        processes == 1 ? ""
                       : "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 "
                         "OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 "
                         "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n " +
                             std::to_string(processes) + " --bind-to none --oversubscribe ";
    const std::string command = launcher + "'" SOLIDUS_BINARY_DIR "/solidus' run '" + file +
                                "' --no-progress -o '" + (folder_.root() / name).string() +
                                std::to_string(processes) + "' " + more + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return "no shell";
    std::string said;
    std::array<char, 512> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe)) said += buffer.data();
    const int status = pclose(pipe);
    return std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1) + "\n" + said;
  }
  CaseFolder folder_{"places"};
};

TEST_F(Places, ARestartGivesTheSameBits) {
  folder_.expect_exact_restart("restart", k_block + k_spray, 5, {"output.checkpoint_every=1"});
}

TEST_F(Places, TwoProcessesGiveTheSameTemperatures) {
  const std::string tight = "--set heat.tolerance=1e-11 --set heat.solver='\"direct\"'";
  ASSERT_THAT(run("spray", k_block + k_spray, 1, tight), ::testing::StartsWith("0"));
  ASSERT_THAT(run("spray", k_block + k_spray, 2, tight), ::testing::StartsWith("0"));
  const testing::Columns one = testing::read_csv(folder_.root() / "spray1/history.csv"),
                         two = testing::read_csv(folder_.root() / "spray2/history.csv");
  for (const char* column : {"T[degC]", "T_mean[degC]"}) {
    ASSERT_EQ(one.at(column).size(), 11U);
    for (std::size_t i = 0; i < one.at(column).size(); ++i)
      EXPECT_NEAR(one.at(column)[i], two.at(column)[i], 1e-8) << column;
  }
  EXPECT_NEAR(one.at("T[degC]")[0], 662, 1e-9);
  EXPECT_LT(one.at("T[degC]").back(), 640);
}

// The end of a run on triangles is the start of one on quadrilaterals; on one process and on two the body has
// the same heat.
TEST_F(Places, ARunGoesOnOnAnotherMeshWithTheSameHeat) {
  ASSERT_THAT(run("first", k_block + k_spray), ::testing::StartsWith("0"));
  std::string vtu;
  for (const auto& file : std::filesystem::directory_iterator(folder_.root() / "first1/fields"))
    if (file.path().extension() == ".vtu" || file.path().extension() == ".pvtu")
      vtu = std::max(vtu, file.path().string());
  std::string second = k_block;
  second.replace(second.find("tri3"), 4, "quad8");
  second.replace(second.find("[6, 30]"), 7, "[4, 17]");
  const std::string formula = R"({ formula = "650 + 300*z", unit = "degC" })";
  second.replace(second.find(formula), formula.size(), "{ file = \"" + vtu + "\", field = \"temperature\" }");
  second +=
      "[[thermal_condition]]\nname = \"still\"\ngroup = \"x_max\"\nkind = \"flux\"\nflux = \"0 W/m2\"\n";
  const std::string said = run("second", second);
  ASSERT_THAT(said, AllOf(::testing::StartsWith("0"), HasSubstr("with its enthalpy per volume")));
  ASSERT_THAT(run("second", second, 2), ::testing::StartsWith("0"));
  const testing::Columns before = testing::read_csv(folder_.root() / "first1/history.csv"),
                         after = testing::read_csv(folder_.root() / "second1/history.csv"),
                         on_two = testing::read_csv(folder_.root() / "second2/history.csv");
  EXPECT_NEAR(after.at("T[degC]")[0], before.at("T[degC]").back(), 1.5);
  for (std::size_t i = 0; i < after.at("T[degC]").size(); ++i)
    EXPECT_NEAR(after.at("T[degC]")[i], on_two.at("T[degC]")[i], 1e-3);
}

TEST_F(Places, ALinearSourceIsOneFormula) {
  const CaseRun run = folder_.run("source", k_block + R"([[thermal_condition]]
name = "source"
group = "block"
kind = "source"
power = { formula = "10*z", unit = "MW/m3" }
)");
  ASSERT_TRUE(run.finished) << run.reason;
  const double pi = 3.14159265358979323846;
  EXPECT_NEAR(testing::at(run.history, "heat_in[J]", 10), 10e6 * 0.05 * pi * 0.02 * 0.02 * 0.1 * 10, 1e-3);
}

TEST_F(Places, ABodyIsFreeOfThermalStrainAtTheTemperaturesItStartsWith) {
  std::string text = k_block;
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("physics = \"heat\"", "physics = \"mechanics\"");
  replace("aluminium_alsi7mg", "steel_mould");
  replace("650 + 300*z", "100 + 3000*z");
  text.erase(text.find("[[probe]]"), text.find("[output]") - text.find("[[probe]]"));
  text += R"([[mechanical_condition]]
name = "foot"
group = "y_min"
kind = "displacement"
uz = "0 mm"
[[probe]]
name = "stress"
kind = "maximum"
field = "von_mises"
group = "block"
unit = "MPa"
)";
  const CaseRun run = folder_.run("strain", text);
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_LT(run.history.at("stress[MPa]").back(), 1e-9);
}

TEST_F(Places, WhatIsWrongIsSaidWithItsLine) {
  const auto source = [](const std::string& power) {
    return k_block +
           "[[thermal_condition]]\nname = \"source\"\ngroup = \"block\"\nkind = \"source\"\npower = " +
           power + "\n";
  };
  EXPECT_THAT(
      run("unknown", source(R"({ formula = "10*speed" })")),
      AllOf(::testing::StartsWith("1"), HasSubstr("unknown.toml:35"), HasSubstr("'speed' is not known")));
  EXPECT_THAT(run("solid", source(R"({ file = "missing.csv" })")),
              AllOf(::testing::StartsWith("1"), HasSubstr("solid.toml:35"),
                    HasSubstr("missing.csv' cannot be read")));
  EXPECT_THAT(run("field", source(R"({ file = "missing.vtu", field = "power" })")),
              AllOf(::testing::StartsWith("1"), HasSubstr("field.toml:35"), HasSubstr("does not exist")));
  for (const int processes : {1, 2})
    EXPECT_THAT(run("zero", source(R"~({ formula = "1/(5 - t)" })~"), processes),
                AllOf(::testing::StartsWith("1"), HasSubstr("zero.toml:35"), HasSubstr("not finite at"),
                      HasSubstr("t = 5 s")));
}

}  // namespace
}  // namespace solidus
