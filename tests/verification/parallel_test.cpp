/// The program on one and on two processes: the same curves.
///
/// Partition and order of summation differ, the algorithm does not: with direct solvers both runs take the
/// same iterations and differ by rounding, enlarged by the condition of the contact problem (measured: below
/// 1e-10). The criteria of the phases, 1e-9 of the forces and 1e-11 of the heat, are what may show where
/// rounding decides over one more iteration: 1e-8. With the default criterion of mechanics, 1e-3, such a step
/// would differ by more.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "../cases/case_run.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::Columns;

const fs::path k_folder = fs::path(SOLIDUS_BINARY_DIR) / "parallel_runs";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::string(" ") + name + "='" + value + "'" : "";
}

/// This test is a process of MPI itself: its children start from a clean environment, or mpirun would take
/// them for a part of it.
std::string launcher(int processes) {
  std::string command = "env -i" + variable("PATH") + variable("HOME") + variable("TMPDIR") +
                        variable("LD_LIBRARY_PATH") + " OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1";
  if (processes > 1)
    command += fmt::format(
        " OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle={} mpirun "
        "-n {} "
        "--bind-to none --oversubscribe",
        processes > static_cast<int>(std::thread::hardware_concurrency()) ? 1 : 0, processes);
  return command;
}

bool says(const fs::path& file, const std::string& text) {
  std::ifstream in(file);
  return std::string(std::istreambuf_iterator<char>(in), {}).find(text) != std::string::npos;
}

/// history.csv of the program's run.
Columns history(const std::string& name, const std::string& case_path,
                const std::vector<std::string>& overrides, int processes) {
  const fs::path folder = k_folder / fmt::format("{}_on_{}", name, processes);
  fs::remove_all(folder);
  fs::create_directories(k_folder);
  std::string command = fmt::format("{} '{}/solidus' run '{}/{}' -o '{}' --no-progress", launcher(processes),
                                    SOLIDUS_BINARY_DIR, SOLIDUS_SOURCE_DIR, case_path, folder.string());
  for (const std::string& o : overrides) command += " --set '" + o + "'";
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {};
  std::string said;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe)) said += buffer.data();
  const int status = pclose(pipe);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << command << "\n" << said;
  EXPECT_TRUE(says(folder / "summary.json", fmt::format("\"processes\": {}", processes))) << command;
  return solidus::testing::read_csv(folder / "history.csv");
}

double range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// Every column to `tolerance` of its range over the run. The defect of the energy and other differences of
/// joules are compared with the heat exchanged, of which they are what is left.
void compare(const std::string& name, const std::string& case_path, std::vector<std::string> overrides,
             double tolerance) {
  const Columns one = history(name, case_path, overrides, 1), two = history(name, case_path, overrides, 2);
  ASSERT_FALSE(one.empty());
  ASSERT_EQ(one.size(), two.size());
  const double heat = range(one.at("heat_exchanged[J]"));
  std::string worst_column;
  double worst = 0;
  for (const auto& [column, values] : one) {
    ASSERT_TRUE(two.contains(column)) << column;
    const std::vector<double>& others = two.at(column);
    ASSERT_EQ(values.size(), others.size());
    const bool joules = column.find("[J]") != std::string::npos;
    const double scale = joules ? heat : std::max(range(values), 1e-12);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double difference = std::abs(values[i] - others[i]) / scale;
      if (difference > worst) {
        worst = difference;
        worst_column = column;
      }
      EXPECT_LE(difference, tolerance) << column << " in row " << i << ": " << values[i] << ", " << others[i];
    }
  }
  ::testing::Test::RecordProperty("largest_difference", fmt::format("{:.1e} in {}", worst, worst_column));
  fmt::print("largest difference: {:.1e} of the range of {}\n", worst, worst_column);
}

const std::vector<std::string> k_strict{"mechanics.tolerance=1e-9", "mechanics.max_iterations=60",
                                        "mechanics.solver=\"direct\"", "heat.solver=\"direct\"",
                                        "heat.tolerance=1e-11"};
const std::vector<std::string> k_cylinder{"mesh.cylinder_in_mould.element_size=\"2.5 mm\"",
                                          "mesh.cylinder_in_mould.mould_element_size=\"5 mm\"",
                                          "time.end=\"10 s\"", "output.every=\"10 s\""};
const std::vector<std::string> k_blocks{"mesh.two_blocks.lower_divisions=[5, 5, 2]",
                                        "mesh.two_blocks.upper_divisions=[4, 4, 3]", "time.end=\"10 s\"",
                                        "output.every=\"10 s\""};

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(TwoProcesses, SolidifyTheAluminiumCylinderAsOneDoes) {
  compare("aluminium_cylinder", "cases/aluminium_cylinder", both(k_cylinder, k_strict), 1e-8);
}

TEST(TwoProcesses, SolidifyTheAluminiumCylinderSimultaneouslyAsOneDoes) {
  compare("aluminium_cylinder_simultaneous", "cases/aluminium_cylinder",
          both(both(k_cylinder, k_strict),
               {"coupling.scheme=\"simultaneous\"", "time.end=\"4 s\"", "output.every=\"4 s\""}),
          1e-8);
}

TEST(TwoProcesses, CoolTwoBlocksInThreeDimensionsAsOneDoes) {
  compare("two_blocks", "cases/two_blocks", both(k_blocks, k_strict), 1e-8);
}

TEST(TwoProcesses, SolveTheCasesAsTheyAreAsOneDoes) {
  // The thermal phase ends at 1e-5 of the heat that moves in each of the two stages of a step.
  compare("aluminium_cylinder_default", "cases/aluminium_cylinder", k_cylinder, 2e-5);
  compare("two_blocks_default", "cases/two_blocks", k_blocks, 2e-5);
}

}  // namespace
