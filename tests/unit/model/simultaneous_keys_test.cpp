/// Keys of a case for the simultaneous scheme.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanics/mechanical_phase.hpp"
#include "model/mechanics_input.hpp"
#include "small_case.hpp"

namespace solidus::model {
namespace {

using test::refusal;
using ::testing::HasSubstr;

CaseSpec read(const std::string& coupling, const std::string& more = "") {
  return test::bar_case("[coupling]\n" + coupling + "\n" + more);
}

TEST(SimultaneousKeys, AreReadWithTheirDefaults) {
  const CaseSpec spec = read("scheme = \"simultaneous\"");
  EXPECT_TRUE(spec.simultaneous());
  EXPECT_FALSE(spec.isentropic());
  EXPECT_EQ(spec.coupling.solver, algebra::CoupledSolverKind::automatic);
  EXPECT_EQ(spec.coupling.integration, CouplingSpec::Integration::backward_euler);
  EXPECT_EQ(mechanics_options(spec).mapping, mechanics::Mapping::simultaneous);
  EXPECT_EQ(refusal(spec), "");
  EXPECT_EQ(read("scheme = \"simultaneous\"\nsolver = \"field_split\"").coupling.solver,
            algebra::CoupledSolverKind::field_split);
}

TEST(SimultaneousKeys, OfItsSolverAndIntegrationAreRefusedWithOtherSchemes) {
  EXPECT_THAT(refusal(read("integration = \"sdirk2\"")), HasSubstr("those of the simultaneous scheme"));
  EXPECT_THAT(refusal(read("scheme = \"isothermal\"\nsolver = \"direct\"")),
              HasSubstr("those of the simultaneous scheme"));
}

TEST(SimultaneousKeys, ThatContradictEachOtherAreRefused) {
  const std::string two_stages = "scheme = \"simultaneous\"\nintegration = \"sdirk2\"";
  EXPECT_EQ(refusal(read(two_stages)), "");
  EXPECT_THAT(refusal(read(two_stages, "[mechanics]\nintegration = \"bdf2\"")),
              HasSubstr("two integrators of second order"));
  EXPECT_THAT(refusal(read(two_stages, "[dynamics]")), HasSubstr("quasi-statics"));
  EXPECT_THAT(refusal(read("scheme = \"simultaneous\"\nstructural_heating = \"none\"")),
              HasSubstr("without structural heat"));
  EXPECT_THAT(refusal(read("scheme = \"simultaneous\"\nstructural_heating = \"literal\"")),
              HasSubstr("isothermal"));
}

}  // namespace
}  // namespace solidus::model
