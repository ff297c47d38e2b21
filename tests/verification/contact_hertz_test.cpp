/// Hertz's line and point contacts (contact_hertz.hpp) on meshes that do not match.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "contact_hertz.hpp"

namespace solidus {
namespace {

using contact::Formulation;
using contact::NormalKind;
using mesh::Shape;
using test::Hertz;
using test::HertzCase;
using Bodies = HertzCase::Bodies;

struct Named {
  std::string name;
  Bodies bodies;
  Formulation formulation;
  contact::IntegrationRule rule = contact::IntegrationRule::automatic;
};
const Named k_cases[] = {
    {"small_sliding_on_block", Bodies::round_on_block, Formulation::small_sliding},
    {"large_sliding_on_block", Bodies::round_on_block, Formulation::large_sliding},
    {"segments_of_large_sliding", Bodies::round_on_block, Formulation::large_sliding,
     contact::IntegrationRule::segments},
    {"on_rigid_plane", Bodies::round_on_rigid, Formulation::large_sliding},
    {"rigid_in_block", Bodies::rigid_in_block, Formulation::large_sliding},
};

/// Relative errors.
struct Errors {
  double pressure, half_width, edge, deviation;
};

Errors errors(const Hertz& hertz) {
  const Hertz::Measured m = hertz.measure();
  const double a = hertz.exact_half_width();
  return {m.pressure / hertz.exact_pressure() - 1, m.half_width / a - 1, m.edge / a - 1, m.deviation};
}

void compare(AnalysisKind kind, const std::string& name) {
  auto table = verification::table("contact_hertz_" + name, "bodies,n,p0,half_width,edge,deviation");
  auto convergence = verification::table(
      "contact_hertz_" + name + "_convergence",
      "elements,small_sliding_on_block,large_sliding_on_block,segments_of_large_sliding,on_rigid_plane,"
      "rigid_in_block");
  std::map<int, std::vector<double>> deviations;
  for (const Named& c : k_cases) {
    SCOPED_TRACE(c.name);
    for (const int n : {16, 32, 64}) {
      Hertz hertz({.bodies = c.bodies, .kind = kind, .formulation = c.formulation, .n = n, .rule = c.rule});
      hertz.run->step(1);
      const Errors e = errors(hertz);
      table << fmt::format("{},{},{:.2e},{:.2e},{:.2e},{:.2e}\n", c.name, n, e.pressure, e.half_width, e.edge,
                           e.deviation);
      deviations[n].push_back(e.deviation);
      if (n < 64) continue;
      EXPECT_NEAR(e.pressure, 0, 0.03);
      EXPECT_NEAR(e.half_width, 0, 0.03);
      // 25 elements under half the contact: the last closed point is within one of them, and a cell's middle
      // a quarter more from its end.
      EXPECT_NEAR(e.edge, 0, (c.rule == contact::IntegrationRule::segments ? 1.25 : 1) / 25.0);
    }
  }
  for (std::size_t i = 0; i < std::size(k_cases); ++i)
    EXPECT_LT(deviations[64][i], 0.6 * deviations[16][i]) << k_cases[i].name;
  for (const auto& [n, values] : deviations) {
    convergence << n;
    for (double d : values) convergence << "," << d;
    convergence << "\n";
  }
}

TEST(HertzLine, HasPressureAndHalfWidthWithinThreePercentAndConverges) {
  compare(AnalysisKind::plane_strain, "line");
}

TEST(HertzPoint, HasPressureAndRadiusWithinThreePercentAndConverges) {
  compare(AnalysisKind::axisymmetric, "point");
}

TEST(Hertz, HasTheEllipseOfPressureInBothFormulations) {
  for (const auto kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric}) {
    Hertz small({.kind = kind, .formulation = Formulation::small_sliding, .n = 48});
    Hertz large({.kind = kind, .formulation = Formulation::large_sliding, .n = 48});
    small.run->step(1);
    large.run->step(1);
    const double a = small.exact_half_width(), p0 = small.exact_pressure();
    const auto of_small = small.profile(), of_large = large.profile();
    const bool line = kind == AnalysisKind::plane_strain;
    auto table = verification::table(line ? "contact_hertz_line_pressure" : "contact_hertz_point_pressure",
                                     "x[a],exact,small_sliding,large_sliding");
    for (std::size_t i = 0; i < std::min(of_small.size(), of_large.size()); ++i) {
      const double x = of_small[i].first / a;
      if (x > 1.3) break;
      table << x << "," << std::sqrt(std::max(0.0, 1 - x * x)) << "," << of_small[i].second / p0 << ","
            << of_large[i].second / p0 << "\n";
      EXPECT_NEAR(of_small[i].second, of_large[i].second, 0.02 * p0);
    }
  }
}

TEST(Hertz, HoldsForAllPlaneElementsAndWithTheAugmentedLagrangian) {
  for (const auto kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric})
    for (const Shape shape : {Shape::tri3, Shape::quad4, Shape::tri6, Shape::quad8}) {
      const bool quadratic = shape == Shape::tri6 || shape == Shape::quad8;
      for (const auto normal : {NormalKind::penalty, NormalKind::augmented_lagrangian}) {
        const bool augmented = normal == NormalKind::augmented_lagrangian;
        // Uzawa's steps shrink slowest where a point near the edge stands for little of a curved face: a
        // stiffer penalty saves them.
        Hertz hertz({.bodies = Bodies::round_on_rigid,
                     .kind = kind,
                     .shape = shape,
                     .n = quadratic ? 24 : 48,
                     .normal = normal,
                     .stiffness = quadratic && augmented ? 15 : 1.5});
        const std::string name =
            fmt::format("{}_{}_{}", mesh::name(shape), kind == AnalysisKind::plane_strain ? "line" : "point",
                        augmented ? "augmented" : "penalty");
        SCOPED_TRACE(name);
        hertz.run->step(1);
        const Errors e = errors(hertz);
        RecordProperty(
            name, fmt::format("{:+.1e} {:+.1e} turns {}", e.pressure, e.half_width, hertz.run->turns.size()));
        EXPECT_NEAR(e.pressure, 0, 0.03);
        EXPECT_NEAR(e.half_width, 0, 0.03);
      }
    }
}

