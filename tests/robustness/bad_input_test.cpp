/// Broken cases, meshes, materials and command lines, given to the real program: each must end with exit code
/// 1 and one clear message, and leave no results behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <future>
#include <string>
#include <vector>

#include "bad_inputs.hpp"

namespace {

namespace fs = std::filesystem;
using namespace solidus::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct Outcome {
  int code;
  std::string errors;         ///< what it said on stderr
  bool left_results = false;  ///< a results folder was begun
};

/// Runs the program in a folder and keeps what it says on stderr.
/// @param setting  NAME=value of the environment
Outcome run(const fs::path& folder, const std::string& arguments, const std::string& setting = "") {
  const std::string command = "cd '" + folder.string() + "' && " + setting +
                              " SOLIDUS_MATERIALS='" SOLIDUS_SOURCE_DIR "/materials' '" SOLIDUS_BINARY_DIR
                              "/solidus' " +
                              arguments + " 2>&1 >/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  Outcome outcome{-1, {}, false};
  if (!pipe) return outcome;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe)) outcome.errors += buffer.data();
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// Writes the files of a broken input and runs the program on them.
Outcome try_out(const BadInput& input) {
  const fs::path folder = fs::temp_directory_path() / ("solidus_bad_" + input.name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const auto& [name, content] : input.files) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << content;
  }
  Outcome outcome = run(folder, input.arguments);
  outcome.left_results = fs::exists(folder / "results");
  fs::remove_all(folder);
  return outcome;
}

/// The outcome of an input, while the next ones already run at the same time: the program's start is most of
/// the time.
Outcome outcome_of(const std::string& name) {
  static const std::vector<BadInput> inputs = all();
  static std::vector<std::shared_future<Outcome>> outcomes(inputs.size());
  const auto found =
      std::find_if(inputs.begin(), inputs.end(), [&](const BadInput& i) { return i.name == name; });
  const auto at = static_cast<std::size_t>(found - inputs.begin());
  constexpr std::size_t k_ahead = 3;
  for (std::size_t i = at; i < std::min(at + k_ahead, inputs.size()); ++i)
    if (!outcomes[i].valid())
      outcomes[i] = std::async(std::launch::async, try_out, std::cref(inputs[i])).share();
  return outcomes[at].get();
}

class BadInputTest : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, GivesOneClearMessageAndExitCodeOne) {
  const Outcome outcome = outcome_of(GetParam().name);
  EXPECT_EQ(outcome.code, 1) << outcome.errors;
  for (const std::string& phrase : GetParam().phrases) EXPECT_THAT(outcome.errors, HasSubstr(phrase));
  // One message: it begins with the program's name, and nothing else speaks (libraries, MPI, the shell). On a
  // busy machine it waits behind those that read on.
  std::string message = outcome.errors;
  for (std::size_t end = message.find('\n');
       message.starts_with("info: ") && message.substr(0, end).find(" is being read or meshed for ") < end;
       end = message.find('\n'))
    message.erase(0, end == std::string::npos ? end : end + 1);
  EXPECT_EQ(message.find("solidus: "), 0u) << outcome.errors;
  EXPECT_EQ(message.find("solidus: ", 1), std::string::npos) << outcome.errors;
  EXPECT_FALSE(outcome.left_results);
}

INSTANTIATE_TEST_SUITE_P(Robustness, BadInputTest, ::testing::ValuesIn(all()),
                         [](const auto& input) { return input.param.name; });

TEST(BadInputTest, TheCasesTheBrokenOnesAreMadeFromAreRight) {
  const fs::path folder = fs::temp_directory_path() / "solidus_good";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "good.toml") << k_good;
  std::ofstream(folder / "mesh.toml") << k_mesh_case;
  std::ofstream(folder / "part.msh") << mesh();
  std::ofstream(folder / "own.toml") << k_material;
  std::ofstream(folder / "plastic.toml") << k_plastic_material;
  for (const char* arguments :
       {"check good.toml", "check mesh.toml", "check good.toml --set body.block.material=own.toml",
        "check good.toml --set body.block.material=plastic.toml"}) {
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << ": " << outcome.errors;
  }
  fs::remove_all(folder);
}

// Processes that start at the same moment have nothing in common that one could take from another.
TEST(BadInputTest, TheProgramStartsWithoutAFolderForTemporaryFiles) {
  const fs::path folder = fs::temp_directory_path() / "solidus_start";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "good.toml") << k_good;
  const Outcome outcome = run(folder, "check good.toml", "TMPDIR=/dev/null");
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  fs::remove_all(folder);
}

TEST(BadInputTest, PhysicsThatCannotGoOnEndsWithExitCodeTwo) {
  const fs::path folder = fs::temp_directory_path() / "solidus_falling";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "case.toml")
      << good_but("physics = \"heat\"", "gravity = \"9.81 m/s2\"");  // nothing holds the block
  const Outcome outcome = run(folder, "run case.toml -o out");
  EXPECT_EQ(outcome.code, 2) << outcome.errors;
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("solidus: the simulation could not go on at t = 0 s"),
                                    HasSubstr("reason: nothing carries body 'block', which weighs "),
                                    HasSubstr("equations: mechanics:")));
  fs::remove_all(folder);
}

TEST(BadInputTest, AFullDiskStopsTheRunWithAClearMessage) {
  const fs::path folder = fs::temp_directory_path() / "solidus_full_disk";
  fs::remove_all(folder);
  fs::create_directories(folder / "out");
  std::ofstream(folder / "case.toml") << k_good;
  fs::create_symlink("/dev/full", folder / "out/history.csv");  // every write to it finds no space left
  const Outcome outcome = run(folder, "run case.toml -o out");
  EXPECT_EQ(outcome.code, 1) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("No space left on device"));
  fs::remove_all(folder);
}

}  // namespace
