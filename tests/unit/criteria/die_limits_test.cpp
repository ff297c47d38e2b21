/// Wear and soldering of dies from shot to shot, of temperatures and depths given by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../mechanics/lattice.hpp"
#include "criteria/die_wear.hpp"
#include "criteria/quantities.hpp"
#include "criteria/soldering.hpp"

namespace solidus::criteria {
namespace {

TEST(Soldering, PartOfAStepAboveALimitIsThatOfALine) {
  EXPECT_EQ(part_above(500, 600, 700), 0);
  EXPECT_EQ(part_above(700, 700, 700), 0);
  EXPECT_EQ(part_above(800, 900, 700), 1);
  EXPECT_EQ(part_above(700, 900, 700), 1);
  EXPECT_DOUBLE_EQ(part_above(600, 800, 700), 0.5);
  EXPECT_DOUBLE_EQ(part_above(900, 500, 600), 0.75);
}

/// A block of one body, whose temperature and wear a test gives.
template <class Followed>
class Die {
 public:
  explicit Die(DieLimits limits)
      : mesh_(test::make_mesh({.shape = mesh::Shape::tet4, .cells = {2, 2, 2}, .distortion = 0.1})),
        materials_(1) {
    followed_ = std::make_unique<Followed>(CriterionContext{.mesh = mesh_,
                                                            .kind = AnalysisKind::solid,
                                                            .materials = materials_,
                                                            .heat = nullptr,
                                                            .mechanics = true,
                                                            .temperature = {},
                                                            .followed = {0},
                                                            .evaluation = 0.1,
                                                            .feeding_limit = 0.7,
                                                            .feeders = {},
                                                            .die_limits = {limits}});
    heat_.temperature.assign(mesh_.x.size(), 400);
    wear_.assign(mesh_.x.size(), 0);
    record_ = followed_->initial({0, heat_, mechanics_});
  }
  /// A step of `dt` to this temperature and depth; depth grows along x.
  void step(double dt, double temperature, double depth) {
    const heat::ThermalState before = heat_;
    heat_.temperature.assign(mesh_.x.size(), temperature);
    for (std::size_t i = 0; i < wear_.size(); ++i) wear_[i] = depth * mesh_.x[i][0];
    followed_->step({time_, before, mechanics_}, {time_ + dt, heat_, mechanics_, {}, {}, wear_}, record_);
    time_ += dt;
  }
  void next_shot() {
    record_ = followed_->next_shot(record_, {0, heat_, mechanics_});
    time_ = 0;
  }
  /// Values of a field at all nodes.
  std::vector<double> values(std::size_t field) const {
    std::vector<std::vector<double>> all(followed_->fields().size(), std::vector<double>(mesh_.x.size()));
    const std::vector<std::span<double>> spans(all.begin(), all.end());
    followed_->fill({time_, heat_, mechanics_}, record_, spans);
    return all[field];
  }
  std::vector<CriterionResult> findings() const { return followed_->findings(record_); }
  const mesh::Mesh& mesh() const { return mesh_; }

 private:
  mesh::Mesh mesh_;
  std::vector<material::Material> materials_;
  std::unique_ptr<Followed> followed_;
  heat::ThermalState heat_;
  mechanics::MechanicalState mechanics_;
  std::vector<double> wear_;
  CriterionRecord record_;
  double time_ = 0;
};

TEST(Soldering, CountsTheTimeOfAShotAndKeepsThatOfTheLast) {
  Die<Soldering> die({.soldering_temperature = 500.0});
  die.step(2, 600, 0);  // half of it above
  die.step(3, 700, 0);
  die.step(4, 300, 0);  // half of it above
  EXPECT_NEAR(die.values(0)[0], 1 + 3 + 2, 1e-12);
  // The next shot is shorter so far; that of two shots ago is forgotten.
  die.next_shot();
  die.step(1, 700, 0);
  EXPECT_NEAR(die.values(0)[0], 6, 1e-12);
  die.next_shot();
  EXPECT_NEAR(die.values(0)[0], 0.5, 1e-12);
  const std::vector<CriterionResult> findings = die.findings();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].name, "soldering_time_max");
  EXPECT_NEAR(findings[0].value, 0.5, 1e-12);
}

TEST(DieWear, IsWhatAShotAddsAndGivesTheShotsToADepth) {
  Die<DieWear> die({.worn_depth = 1e-4});
  die.step(1, 400, 1e-6);
  die.step(1, 400, 3e-6);
  die.next_shot();
  die.step(1, 400, 5e-6);
  die.next_shot();
  // In the second shot 2e-6 x were worn, which is what counts until the third wears more.
  for (std::size_t i = 0; i < die.mesh().x.size(); ++i) {
    const double depth = 2e-6 * die.mesh().x[i][0];
    EXPECT_NEAR(die.values(0)[i], depth, 1e-18);
    if (depth > 1e-12)
      EXPECT_NEAR(die.values(1)[i], 1e-4 / depth, 1e-6 / depth);
    else if (depth == 0)
      EXPECT_EQ(die.values(1)[i], -1);
  }
  die.step(1, 400, 9e-6);
  const std::vector<CriterionResult> findings = die.findings();
  double longest = 0;
  for (const mesh::Point& x : die.mesh().x) longest = std::max(longest, x[0]);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].name, "shot_wear_max");
  EXPECT_NEAR(findings[0].value, 4e-6 * longest, 1e-17);
  EXPECT_EQ(findings[1].name, "shots_until_worn_min");
  EXPECT_NEAR(findings[1].value, 25 / longest, 1e-9 / longest);
}

}  // namespace
}  // namespace solidus::criteria
