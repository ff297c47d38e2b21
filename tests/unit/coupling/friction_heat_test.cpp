/// Heat of friction in the simultaneous scheme: its tangent against differences of both residuals, and its
/// convergence. Two blocks that press and slide, some points sticking, with an interface that has a heat
/// capacity, friction that hardens and softens with temperature, and a conductance that follows everything.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rubbing_blocks.hpp"

namespace solidus {
namespace {

using contact::Formulation;
using mesh::Shape;
using test::noise;
using test::Rubbing;
using test::RubbingBlocks;

class FrictionalHeat : public ::testing::TestWithParam<Rubbing> {};

TEST_P(FrictionalHeat, HasTheTangentThatFiniteDifferencesShow) {
  RubbingBlocks b(GetParam(), false);
  test::Iterate iterate(b);
  iterate.move(test::rubbed(b.mesh));
  const contact::ContactSums sums = contact::sums(b.pair->view(), {});
  EXPECT_GT(sums.sticking_points, 0);
  EXPECT_GT(sums.closed_points, sums.sticking_points);
  EXPECT_LT(sums.closed_points, sums.points);

  // Displacement and temperature apart: neither hides behind the other.
  for (const bool moves : {true, false}) {
    const auto error = iterate.tangent_errors(noise(b.mesh, b.mesh.dimension, 2.1, moves ? 1e-7 : 0),
                                              noise(b.mesh, 1, 1.9, moves ? 0 : 10), 4e-3);
    // Places of 0.3 m round by 1e-16 of it, over steps of 4e-10 m: 1e-7 of the slopes; curvature is less.
    EXPECT_LT(error.force, 2e-7) << moves;
    EXPECT_LT(error.heat, 2e-7) << moves;
  }
}

TEST_P(FrictionalHeat, ConvergesQuadratically) {
  RubbingBlocks b(GetParam(), true);
  coupling::SimultaneousOptions options;
  options.solver = linear::CoupledSolverKind::direct;
  coupling::SimultaneousScheme scheme(b.phases, options);
  scheme.synchronise(b.state);
  coupling::State now = b.state;
  constexpr double k_dt = 0.1;
  for (int n = 1; n <= 4; ++n) {
    coupling::State trial = now;
    trial.time = n * k_dt;
    const coupling::StepEffort effort = scheme.advance(now, trial, trial.time, k_dt);
    now = std::move(trial);
    EXPECT_LT(std::abs(effort.energy.defect()), 1e-8 * effort.energy.heat_exchanged) << "step " << n;
    if (n < 3) continue;  // the active set settles
    EXPECT_GT(effort.energy.frictional_heat, 0);
    const auto& residuals = scheme.report().residuals;
    ASSERT_LE(residuals.size(), 9U);
    // Of the last three that are above rounding: e_{k+1} <= C e_k² needs an order well above one.
    int quadratic = 0;
    for (std::size_t k = 2; k < residuals.size(); ++k) {
      const double e0 = residuals[k - 2].size(), e1 = residuals[k - 1].size(), e2 = residuals[k].size();
      if (e0 < 1e-1 && e2 > 1e-13 && std::log(e2 / e1) > 1.7 * std::log(e1 / e0)) ++quadratic;
      if (e1 < 1e-4 && e2 < 1e-9) ++quadratic;
    }
    EXPECT_GE(quadratic, 1) << "step " << n;
  }
}

using contact::InternalVariable;
INSTANTIATE_TEST_SUITE_P(
    Of, FrictionalHeat,
    ::testing::Values(
        Rubbing{.name = "Quad4"}, Rubbing{.name = "Quad4Consistent", .nodal = false},
        Rubbing{.name = "Quad4Capacity", .heat_capacity = 5},
        Rubbing{.name = "Quad4OfWork", .variable = InternalVariable::frictional_work},
        Rubbing{.name = "Quad4OfSlip", .heat_capacity = 2, .variable = InternalVariable::slip},
        Rubbing{.name = "Quad4Coulomb", .mu_of_temperature = false},
        Rubbing{.name = "Tri6", .shape = Shape::tri6, .nodal = false},
        Rubbing{.name = "Hex8", .shape = Shape::hex8},
        Rubbing{.name = "Quad4Sliding", .formulation = Formulation::large_sliding},
        Rubbing{.name = "Quad4SlidingSmooth",
                .formulation = Formulation::large_sliding,
                .smoothing = true,
                .nodal = false,
                .heat_capacity = 5},
        Rubbing{.name = "Hex8Sliding", .shape = Shape::hex8, .formulation = Formulation::large_sliding},
        Rubbing{.name = "Hex8SlidingSmooth",
                .shape = Shape::hex8,
                .formulation = Formulation::large_sliding,
                .smoothing = true,
                .twist = 0.5}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace solidus
