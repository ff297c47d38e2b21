/// The work of a pass by the forces that it is given.
#include <gtest/gtest.h>

#include "body.hpp"

namespace solidus {
namespace {

using mesh::Shape;

/// A linear elastic body that is pulled at a constant rate: with the forces of the end of the first step at
/// work in the second one, the second step does the same work as the first.
TEST(ForcesAtWork, AreThoseThatAPassIsGivenWhateverIsSolvedInBetween) {
  for (const auto& [shape, kind] :
       {std::pair{Shape::quad4, AnalysisKind::plane_strain},
        std::pair{Shape::tri3, AnalysisKind::axisymmetric}, std::pair{Shape::hex8, AnalysisKind::solid}}) {
    const int layers = kind == AnalysisKind::solid ? 2 : 1;
    test::Body body({.shape = shape, .cells = {3, 2, layers}, .distortion = 0.1}, kind,
                    test::elastic_material(2e11, 0.3));
    body.options.simplices = mechanics::Simplices::mixed;
    body.hold("bottom", 1);
    body.hold("left", 0);
    if (kind == AnalysisKind::solid) body.hold("back", 2);
    body.hold("top", 1, Table({0, 10}, {0, 1e-3}));
    const auto phase = body.phase();
    const mechanics::MechanicalState start = phase->initial_state();
    mechanics::MechanicalState first, other, second;
    const mechanics::MechanicalReport before = phase->solve(
        start, first, {.time = 1, .dt = 1, .temperature = body.temperature, .returns_at_work = true});
    const auto at_its_end = phase->solve(first, other, {.time = 2, .dt = 1, .temperature = body.temperature});
    EXPECT_TRUE(at_its_end.at_work.stress.empty());  // no one has asked for them
    phase->solve(start, other, body.temperature, 7, 7);
    const mechanics::MechanicalReport after = phase->solve(
        first, second, {.time = 2, .dt = 1, .temperature = body.temperature, .at_work = &before.at_work});

    const double work = before.work.internal_work + before.work.numerical;
    ASSERT_GT(work, 0);
    EXPECT_NEAR(after.work.internal_work, before.work.internal_work, 1e-9 * work);
    EXPECT_NEAR(after.work.numerical, before.work.numerical, 1e-9 * work);
    EXPECT_NEAR(after.work.support_work, before.work.support_work, 1e-9 * work);
    EXPECT_NEAR(after.work.support_work, work, 1e-9 * work);
    EXPECT_NEAR(at_its_end.work.support_work, 2 * work, 1e-9 * work);
  }
}

}  // namespace
}  // namespace solidus
