/// Tests of the texts by which a run that cannot go on names the physical state behind it.
#include "coupling/diagnosis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace solidus::coupling {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A casting of 100 mm from corner to corner that weighs 10 N.
Diagnosis casting(Physics physics) {
  Diagnosis d;
  d.physics = physics;
  d.body = "casting";
  d.size = 0.1;
  d.weight = 10;
  return d;
}

/// The same at a try in which it goes 20 mm and 3 of 40 points stay closed, of 12.
Diagnosis tried(Physics physics) {
  Diagnosis d = casting(physics);
  d.in_try = true;
  d.moved = 0.02;
  d.place = {0.01, 0.02, 0.03};
  d.temperature = 873.15;
  d.supported = false;
  d.contact = {.all = 40, .before = 12, .now = 3, .changed = 5};
  return d;
}

TEST(Diagnosis, SaysNothingOfAnUnknownState) {
  EXPECT_EQ(text(Diagnosis{}), "");
}

TEST(Diagnosis, SaysOnWhichBodyTheContactPressureDoesNotComeToRest) {
  Diagnosis d = tried(Physics::multipliers);
  d.detail = "contact 'mould': 200 turns";
  d.solid_fraction = 0.4;
  EXPECT_THAT(text(d), HasSubstr("the contact pressure on body 'casting', 40 % solid, does not come to rest: "
                                 "contact 'mould': 200 turns; contact alone holds it: 12 of its 40"));
}

TEST(Diagnosis, NamesABodyThatNothingCarriesWithItsWeight) {
  Diagnosis d = casting(Physics::nothing_carries);
  EXPECT_EQ(
      text(d),
      "nothing carries body 'casting', which weighs 10 N: no displacement of it is prescribed against its "
      "weight, and no contact is on it");
  d.contact.all = 40;
  d.weight = 0;
  EXPECT_EQ(text(d),
            "nothing carries body 'casting': no displacement of it is prescribed, and none of its 40 contact "
            "points is closed");
}

TEST(Diagnosis, CountsTheContactPointsOfABodyThatComesOff) {
  EXPECT_EQ(
      text(tried(Physics::comes_off)),
      "body 'casting' comes off what it lies on; contact alone holds it: 12 of its 40 contact points were "
      "closed at the last step, 3 are in the failing try; in the failing try it moves 20 mm, 20 % of its "
      "100 mm from corner to corner (usual in a step: below 1 %)");
}

TEST(Diagnosis, SaysThatABodyIsFreeToSlide) {
  Diagnosis d = tried(Physics::slides);
  EXPECT_EQ(
      text(d),
      "body 'casting' is free to slide or to turn: contact alone holds it, without friction: 12 of its 40 "
      "contact points were closed at the last step, 3 are in the failing try");
  d.rubs = true;
  EXPECT_THAT(text(d), Not(HasSubstr("without friction")));
}

TEST(Diagnosis, SaysWhereAndHowHotMeltFlows) {
  Diagnosis d = tried(Physics::melt_flows);
  d.solid_fraction = 0.12;
  EXPECT_THAT(text(d),
              AllOf(HasSubstr("the melt of body 'casting' flows without an equilibrium under its weight"),
                    HasSubstr("at (10, 20, 30) mm, 600 degC, 12 % solid: in the failing try it moves 20 mm"),
                    HasSubstr("contact alone holds it: 12 of its 40")));
}

TEST(Diagnosis, SpeaksOfALimitLoadWithTheShareThatFlows) {
  Diagnosis d = tried(Physics::limit_load);
  d.yielding = 0.87;
  d.elongation = 0.3;
  d.supported = true;
  EXPECT_THAT(
      text(d),
      AllOf(HasSubstr("at its limit load: 87 % of its volume flows plastically, and it is strained by "
                      "up to 30 % (usual: below 10 %)"),
            Not(HasSubstr("contact alone"))));
}

