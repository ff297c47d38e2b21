// The skin behind a contact point, and the penalty that follows it.
#include "contact/surfaces/skin.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "contact/points/point_law.hpp"

namespace solidus::contact {
namespace {

/// Two nodes of the slave and two of the master, half and half.
Skin skin(const std::vector<double>& coherency, const std::vector<double>& of_solid) {
  const std::array<Index, 4> nodes{0, 1, 2, 3};
  const std::array<double, 4> share{0.5, 0.5, -0.5, -0.5};
  return skin_at(nodes, share, 2, {coherency, of_solid});
}

TEST(Skin, IsAsStrongAsTheLessSolidSide) {
  const std::vector<double> solid{2, 2, 4, 4};  // coherent at a half and at a quarter
  EXPECT_EQ(skin({2, 2, 4, 4}, solid).strength, 1);
  EXPECT_DOUBLE_EQ(skin({1.5, 1.5, 4, 4}, solid).strength, 0.5);
  EXPECT_DOUBLE_EQ(skin({1.5, 1.5, 1.75, 1.75}, solid).strength, 0.25);
  EXPECT_DOUBLE_EQ(skin({1, 2, 4, 4}, solid).strength, 0.5);
  EXPECT_EQ(skin({1, 1, 4, 4}, solid).strength, 0);
  // The other side never melts, or solid metal is just coherent.
  EXPECT_DOUBLE_EQ(skin({1.5, 1.5, 1, 1}, {2, 2, 1, 1}).strength, 0.5);
  EXPECT_EQ(skin({1, 1, 1, 1}, {1, 1, 1, 1}).strength, 1);
  EXPECT_EQ(skin({0.99, 1, 1, 1}, {1, 1, 1, 1}).strength, 0);
}

TEST(Skin, IsMoltenBelowCoherencyAndLiquidWithoutACoherentNode) {
  const std::vector<double> solid{2, 2, 1, 1};
  EXPECT_FALSE(skin({1, 1, 1, 1}, solid).molten);
  const Skin half = skin({0.5, 1, 1, 1}, solid), melt = skin({0.5, 0.5, 1, 1}, solid);
  EXPECT_TRUE(half.molten && !half.liquid);
  EXPECT_TRUE(melt.molten && melt.liquid);
  EXPECT_EQ(half.strength, 0);
}

struct Law {
  PointLaw law;
  Law() {
    law.normal = {NormalKind::penalty, 1e10};
    law.stiffening = 1e4;
    FrictionParameters friction;
    friction.coefficient.terms = {Table(0.3)};
    law.friction.emplace(friction, 1e10);
  }
  /// A closed point of a skin so strong.
  ContactPointState point(double strength, double pressure) const {
    ContactPointState p;
    p.anchored = true;
    p.status = PointStatus::sticks;
    p.stiffening = std::pow(law.stiffening, strength);
    p.pressure = pressure;
    p.penetration = pressure / law.normal_at(p).penalty;
    p.traction = {0.1 * pressure, 0, 0};
    return p;
  }
  double pressure_at(const ContactPointState& p) const {
    return law.normal_at(p).update(p.penetration, {}, 1).pressure;
  }
};

TEST(StiffeningPoint, KeepsItsPressureAndTakesWhatItSankInForItsWall) {
  const Law of;
  ContactPointState p = of.point(0, 1e6);
  const double before = of.law.stored(p), sunk = p.penetration;
  of.law.stiffen(0.5, p);
  EXPECT_DOUBLE_EQ(of.law.normal_at(p).penalty, 1e12);
  EXPECT_NEAR(of.pressure_at(p), 1e6, 1e-9 * 1e6);
  EXPECT_NEAR(p.penetration - p.offset, sunk, 1e-12 * sunk);  // the body has not moved
  EXPECT_DOUBLE_EQ(p.sunk, -p.offset);
  EXPECT_EQ(p.traction[0], 1e5);
  EXPECT_LT(of.law.stored(p), before);
  const ContactPointState once = p;
  of.law.stiffen(0.5, p);
  EXPECT_EQ(p.offset, once.offset);
  // In one step as in two.
  of.law.stiffen(1, p);
  ContactPointState at_once = of.point(0, 1e6);
  of.law.stiffen(1, at_once);
  EXPECT_NEAR(p.offset, at_once.offset, 1e-12 * sunk);
}

TEST(StiffeningPoint, GivesWayWhereItsSkinMeltsAgain) {
  const Law of;
  ContactPointState p = of.point(1, 1e8);
  const double before = of.law.stored(p), penetration = p.penetration;
  of.law.stiffen(0.5, p);
  EXPECT_EQ(p.penetration, penetration);
  EXPECT_EQ(p.offset, 0);
  EXPECT_NEAR(of.pressure_at(p), 1e6, 1e-9 * 1e6);
  EXPECT_NEAR(p.traction[0], 1e5, 1e-9 * 1e5);
  EXPECT_LT(of.law.stored(p), before);
}

TEST(StiffeningPoint, LeavesAnOpenGapAsItIs) {
  const Law of;
  ContactPointState p;
  p.anchored = true;
  p.penetration = -1e-5;
  of.law.stiffen(1, p);
  EXPECT_EQ(p.penetration, -1e-5);
  EXPECT_EQ(p.offset, 0);
  EXPECT_EQ(of.law.normal_at(p).penalty, 1e14);
}

}  // namespace
}  // namespace solidus::contact
