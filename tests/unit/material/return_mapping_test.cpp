/// The local equation alone: a million problems over the whole admissible range, and beyond what metals do.
#include "material/return_mapping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "counted.hpp"
#include "flow_cases.hpp"

namespace solidus::material::test {
namespace {

using namespace return_mapping;

/// A problem and what it refers to.
struct Posed {
  FlowProperties<double> flow;
  Sym<double> trial, back_strain;
  Problem<double> problem;

  Posed(const Posed&) = delete;
  Posed(Random& random, IsotropicHardening isotropic, bool recalls, const FlowCurves& curves)
      : problem{isotropic,
                recalls ? KinematicHardening::armstrong_frederick : KinematicHardening::linear,
                RateDependence::perzyna,
                &curves,
                &flow,
                recalls,
                0,
                1,
                1,
                trial,
                back_strain,
                0} {
    const auto zero_or = [&](double low, double high) {
      return uniform(random, 0, 1) < 0.15 ? 0.0 : decades(random, low, high);
    };
    flow.flow_stress = flow.hardening_origin = decades(random, 3, 9);
    const double saturation = flow.flow_stress + zero_or(0, 9), rate = decades(random, -1, 4);
    const double modulus = zero_or(0, 11);
    const double reference = decades(random, -6, -1), exponent = uniform(random, 0, 1);
    if (isotropic == IsotropicHardening::linear) flow.hardening = {modulus};
    if (isotropic == IsotropicHardening::saturation) flow.hardening = {saturation, rate, modulus};
    if (isotropic == IsotropicHardening::power) flow.hardening = {reference, exponent};
    flow.kinematic_modulus = recalls ? decades(random, 3, 11) : zero_or(3, 11);
    flow.recall[0] = recalls ? decades(random, -1, 4) : 0;
    flow.rate[Perzyna::exponent] = uniform(random, 0, 1) < 0.2
                                       ? 1.0
                                       : decades(random, std::log10(k_least_rate_exponent), std::log10(50.0));
    flow.rate[Perzyna::drag_stress] = decades(random, 3, 9);
    flow.temperature = 500;

    problem.twice_shear = decades(random, 0, 11.5);
    problem.strength = uniform(random, 0, 1) < 0.3 ? decades(random, -12, 0) : 1.0;
    problem.rate = decades(random, -12, 3);
    flow.rate[Perzyna::viscosity] = problem.rate * zero_or(-12, 20);
    problem.hardening = zero_or(-8, 0);
    // 1/(√⅔ recall) is the most that loading can reach; three times that after heating
    const double most = recalls ? 3 / (k_root_two_thirds * flow.recall[0]) : zero_or(-6, -1);
    back_strain = dev(random_tensor(random, 1));
    back_strain *= uniform(random, 0, 1) * most / norm(back_strain);
    const double k = hardening_stress(isotropic, curves, flow, problem.hardening).stress;
    const double radius = k_root_two_thirds * problem.strength * (flow.flow_stress + k);
    Sym<double> relative = dev(random_tensor(random, 1));
    relative *= radius * (1 + decades(random, -12, 6)) / norm(relative);
    trial = relative - problem.pull() * back_strain;
    // An elastic strain of 10 is no small strain any more.
    problem.twice_shear = std::max(problem.twice_shear, 0.1 * norm(trial));
  }
};

/// The same problems on another number type, one or one per lane.
template <class T>
struct Copy {
  FlowProperties<T> flow;
  Sym<T> trial, back_strain;
  Problem<T> problem;

