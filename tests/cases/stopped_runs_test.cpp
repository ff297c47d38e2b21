/// Runs that signals, full disks or other runs stop leave their folder in good order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "restarted_run.hpp"

namespace {

namespace fs = std::filesystem;
using namespace solidus::testing;
using ::testing::AnyOf;
using ::testing::HasSubstr;

using StoppedRuns = RestartedRun;

/// The largest disk of `./dev disk` that still fills up in ten steps [4 kB].
constexpr int k_pages = 320;

// A script that takes for ever to mesh.
TEST_F(StoppedRuns, ASignalWhileTheMeshIsReadEndsTheRunInGoodOrder) {
  fs::create_directories(root());
  std::ofstream(root() / "endless.geo") << "For i In {1:1e12}\n  a = i;\nEndFor\n";
  std::ofstream(root() / "case.toml") << "include = '" SOLIDUS_SOURCE_DIR "/cases/bracket/case.toml'\n"
                                      << "[mesh]\nfile = 'endless.geo'\n";
  // The run is at it as soon as it has started the process that reads.
  const Outcome stopped = shell(
      "('" SOLIDUS_BINARY_DIR "/solidus' run '" + (root() / "case.toml").string() + "' -o '" +
      (root() / "early").string() +
      "' & p=$!; while kill -0 $p && ! grep -qs \"^PPid:.$p\\$\" /proc/[0-9]*/status; do sleep 0.05; done; "
      "sleep 0.5; kill -USR1 $p; wait $p)");
  EXPECT_EQ(stopped.code, 2) << stopped.output;
  EXPECT_THAT(stopped.output, HasSubstr("stopped by a signal while the mesh was read"));
  EXPECT_FALSE(fs::exists(root() / "early"));
}

// A slender beam and Jacobi's preconditioner: thousands of iterations in one solve.
TEST_F(StoppedRuns, ASignalIsHeededWithinALinearSolve) {
  fs::create_directories(root());
  std::ofstream(root() / "beam.toml") << R"(title = "A long beam bends"
[analysis]
kind = "solid"
physics = "mechanics"
gravity = "9.81 m/s2"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["4 m", "40 mm", "40 mm"]
divisions = [400, 5, 5]
[time]
end = "100 s"
step = "1 s"
[mechanics]
solver = "jacobi"
inexact_newton = false
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "wall"
group = "x_min"
kind = "displacement"
ux = "0 m"
uy = "0 m"
uz = "0 m"
)";
  for (const char* launcher : {"", "mpirun -n 2 --bind-to none --oversubscribe "}) {
    fs::remove_all(root() / "beam");
    fs::remove(root() / "beam.log");  // else the signal may come on what the run before has told
    const std::string log = "'" + (root() / "beam.log").string() + "'";
    // The signal comes once hundreds of iterations of the first solve have been told.
    const Outcome stopped = shell(
        "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 " +
        std::string(launcher) + "'" SOLIDUS_BINARY_DIR "/solidus' run '" + (root() / "beam.toml").string() +
        "' -o '" + (root() / "beam").string() +
        "' -- -mechanics_ksp_max_it 10000000 -mechanics_ksp_monitor > " + log +
        " 2>&1 & p=$!; while kill -0 $p && ! [ $(grep -c 'KSP Residual norm' " + log +
        ") -gt 300 ]; do sleep 0.05; done; a=$(date +%s%N); kill -USR1 $p; wait $p; code=$?; "
        "b=$(date +%s%N); [ $((b - a)) -lt 7000000000 ] && echo 'within 7 s'; grep -v 'KSP Residual norm' " +
        log + "; exit $code");
    EXPECT_EQ(stopped.code, 2) << stopped.output;
    EXPECT_THAT(stopped.output, HasSubstr("stopped as asked at t = 0 s"));
    EXPECT_THAT(stopped.output, HasSubstr("within 7 s"))
        << "1 s on a machine that is free; the whole solve takes minutes";
    EXPECT_TRUE(fs::exists(root() / "beam/checkpoint/state.h5"));
  }
}

