/// Runs that are exported: what the file balances, what holds the parts in it, and what they are called.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "case_folder.hpp"
#include "run/structural_export.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::read_text;
using ::testing::HasSubstr;
using ::testing::Not;

const solidus::testing::CaseFolder k_here("export");

solidus::model::ExportReport exported(const std::string& run, const fs::path& file) {
  return solidus::model::export_state(solidus::model::load_case(k_here.root() / run / "case.toml"),
                                      {.folder = k_here.root() / run, .file = file});
}

/// The numbers of every line below a keyword of the file, up to the next one.
std::vector<std::vector<double>> numbers(const std::string& deck, const std::string& keyword) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(deck.substr(deck.find(keyword)));
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line) && line[0] != '*') {
    rows.emplace_back();
    for (std::istringstream row(line); std::getline(row, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

const std::string k_press = R"(title = "A plate that lies on a block"
[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "10 mm"]
upper = ["40 mm", "5 mm"]
lower_divisions = [8, 2]
upper_divisions = [8, 1]
[time]
end = "1 s"
step = "1 s"
[[body]]
name = "block"
group = "lower"
material = "steel_mould"
initial_temperature = "20 degC"
[[body]]
name = "plate"
group = "upper"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "ground"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "side"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "pressed"
group = "upper_y_max"
kind = "pressure"
pressure = "10 MPa"
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
)";

TEST(Export, HoldsAPartThatOnlyContactHeldAndSaysSo) {
  ASSERT_TRUE(k_here.run("press", k_press).finished);
  const fs::path file = k_here.root() / "press.inp";
  EXPECT_EQ(exported("press", file).supports, 1u);  // the plate, against moving up and down
  const std::string deck = read_text(file);
  EXPECT_THAT(deck, HasSubstr("** Of a part that only contact held"));
  ASSERT_TRUE(k_here
                  .run("clamped", k_press + R"([[mechanical_condition]]
name = "top"
group = "upper_y_max"
kind = "displacement"
uy = "-0.01 mm"
)")
                  .finished);
  EXPECT_EQ(exported("clamped", file).supports, 0u);
  EXPECT_THAT(read_text(file), Not(HasSubstr("only contact held")));
}

TEST(Export, CallsBodiesByTheirNames) {
  ASSERT_TRUE(k_here.run("names", k_press).finished);
  const fs::path file = k_here.root() / "names.inp";
  exported("names", file);
  EXPECT_THAT(read_text(file), HasSubstr("ELSET=PLATE"));
  EXPECT_THAT(read_text(k_here.root() / "names/summary.json"), HasSubstr("\"plate\": 8"));
}

// The forces of the stress in the file, by the one point that a CAX3 has, are the loads in the file.
TEST(Export, BalancesMixedTrianglesAroundAnAxis) {
  ASSERT_TRUE(solidus::testing::run("cases/aluminium_cylinder", "export/cylinder",
                                    {"mesh.cylinder_in_mould.element_size=8 mm",
                                     "mesh.cylinder_in_mould.mould_element_size=16 mm", "time.end=10 s",
                                     "mechanics.simplices=mixed", "mechanics.tolerance=1e-10"})
                  .finished);
  const fs::path file = k_here.root() / "cylinder.inp";
  exported("cylinder", file);
  const std::string deck = read_text(file);
  std::map<int, std::array<double, 2>> place, force;
  std::map<int, std::array<int, 3>> nodes;
  for (const auto& row : numbers(deck, "*NODE,")) place[static_cast<int>(row[0])] = {row[1], row[2]};
  for (std::size_t from = deck.find("*ELEMENT, TYPE=CAX3"); from != std::string::npos;
       from = deck.find("*ELEMENT, TYPE=CAX3", from + 1))
    for (const auto& row : numbers(deck.substr(from), "*ELEMENT"))
      nodes[static_cast<int>(row[0])] = {static_cast<int>(row[1]), static_cast<int>(row[2]),
                                         static_cast<int>(row[3])};
  ASSERT_GT(nodes.size(), 20u);
  double scale = 0;
  for (const auto& row : numbers(deck, "*INITIAL CONDITIONS, TYPE=STRESS")) {
    if (row[1] != 1) continue;  // a point of the other layer
    const std::array<int, 3>& e = nodes.at(static_cast<int>(row[0]));
    const auto &a = place[e[0]], &b = place[e[1]], &c = place[e[2]];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    const double r = (a[0] + b[0] + c[0]) / 3, w = std::numbers::pi * r * twice;
    const std::array<std::array<double, 2>, 3> x{a, b, c};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &next = x[(i + 1) % 3], &last = x[(i + 2) % 3];
      const double gr = (next[1] - last[1]) / twice, gz = (last[0] - next[0]) / twice;
      const double fr = w * (gr * row[2] + gz * row[5] + row[4] / (3 * r)),
                   fz = w * (gz * row[3] + gr * row[5]);
      force[e[i]][0] += fr;
      force[e[i]][1] += fz;
      scale = std::max({scale, std::abs(fr), std::abs(fz)});
    }
  }
  for (const auto& row : numbers(deck, "*CLOAD"))
    force[static_cast<int>(row[0])][static_cast<std::size_t>(row[1]) - 1] -= row[2];
  for (std::size_t from = deck.find("*BOUNDARY"); from != std::string::npos;
       from = deck.find("*BOUNDARY", from + 1))
    for (const auto& row : numbers(deck.substr(from), "*BOUNDARY"))
      force[static_cast<int>(row[0])][static_cast<std::size_t>(row[1]) - 1] = 0;
  for (const auto& [node, f] : force)
    for (const double value : f) EXPECT_NEAR(value, 0, 1e-6 * scale) << node;
}

/// Runs CalculiX on an exported file. If it is not installed these tests say so and are skipped.
class CalculiX : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v ccx >/dev/null") != 0) GTEST_SKIP() << "calculix-ccx is not installed";
  }
  /// Displacements of the nodes of the input in the last increment; of the layer that CalculiX makes of a
  /// plane element the nodes on both sides move alike. By the number of CalculiX [m].
  static std::map<int, std::array<double, 3>> displacements(const fs::path& deck) {
    const std::string command = fmt::format("cd '{}' && OMP_NUM_THREADS=1 ccx -i '{}' > ccx.log 2>&1",
                                            deck.parent_path().string(), deck.stem().string());
    EXPECT_EQ(std::system(command.c_str()), 0) << read_text(deck.parent_path() / "ccx.log");
    std::istringstream lines(read_text(fs::path(deck).replace_extension(".frd")));
    std::map<int, std::array<double, 3>> moved;
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(" -4")) inside = line.find("DISP") != std::string::npos;
      if (!inside || !line.starts_with(" -1") || line.size() < 49) continue;
      for (std::size_t i = 0; i < 3; ++i)
        moved[std::stoi(line.substr(3, 10))][i] = std::stod(line.substr(13 + 12 * i, 12));
    }
    EXPECT_FALSE(moved.empty()) << read_text(deck.parent_path() / "ccx.log");
    return moved;
  }
  static double largest(const std::map<int, std::array<double, 3>>& moved) {
    double most = 0;
    for (const auto& [node, u] : moved)
      for (const double value : u) most = std::max(most, std::abs(value));
    return most;
  }
  /// σ L/E: what the largest stress of a file would move it, were it not balanced [m].
  static double unbalanced(const fs::path& file) {
    const std::string deck = read_text(file);
    double stress = 0, low = 1e300, high = -1e300;
    for (const auto& row : numbers(deck, "*INITIAL CONDITIONS, TYPE=STRESS"))
      for (std::size_t i = 2; i < 8; ++i) stress = std::max(stress, std::abs(row[i]));
    for (const auto& row : numbers(deck, "*NODE,"))
      for (std::size_t i = 1; i < 3; ++i) {
        low = std::min(low, row[i]);
        high = std::max(high, row[i]);
      }
    return stress * (high - low) / numbers(deck, "*ELASTIC")[0][0];
  }
};