// On meshes that do not match the points of segments ask for more than the faces can follow, the more the
// stiffer the penalty; means around the slave's nodes do not.
TEST(Hertz, HasPressuresThatDoNotDependOnThePenaltyAtMeansAroundNodes) {
  auto table = verification::table("contact_hertz_penalty", "kind,rule,penalty[E/h],p0,deviation");
  using contact::IntegrationRule;
  const auto measured = [&](AnalysisKind kind, IntegrationRule rule, double factor) {
    Hertz hertz({.kind = kind,
                 .formulation = Formulation::small_sliding,
                 .n = 32,
                 .stiffness = 0.4 * factor,
                 .rule = rule});
    hertz.run->step(1);
    const Errors e = errors(hertz);
    table << fmt::format("{},{},{},{:.2e},{:.2e}\n", kind == AnalysisKind::plane_strain ? "line" : "point",
                         rule == IntegrationRule::mortar ? "mortar" : "segments", factor, e.pressure,
                         e.deviation);
    return e;
  };
  for (const auto kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric}) {
    const Errors segments = measured(kind, IntegrationRule::segments, 100),
                 soft = measured(kind, IntegrationRule::mortar, 10);
    if (kind == AnalysisKind::plane_strain) {
      EXPECT_GT(segments.deviation, 0.1);
      EXPECT_LT(soft.deviation, 0.1);
    }
    EXPECT_NEAR(soft.pressure, 0, 0.01);
    for (const double factor : {100.0, 1000.0}) {
      const Errors stiff = measured(kind, IntegrationRule::mortar, factor);
      EXPECT_NEAR(stiff.pressure, soft.pressure, 0.005);
      EXPECT_NEAR(stiff.deviation, soft.deviation, 0.03);
    }
  }
}

// As a case of solid bodies has it that says nothing of its normal law (docs/decisions/0033): multipliers
// with the penalty of segments, until an augmentation changes pressures by less than 1 % of the largest.
TEST(Hertz, HasPressuresByDefaultNoFartherFromTheEllipseThanWithThePenaltyAlone) {
  auto table = verification::table("contact_hertz_default", "kind,n,law,p0,deviation,turns,iterations");
  for (const auto kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric})
    for (const int n : {32, 64}) {
      std::map<NormalKind, Errors> found;
      for (const auto normal : {NormalKind::penalty, NormalKind::augmented_lagrangian}) {
        const bool augmented = normal == NormalKind::augmented_lagrangian;
        Hertz hertz({.kind = kind,
                     .formulation = Formulation::small_sliding,
                     .n = n,
                     .normal = normal,
                     .penalty_factor = 10,
                     .pressure_tolerance = augmented ? std::optional(0.01) : std::nullopt});
        hertz.run->step(1);
        const Errors e = found[normal] = errors(hertz);
        table << fmt::format("{},{},{},{:.2e},{:.2e},{},{}\n",
                             kind == AnalysisKind::plane_strain ? "line" : "point", n,
                             augmented ? "augmented" : "penalty", e.pressure, e.deviation,
                             hertz.run->turns.size(), hertz.run->iterations());
        EXPECT_NEAR(e.pressure, 0, 0.01) << n;
      }
      EXPECT_LT(found[NormalKind::augmented_lagrangian].deviation,
                found[NormalKind::penalty].deviation + 0.01)
          << n;
    }
}

// The mesh on which the augmented Lagrangian once took 60 augmentations and more: 48 triangles under half the
// contact.
TEST(Hertz, OfAFineMeshOfTrianglesEndsInFewTurnsOfTheAugmentedLagrangian) {
  Hertz hertz({.bodies = Bodies::round_on_rigid,
               .shape = Shape::tri3,
               .n = 120,
               .normal = NormalKind::augmented_lagrangian});
  hertz.run->step(1);
  const Errors e = errors(hertz);
  EXPECT_NEAR(e.pressure, 0, 0.01);
  EXPECT_NEAR(e.half_width, 0, 0.01);
  EXPECT_NEAR(e.edge, 0, 1 / 48.0);
  EXPECT_LE(hertz.run->turns.size(), 25U);
}

}  // namespace
}  // namespace solidus
