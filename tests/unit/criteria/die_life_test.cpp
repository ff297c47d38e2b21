/// Fatigue of dies: lives by the law of Coffin, Manson and Basquin, ranges of strain of motions and
/// temperatures given by formula.
#include "criteria/die_life.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../mechanics/lattice.hpp"
#include "criteria/quantities.hpp"

namespace solidus::criteria {
namespace {

FatigueLaw steel() {
  return {.strength = 2e9,
          .modulus = 2e11,
          .strength_exponent = -0.09,
          .ductility = 0.3,
          .ductility_exponent = -0.6};
}

double range_of(const FatigueLaw& law, double cycles) {
  return 2 * ((law.strength - law.mean_stress) / law.modulus * std::pow(2 * cycles, law.strength_exponent) +
              law.ductility * std::pow(2 * cycles, law.ductility_exponent));
}

TEST(FatigueLaw, FindsTheCyclesThatTheFormulaHasTheRangeOf) {
  FatigueLaw law = steel();
  for (const double stress : {0.0, 4e8, -3e8}) {
    law.mean_stress = stress;
    for (const double cycles : {0.5, 100.0, 1e4, 1e7})
      EXPECT_NEAR(law.life(range_of(law, cycles)) / cycles, 1, 1e-9);
  }
  EXPECT_EQ(law.life(0), k_most_cycles);
  EXPECT_EQ(law.life(1e-6), k_most_cycles);
  EXPECT_GT(law.life(100), 0);
}

TEST(FatigueLaw, OfATableIsStraightInLogarithmsAndGoesOn) {
  FatigueLaw law;
  law.strain = {0.002, 0.02};
  law.cycles = {1e5, 10};
  EXPECT_NEAR(law.life(0.002), 1e5, 1e-6);
  EXPECT_NEAR(law.life(std::sqrt(0.002 * 0.02)), 1e3, 1e-8);
  EXPECT_NEAR(law.life(0.2), 1e-3, 1e-12);
  EXPECT_EQ(law.life(1e-5), k_most_cycles);
}

/// A block of one body, whose temperature and motion a test gives.
class Die {
 public:
  explicit Die(bool deforms)
      : mesh_(test::make_mesh({.shape = mesh::Shape::tet4, .cells = {2, 2, 2}, .distortion = 0.1})),
        materials_(1) {
    materials_[0].expansion = Table(1.2e-5);
    materials_[0].poisson_ratio = Table(0.3);
    FatigueLaw law = steel();
    law.deforms = deforms;
    life_ = std::make_unique<DieLife>(CriterionContext{.mesh = mesh_,
                                                       .kind = AnalysisKind::solid,
                                                       .materials = materials_,
                                                       .heat = nullptr,
                                                       .mechanics = deforms,
                                                       .temperature = {},
                                                       .followed = {0},
                                                       .evaluation = 0.1,
                                                       .feeding_limit = 0.7,
                                                       .feeders = {},
                                                       .fatigue = {law}});
    move(400, 0);
    record_ = life_->initial({0, heat_, mechanics_});
  }
  void step(double temperature, double strain) {
    const heat::ThermalState heat = heat_;
    const mechanics::MechanicalState mechanics = mechanics_;
    move(temperature, strain);
    life_->step({0, heat, mechanics}, {1, heat_, mechanics_}, record_);
  }
  void next_shot() { record_ = life_->next_shot(record_, {1, heat_, mechanics_}); }
  /// Range of strain and shots, which are the same at all nodes.
  std::array<double, 2> values() const {
    std::vector<double> range(mesh_.x.size()), shots(mesh_.x.size());
    life_->fill({1, heat_, mechanics_}, record_,
                std::array{std::span<double>(range), std::span<double>(shots)});
    for (std::size_t i = 0; i < range.size(); ++i) {
      EXPECT_NEAR(range[i], range[0], 1e-12);
      EXPECT_NEAR(shots[i], shots[0], 1e-6 * shots[0]);
    }
    return {range[0], shots[0]};
  }
  std::vector<CriterionResult> findings() const { return life_->findings(record_); }

 private:
  /// A bar along x under one stress, and thermal strain in all directions.
  void move(double temperature, double strain) {
    heat_.temperature.assign(mesh_.x.size(), temperature);
    mechanics_.displacement.clear();
    const double thermal = 1.2e-5 * (temperature - 400);
    for (const mesh::Point& x : mesh_.x) {
      mechanics_.displacement.push_back((strain + thermal) * x[0]);
      for (std::size_t i = 1; i < 3; ++i) mechanics_.displacement.push_back((thermal - 0.3 * strain) * x[i]);
    }
  }
  mesh::Mesh mesh_;
  std::vector<material::Material> materials_;
  std::unique_ptr<DieLife> life_;
  heat::ThermalState heat_;
  mechanics::MechanicalState mechanics_;
  CriterionRecord record_;
};

TEST(DieLife, OfASkinThatIsHeldIsTheBoundAndKeepsTheLastShot) {
  Die die(false);
  die.step(650, 0);
  die.step(380, 0);
  EXPECT_NEAR(die.values()[0], 2 * 1.2e-5 * 270, 1e-15);
  EXPECT_NEAR(die.values()[1], steel().life(2 * 1.2e-5 * 270), 1e-6);
  // The next shot is milder so far: that of the last one holds; then it is worse.
  die.next_shot();
  die.step(400, 0);
  EXPECT_NEAR(die.values()[0], 2 * 1.2e-5 * 270, 1e-15);
  die.step(700, 0);
  EXPECT_NEAR(die.values()[0], 2 * 1.2e-5 * 320, 1e-15);
  // Two shots on, the first one is forgotten.
  die.next_shot();
  die.next_shot();
  die.step(690, 0);
  EXPECT_NEAR(die.values()[0], 2 * 1.2e-5 * 10, 1e-15);
}

/// The bar is strained between its coldest and its hottest moment; what it does at others does not count, nor
/// does thermal strain.
TEST(DieLife, OfADieThatDeformsIsTheStrainOfABarUnderOneStress) {
  Die die(true);
  die.step(650, -0.004);
  die.step(500, -0.02);
  die.step(380, 0.001);
  EXPECT_NEAR(die.values()[0], 0.005, 1e-12);
  EXPECT_NEAR(die.values()[1], steel().life(0.005), 1e-3);
  const std::vector<CriterionResult> findings = die.findings();
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].name, "shot_strain_range_max");
  EXPECT_NEAR(findings[0].value, 0.005, 1e-12);
  EXPECT_EQ(findings[1].name, "shots_until_crack_min");
  EXPECT_NEAR(findings[1].value, steel().life(0.005), 1e-3);
  EXPECT_TRUE(findings[1].somewhere);
}

}  // namespace
}  // namespace solidus::criteria