TEST_F(CalculiX, DoesNotMoveAPartThatOnlyContactHeld) {
  ASSERT_TRUE(k_here.run("press", k_press).finished);
  const fs::path file = k_here.root() / "held.inp";
  EXPECT_EQ(exported("press", file).supports, 1u);
  EXPECT_LT(largest(displacements(file)), 1e-6 * unbalanced(file));
}

// An axisymmetric layer is a wedge for CalculiX, right to the square of its angle: 1e-4 of σ L/E.
TEST_F(CalculiX, DoesNotMoveMixedTrianglesAroundAnAxis) {
  ASSERT_TRUE(solidus::testing::run("cases/aluminium_cylinder", "export/cylinder",
                                    {"mesh.cylinder_in_mould.element_size=8 mm",
                                     "mesh.cylinder_in_mould.mould_element_size=16 mm", "time.end=10 s",
                                     "mechanics.simplices=mixed", "mechanics.tolerance=1e-10"})
                  .finished);
  const fs::path file = k_here.root() / "cylinder_held.inp";
  exported("cylinder", file);
  EXPECT_LT(largest(displacements(file)), 3e-4 * unbalanced(file));
}

const std::string k_tube = R"(title = "A tube under pressure, held at its ends"
[analysis]
kind = "axisymmetric"
physics = "mechanics"
[mesh]
shape = "block"
element = "tri3"
[mesh.block]
origin = ["100 mm", "0 mm"]
size = ["100 mm", "10 mm"]
divisions = [40, 4]
[time]
end = "1 s"
step = "1 s"
[mechanics]
simplices = "mixed"
tolerance = 1e-10
[[body]]
name = "tube"
group = "block"
material = "elastic.toml"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "ends"
group = "y_min"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "other end"
group = "y_max"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "inside"
group = "x_min"
kind = "pressure"
pressure = "10 MPa"
)";

