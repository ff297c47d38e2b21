/// Cases that a test writes itself, and their runs, in a folder of their own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "case_run.hpp"
#include "system/errors.hpp"

namespace solidus::testing {

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

class CaseFolder {
 public:
  /// @param name  of the folder below those of all runs
  explicit CaseFolder(std::string name) : name_(std::move(name)) {}

  std::filesystem::path root() const {
    return std::filesystem::path(SOLIDUS_BINARY_DIR) / "case_runs" / name_;
  }
  /// Writes a file and returns its path.
  std::string write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories(root());
    std::ofstream(root() / file) << text;
    return (root() / file).string();
  }
  /// Writes NAME.toml and runs it; results in NAME.
  CaseRun run(const std::string& name, const std::string& text,
              const std::vector<std::string>& overrides = {}) const {
    return testing::run(write(name + ".toml", text), name_ + "/" + name, overrides);
  }
  /// Returns the message with which run() refuses a case; empty where it runs.
  std::string refusal(const std::string& name, const std::string& text) const {
    try {
      run(name, text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  /// Runs until so many steps are taken, then goes on: the tables must be, byte for byte, those of a run that
  /// never stopped (in NAME_whole).
  void expect_exact_restart(const std::string& name, const std::string& text, int stop_after,
                            const std::vector<std::string>& overrides = {}) const {
    const std::string file = write(name + ".toml", text);
    const auto go = [&](const std::string& folder, bool restart, int steps) {
      run::RunOptions options;
      options.folder = root() / folder;
      options.restart = restart;
      int asked = 0;
      options.stop_asked = [&asked, steps] { return asked++ == steps; };
      return run::run_case(setup::load_case(file, overrides), options).finished;
    };
    constexpr int k_never = -1;
    ASSERT_TRUE(go(name + "_whole", false, k_never));
    ASSERT_FALSE(go(name + "_parts", false, stop_after));
    ASSERT_TRUE(go(name + "_parts", true, k_never));
    for (const char* table : {"history.csv", "stages.csv"})  // the second of a case with stages
      EXPECT_EQ(read_text(root() / (name + "_whole") / table), read_text(root() / (name + "_parts") / table))
          << table;
  }

 private:
  std::string name_;
};

}  // namespace solidus::testing
