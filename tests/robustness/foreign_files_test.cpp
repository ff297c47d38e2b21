/// Files of strangers and an unkind system, given to the real program: nothing is run, nothing hangs, nothing
/// crashes, and every end has its message and its code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "../sanitized.hpp"
#include "foreign_files.hpp"

namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace solidus::tests;

TEST_F(ForeignFiles, TheSquareThatTheyAreMadeFromRunsOnOneAndTwoProcesses) {
  const Outcome one = shell("solidus run case.toml -o one");
  EXPECT_EQ(one.code, 0) << one.said;
  // This program is one of MPI too: its environment would confuse mpirun.
  const Outcome two = shell(
      "env -i PATH=\"$PATH\" HOME=\"$HOME\" SOLIDUS_MATERIALS=\"$SOLIDUS_MATERIALS\" "
      "OMPI_ALLOW_RUN_AS_ROOT=1 "
      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n 2 --bind-to none "
      "--oversubscribe '" SOLIDUS_BINARY_DIR
      "/solidus' run case.toml -o two && cmp one/case.toml two/case.toml");
  EXPECT_EQ(two.code, 0) << two.said;
}

TEST_F(ForeignFiles, NoVerbRunsACommandOfAMesh) {
  write("part.geo", std::string(k_square) + "SystemCall \"touch victim\";\n");
  write("part.msh", k_square);
  write("part.txt", k_square);
  for (const char* line :
       {"solidus check case.toml", "solidus run case.toml -o out", "solidus mesh-info part.geo"})
    expect_refused(line, {"part.geo:5:1", "'SystemCall'"});
  // A script under another name is no script.
  for (const char* line : {"solidus mesh-info part.msh", "solidus mesh-info part.txt"})
    expect_refused(line, {"part."});
  EXPECT_FALSE(has("victim"));
  EXPECT_EQ(shell("solidus mesh-info part.geo --trust-geo").code, 0);
  EXPECT_TRUE(has("victim")) << "trusted, it runs";
}

TEST_F(ForeignFiles, AScriptThatEndsTheReaderEndsInAMessage) {
  write("part.geo", std::string(k_square) + "Exit;\n");
  expect_refused("solidus check case.toml", {"part.geo:5:1", "'Exit'"});
  expect_refused("solidus check case.toml --trust-geo", {"part.geo", "ended the program that read it"});
}

#ifndef SOLIDUS_ADDRESS_SANITIZER  // with which no memory is limited
TEST_F(ForeignFiles, MemoryOfTheReaderIsLimited) {
  expect_refused("export SOLIDUS_MESH_MEMORY='1 MB'; solidus check case.toml", {"part.geo", "1 MB"});
  EXPECT_EQ(shell("export SOLIDUS_MESH_MEMORY='1 GB'; solidus check case.toml").code, 0);
}
#endif

TEST_F(ForeignFiles, AUnitThatContradictsTheFileIsRefusedBeforeTheMeshIsMade) {
  for (const char* unit : {"m", "cm"})
    expect_refused("cp -r '" SOLIDUS_SOURCE_DIR
                   "/cases/bracket_from_step' bracket; solidus check bracket --heat-only --set mesh.unit=" +
                       std::string(unit),
                   {"bracket/case.toml:9:1", "the unit '" + std::string(unit) + "' contradicts the file",
                    "its lengths are in mm"});
}

TEST_F(ForeignFiles, ASmallestSizeAboveTheLargestIsRefused) {
  expect_refused("cp -r '" SOLIDUS_SOURCE_DIR
                 "/cases/bracket_from_step' bracket; sed -i 's/smallest = \"5 mm\"/smallest = \"50 mm\"/' "
                 "bracket/case.toml; solidus check bracket --heat-only",
                 {"case.toml:14:1", "'smallest' is 0.05 m, larger than 'size', 0.005 m"});
}

TEST_F(ForeignFiles, WhatNeverEndsOrIsFarTooMuchIsRefused) {
  write("zero.toml", "include = \"/dev/zero\"\n");
  expect_refused("solidus check zero.toml", {"/dev/zero", "device"});
  expect_refused("solidus check /dev/zero", {"/dev/zero", "device"});
  mkfifo((folder_ / "pipe").c_str(), 0600);
  write("fifo.toml", "include = \"pipe\"\n");
  expect_refused("solidus check fifo.toml", {"pipe"});
  expect_refused("solidus mesh-info pipe", {"pipe"});

  std::string deep = "a";
  for (int i = 0; i < 32; ++i) deep += ".a";  // one part more than are allowed
  write("deep.toml", "title = \"x\"\n" + deep + " = 1\n");
  expect_refused("solidus check deep.toml", {"deep.toml:2", "too many parts"});
  expect_refused("solidus check case.toml --set \"$(tail -n 1 deep.toml | tr -d ' ')\"", {"too many parts"});
  write("inline.toml", "x = { " + deep + " = 1 }\n");
  expect_refused("solidus check inline.toml", {"inline.toml:1", "too many parts"});

  for (int i = 0; i < 30; ++i)
    write("n" + std::to_string(i) + ".toml", "include = \"n" + std::to_string(i + 1) + ".toml\"\n");
  expect_refused("solidus check n0.toml", {"include each other"});
  for (int i = 0; i < 12; ++i) {
    const std::string next = "\"m" + std::to_string(i + 1) + ".toml\"";
    write("m" + std::to_string(i) + ".toml", "include = [" + next + ", " + next + "]\n");
  }
  write("m12.toml", "title = \"x\"\n");
  expect_refused("solidus check m0.toml", {"include each other"});
}

