/// A folder with a small case, and the real program to be run on it and on what a test changes there.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace solidus::tests {

inline constexpr const char* k_case = R"(title = "A square cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "part.geo"
unit = "mm"
[time]
end = "2 s"
step = "1 s"
[[body]]
name = "part"
material = "steel_mould"
initial_temperature = "200 degC"
)";

inline constexpr const char* k_square = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 10, 10};
Physical Surface("part") = {1};
Mesh.MeshSizeMax = 5;
)";

struct Outcome {
  int code = -1;
  std::string said;  ///< on both streams
  double seconds = 0;
};

class ForeignFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    write("case.toml", k_case);
    write("part.geo", k_square);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  /// A line for the shell in the folder; `solidus` is the program.
  Outcome shell(const std::string& line) const {
    const std::string command = "cd '" + folder_.string() +
                                "' && export SOLIDUS_MATERIALS='" SOLIDUS_SOURCE_DIR
                                "/materials' && solidus() { '" SOLIDUS_BINARY_DIR
                                "/solidus' \"$@\"; } && { " +
                                line + "; } 2>&1";
    const std::string quoted = "bash -c \"$COMMAND\"";
    setenv("COMMAND", command.c_str(), 1);
    Outcome outcome;
    const auto begin = std::chrono::steady_clock::now();
    std::FILE* pipe = popen(quoted.c_str(), "r");
    if (pipe == nullptr) return outcome;
    std::array<char, 512> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe)) outcome.said += buffer.data();
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return outcome;
  }
  /// Expects exit code 1 and one message that holds the phrases, behind those that reading goes on, which a
  /// busy machine gives.
  void expect_refused(const std::string& line, const std::vector<std::string>& phrases) const {
    const Outcome outcome = shell(line);
    EXPECT_EQ(outcome.code, 1) << line << ": " << outcome.said;
    for (const std::string& phrase : phrases) EXPECT_THAT(outcome.said, ::testing::HasSubstr(phrase)) << line;
    std::string message = outcome.said;
    // A run says first on how many processes it is.
    if (message.starts_with("1 process of ")) message.erase(0, message.find('\n') + 1);
    while (message.starts_with("info: ") && message.find('\n') != std::string::npos)
      message.erase(0, message.find('\n') + 1);
    EXPECT_TRUE(message.starts_with("solidus: ")) << line << ": " << outcome.said;
    EXPECT_THAT(outcome.said, ::testing::Not(::testing::HasSubstr("PETSC ERROR"))) << line;
    const char* patience = std::getenv("SOLIDUS_TEST_PATIENCE");
    EXPECT_LT(outcome.seconds, 20 * (patience == nullptr ? 1 : std::atof(patience))) << line;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("solidus_foreign_" + std::to_string(getpid()));
};

}  // namespace solidus::tests
