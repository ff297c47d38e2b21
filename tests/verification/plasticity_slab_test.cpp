/// Weiner and Boley's slab: a shell that freezes from a cold wall and yields, against the similarity solution
/// of analytic/solidifying_slab.hpp. Deformation does no heat here; coupling_slab_test.cpp has it coupled.
#include <gtest/gtest.h>

#include "coupling/isothermal_split.hpp"
#include "slab.hpp"

namespace solidus {
namespace {

using analytic::SolidifyingSlab;
using mesh::Shape;
using verification::disc;
using verification::freeze;
using verification::k_length;
using verification::material_of;
using verification::solid;
using verification::steel;

// The similarity solution by itself.

TEST(WeinerBoley, SolutionIsContinuousCarriesNoForceAndFlowsTheWayItIsStressed) {
  const SolidifyingSlab slab = steel();
  EXPECT_NEAR(slab.lambda() * std::exp(slab.lambda() * slab.lambda()) * std::erf(slab.lambda()),
              661 * 494.4 / (272e3 * std::sqrt(std::numbers::pi)), 1e-12);
  EXPECT_NEAR(slab.stress_at(slab.compressed_up_to() + 1e-9), slab.stress_at(slab.compressed_up_to() - 1e-9),
              1.0);
  EXPECT_NEAR(slab.stress_at(slab.stretched_from() + 1e-9), slab.stress_at(slab.stretched_from() - 1e-9),
              1.0);
  EXPECT_EQ(slab.stress_at(0), -20e6);
  double force = 0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double xi = (i + 0.5) / n;
    force += slab.stress_at(xi) / n;
    EXPECT_LE(std::abs(slab.stress_at(xi)), slab.yield(xi) * (1 + 1e-9));
    EXPECT_GE(slab.flow_at(xi) * slab.stress_at(xi), -1e-6);  // dissipation, zero at ξ_2
  }
  EXPECT_NEAR(force, 0, 1e-3 * 20e6 / n * 10);  // the kinks at ξ_1 and ξ_2
}

// The problem marched in time on a fine grid, without the similarity: elastic step, cut at the yield stress,
// the strain that leaves no net force.
TEST(WeinerBoley, SolutionIsWhatMarchingInTimeFinds) {
  const SolidifyingSlab slab = steel();
  constexpr int n = 400, steps = 4000;
  const double end = 1, first = 1e-3, ratio = std::pow(end / first, 1.0 / steps);
  const double modulus = 40e9 / 0.65, length = slab.front(end);
  std::vector<double> stress(n, 0.0), temperature(n, slab.melting), cut(n);
  double last = 0;
  for (double t = first * ratio; t < end * 1.000001; t *= ratio) {
    std::vector<double> next(n);
    for (int i = 0; i < n; ++i)
      next[static_cast<std::size_t>(i)] = slab.temperature((i + 0.5) / n * length, t);
    const auto force = [&](double strain) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const double yield = slab.wall_yield * (slab.melting - next[i]) / (slab.melting - slab.wall);
        const double trial = stress[i] + modulus * (strain - slab.expansion * (next[i] - temperature[i]));
        cut[i] = std::clamp(trial, -yield, yield);
        sum += cut[i];
      }
      return sum;
    };
    double low = -1e-3, high = 1e-3;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (force(middle) < 0 ? low : high) = middle;
    }
    stress = cut;
    temperature = next;
    last = low;
  }
  double squares = 0;
  for (int i = 0; i < n; ++i) {
    const double error = stress[static_cast<std::size_t>(i)] - slab.stress((i + 0.5) / n * length, end);
    squares += error * error / n;
  }
  EXPECT_LT(std::sqrt(squares), 0.002e6);  // first order in the step, 0.17 % of the time
  EXPECT_NEAR(2 * last / std::log(ratio), slab.strain_constant(), 2e-3 * std::abs(slab.strain_constant()));
}

// The finite elements.

verification::SlabRun uncoupled(double dt, std::string table = {}) {
  verification::SlabRun run{material_of(steel()), dt, std::move(table)};
  run.scheme = [](coupling::Phases phases) {
    return std::make_unique<coupling::IsothermalSplit>(std::move(phases));
  };
  return run;
}

TEST(WeinerBoley, StressProfilesAtFiveAndTwentyOneSecondsAreWithinHalfAMegapascal) {
  const verification::SlabResult result = freeze(solid(Shape::hex8, 150), uncoupled(0.05, "plasticity_slab"));
  EXPECT_LT(result.rms[0], 0.5e6);
  EXPECT_LT(result.rms[1], 0.5e6);
}

// Size of the elements and step are halved together. The mechanical phase sees the temperatures of the last
// step (isothermal split), and the front lies between two nodes: both of first order, which the stress,
// steep where it is elastic, shows.
TEST(WeinerBoley, ARoundDiscOfAxisymmetricElementsConvergesToTheProfiles) {
  auto out = verification::table("plasticity_slab_order", "h[mm],stress_at_5_s[MPa],stress_at_21_s[MPa]");
  std::vector<verification::SlabResult> results;
  for (const int n : {75, 150, 300}) {
    results.push_back(freeze(disc(n), uncoupled(7.5 / n)));
    out << 1e3 * k_length / n << "," << 1e-6 * results.back().rms[0] << "," << 1e-6 * results.back().rms[1]
        << "\n";
  }
  for (std::size_t at = 0; at < 2; ++at) {
    EXPECT_LT(results[1].rms[at], 0.5e6);
    EXPECT_GT(verification::order(results[0].rms[at], results[2].rms[at]) / 2, 0.7);
  }
}

}  // namespace
}  // namespace solidus