// Without its loads the file springs back by what Lamé's tube had widened, with the error of its mesh.
TEST_F(CalculiX, ReleasesATubeOfMixedTrianglesByWhatLameSays) {
  k_here.write("elastic.toml", R"(title = "Elastic"
[density]
value = "7800 kg/m3"
source = "test"
[young_modulus]
value = "200 GPa"
source = "test"
[poisson_ratio]
value = 0.3
source = "test"
[conductivity]
value = "50 W/m/K"
source = "test"
[specific_heat]
value = "500 J/kg/K"
source = "test"
[expansion]
value = "1e-5 1/K"
source = "test"
)");
  ASSERT_TRUE(k_here.run("tube", k_tube).finished);
  const fs::path file = k_here.root() / "tube.inp";
  exported("tube", file);
  EXPECT_LT(largest(displacements(file)), 3e-4 * unbalanced(file));
  const std::string deck = read_text(file);
  const std::size_t loads = deck.find("*CLOAD");
  ASSERT_NE(loads, std::string::npos);
  const fs::path released = k_here.root() / "released.inp";
  k_here.write("released.inp", deck.substr(0, loads) + deck.substr(deck.find('*', loads + 1)));
  const std::map<int, std::array<double, 3>> moved = displacements(released);
  constexpr double k_e = 200e9, k_nu = 0.3, k_p = 10e6, k_a = 0.1, k_b = 0.2;
  int compared = 0;
  for (const auto& row : numbers(deck, "*NODE,")) {
    const double r = row[1], widened = (1 + k_nu) * k_p * k_a * k_a / (k_e * (k_b * k_b - k_a * k_a)) *
                                       ((1 - 2 * k_nu) * r + k_b * k_b / r);
    const auto node = moved.find(static_cast<int>(row[0]));
    if (node == moved.end()) continue;
    EXPECT_NEAR(node->second[0], -widened, 2e-3 * widened) << "at " << r;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

// The pressure of the file is that of the volumetric modes, which differs from that of the law at the points
// where the bulk modulus varies within an element.
TEST_F(CalculiX, DoesNotMoveQuadsAndHexesOfSecondOrder) {
  k_here.write("softens.toml", R"(title = "Softens"
[density]
value = "7800 kg/m3"
source = "test"
[young_modulus]
argument_unit = "degC"
unit = "GPa"
points = [[20, 200], [1020, 50]]
source = "test"
[poisson_ratio]
value = 0.4
source = "test"
[conductivity]
value = "50 W/m/K"
source = "test"
[specific_heat]
value = "500 J/kg/K"
source = "test"
[expansion]
value = "1e-5 1/K"
source = "test"
)");
  for (const bool solid : {false, true}) {
    const std::string text = fmt::format(R"(title = "A block under its own pressure"
[analysis]
kind = "{}"
physics = "mechanics"
[mesh]
shape = "block"
element = "{}"
[mesh.block]
origin = [{}]
size = [{}]
divisions = [{}]
[time]
end = "1 s"
step = "1 s"
[mechanics]
tolerance = 1e-10
[[body]]
name = "block"
group = "block"
material = "softens.toml"
initial_temperature = {{ formula = "20 + 1e4*y", unit = "degC" }}
[[mechanical_condition]]
name = "ground"
group = "y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
{}
[[mechanical_condition]]
name = "pressed"
group = "x_max"
kind = "pressure"
pressure = "10 MPa"
)",
                                         solid ? "solid" : "plane_strain", solid ? "hex20" : "quad8",
                                         solid ? R"("0 mm", "0 mm", "0 mm")" : R"("0 mm", "0 mm")",
                                         solid ? R"("40 mm", "20 mm", "10 mm")" : R"("40 mm", "20 mm")",
                                         solid ? "3, 2, 1" : "3, 2", solid ? "uz = \"0 mm\"" : "");
    const std::string name = solid ? "hex20" : "quad8";
    ASSERT_TRUE(k_here.run(name, text).finished);
    const fs::path file = k_here.root() / (name + ".inp");
    exported(name, file);
    EXPECT_LT(largest(displacements(file)), 1e-6 * unbalanced(file)) << name;
  }
}

// CalculiX would take a set called ALL twice for one set of both.
TEST_F(CalculiX, DoesNotMoveAPartWithAGroupCalledAll) {
  k_here.write("plate.geo", R"(Point(1) = {0, 0, 0, 5}; Point(2) = {40, 0, 0, 5};
Point(3) = {40, 10, 0, 5}; Point(4) = {0, 10, 0, 5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("plate") = {1}; Physical Curve("all") = {1}; Physical Curve("top") = {3};
)");
  std::string text = k_press.substr(0, k_press.find("[mesh]")) + R"([mesh]
file = "plate.geo"
unit = "mm"
[time]
end = "1 s"
step = "1 s"
[[body]]
name = "plate"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "ground"
group = "all"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "pressed"
group = "top"
kind = "pressure"
pressure = "10 MPa"
)";
  ASSERT_TRUE(k_here.run("all", text).finished);
  const fs::path file = k_here.root() / "all.inp";
  exported("all", file);
  EXPECT_LT(largest(displacements(file)), 1e-6 * unbalanced(file));
  EXPECT_THAT(read_text(file), HasSubstr("NSET=ALL_2"));
}

}  // namespace
