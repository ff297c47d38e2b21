/// Runs that are exported: what the file balances, what holds the parts in it, and what they are called.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "exported_case.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::exported;
using solidus::testing::k_press;
using solidus::testing::numbers;
using solidus::testing::read_text;
using ::testing::HasSubstr;
using ::testing::Not;

const solidus::testing::CaseFolder k_here("export");

TEST(Export, HoldsAPartThatOnlyContactHeldAndSaysSo) {
  ASSERT_TRUE(k_here.run("press", k_press).finished);
  const fs::path file = k_here.root() / "press.inp";
  EXPECT_EQ(exported(k_here, "press", file).supports, 1u);  // the plate, against moving up and down
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
  EXPECT_EQ(exported(k_here, "clamped", file).supports, 0u);
  EXPECT_THAT(read_text(file), Not(HasSubstr("only contact held")));
}

TEST(Export, CallsBodiesByTheirNames) {
  ASSERT_TRUE(k_here.run("names", k_press).finished);
  const fs::path file = k_here.root() / "names.inp";
  exported(k_here, "names", file);
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
  exported(k_here, "cylinder", file);
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

}  // namespace
