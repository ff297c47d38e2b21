/// The program as a user runs it, stops it and lets it go on, on one process and on several.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace solidus::testing {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string output;
};

inline Outcome shell(const std::string& command) {
  Outcome outcome;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return outcome;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe)) outcome.output += buffer.data();
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

inline std::string text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

inline int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : otherwise;
}

/// Heat, mechanics and contact on a coarse mesh: 10 steps, fields and checkpoints every 5 s.
class RestartedRun : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(root()); }
  /// The folder of the tests of one name: those of another may run along with them.
  static fs::path root() {
    return fs::path(SOLIDUS_BINARY_DIR) / "case_runs" /
           ::testing::UnitTest::GetInstance()->current_test_suite()->name();
  }
  static std::string command(const std::string& folder, const std::string& more) {
    return "'" SOLIDUS_BINARY_DIR "/solidus' run '" SOLIDUS_SOURCE_DIR
           "/cases/aluminium_cylinder' --set mesh.cylinder_in_mould.element_size='\"4 mm\"'"
           " --set mesh.cylinder_in_mould.mould_element_size='\"8 mm\"' --set time.end='\"10 s\"' -o '" +
           (root() / folder).string() + "' " + more;
  }
  static std::string launched(const std::string& folder, const std::string& more, int processes) {
    // This program is an MPI program too, whose environment would confuse mpirun.
    const std::string launcher =
        processes == 1 ? ""
                       : "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
                         "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                         "OMPI_MCA_mpi_yield_when_idle=1 mpirun -n " +
                             std::to_string(processes) + " --bind-to none --oversubscribe ";
    return launcher + command(folder, more);
  }
  static Outcome run(const std::string& folder, const std::string& more = {}, int processes = 1) {
    return shell(launched(folder, more, processes));
  }
  /// A run in two halves leaves the tables and fields of one that was never stopped.
  static void expect_the_same(const std::string& options, int processes) {
    ASSERT_EQ(run("whole", options, processes).code, 0);
    ASSERT_EQ(run("halves", options + " --set time.end='\"5 s\"'", processes).code, 0);
    const Outcome rest = run("halves", options + " --restart", processes);
    ASSERT_EQ(rest.code, 0) << rest.output;
    EXPECT_EQ(text(root() / "whole/history.csv"), text(root() / "halves/history.csv"));
    EXPECT_EQ(text(root() / "whole/fields.pvd"), text(root() / "halves/fields.pvd"));
    for (const auto& file : fs::directory_iterator(root() / "whole/fields"))
      EXPECT_EQ(text(file.path()), text(root() / "halves/fields" / file.path().filename())) << file.path();
  }
};

}  // namespace solidus::testing
