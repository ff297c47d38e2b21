/// Every case of the project is in order: `check` finds nothing to say of it, and its table is complete.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "results/overview.hpp"
#include "run/session.hpp"
#include "setup/case_layers.hpp"
#include "system/log.hpp"

namespace {

using namespace solidus;
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The files of cases/ that are whole cases, and variants: materials and plots are none.
std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const auto& folder : fs::directory_iterator(fs::path(SOLIDUS_SOURCE_DIR) / "cases")) {
    if (!fs::exists(folder.path() / "case.toml")) continue;
    for (const auto& file : fs::directory_iterator(folder.path())) {
      if (file.path().extension() != ".toml" || file.path().filename() == "plots.toml") continue;
      if (file.path().filename() == "variants.toml") {
        for (const setup::VariantInfo& variant : setup::variants_beside(file.path()))
          files.emplace_back(folder.path().string() + ":" + variant.name);
        continue;
      }
      std::ifstream in(file.path());
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      const auto has = [&text](const char* part) { return text.find(part) != std::string::npos; };
      // A file that cases include may have bodies as well, but it has no title.
      if (has("include = ") || (has("[[body]]") && has("title = "))) files.push_back(file.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Coarser meshes for what takes long to mesh.
std::vector<std::string> overrides(const fs::path& file) {
  if (file.parent_path().filename() == "crankshaft") return {"mesh.constant.size.value=12"};
  return {};
}

/// Cases that are unusual on purpose, as their READMEs say: iron and sand that share nodes as in the
/// monograph's figure, a drawn die whose parts do not face each other at their corners, a wheel whose web has
/// one element through it, so that ten shots take two minutes, a die that is asked for and not its thin
/// casting, a wall of beads whose sides see the plate a little, and layers on a shaft and in a groove that
/// draw in as they freeze, as elements with pores cannot grow.
bool unusual(const fs::path& file) {
  const fs::path folder = file.parent_path().filename();
  return folder == "cast_iron_in_sand" || folder == "wheel_in_die" || folder == "wheel_from_step" ||
         folder == "die_with_channels" || folder == "deposited_wall" || folder == "built_up_shaft" ||
         folder == "weld_repair";
}

TEST(Check, FindsNothingToSayOfTheProjectsCases) {
  logging::set_level(logging::Level::silent);
  const std::vector<fs::path> files = case_files();
  EXPECT_GT(files.size(), 100u);
  for (const fs::path& file : files) {
    logging::clear_warnings();
    const run::CheckedRun checked = run::check_run(setup::load_case(file, overrides(file)));
    if (!unusual(file)) {
      EXPECT_THAT(logging::warnings(), IsEmpty()) << file;
    }
    EXPECT_THAT(results::text(checked.overview), HasSubstr("effort")) << file;
  }
  logging::set_level(logging::Level::info);
}

/// The estimate against what runs of the cases took (docs/guide/findings.md).
TEST(Check, EstimatesWhenCastingsAreSolid) {
  struct Measured {
    const char* file;
    double seconds;  ///< until the last node is solid, of the run of the case
  };
  for (const Measured& m : {Measured{"aluminium_cylinder/case.toml", 13.0},
                            {"bracket/case.toml", 168},
                            {"bracket/plate.toml", 371},
                            {"hot_spots/case.toml", 272},
                            {"crankshaft/case.toml", 551}}) {
    const fs::path file = fs::path(SOLIDUS_SOURCE_DIR) / "cases" / m.file;
    const run::CheckedRun checked = run::check_run(setup::load_case(file, overrides(file)));
    ASSERT_EQ(checked.overview.pours.size(), 1u) << m.file;
    ASSERT_TRUE(checked.overview.pours[0].freezing_time) << m.file;
    const double ratio = *checked.overview.pours[0].freezing_time / m.seconds;
    EXPECT_GT(ratio, 0.7) << m.file;
    EXPECT_LT(ratio, 1.4) << m.file;
  }
}

/// A riser gives heat to the casting below it (docs/guide/findings.md).
TEST(Check, EstimatesWhenCastingsWithRisersAreSolid) {
  struct Measured {
    const char* file;
    double casting, riser;  ///< until the last node is solid, by heat alone [s]
  };
  for (const Measured& m :
       {Measured{"stepped_plate/case.toml", 301, 342}, {"riser_sleeve/sand.toml", 982, 973}}) {
    const fs::path file = fs::path(SOLIDUS_SOURCE_DIR) / "cases" / m.file;
    const run::CheckedRun checked = run::check_run(setup::load_case(file));
    ASSERT_EQ(checked.overview.pours.size(), 2u) << m.file;
    for (const results::PourOverview& pour : checked.overview.pours) {
      ASSERT_TRUE(pour.freezing_time) << m.file;
      const double ratio = *pour.freezing_time / (pour.body == "riser" ? m.riser : m.casting);
      EXPECT_GT(ratio, 0.7) << m.file << ' ' << pour.body;
      EXPECT_LT(ratio, 1.3) << m.file << ' ' << pour.body;
    }
  }
}

/// Output of the program for a case, without the line on the effort of the run, which depends on the number
/// of processes.
std::string table(int processes) {
  const std::string command =
      "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n " +
      std::to_string(processes) +
      " --bind-to none --oversubscribe '" SOLIDUS_BINARY_DIR "/solidus' check '" SOLIDUS_SOURCE_DIR
      "/cases/bracket' 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::string text;
  std::array<char, 512> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr)
    if (std::string_view(line.data()).find("  effort") != 0) text += line.data();
  pclose(pipe);
  return text;
}

TEST(Check, PrintsTheSameTableOnOneProcessAndOnTwo) {
  const std::string one = table(1);
  for (const char* said :
       {"poured      part: at 700 degC, 86 K above its liquidus", "148.5 cm3", "256.5 cm2", "0.399 kg",
        "on mould_surface (mould)", "9.81 m/s2 along -z", "by Chvorinov", "Biot", "in order"})
    EXPECT_THAT(one, HasSubstr(said));
  EXPECT_EQ(one, table(2));
}

}  // namespace