TEST(Diagnosis, SaysOfALimitLoadThatTheHeatTellsHowHotFlowHasMadeIt) {
  Diagnosis d = tried(Physics::limit_load);
  d.in_try = false;
  d.elongation = 3;
  EXPECT_THAT(
      text(d),
      HasSubstr("flow has heated it at (10, 20, 30) mm, 600 degC, and it is strained by up to 300 %"));
}

TEST(Diagnosis, HandsOnTheWordsOfTheLawAndOfTheWatchOnMelts) {
  Diagnosis law = casting(Physics::law);
  law.step = 1e-3;
  law.detail = "body 'casting', element 7";
  EXPECT_EQ(text(law), "the material law finds no state in a try of 0.001 s: body 'casting', element 7");
  law.physics = Physics::cold_law;
  law.tried_temperature = -0.5;
  EXPECT_THAT(text(law),
              HasSubstr("more heat is taken than there is: in a try of 0.001 s a temperature of -0.5 K"));
  Diagnosis out = casting(Physics::runs_out);
  out.detail = "the melt of 'casting' has run out";
  EXPECT_EQ(text(out), out.detail);
}

TEST(Diagnosis, CountsPointsThatChangeWithoutEnd) {
  EXPECT_THAT(
      text(tried(Physics::points_change)),
      HasSubstr("5 of its 40 points change between open, sticking and slipping in the last iteration"));
}

TEST(Diagnosis, SaysWhereForcesStayOutOfBalanceAlsoWhereDisplacementsAreNoNumbers) {
  Diagnosis d = tried(Physics::no_equilibrium);
  d.yielding = 0.1;
  EXPECT_THAT(text(d), AllOf(HasSubstr("finds no equilibrium: at (10, 20, 30) mm, 600 degC: in"),
                             HasSubstr("10 % of its volume flows plastically")));
  d.moved = HUGE_VAL;
  EXPECT_THAT(text(d), HasSubstr("its displacements are no numbers"));
  d.moved = 10;
  EXPECT_THAT(text(d), AllOf(HasSubstr("it goes farther than its 100 mm"), Not(HasSubstr("1e+04"))));
}

TEST(Diagnosis, SaysThatTheIterationEndedARunInWhichNextToNothingMovesOrCools) {
  Diagnosis d = tried(Physics::no_equilibrium);
  d.moved = 1e-9;
  EXPECT_THAT(text(d),
              HasSubstr("the iteration of forces ends before body 'casting' is in balance, although it "
                        "hardly moves: 1e-06 mm"));
  d.physics = Physics::heat;
  d.largest_change = 1e-4;
  EXPECT_THAT(text(d), HasSubstr("although temperatures hardly change: by 0.0001 K at most"));
}

TEST(Diagnosis, ComparesTheHeatOfAContactWithWhatItsSurfaceStores) {
  Diagnosis d = casting(Physics::contact_heat);
  d.temperature = 873.15;
  d.tried_temperature = 473.15;
  d.largest_change = 400;
  d.step = 2;
  d.contact_name = "mould";
  d.conductance_number = 35;
  EXPECT_THAT(text(d), AllOf(HasSubstr("heat through contact 'mould' does not come to rest"),
                             HasSubstr("of body 'casting' goes from 600 degC to 200 degC in a try of 2 s"),
                             HasSubstr("the largest change anywhere is 400 K"),
                             HasSubstr("passes 35 times in a step what its surface stores")));
  d.physics = Physics::heat;
  EXPECT_THAT(text(d), HasSubstr("the heat of a step is not balanced"));
  d.physics = Physics::cold;
  EXPECT_THAT(text(d), HasSubstr("more heat is taken than there is"));
}

TEST(Diagnosis, SaysThatThePhasesDoNotAgreeAndWhatIsInContact) {
  Diagnosis d = casting(Physics::phases);
  d.contact = {.all = 40, .before = 12};
  d.supported = false;
  EXPECT_EQ(
      text(d),
      "heat and deformation of a step do not agree; body 'casting': contact alone holds it: 12 of its 40 "
      "contact points were closed at the last step");
}

}  // namespace
}  // namespace solidus::coupling
