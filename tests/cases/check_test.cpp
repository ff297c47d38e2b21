/// Every case of the project is in order: `check` finds nothing to say of it, and its table is complete.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/log.hpp"
#include "model/run.hpp"
#include "results/overview.hpp"

namespace {

using namespace solidus;
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The files of cases/ that are whole cases: variants include a case.toml, materials and plots are none.
std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const auto& folder : fs::directory_iterator(fs::path(SOLIDUS_SOURCE_DIR) / "cases")) {
    if (!fs::exists(folder.path() / "case.toml")) continue;
    for (const auto& file : fs::directory_iterator(folder.path())) {
      if (file.path().extension() != ".toml" || file.path().filename() == "plots.toml") continue;
      std::ifstream in(file.path());
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      if (text.find("include = ") != std::string::npos || text.find("[[body]]") != std::string::npos)
        files.push_back(file.path());
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

TEST(Check, FindsNothingToSayOfTheProjectsCases) {
  logging::set_level(logging::Level::silent);
  const std::vector<fs::path> files = case_files();
  EXPECT_GT(files.size(), 100u);
  for (const fs::path& file : files) {
    logging::clear_warnings();
    const model::CheckedRun checked = model::check_run(model::load_case(file, overrides(file)));
    EXPECT_THAT(logging::warnings(), IsEmpty()) << file;
    EXPECT_THAT(results::text(checked.overview), HasSubstr("effort")) << file;
  }
  logging::set_level(logging::Level::info);
}

/// The estimate against what runs of the cases took, within a factor of two (docs/guide/findings.md).
TEST(Check, EstimatesWhenCastingsAreSolid) {
  struct Measured {
    const char* file;
    double seconds;  ///< until the last node is solid, of the run of the case
  };
  for (const Measured& m : {Measured{"aluminium_cylinder/case.toml", 14.0},
                            {"bracket/case.toml", 187},
                            {"bracket/plate.toml", 446},
                            {"hot_spots/case.toml", 272},
                            {"crankshaft/case.toml", 515}}) {
    const fs::path file = fs::path(SOLIDUS_SOURCE_DIR) / "cases" / m.file;
    const model::CheckedRun checked = model::check_run(model::load_case(file));
    ASSERT_EQ(checked.overview.pours.size(), 1u) << m.file;
    ASSERT_TRUE(checked.overview.pours[0].freezing_time) << m.file;
    const double ratio = *checked.overview.pours[0].freezing_time / m.seconds;
    EXPECT_GT(ratio, 0.5) << m.file;
    EXPECT_LT(ratio, 2.0) << m.file;
  }
}

}  // namespace
