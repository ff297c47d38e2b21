/// The block-iterative scheme: its rates on a body of one mode, as theory derives them
/// (docs/theory/coupling.md), and what it promises of a step that fails.
///
/// A free block in plane strain that conducts so well that its temperature is uniform, cooled from both
/// sides; constant properties, so that the coupling number is
///
///   δ_K = β² Θ / (C (λ + μ)),  β = 3 α k,  and one mode with c = C V, a = Δt h A.
#include "coupling/block_iterative.hpp"

#include <gtest/gtest.h>

#include "../mechanics/body.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using coupling::BlockIterative;
using coupling::IterationOptions;
using mechanics::Mapping;
using Sweep = IterationOptions::Sweep;
using Loop = IterationOptions::Loop;
using Relaxing = coupling::RelaxationOptions::Kind;

constexpr double k_start = 600, k_capacity = 7800 * 500.0;  // [K], [J/(m³ K)]

/// @param film_over_capacity  a/c of a step of one second
struct Block {
  test::Body body;
  std::unique_ptr<mechanics::MechanicalPhase> mechanics;
  std::unique_ptr<mechanics::StructuralHeat> structural;
  std::unique_ptr<heat::ThermalPhase> heat;
  coupling::Phases phases;
  coupling::State start;

  static material::Material metal(double coupling_number) {
    constexpr double young = 2e11, nu = 0.3, bulk = young / (3 * (1 - 2 * nu)),
                     resists = young / (2 * (1 + nu) * (1 - 2 * nu));
    const double beta = std::sqrt(coupling_number * k_capacity * resists / k_start);
    material::Material m = test::elastic_material(young, nu, beta / (3 * bulk));
    m.expansion_reference = k_start;
    m.conductivity = 1e10;
    m.specific_heat_at = material::SpecificHeatAt::constant_strain;
    return m;
  }

  Block(double coupling_number, double film_over_capacity, Mapping mapping, bool radiates = false)
      : body({.cells = {4, 2, 1}}, AnalysisKind::plane_strain, metal(coupling_number)) {
    body.hold("left", 0);
    body.hold("bottom", 1);
    body.options.mapping = mapping;
    body.initial_temperature.assign(body.mesh.x.size(), k_start);
    mechanics = body.phase();
    structural = std::make_unique<mechanics::StructuralHeat>(*mechanics, mechanics::StructuralForm::energy);
    heat::ThermalConditions thermal;
    if (radiates)
      for (const char* side : {"left", "right"}) thermal.radiations.push_back({side, side, {1.0}, 300.0});
    else if (film_over_capacity > 0)
      for (const char* side : {"left", "right"})
        thermal.films.push_back({side, side, {0.5 * film_over_capacity * k_capacity}, k_start - 0.1});
    else
      thermal.sources.push_back({"heater", "body", 0.1 * k_capacity});
    heat::HeatOptions options;
    options.tolerance = 1e-13;
    options.solver = linear::SolverKind::direct;
    heat = std::make_unique<heat::ThermalPhase>(body.mesh, body.kind, body.materials, thermal, options,
                                                std::vector<linear::Contribution*>{structural.get()});
    phases.heat = heat.get();
    phases.mechanics = mechanics.get();
    phases.structural = structural.get();
    start.heat = heat->states().initial(std::vector<double>{k_start});
    start.mechanics = mechanics->initial_state();
  }
};

std::vector<BlockIterative::Change> changes(double coupling_number, double film_over_capacity,
                                            Mapping mapping, const IterationOptions& options) {
  Block block(coupling_number, film_over_capacity, mapping);
  BlockIterative scheme(block.phases, options);
  coupling::State trial;
  scheme.advance(block.start, trial, 1, 1);
  return scheme.changes();
}

/// The factor of the change of temperature over `span` iterations, once it is that of the mode.
double ratio(const std::vector<BlockIterative::Change>& changes, std::size_t span = 1) {
  constexpr std::size_t k_first = 2;
  return changes.at(k_first + span).temperature / changes.at(k_first).temperature;
}

// The temperature changes by 0.1 K of 600 K and by no more than its rounding besides: a thousandth.
constexpr double k_linear = 2e-3;

TEST(BlockIterative, IsothermalPassesContractByTheCouplingNumber) {
  for (const double delta : {0.2, 0.8, 1.5}) {
    const double mode = delta / (1 + 1);  // m/(c + a)
    EXPECT_NEAR(ratio(changes(delta, 1, Mapping::isothermal, {})), mode, k_linear * mode);
    IterationOptions jacobi;
    jacobi.sweep = Sweep::jacobi;
    jacobi.max_iterations = 300;
    EXPECT_NEAR(ratio(changes(delta, 1, Mapping::isothermal, jacobi), 2), mode, k_linear * mode);
    IterationOptions relaxed;
    relaxed.relaxation = {Relaxing::fixed, 0.4};
    const double factor = std::abs(1 - 0.4 * (1 + mode));
    EXPECT_NEAR(ratio(changes(delta, 1, Mapping::isothermal, relaxed)), factor, k_linear);
  }
}

TEST(BlockIterative, IsentropicPassesContractWhateverTheCouplingNumber) {
  for (const double delta : {0.5, 2.0, 10.0}) {
    const double mode = delta / (1 + delta) * (1 - 1.0 / (1 + 1));  // (m_S − m_a)/(k + m_S)
    EXPECT_NEAR(ratio(changes(delta, 1, Mapping::isentropic, {})), mode, k_linear * mode);
  }
}

