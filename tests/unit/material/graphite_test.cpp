/// Graphite of cast irons by lever and by Scheil.
#include "material/graphite.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace solidus::material {
namespace {

Graphite iron(double carbon, double silicon, Graphite::Rule rule) {
  Graphite graphite;
  graphite.carbon = carbon;
  graphite.silicon = silicon;
  graphite.rule = rule;
  return graphite;
}

TEST(Graphite, ByLeverIsTheCarbonThatAusteniteDoesNotHold) {
  // 3.45 % C, 2.55 % Si: austenite holds 2.08 − 0.2805 = 1.7995 %.
  const Graphite nodular = iron(3.45, 2.55, Graphite::Rule::lever);
  EXPECT_NEAR(nodular.precipitated(), 100 * (3.45 - 1.7995) / (100 - 1.7995), 1e-12);
  EXPECT_NEAR(nodular.volume_change(), 0.0538, 1e-4);
}

TEST(Graphite, ByScheilIsThatOfTheEutecticThatIsLeft) {
  const Graphite lever = iron(3.3, 1.8, Graphite::Rule::lever),
                 scheil = iron(3.3, 1.8, Graphite::Rule::scheil);
  const double melt = 4.26 - 0.31 * 1.8, austenite = 2.08 - 0.11 * 1.8;
  const double left = std::pow(3.3 / melt, 1 / (1 - austenite / melt));
  EXPECT_NEAR(scheil.precipitated(), left * 100 * (melt - austenite) / (100 - austenite), 1e-12);
  // Primary austenite that keeps less carbon than C_A leaves more of it for the eutectic.
  EXPECT_GT(scheil.precipitated(), lever.precipitated());
}

TEST(Graphite, OfEutecticMeltIsTheSameByBothRules) {
  const double eutectic = iron(4, 2, Graphite::Rule::lever).eutectic();
  EXPECT_NEAR(iron(eutectic, 2, Graphite::Rule::lever).precipitated(),
              iron(eutectic, 2, Graphite::Rule::scheil).precipitated(), 1e-12);
  EXPECT_EQ(iron(1.5, 1, Graphite::Rule::lever).precipitated(), 0);
}

TEST(Graphite, FeedsInARigidMould) {
  Graphite graphite = iron(3.5, 2, Graphite::Rule::lever);
  for (const Graphite::Form form :
       {Graphite::Form::flake, Graphite::Form::compacted, Graphite::Form::nodular}) {
    graphite.form = form;
    EXPECT_EQ(graphite.feeding_share(1), 1);
    EXPECT_EQ(graphite.feeding_share(0), 0);
  }
  graphite.form = Graphite::Form::flake;
  const double flakes = graphite.feeding_share(0.5);
  graphite.form = Graphite::Form::compacted;
  const double compacted = graphite.feeding_share(0.5);
  graphite.form = Graphite::Form::nodular;
  EXPECT_GT(flakes, compacted);
  EXPECT_GT(compacted, graphite.feeding_share(0.5));
}

}  // namespace
}  // namespace solidus::material
