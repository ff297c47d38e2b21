/// `solidus materials NAME -o FOLDER` and its picture, `import` and `scheil`, by the real program.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "material/cards/library.hpp"

namespace solidus {
namespace {

namespace fs = std::filesystem;

const std::array<fs::path, 1> k_library{fs::path(SOLIDUS_SOURCE_DIR) / "materials"};

/// The files of a material's tables, written into a folder of their own.
class MaterialTables : public ::testing::TestWithParam<std::string> {
 protected:
  fs::path folder_ = fs::temp_directory_path() / ("solidus_tables_" + GetParam());
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  int run(const std::string& command) const {
    return std::system(("SOLIDUS_MATERIALS='" + k_library[0].string() +
                        "' PYTHONPATH='" SOLIDUS_SOURCE_DIR "/python' PYTHONDONTWRITEBYTECODE=1 " + command +
                        " >/dev/null")
                           .c_str());
  }
  std::string quoted_folder() const { return "'" + folder_.string() + "'"; }
};

struct Csv {
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;
  explicit Csv(const fs::path& file) {
    std::ifstream in(file);
    std::string line, cell;
    std::getline(in, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) header.push_back(cell);
    while (std::getline(in, line)) {
      rows.emplace_back();
      for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        rows.back().push_back(std::stod(cell));
    }
  }
  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  }
};

TEST_P(MaterialTables, HoldThePropertiesOfTheCard) {
  ASSERT_EQ(run("'" SOLIDUS_BINARY_DIR "/solidus' materials " + GetParam() + " -o " + quoted_folder()), 0);
  const material::Material m = material::find_material(GetParam(), k_library);
  const Csv table(folder_ / "properties.csv");
  ASSERT_GT(table.rows.size(), 200u);
  const std::size_t conductivity = table.column("conductivity[W/m/K]"),
                    enthalpy = table.column("enthalpy[kJ/kg]");
  double before = table.rows.front()[enthalpy];
  for (const auto& row : table.rows) {
    EXPECT_NEAR(row[conductivity], m.conductivity.value(row[0] + 273.15), 1e-9);
    EXPECT_GE(row[enthalpy], before);
    before = row[enthalpy];
  }
  EXPECT_EQ(fs::exists(folder_ / "flow_curves.csv"), m.flow.has_value());
  if (m.flow) {
    const Csv curves(folder_ / "flow_curves.csv");
    EXPECT_EQ(curves.rows.front()[0], 0);
    const double coldest = m.flow->flow_stress.x().front();
    EXPECT_NEAR(curves.rows.front()[1], 1e-6 * m.flow->flow_stress.value(coldest), 1e-9);
    for (std::size_t i = 1; i < curves.rows.size(); ++i)
      for (std::size_t c = 1; c < curves.header.size(); ++c)
        EXPECT_GE(curves.rows[i][c], curves.rows[i - 1][c] - 1e-9) << curves.header[c];  // rounding
  }
}

// One of each kind; what every card must keep is in tests/unit/material/library_consistency_test.cpp.
INSTANTIATE_TEST_SUITE_P(Library, MaterialTables,
                         ::testing::Values("aluminium_1070", "aluminium_99_7_plastic", "aluminium_alsi9cu3",
                                           "cast_iron_die", "compacted_iron", "copper_chill", "green_sand",
                                           "low_carbon_steel", "magnesium_az91", "pure_iron", "pure_tin",
                                           "steel_mould"),
                         [](const auto& name) { return name.param; });

using MaterialPicture = MaterialTables;

TEST_P(MaterialPicture, IsDrawnWithoutAWarning) {
  ASSERT_EQ(run("'" SOLIDUS_BINARY_DIR "/solidus' materials " + GetParam() + " -o " + quoted_folder()), 0);
  ASSERT_EQ(run("/usr/bin/python3 -W error -m solidus_plots.material " + quoted_folder()), 0);
  EXPECT_GT(fs::file_size(folder_ / "material.png"), 20000u);
}

// One that freezes and creeps, one that stays solid, one that conducts heat only.
INSTANTIATE_TEST_SUITE_P(Library, MaterialPicture,
                         ::testing::Values("aluminium_alsi7mg", "h13_tool_steel", "green_sand"),
                         [](const auto& name) { return name.param; });

/// `solidus materials import` and `scheil` by the real program.
class MaterialImport : public MaterialTables {
 protected:
  std::string program(const std::string& arguments) const {
    return "'" SOLIDUS_BINARY_DIR "/solidus' materials " + arguments;
  }
};

TEST_P(MaterialImport, WritesACardThatTheProgramReads) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "table.csv")
      << "T [C],fs,Enthalpy [J/g]\n650,0,900\n620,0,870\n600,0.4,700\n577,0.6,580\n577,1,400\n560,1,380\n";
  const std::string table = "'" + (folder_ / "table.csv").string() + "'",
                    card = "'" + (folder_ / "card.toml").string() + "'";
  ASSERT_EQ(run(program("import " + table + " -o " + card + " --like " + GetParam() + " --title Test")), 0);
  EXPECT_EQ(run(program(card)), 0);
  const material::Material m = material::load_material(folder_ / "card.toml", k_library);
  EXPECT_NEAR(m.solid_fraction(600 + 273.15), 0.4, 1e-12);
  EXPECT_EQ(m.title, "Test");
  EXPECT_EQ(run(program("import " + table + " 2>/dev/null")), 256) << "nothing tells the conductivity";
  EXPECT_EQ(run(program("scheil Al-7Si-0.3Mg -o " + card)), 0);
  EXPECT_EQ(run(program("scheil Al-17Si 2>/dev/null")), 256);
}

INSTANTIATE_TEST_SUITE_P(Program, MaterialImport, ::testing::Values("aluminium_alsi7mg"),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace solidus