TEST(BlockIterative, IsentropicPassesAreExactWithoutConduction) {
  // The first iteration moves heat, the second one answers it, the third one finds nothing left to do.
  IterationOptions options;
  options.tolerance = 1e-3;
  EXPECT_EQ(changes(2, 0, Mapping::isentropic, options).size(), 3U);
  EXPECT_GT(changes(0.5, 0, Mapping::isothermal, options).size(), 8U);
}

TEST(BlockIterative, DivergesWhereTheCouplingNumberExceedsOneAndSaysSo) {
  try {
    changes(1.5, 0, Mapping::isothermal, {});
    FAIL();
  } catch (const StepRejected& rejected) {
    EXPECT_EQ(rejected.reason().rfind("coupling: the iteration between the phases diverges", 0), 0U)
        << rejected.reason();
    EXPECT_NE(rejected.reason().find(" K in "), std::string::npos) << rejected.reason();
    EXPECT_EQ(rejected.where().rfind("node ", 0), 0U) << rejected.where();
  }
  IterationOptions aitken;
  aitken.relaxation.kind = Relaxing::aitken;
  EXPECT_LT(changes(1.5, 0, Mapping::isothermal, aitken).size(), 10U);
}

// A change that grows by a tenth from iteration to iteration; half of the step contracts to a twentieth.
TEST(BlockIterative, GoesHalfAsFarWhereItsChangesDoNotFall) {
  const std::vector<BlockIterative::Change> found = changes(1.1, 0, Mapping::isothermal, {});
  ASSERT_GT(found.size(), 25U);
  EXPECT_LT(found.size(), 40U);
  EXPECT_GT(found[23].temperature, 5 * found[0].temperature);
  EXPECT_LT(found.back().temperature, 1e-6 * found[23].temperature);
}

TEST(BlockIterative, RejectsAStepThatTakesTooManyIterations) {
  IterationOptions options;
  options.max_iterations = 4;
  try {
    changes(0.8, 1, Mapping::isothermal, options);
    FAIL();
  } catch (const StepRejected& rejected) {
    EXPECT_EQ(rejected.reason().rfind("coupling: no convergence in 4 iterations", 0), 0U)
        << rejected.reason();
    EXPECT_EQ(rejected.where().rfind("node ", 0), 0U) << rejected.where();
  }
}

// Radiation takes more Newton steps than there are iterations of the phases.
TEST(BlockIterative, SolvesAStepWithWholePassesWhereSingleNewtonStepsDoNotConverge) {
  constexpr double k_day = 86400;
  const auto solve = [](const IterationOptions& options, coupling::State& end) {
    Block block(1e-6, 0, Mapping::isothermal, true);
    return BlockIterative(block.phases, options).advance(block.start, end, k_day, k_day).coupling_iterations;
  };
  coupling::State expected, trial;
  IterationOptions options;
  const int nested = solve(options, expected);
  options.loop = Loop::single;
  EXPECT_GT(solve(options, trial), nested);
  options.max_iterations = nested;
  EXPECT_EQ(solve(options, trial), nested);
  EXPECT_EQ(trial.heat.temperature, expected.heat.temperature);
  EXPECT_EQ(trial.mechanics.displacement, expected.mechanics.displacement);
  EXPECT_LT(trial.heat.temperature[0], k_start - 10);
}

// With so much conduction in a long step the coupling is weak, in a short one it is not.
TEST(BlockIterative, ARejectedStepLeavesNothingBehind) {
  IterationOptions options;
  for (const auto loop : {Loop::nested, Loop::single}) {
    options.loop = loop;
    Block fresh(1.5, 1, Mapping::isothermal), tried(1.5, 1, Mapping::isothermal);
    BlockIterative one(fresh.phases, options), two(tried.phases, options);
    coupling::State expected, trial;
    one.advance(fresh.start, expected, 1, 1);
    EXPECT_THROW(two.advance(tried.start, trial, 0.01, 0.01), StepRejected);
    EXPECT_TRUE(trial.heat.temperature.empty());
    EXPECT_EQ(tried.start.heat.temperature, fresh.start.heat.temperature);
    two.synchronise(tried.start);
    two.advance(tried.start, trial, 1, 1);
    EXPECT_EQ(trial.heat.temperature, expected.heat.temperature);
    EXPECT_EQ(trial.mechanics.displacement, expected.mechanics.displacement);
  }
}

TEST(BlockIterative, CountsItsIterationsAndTheEffortOfAllPasses) {
  Block block(0.8, 1, Mapping::isothermal);
  BlockIterative scheme(block.phases, {});
  coupling::State trial;
  const coupling::StepEffort effort = scheme.advance(block.start, trial, 1, 1);
  EXPECT_EQ(effort.coupling_iterations, static_cast<int>(scheme.changes().size()));
  EXPECT_GE(effort.mechanics.iterations, effort.coupling_iterations - 4);  // the last changes are rounding
  EXPECT_LT(std::abs(effort.energy.defect()), 1e-9 * effort.energy.heat_exchanged);
}

TEST(BlockIterative, RefusesPhasesAndRelaxationsThatDoNotFit) {
  Block block(0.8, 1, Mapping::isentropic);
  IterationOptions aitken;
  aitken.relaxation.kind = Relaxing::aitken;
  EXPECT_NO_THROW(BlockIterative(block.phases, {}));
  EXPECT_THROW(BlockIterative(block.phases, aitken), std::invalid_argument);
  coupling::Phases phases = block.phases;
  phases.structural = nullptr;
  EXPECT_THROW(BlockIterative(phases, {}), std::invalid_argument);
  phases = block.phases;
  phases.heat = nullptr;
  EXPECT_THROW(BlockIterative(phases, {}), std::invalid_argument);
}

}  // namespace
}  // namespace solidus