TEST_F(ForeignFiles, NumbersBeyondAllPhysicsAndTolerancesWithoutSenseAreRefused) {
  const std::vector<std::pair<std::string, std::string>> numbers = {
      {"body.part.initial_temperature='1e308 K'", "beyond all physics"},
      {"heat.tolerance=1e300", "out of range"},
      {"heat.tolerance=0.9", "out of range"},
      {"mechanics.linear_tolerance=2", "out of range"},
      {"mechanics.tolerance=5", "out of range"},
      {"mesh.element_size='1e300 m'", "beyond all physics"}};
  for (const auto& [set, phrase] : numbers) expect_refused("solidus check case.toml --set " + set, {phrase});
  for (const char* line :
       {"density = \"1e308 kg/m3\"", "conductivity = \"1e308 W/m/K\"",
        "conductivity = { argument_unit = \"K\", unit = \"W/m/K\", points = [[300, 1e308], [600, 40]] }",
        "specific_heat = { argument_unit = \"K\", unit = \"J/kg/K\", points = [[-1e308, 1], [1e308, 2]] }"}) {
    const std::string text = line;
    std::string material = "title = \"Own\"\n";
    for (const char* usual :
         {"density = \"7800 kg/m3\"", "conductivity = \"40 W/m/K\"", "specific_heat = \"500 J/kg/K\""})
      material += (text.substr(0, 6) == std::string(usual).substr(0, 6) ? text : usual) + "\n";
    write("own.toml", material);
    expect_refused("solidus check case.toml --set body.part.material=own.toml",
                   {"own.toml", "beyond all physics"});
  }
}

TEST_F(ForeignFiles, TextsCannotSteerTheTerminal) {
  write("escape.toml", "title = \"\\u001b]0;owned\\u0007\"\n");
  expect_refused("solidus check escape.toml", {"escape.toml:1", "control character"});
  const Outcome outcome = shell("solidus check $'\\e[31mred.toml'");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, AllOf(HasSubstr("?[31mred.toml"), Not(HasSubstr("\x1b"))));
}

TEST_F(ForeignFiles, OptionsOfThePresentFolderAreNotRead) {
  write(".petscrc", "-heat_ksp_type nonsense\n-heat_pc_type nonsense\n");
  const Outcome outcome = shell("solidus run case.toml -o out");
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

/// A run of many steps, ended in different ways.
constexpr const char* k_long_run = "solidus run case.toml -o out --set time.end='9e7 s' --no-progress";

TEST_F(ForeignFiles, SignalsOfATerminalThatClosesEndARunWithACheckpoint) {
  for (const char* signal : {"HUP", "QUIT", "TERM"}) {
    fs::remove_all(folder_ / "out");
    // Its fifth step is awaited. With jobs (-m) a shell lets what it starts hear SIGQUIT.
    const Outcome outcome =
        shell("set -m; rm -f log; '" SOLIDUS_BINARY_DIR
              "/solidus' run case.toml -o out --set time.end='9e7 s' --no-progress > log & "
              "until grep -qs '^ *5 ' log; do kill -0 $! || exit 9; sleep 0.1; done; kill -s " +
              std::string(signal) + " $!; wait $!");
    EXPECT_EQ(outcome.code, 2) << signal << ": " << outcome.said;
    EXPECT_TRUE(has("out/checkpoint/state.h5")) << signal;
  }
}

TEST_F(ForeignFiles, AnOutputThatClosesEndsARunQuietly) {
  const Outcome listing = shell("solidus explain | head -n 1 > /dev/null; exit ${PIPESTATUS[0]}");
  EXPECT_EQ(listing.code, 0) << listing.said;
  EXPECT_EQ(listing.said, "");
  const Outcome run = shell(std::string(k_long_run) + " | head -n 3 > /dev/null; exit ${PIPESTATUS[0]}");
  EXPECT_EQ(run.code, 2) << run.said;
  EXPECT_THAT(run.said, Not(HasSubstr("PETSC ERROR")));
  EXPECT_TRUE(has("out/checkpoint/state.h5"));
}

}  // namespace
