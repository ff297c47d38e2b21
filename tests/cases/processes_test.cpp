/// A complete casting on four, two and one process: contact with friction, phase change, plasticity, steps
/// that adapt, stopped and continued on fewer processes. There are fewer cores than processes where this
/// runs.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "case_folder.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::Columns;

/// The aluminium cylinder on a coarse mesh, which sticks and slips in its mould far enough to meet other
/// faces.
constexpr const char* k_case =
    " --set mesh.cylinder_in_mould.element_size='\"3.5 mm\"'"
    " --set mesh.cylinder_in_mould.mould_element_size='\"7 mm\"'"
    " --set body.part.material='\"" SOLIDUS_SOURCE_DIR
    "/cases/aluminium_cylinder/plastic_aluminium_99_7.toml\"'"
    " --set contact.interface.formulation='\"large_sliding\"'"
    " --set contact.interface.friction.coefficient=0.3"
    " --set contact.interface.wear.archard=1e-4 --set contact.interface.wear.hardness='\"1 GPa\"'"
    " --set contact.interface.wear.master_share=0.5"
    " --set time.adaptive=true --set time.step='\"0.5 s\"' --set output.every='\"4 s\"'"
    // Steps take the same iterations on any number of processes where rounding alone differs.
    " --set mechanics.tolerance=1e-9 --set mechanics.max_iterations=60 --set heat.tolerance=1e-11"
    " --set mechanics.solver='\"direct\"' --set heat.solver='\"direct\"'"
    " --set mechanics.simplices='\"mixed\"'";

class Processes : public ::testing::Test {
 protected:
  static fs::path root() { return fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "processes"; }
  void SetUp() override { fs::remove_all(root()); }

  /// This program is one of MPI too: its environment would confuse mpirun.
  static void run(const std::string& folder, int processes, const std::string& more,
                  const std::string& of = std::string("cases/aluminium_cylinder'") + k_case) {
    const std::string command = fmt::format(
        "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 "
        "mpirun -n {} --bind-to none --oversubscribe '" SOLIDUS_BINARY_DIR
        "/solidus' run -o '{}' --no-progress '" SOLIDUS_SOURCE_DIR "/{} {} 2>&1",
        processes, (root() / folder).string(), of, more);
    std::FILE* pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string said;
    std::array<char, 512> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe)) said += buffer.data();
    const int status = pclose(pipe);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << command << "\n" << said;
  }

  /// Every column to `tolerance` of its range; joules and the heat of friction, which are differences of
  /// large heats and small slips, of the heat.
  static void expect_alike(const Columns& a, const Columns& b, double tolerance) {
    const auto range = [](const std::vector<double>& v) {
      const auto [low, high] = std::minmax_element(v.begin(), v.end());
      return *high - *low;
    };
    ASSERT_EQ(a.size(), b.size());
    const double heat = range(a.at("heat_exchanged[J]"));
    for (const auto& [column, values] : a) {
      const std::vector<double>& others = b.at(column);
      ASSERT_EQ(values.size(), others.size()) << column;
      const double scale = column.find("[J]") != std::string::npos ? heat
                           : column == "interface_frictional_heat[W]"
                               ? range(a.at("interface_conducted_heat[W]"))
                               : std::max(range(values), 1e-12);
      double worst = 0;
      for (std::size_t i = 0; i < values.size(); ++i)
        worst = std::max(worst, std::abs(values[i] - others[i]) / scale);
      EXPECT_LE(worst, tolerance) << column;
    }
  }
};

// Partition and order of sums differ, the algorithm does not. Between steps of contact with friction rounding
// grows by the condition of the problem; the criteria above are 1e-9 of the forces: 1e-7 of a column's range.
TEST_F(Processes, AStoppedCastingGoesOnFromFourToTwoToOneAsIfOneHadComputedItAll) {
  run("one", 1, "--set time.end='\"12 s\"'");
  run("moved", 4, "--set time.end='\"4 s\"'");
  run("moved", 2, "--set time.end='\"8 s\"' --restart");
  run("moved", 1, "--set time.end='\"12 s\"' --restart");
  const Columns one = solidus::testing::read_csv(root() / "one/history.csv");
  expect_alike(one, solidus::testing::read_csv(root() / "moved/history.csv"), 1e-7);
  // The comparison is significant only if the run has frozen, rubbed and flowed.
  EXPECT_LT(one.at("solid_fraction[1]").front(), 0.5);
  EXPECT_GT(one.at("interface_friction_dissipation[J]").back(), 0);
  EXPECT_GT(one.at("plastic_work[J]").back(), 0);
}

// Mixed tetrahedra that freeze next to others that do not, in contact. Three processes, for of two messages
// only one order is possible.
TEST_F(Processes, MultigridOfMixedTetrahedraGivesTheSameBitsInEveryRunOnThree) {
  const std::string blocks =
      "cases/two_blocks' --set mesh.two_blocks.lower_divisions='[6, 6, 3]'"
      " --set mesh.two_blocks.upper_divisions='[5, 5, 4]' --set mesh.element='\"tet4\"'"
      " --set mechanics.simplices='\"mixed\"' --set mechanics.solver='\"multigrid\"'"
      " --set body.upper.initial_temperature='\"700 degC\"' --set time.end='\"10 s\"'"
      " --set output.every='\"10 s\"'";
  run("first", 3, "", blocks);
  run("second", 3, "", blocks);
  const fs::path first = root() / "first", second = root() / "second";
  EXPECT_EQ(solidus::testing::read_text(first / "history.csv"),
            solidus::testing::read_text(second / "history.csv"));
  int n_pieces = 0;
  for (const auto& file : fs::recursive_directory_iterator(first)) {
    if (file.path().extension() != ".vtu") continue;
    ++n_pieces;
    const fs::path other = second / fs::relative(file.path(), first);
    EXPECT_TRUE(solidus::testing::read_text(file.path()) == solidus::testing::read_text(other)) << other;
  }
  EXPECT_GE(n_pieces, 6);
  const Columns history = solidus::testing::read_csv(first / "history.csv");
  EXPECT_GT(history.at("solid_fraction[1]").back(), history.at("solid_fraction[1]").front());
}

}  // namespace