TEST_F(StoppedRuns, OnlyOneRunAtATimeWritesIntoAFolder) {
  ASSERT_EQ(run("whole").code, 0);
  const std::string both = "--set time.step='\"0.01 s\"' --set output.checkpoint_every=5";
  const std::string history = "'" + (root() / "shared/history.csv").string() + "'";
  for (const char* how : {"", "--restart"}) {
    fs::remove_all(root() / "shared");
    const Outcome outcome =
        shell("(" + command("shared", both) + " > /dev/null & p=$!; while ! [ -s " + history +
              " ]; do sleep 0.05; done; while [ ! -e '" + (root() / "shared/checkpoint/state.h5").string() +
              "' ] && [ -n '" + how + "' ]; do sleep 0.05; done; " + command("shared", how) +
              "; code=$?; kill -KILL $p; wait $p; exit $code)");
    EXPECT_EQ(outcome.code, 1) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("a run is under way in this folder: process ")) << how;
  }
  EXPECT_TRUE(fs::exists(root() / "shared/lock")) << "what was killed leaves its lock";
  const Outcome after = run("shared");
  EXPECT_EQ(after.code, 0) << after.output;
  EXPECT_THAT(after.output, HasSubstr("left its lock behind"));
  EXPECT_FALSE(fs::exists(root() / "shared/lock"));
  EXPECT_EQ(text(root() / "shared/history.csv"), text(root() / "whole/history.csv"));
}

TEST_F(StoppedRuns, ARunThatWasKilledBeforeItsSummaryIsCompleted) {
  ASSERT_EQ(run("whole").code, 0);
  const std::string history = text(root() / "whole/history.csv"), fields = text(root() / "whole/fields.pvd");
  fs::remove(root() / "whole/summary.json");
  const Outcome completed = run("whole", "--restart");
  EXPECT_EQ(completed.code, 0) << completed.output;
  EXPECT_THAT(text(root() / "whole/summary.json"), HasSubstr("\"outcome\": \"finished\""));
  EXPECT_EQ(text(root() / "whole/history.csv"), history);
  EXPECT_EQ(text(root() / "whole/fields.pvd"), fields);
  const Outcome again = run("whole", "--restart");
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.output, HasSubstr("has reached"));
}

// /dev/full takes no byte, like a full disk.
TEST_F(StoppedRuns, AFullDiskAtACheckpointIsSaidAndTheRunCanGoOn) {
  for (const int processes : {1}) {
    ASSERT_EQ(run("whole").code, 0);
    ASSERT_EQ(run("full", "--set time.end='\"5 s\"'", processes).code, 0);
    fs::create_symlink("/dev/full", root() / "full/checkpoint/state.h5.part");
    const Outcome outcome = run("full", "--restart", processes);
    EXPECT_EQ(outcome.code, 1) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("is there room on the disk?"));
    fs::remove(root() / "full/checkpoint/state.h5.part");
    const Outcome rest = run("full", "--restart", processes);
    EXPECT_EQ(rest.code, 0) << rest.output;
    EXPECT_EQ(text(root() / "full/history.csv"), text(root() / "whole/history.csv"));
  }
}

// A small disk in memory, which fills up in the first steps and is then made larger: of one size, or of as
// many random ones as `./dev disk` asks for.
TEST_F(StoppedRuns, ADiskThatFillsUpEndsTheRunAndTheRestGivesTheSameBytes) {
  if (shell("unshare -rm true").code != 0)
    GTEST_SKIP() << "this system lets only root mount a disk of its own";
  const fs::path disk = root() / "disk";
  fs::create_directories(disk);
  const std::string every = "--set output.checkpoint_every=1 --set output.every='\"1 s\"'";
  const int disks = from_environment("SOLIDUS_DISKS", 0);
  std::mt19937 random(static_cast<unsigned>(from_environment("SOLIDUS_DISK_SEED", 1)));
  std::uniform_int_distribution<int> pages(1, k_pages);
  const auto quoted = [](const std::string& text) { return "'" + text + "'"; };
  for (int i = 0; i < std::max(disks, 2); ++i) {
    const int processes = disks == 0   ? i + 1
                          : i % 5 == 4 ? 2
                                       : 1,
              size = disks == 0 ? 900 : 4 * pages(random);
    const fs::path whole = root() / (processes == 1 ? "whole" : "whole_on_two");
    SCOPED_TRACE(std::to_string(size) + " kB on " + std::to_string(processes));
    if (!fs::exists(whole)) {
      ASSERT_EQ(run(whole.filename().string(), every, processes).code, 0);
    }
    // The folder of the run lies on the disk, which is there for this shell alone.
    std::ofstream(root() / "fill.sh")
        << "mount -t tmpfs -o size=" << size << "k tmpfs " << quoted(disk.string()) << "\n"
        << launched("disk/run", every, processes) << "; echo first=$?\n"
        << "mount -o remount,size=100m " << quoted(disk.string()) << "\n"
        << "test -f disk/run/checkpoint/state.h5 -o -f disk/run/checkpoint/previous.h5 && restart=--restart\n"
        << launched("disk/run", every + " $restart", processes) << "; echo second=$?\n"
        << "cmp disk/run/history.csv " << quoted((whole / "history.csv").string()) << " && echo equal\n";
    const Outcome outcome = shell("cd " + quoted(root().string()) + " && timeout 300 unshare -rm sh fill.sh");
    EXPECT_THAT(outcome.output,
                AnyOf(HasSubstr("is there room on the disk?"), HasSubstr("No space left on device")));
    EXPECT_THAT(outcome.output, HasSubstr("first=1"));
    EXPECT_THAT(outcome.output, HasSubstr("second=0"));
    EXPECT_THAT(outcome.output, HasSubstr("equal"));
    if (HasFailure()) std::printf("%s\n", outcome.output.c_str());
  }
  if (disks > 0) std::printf("%d disks that filled up\n", disks);
}

