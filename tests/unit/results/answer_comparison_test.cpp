/// Errors of answers by comparison, of answers whose error is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "results/answers/answer_comparison.hpp"

namespace solidus::results {
namespace {

using ::testing::HasSubstr;

/// Answers that are off by a share of themselves.
Answers off_by(double share) {
  Answers a;
  a.castings.push_back({.cast = {0, "part", false}, .solid_fraction = 1});
  a.castings[0].froze = ValueAt{100 * (1 + share), {}};
  a.gaps = {{"wall", {1e-4 * (1 + share), {}}}};
  a.distortion = ValueAt{2e-4 * (1 + share), {}};
  a.stress = ValueAt{5e6 * (1 + share), {}};
  a.pores = Pores{.volume = 0, .share = 0.01 * (1 + share), .densest = {}};
  a.criteria_errors = {{"niyama_min", {}}};
  return a;
}

// Errors of first order: 1 % with steps h, 2 % with steps 2h.
TEST(ComparedAnswers, OfFirstOrderAreGivenTheirErrorByAQuarterMore) {
  Answers fine = off_by(0.01);
  const std::vector<criteria::CriterionResult> niyama{{"niyama_min", "1", 3 * 1.01, true, {}}};
  const std::vector<criteria::CriterionResult> coarse_niyama{{"niyama_min", "1", 3 * 1.02, true, {}}};
  compare_errors(ErrorPart::step, 2, off_by(0.02), coarse_niyama, fine, niyama);
  EXPECT_NEAR(fine.castings[0].froze->error->step, 1.25 * 1, 1e-9);
  EXPECT_NEAR(fine.gaps[0].gap.error->step, 1.25 * 1e-6, 1e-15);
  EXPECT_NEAR(fine.distortion->error->step, 1.25 * 2e-6, 1e-15);
  EXPECT_NEAR(fine.stress->error->step, 1.25 * 5e4, 1e-4);
  EXPECT_NEAR(fine.pores->error->step, 1.25 * 1e-4, 1e-12);
  EXPECT_NEAR(fine.criteria_errors[0].second.step, 1.25 * 0.03, 1e-12);
  EXPECT_TRUE(fine.stress->error->step_compared);
  EXPECT_FALSE(fine.stress->error->mesh_compared);
  EXPECT_EQ(fine.stress->error->mesh, 0);
}

TEST(ComparedAnswers, KeepTheEstimateOfTheOtherPart) {
  Answers fine = off_by(0.01);
  fine.castings[0].froze->error = ErrorBand{.step = 0.5, .mesh = 2};
  compare_errors(ErrorPart::mesh, 3, off_by(0.03), {}, fine, {});
  EXPECT_NEAR(fine.castings[0].froze->error->mesh, 1.25 * 1, 1e-9);
  EXPECT_EQ(fine.castings[0].froze->error->step, 0.5);
}

TEST(ComparedAnswers, ThatAgreeByChanceKeepHalfOfTheEstimate) {
  Answers fine = off_by(0.01);
  fine.stress->error = ErrorBand{.step = 8e4, .mesh = 0};
  compare_errors(ErrorPart::step, 2, off_by(0.01), {}, fine, {});
  EXPECT_EQ(fine.stress->error->step, 4e4);
}

TEST(ComparedAnswers, AreToldWithTheirError) {
  Answers a = off_by(0);
  a.castings[0].froze->error = ErrorBand{.step = 0.5, .mesh = 1.25};
  EXPECT_THAT(text(a, {}), HasSubstr("froze 100 ± 1.8 s (step 0.5, mesh 1.2) after pouring"));
  a.castings[0].froze->value = 12345.6;
  a.castings[0].froze->error = ErrorBand{.step = 130, .mesh = 14.2};
  EXPECT_THAT(text(a, {}), HasSubstr("froze 12350 ± 140 s (step 130, mesh 14) after pouring"));
}

TEST(Answers, OfACriterionWithAThresholdTellTheShareThatIsBeyond) {
  const std::string told = text(off_by(0), {{"tearing_tendency_max", "1", 2.766, true, {}},
                                            {"tearing_tendency_beyond", "1", 0.25, false, {}}});
  EXPECT_THAT(told, HasSubstr("tearing tendency, ends held         above 1 in 25 % of what was cast; largest "
                              "2.766 at (0, 0, 0) m"));
}

TEST(Answers, OfATendencyThatIsCutSayOnlyThatItIsMore) {
  const std::string told = text(off_by(0), {{"tearing_tendency_max", "1", 100, true, {}},
                                            {"tearing_tendency_beyond", "1", 1, false, {}},
                                            {"critical_strain_rate_zero", "1", 0.985, false, {}}});
  EXPECT_THAT(told, HasSubstr("above 1 in 100 % of what was cast (by shrinkage alone in 98.5 %); largest "
                              "100 or more\n"));
}

// Where fronts meet the gradient, and with it Niyama's number, vanishes but for rounding.
TEST(Answers, FarBelowTheirErrorAreToldAsZero) {
  Answers a = off_by(0);
  a.castings[0].froze->value = 1e-9;
  a.castings[0].froze->error = ErrorBand{.step = 0.5, .mesh = 1.25};
  EXPECT_THAT(text(a, {}), HasSubstr("froze 0 ± 1.8 s (step 0.5, mesh 1.2) after pouring"));
}

// A runner is poured as the part is, and no one asks whether it is sound.
TEST(Soundness, IsToldBodyByBodyAndOfThePartsAlone) {
  Answers a;
  a.castings.push_back({.cast = {0, "part", false, false}, .solid_fraction = 1, .mass = 2});
  a.castings.push_back({.cast = {1, "top", true, false}, .solid_fraction = 1, .mass = 1.5});
  a.castings.push_back({.cast = {2, "sprue", false, true}, .solid_fraction = 1, .mass = 0.5});
  a.castings[0].froze = ValueAt{100, {}};
  a.castings[1].froze = ValueAt{130, {}};
  a.castings[2].froze = ValueAt{150, {}};
  a.castings[0].least_niyama = ValueAt{900, {0.1, 0, 0}};
  a.castings[2].least_niyama = ValueAt{30, {0.2, 0, 0}};
  a.castings[1].shrinkage = Shrinkage{.volume = 1e-4, .holes = 2e-6, .unfed = 3e-12, .of_gas = 5e-12};
  a.castings[2].pores = Pores{.volume = 1e-5, .share = 0.2, .densest = {0.4, {0.3, 0, 0}}};
  const std::vector<criteria::CriterionResult> found{{"niyama_min", "1", 30, true, {0.2, 0, 0}}};
  const std::string said = text(a, found);
  EXPECT_THAT(said, HasSubstr("gating 'sprue'"));
  EXPECT_THAT(said, HasSubstr("outlived the part by 30 s")) << "the sprue is no part";
  EXPECT_THAT(said,
              HasSubstr("soundness of 'part'                 2 kg; least Niyama 0.9 sqrt(K s)/mm at (100"));
  EXPECT_THAT(said, HasSubstr("pores 10 cm3, 20 %, densest 40 % at (300"));
  EXPECT_THAT(said, HasSubstr("soundness of 'top'                  1.5 kg; holes 2 cm3, 2 %; pores none\n"));
  EXPECT_THAT(said, HasSubstr("yield                               50 % of what is poured is part"));
  EXPECT_THAT(said, HasSubstr("least Niyama                        0.9 sqrt(K s)/mm at (100, 0, 0) mm"));
}

Answers with_riser(double part, double riser, double error) {
  Answers a;
  a.castings.push_back({.cast = {0, "part", false}, .solid_fraction = 1});
  a.castings.push_back({.cast = {1, "riser", true}, .solid_fraction = 1});
  a.castings[0].froze = ValueAt{part, {}, ErrorBand{.mesh = error}};
  a.castings[1].froze = ValueAt{riser, {}, ErrorBand{.mesh = error}};
  return a;
}

TEST(RiserVerdict, IsNotGivenWithinTheErrorOfTheTimes) {
  EXPECT_THAT(text(with_riser(100, 130, 5), {}), HasSubstr("outlived the part by 30 ± 5 s"));
  EXPECT_THAT(text(with_riser(100, 70, 5), {}),
              HasSubstr("froze 30 ± 5 s before the part: it could not feed to the end"));
  EXPECT_THAT(text(with_riser(100, 97, 5), {}),
              HasSubstr("froze 3 ± 5 s before the part: too close to tell whether it fed to the end"));
}

}  // namespace
}  // namespace solidus::results
