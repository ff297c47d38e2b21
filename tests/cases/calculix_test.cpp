/// Runs that are exported and go on in CalculiX, which moves nothing: what the file holds is in balance.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include "exported_case.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::exported;
using solidus::testing::k_press;
using solidus::testing::numbers;
using solidus::testing::read_text;
using ::testing::HasSubstr;

const solidus::testing::CaseFolder k_here("calculix");

/// Runs CalculiX on an exported file. If it is not installed these tests say so and are skipped.
class CalculiX : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v ccx >/dev/null") != 0)
      GTEST_SKIP() << "CalculiX is not installed (ccx; Debian 13 has no package of it)";
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
  EXPECT_EQ(exported(k_here, "press", file).supports, 1u);
  EXPECT_LT(largest(displacements(file)), 1e-6 * unbalanced(file));
}

// An axisymmetric layer is a wedge for CalculiX, right to the square of its angle: 1e-4 of σ L/E.
TEST_F(CalculiX, DoesNotMoveMixedTrianglesAroundAnAxis) {
  ASSERT_TRUE(solidus::testing::run("cases/aluminium_cylinder", "calculix/cylinder",
                                    {"mesh.cylinder_in_mould.element_size=8 mm",
                                     "mesh.cylinder_in_mould.mould_element_size=16 mm", "time.end=10 s",
                                     "mechanics.simplices=mixed", "mechanics.tolerance=1e-10"})
                  .finished);
  const fs::path file = k_here.root() / "cylinder_held.inp";
  exported(k_here, "cylinder", file);
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
  exported(k_here, "tube", file);
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
    exported(k_here, name, file);
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
  exported(k_here, "all", file);
  EXPECT_LT(largest(displacements(file)), 1e-6 * unbalanced(file));
  EXPECT_THAT(read_text(file), HasSubstr("NSET=ALL_2"));
}

}  // namespace
