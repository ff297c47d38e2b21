/// kill -9 at random moments, also while a checkpoint or a table is written: what is left must go on, and its
/// results must be those of a run that no one disturbed, byte for byte.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

std::string text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : otherwise;
}

/// The program in a process of its own; what it prints goes to a file.
class Child {
 public:
  Child(std::vector<std::string> arguments, const fs::path& log) {
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    const int error = posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    // Without a process there is nothing to kill or to wait for: -1 means all of them.
    if (error != 0) throw std::runtime_error(arguments[0] + ": " + std::strerror(error));
  }
  void kill_hard() const { ::kill(pid_, SIGKILL); }
  /// The exit code, or minus the signal that ended it.
  int wait() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
};

/// The aluminium cylinder on a coarse mesh: heat, mechanics, contact and freezing in 40 steps, each with a
/// checkpoint.
class Kill : public ::testing::Test {
 protected:
  static constexpr int k_seed = 20;

  void SetUp() override {
    fs::remove_all(root());
    fs::create_directories(root());
    // Folder for the files of MPI's session that killed processes leave.
    fs::create_directories(temporary());
    setenv("TMPDIR", temporary().c_str(), 1);
  }
  void TearDown() override {
    // The message layer may be removing the files of a killed run at the same moment.
    for (int i = 0; i < 50 && fs::exists(temporary()); ++i) {
      std::error_code error;
      fs::remove_all(temporary(), error);
      if (error) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  static const fs::path& temporary() {
    static const fs::path path = fs::temp_directory_path() / ("solidus_kill_" + std::to_string(getpid()));
    return path;
  }
  static fs::path root() { return fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "kill"; }

  std::vector<std::string> options_ = {"time.end=10 s", "time.step=0.25 s"};

  Child start(const std::string& folder, bool restart) const {
    std::vector<std::string> arguments = {SOLIDUS_BINARY_DIR "/solidus",
                                          "run",
                                          SOLIDUS_SOURCE_DIR "/cases/aluminium_cylinder",
                                          "-o",
                                          (root() / folder).string(),
                                          "--set",
                                          "mesh.cylinder_in_mould.element_size=4 mm",
                                          "--set",
                                          "mesh.cylinder_in_mould.mould_element_size=8 mm",
                                          "--set",
                                          "output.checkpoint_every=1"};
    for (const std::string& option : options_) arguments.insert(arguments.end(), {"--set", option});
    if (restart) arguments.emplace_back("--restart");
    return {arguments, root() / (folder + ".log")};
  }
  /// The run that no one disturbs; returns how long it took.
  Seconds run_whole() const {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(start("whole", false).wait(), 0) << text(root() / "whole.log");
    return std::chrono::steady_clock::now() - begin;
  }
  static bool has_checkpoint(const std::string& folder) {
    return fs::exists(root() / folder / "checkpoint/state.h5") ||
           fs::exists(root() / folder / "checkpoint/previous.h5");
  }
  /// Until history.csv has its head and `n` rows; not longer than a minute.
  static void wait_for_rows(const std::string& folder, int n) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    const fs::path file = root() / folder / "history.csv";
    while (n > 0 && std::chrono::steady_clock::now() < end) {
      const std::string rows = fs::exists(file) ? text(file) : std::string();
      if (std::count(rows.begin(), rows.end(), '\n') > n) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  /// Goes on from what is there, or begins again where there is no checkpoint yet.
  void finish(const std::string& folder) const {
    const bool restart = has_checkpoint(folder);
    const int code = start(folder, restart).wait();
    const std::string log = text(root() / (folder + ".log"));
    // Killed behind its last checkpoint: there is nothing left to compute.
    const bool at_the_end = restart && code == 1 && log.find("the run has reached") != std::string::npos;
    EXPECT_TRUE(code == 0 || at_the_end) << "code " << code << "\n" << log;
  }
  static void expect_as_whole(const std::string& folder) {
    EXPECT_EQ(text(root() / folder / "history.csv"), text(root() / "whole/history.csv"));
    EXPECT_EQ(text(root() / folder / "pools.csv"), text(root() / "whole/pools.csv"));
    EXPECT_EQ(text(root() / folder / "fields.pvd"), text(root() / "whole/fields.pvd"));
    std::set<std::string> here, there;
    for (const auto& file : fs::directory_iterator(root() / "whole/fields")) {
      there.insert(file.path().filename().string());
      EXPECT_EQ(text(root() / folder / "fields" / file.path().filename()), text(file.path()))
          << file.path().filename();
    }
    for (const auto& file : fs::directory_iterator(root() / folder / "fields"))
      here.insert(file.path().filename().string());
    EXPECT_EQ(here, there);
  }
  /// Kills `n` times in one folder, each time after a part of the whole run's length, then lets it finish.
  void expect_survives_a_chain(int n) {
    const Seconds length = run_whole();
    std::mt19937 random(k_seed);
    std::uniform_real_distribution<double> share(0.2, 0.6);
    for (int i = 0; i < n; ++i) {
      const Child child = start("chain", has_checkpoint("chain"));
      std::this_thread::sleep_for(share(random) * length);
      child.kill_hard();
      child.wait();
    }
    finish("chain");
    expect_as_whole("chain");
  }
};

// Twenty times, or as often and with the seed that `./dev kill` asks for.
TEST_F(Kill, AtRandomMomentsLeavesTheSameBytes) {
  constexpr int k_steps = 40;  // of the run
  const int kills = from_environment("SOLIDUS_KILLS", 20);
  const Seconds step = run_whole() / k_steps;
  std::mt19937 random(static_cast<unsigned>(from_environment("SOLIDUS_KILL_SEED", k_seed)));
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int killed = 0, with_checkpoint = 0;
  for (int i = 0; i < kills; ++i) {
    const std::string folder = "killed";
    fs::remove_all(root() / folder);
    // By the run's own progress, whatever else the machine does: a number of rows, and up to two steps more.
    const int rows = static_cast<int>(share(random) * (k_steps - 2));
    SCOPED_TRACE("kill " + std::to_string(i + 1) + " after " + std::to_string(rows) + " rows");
    const Child child = start(folder, false);
    wait_for_rows(folder, rows);
    std::this_thread::sleep_for(2 * share(random) * step);
    child.kill_hard();
    if (child.wait() == -SIGKILL) ++killed;
    if (has_checkpoint(folder)) ++with_checkpoint;
    finish(folder);
    expect_as_whole(folder);
    if (HasFailure()) return;  // the folder is left to look at
  }
  // The moments are worth their name: few come after the end, many find a checkpoint.
  std::printf("%d kills, %d before the end of the run, %d with a checkpoint to go on from\n", kills, killed,
              with_checkpoint);
  EXPECT_GE(killed, kills * 3 / 4);
  EXPECT_GE(with_checkpoint, kills * 2 / 5);
}

TEST_F(Kill, AgainAndAgainInAdaptiveSteps) {
  options_ = {"time.end=10 s", "time.adaptive=true", "time.temperature_error=0.5 K"};
  expect_survives_a_chain(5);
}

TEST_F(Kill, AgainAndAgainWithPlasticHistoryAndATwoStepMethod) {
  options_.insert(options_.end(),
                  {"mechanics.integration=bdf2", "body.part.material=aluminium_99_7_plastic"});
  expect_survives_a_chain(5);
}

// A kill between the two renames that make a checkpoint the latest one, with a row that was not finished.
TEST_F(Kill, BetweenTheRenamesOfACheckpointGoesOnFromTheOneBefore) {
  run_whole();
  fs::copy(root() / "whole", root() / "between", fs::copy_options::recursive);
  const fs::path checkpoints = root() / "between/checkpoint";
  fs::rename(checkpoints / "state.h5", checkpoints / "state.h5.part");
  std::ofstream(root() / "between/history.csv", std::ios::app) << "10.25,61";
  finish("between");
  EXPECT_NE(text(root() / "between.log").find("continuing from"), std::string::npos);
  expect_as_whole("between");
}

// A run that begins again in a used folder and dies at once must not leave checkpoints of the old one.
TEST_F(Kill, OfARunThatBeginsAnewLeavesNoCheckpointOfTheOldOne) {
  const Seconds length = run_whole();
  fs::copy(root() / "whole", root() / "again", fs::copy_options::recursive);
  std::mt19937 random(k_seed);
  for (int i = 0; i < 3; ++i) {
    const Child child = start("again", false);
    std::this_thread::sleep_for(std::uniform_real_distribution<double>(0.0, 0.3)(random) * length);
    child.kill_hard();
    child.wait();
  }
  finish("again");
  expect_as_whole("again");
}

}  // namespace