TEST_F(StoppedRuns, ASignalEndsTheRunAfterItsStepAndTheRestGivesTheSameBits) {
  const std::string steps = "--set time.step='\"0.02 s\"'";
  ASSERT_EQ(run("whole", steps).code, 0);
  const std::string table = "'" + (root() / "halves/history.csv").string() + "'";
  const Outcome stopped = shell("(" + command("halves", steps) + " & p=$!; while kill -0 $p && ! [ $(cat " +
                                table + " | wc -l) -gt 5 ]; do sleep 0.01; done; kill -TERM $p; wait $p)");
  ASSERT_EQ(stopped.code, 2) << stopped.output;
  EXPECT_THAT(stopped.output, HasSubstr("stopped as asked"));
  EXPECT_THAT(stopped.output, HasSubstr("--restart"));
  const Outcome rest = run("halves", steps + " --restart");
  ASSERT_EQ(rest.code, 0) << rest.output;
  EXPECT_EQ(text(root() / "whole/history.csv"), text(root() / "halves/history.csv"));
}

// A factorisation of some seconds cannot be left: the first signal waits for it, the second does not.
TEST_F(StoppedRuns, ASecondSignalEndsAFactorisationAtOnceAndTheCheckpointStays) {
  fs::create_directories(root());
  std::ofstream(root() / "block.toml") << R"(title = "A block that cools, by factorisation"
[analysis]
kind = "solid"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["100 mm", "100 mm", "100 mm"]
divisions = [24, 24, 24]
[time]
end = "100 s"
step = "1 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "500 degC"
[[thermal_condition]]
name = "water"
group = "z_min"
kind = "film"
coefficient = "5000 W/m2/K"
ambient = "20 degC"
[[mechanical_condition]]
name = "table"
group = "z_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
uz = "0 mm"
[mechanics]
solver = "direct"
[output]
checkpoint_every = 1
)";
  const std::string program = "'" SOLIDUS_BINARY_DIR "/solidus' run '" + (root() / "block.toml").string() +
                              "' -o '" + (root() / "block").string() + "' --set time.end='\"2 s\"'";
  const std::string file = "'" + (root() / "block/checkpoint/state.h5").string() + "'";
  // The second step begins behind the checkpoint of the first: it is in its factorisation soon.
  const Outcome outcome = shell(
      "(" + program + " & p=$!; while kill -0 $p && ! [ -e " + file +
      " ]; do sleep 0.05; done; sleep 1; kill -TERM $p; sleep 0.3; kill -TERM $p; a=$(date +%s%N); wait $p; "
      "echo code=$?; b=$(date +%s%N); [ $((b - a)) -lt 2000000000 ] && echo 'within 2 s')");
  EXPECT_THAT(outcome.output, HasSubstr("asked again, it ends at once"));
  EXPECT_THAT(outcome.output, HasSubstr("within 2 s"));
  EXPECT_THAT(outcome.output, ::testing::AnyOf(HasSubstr("code=143"), HasSubstr("code=2")));
  const Outcome rest = shell(program + " --restart");
  EXPECT_EQ(rest.code, 0) << rest.output;
}

}  // namespace