  explicit Copy(const std::vector<std::unique_ptr<Posed>>& from)
      : problem{from[0]->problem.isotropic,
                from[0]->problem.kinematic,
                from[0]->problem.rate_dependence,
                from[0]->problem.curves,
                &flow,
                from[0]->problem.recalls,
                {},
                {},
                {},
                trial,
                back_strain,
                {}} {
    const auto gather = [&](auto pick) {
      T number(pick(*from[0]));
      if constexpr (std::is_same_v<T, Lane>)
        for (int i = 0; i < k_lanes; ++i) number.set(i, pick(*from[static_cast<std::size_t>(i)]));
      return number;
    };
    using P = const Posed&;
    flow.flow_stress = gather([](P p) { return p.flow.flow_stress; });
    flow.hardening_origin = gather([](P p) { return p.flow.hardening_origin; });
    for (std::size_t i = 0; i < k_hardening_parameters; ++i)
      flow.hardening[i] = gather([i](P p) { return p.flow.hardening[i]; });
    flow.kinematic_modulus = gather([](P p) { return p.flow.kinematic_modulus; });
    flow.recall[0] = gather([](P p) { return p.flow.recall[0]; });
    flow.rate[Perzyna::viscosity] = gather([](P p) { return p.flow.rate[Perzyna::viscosity]; });
    flow.rate[Perzyna::exponent] = gather([](P p) { return p.flow.rate[Perzyna::exponent]; });
    flow.rate[Perzyna::drag_stress] = gather([](P p) { return p.flow.rate[Perzyna::drag_stress]; });
    flow.temperature = gather([](P p) { return p.flow.temperature; });
    problem.twice_shear = gather([](P p) { return p.problem.twice_shear; });
    problem.strength = gather([](P p) { return p.problem.strength; });
    problem.rate = gather([](P p) { return p.problem.rate; });
    problem.hardening = gather([](P p) { return p.problem.hardening; });
    for (int c = 0; c < 6; ++c) {
      trial[c] = gather([c](P p) { return p.trial[c]; });
      back_strain[c] = gather([c](P p) { return p.back_strain[c]; });
    }
  }
  Copy(const Copy&) = delete;
};

/// Convex, concave and straight pieces, some short.
FlowCurves bent_curves() {
  return FlowCurves(
      {0, 1e-6, 1e-4, 1.1e-4, 1e-3, 0.02, 0.3, 0.31, 2}, {300, 900},
      {1e8, 1e8, 1.5e8, 2.5e8, 2.6e8, 2.6e8, 3e8, 9e8, 1e9, 1e7, 5e7, 5e7, 9e7, 1e8, 3e8, 3e8, 3e8, 4e8});
}

/// |Φ(γ) − x| and the distance of (γ, x) from the rate curve, in parts of what rounding leaves of Φ.
double defect(const Problem<double>& p, const Yield<double>& trial, const Solution<double>& s) {
  const Yield<double> end = yield(p, s.gamma);
  const double drag = p.flow->rate[Perzyna::drag_stress], n = p.flow->rate[Perzyna::exponent];
  // γ = A (x/D)^n underflows for a small overstress and a large n.
  const double gamma = std::max(s.gamma, 1e-280);
  const double x = drag * std::pow(gamma * p.flow->rate[Perzyna::viscosity] / (p.rate * drag), 1 / n);
  const double curve = s.gamma < 1e-280 && s.overstress < x ? 0 : std::abs(x - s.overstress);
  // the last places of γ and x, too
  const double noise = std::max(end.noise, trial.noise) +
                       k_rounding * (s.gamma * (std::abs(end.slope) + p.stiffness()) + s.overstress);
  return std::max(std::abs(end.value - s.overstress), curve) / noise;
}

TEST(ReturnMapping, SolvesAMillionProblemsToRounding) {
  const FlowCurves curves = bent_curves();
  Random random(21);
  double worst = 0;
  int viscous = 0, plastic = 0, unsolved = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const Posed posed(random, k_isotropic[i % 5], i / 5 % 3 == 2, curves);
    const auto& p = posed.problem;
    const Yield<double> trial = yield(p, 0.0);
    if (!flows(p, trial)) continue;  // rounding of a small overstress
    const auto s = solve_power_rate(p, trial);
    if (!s.converged) {  // a step is cut
      ASSERT_LT(posed.flow.rate[Perzyna::exponent], 0.2) << i;
      ++unsolved;
      continue;
    }
    ASSERT_GE(s.gamma, 0) << i;
    ASSERT_GE(s.overstress, 0) << i;
    ASSERT_GE(s.inverse_stiffness, 0) << i;
    worst = std::max(worst, defect(p, trial, s));
    ++(s.overstress > 0.5 * trial.value ? viscous : plastic);
    if (posed.flow.rate[Perzyna::exponent] == 1) {
      const auto linear = solve_linear_rate(p, trial);
      ASSERT_TRUE(linear.converged) << i;
      worst = std::max(worst, defect(p, trial, linear));
    }
    ASSERT_LT(worst, 10) << i << " kind " << i % 5 << " n " << posed.flow.rate[Perzyna::exponent];
  }
  EXPECT_GT(viscous, 100'000);
  EXPECT_LE(unsolved, 1);
  EXPECT_GT(plastic, 100'000);
}

TEST(ReturnMapping, TheSolverOfAnyRateLawFindsWhatThatOfPerzynaFinds) {
  const FlowCurves curves = bent_curves();
  Random random(23);
  double worst = 0;
  int solved = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Posed posed(random, k_isotropic[i % 5], i / 5 % 3 == 2, curves);
    const auto& p = posed.problem;
    const double n = posed.flow.rate[Perzyna::exponent];
    if (n < 1 || n > 20 || posed.flow.rate[Perzyna::viscosity] == 0) continue;
    const Yield<double> trial = yield(p, 0.0);
    if (!flows(p, trial)) continue;
    const auto s = solve_power_rate(p, trial), any = solve_rate_law(p, trial);
    if (s.gamma < 1e-250) continue;
    ASSERT_TRUE(any.converged) << i << " n " << n;
    ++solved;
    worst = std::max(worst, defect(p, trial, any));
    ASSERT_LT(worst, 10) << i << " kind " << i % 5 << " n " << n;
  }
  EXPECT_GT(solved, 20'000);
}

TEST(ReturnMapping, NeedsFewIterations) {
  const FlowCurves curves = bent_curves();
  Random random(22);
  std::vector<int> count;
  for (int i = 0; i < 100'000; ++i) {
    std::vector<std::unique_ptr<Posed>> one;
    one.push_back(std::make_unique<Posed>(random, IsotropicHardening::saturation, i % 3 == 2, curves));
    const Copy<Counted> counted(one);
    const Yield<Counted> trial = yield(counted.problem, Counted(0.0));
    if (!flows(counted.problem, trial)) continue;
    Counted::exponentials = 0;  // n = 1: no other than those of hardening
    EXPECT_TRUE(solve_linear_rate(counted.problem, trial).converged);
    count.push_back(Counted::exponentials);
  }
  std::sort(count.begin(), count.end());
  EXPECT_LE(count[count.size() / 2], 5);
  EXPECT_LE(count[count.size() * 99 / 100], 20);
  EXPECT_LE(count.back(), k_max_iterations / 2);
}

TEST(ReturnMapping, APackOfUnlikeProblemsIsSolvedAsEachAlone) {
  const FlowCurves curves = bent_curves();
  Random random(23);
  for (int i = 0; i < 5'000; ++i) {
    std::vector<std::unique_ptr<Posed>> lanes;
    for (int l = 0; l < k_lanes; ++l) {
      lanes.push_back(std::make_unique<Posed>(random, k_isotropic[i % 5], i / 5 % 2 == 1, curves));
      if (l == 3) lanes[3]->trial = -1.0 * lanes[3]->problem.pull() * lanes[3]->back_strain;  // inside
      if (l == 5) lanes[5]->problem.rate = 0;                                                 // liquid
    }
    const Copy<Lane> packed(lanes);
    const auto s = solve_power_rate(packed.problem, yield(packed.problem, Lane(0.0)));
    ASSERT_TRUE(s.converged) << i;
    for (int l = 0; l < k_lanes; ++l) {
      const Problem<double>& p = lanes[static_cast<std::size_t>(l)]->problem;
      const Yield<double> trial = yield(p, 0.0);
      if (l == 3 || l == 5 || !flows(p, trial)) {
        ASSERT_EQ(s.gamma[l], 0) << i;
        ASSERT_EQ(s.overstress[l], 0) << i;
        ASSERT_EQ(s.inverse_stiffness[l], 0) << i;
      } else {
        ASSERT_LT(defect(p, trial, {s.gamma[l], s.overstress[l], 0, true}), 10) << i << ' ' << l;
      }
    }
  }
}

}  // namespace
}  // namespace solidus::material::test
