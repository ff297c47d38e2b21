/// Requirements of the splits on their phases.
#include "coupling/isentropic_split.hpp"

#include <gtest/gtest.h>

#include "../mechanics/body.hpp"
#include "coupling/isothermal_split.hpp"

namespace solidus {
namespace {

TEST(Split, RefusesAMechanicalPhaseThatWasBuiltForAnother) {
  test::Body body({.cells = {1, 1, 1}}, AnalysisKind::plane_strain, test::elastic_material(2e11, 0.3));
  const auto isothermal = body.phase();
  body.options.mapping = mechanics::Mapping::isentropic;
  const auto isentropic = body.phase();
  heat::ThermalPhase heat(body.mesh, body.kind, body.materials, {});
  mechanics::StructuralHeat structural(*isentropic, mechanics::StructuralForm::energy);

  coupling::Phases phases;
  phases.heat = &heat;
  phases.mechanics = isentropic.get();
  phases.structural = &structural;
  EXPECT_NO_THROW(coupling::IsentropicSplit{phases});
  EXPECT_THROW(coupling::IsothermalSplit{phases}, std::invalid_argument);
  phases.mechanics = isothermal.get();
  EXPECT_THROW(coupling::IsentropicSplit{phases}, std::invalid_argument);
  EXPECT_NO_THROW(coupling::IsothermalSplit{phases});
}

TEST(IsentropicSplit, RefusesToHoldEntropyThatNobodyAccountsFor) {
  test::Body body({.cells = {1, 1, 1}}, AnalysisKind::plane_strain, test::elastic_material(2e11, 0.3));
  body.options.mapping = mechanics::Mapping::isentropic;
  const auto mechanics = body.phase();
  heat::ThermalPhase heat(body.mesh, body.kind, body.materials, {});
  coupling::Phases phases;
  phases.mechanics = mechanics.get();
  EXPECT_THROW(coupling::IsentropicSplit{phases}, std::invalid_argument);
  phases.heat = &heat;
  EXPECT_THROW(coupling::IsentropicSplit{phases}, std::invalid_argument);
}

}  // namespace
}  // namespace solidus
