/// Layers on what is poured, as `solidus new` chooses them.
#include "new_case/draft_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/roles.hpp"

namespace solidus::new_case {
namespace {

Draft draft() {
  Draft d;
  const auto body = [&](const char* name, const char* group, const char* material, cases::Role role) {
    DraftBody& b = d.bodies.emplace_back();
    b.name = name;
    b.group = group;
    b.material = material;
    b.role = role;
  };
  body("casting", "body_1", "aluminium_alsi7mg", cases::Role::casting);
  body("riser", "riser", "aluminium_alsi7mg", cases::Role::riser);
  body("mould", "mould", "green_sand", cases::Role::mould);
  body("core", "core", "furan_sand", cases::Role::core);
  return d;
}

/// Depth at which all layers end [m].
double depth(const DraftLayers& layers) {
  return layers.first * (std::pow(layers.growth, layers.number) - 1) / (layers.growth - 1);
}

TEST(DraftLayers, LieOnPartAndRiserAsDeepAsTheRootOfTheirTimes) {
  const std::vector<HeatedWall> walls = {{"mould_to_casting", "mould", "casting", 0.02, 0.05},
                                         {"mould_to_riser", "mould", "riser", 0.01, 0.05}};
  const std::vector<PouredTime> times = {{"casting", 200, 850}, {"riser", 800, 850}};
  const std::vector<DraftLayers> layers = choose_layers(draft(), walls, times, 1);
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_EQ(layers[0].surface, "mould_to_casting");
  EXPECT_EQ(layers[1].surface, "mould_to_riser");
  EXPECT_NE(layers[0].name, layers[1].name);
  for (const DraftLayers& l : layers) EXPECT_EQ(l.body, "mould");
  EXPECT_EQ(layers[0].number, layers[1].number);
  EXPECT_EQ(layers[0].growth, layers[1].growth);
  EXPECT_NEAR(depth(layers[1]) / depth(layers[0]), 2, 0.1);  // to two digits
  const double reach = std::sqrt(0.607 / (1500.0 * 1130) * 200);
  EXPECT_GT(depth(layers[0]), reach);
  EXPECT_LT(depth(layers[0]), 2 * reach);
}

TEST(DraftLayers, OfAThinCoreLeaveItAThirdOfItsThickness) {
  // A plate of 10 mm with metal on both sides: half of it is all that heat from one side has.
  const double area = 0.04, volume = 0.5 * area * 0.01;
  const std::vector<DraftLayers> layers = choose_layers(
      draft(), {{"core_to_casting", "core", "casting", area, volume}}, {{"casting", 600, 850}}, 1);
  ASSERT_EQ(layers.size(), 1U);
  EXPECT_NEAR(depth(layers[0]), 0.0035, 2e-4);
}

TEST(DraftLayers, AreMoreAndThinnerInAFinerMeshAndNeverFewer) {
  const std::vector<HeatedWall> walls = {{"mould_to_casting", "mould", "casting", 0.02, 0.05}};
  const auto at = [&](double fineness) {
    return choose_layers(draft(), walls, {{"casting", 200, 850}}, fineness).front();
  };
  EXPECT_EQ(at(0.5), at(1));
  EXPECT_EQ(at(2).number, 2 * at(1).number);
  EXPECT_LT(at(2).first, 0.6 * at(1).first);
  EXPECT_NEAR(depth(at(2)), depth(at(1)), 0.05 * depth(at(1)));
  EXPECT_LE(at(5).number, 20) << "more than the key takes";
}

TEST(DraftLayers, ThereAreNoneWithoutAnEstimateNorInDiesAndChills) {
  EXPECT_TRUE(
      choose_layers(draft(), {{"mould_to_casting", "mould", "casting", 0.02, 0.05}}, {{"casting", 0, 850}}, 1)
          .empty());
  for (const cases::Role role :
       {cases::Role::mould, cases::Role::core, cases::Role::sleeve, cases::Role::insulation})
    EXPECT_TRUE(has_layers(role)) << cases::name(role);
  for (const cases::Role role :
       {cases::Role::casting, cases::Role::riser, cases::Role::chill, cases::Role::die})
    EXPECT_FALSE(has_layers(role)) << cases::name(role);
}

TEST(Roles, PouredAreCastingsAndRisers) {
  for (const cases::Role role : {cases::Role::casting, cases::Role::riser})
    EXPECT_TRUE(cases::is_poured(role)) << cases::name(role);
  for (const cases::Role role : {cases::Role::mould, cases::Role::core, cases::Role::chill,
                                 cases::Role::sleeve, cases::Role::die, cases::Role::insulation})
    EXPECT_FALSE(cases::is_poured(role)) << cases::name(role);
}

}  // namespace
}  // namespace solidus::new_case
