/// Keys of a case for the simultaneous scheme.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/schemes/simultaneous_keys.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "setup/mechanics_input.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using test::refusal;
using ::testing::HasSubstr;

CaseSpec read(const std::string& coupling, const std::string& more = "") {
  return test::bar_case("[coupling]\n" + coupling + "\n" + more);
}

std::string error(const std::string& coupling) {
  try {
    read(coupling);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

const coupling::SimultaneousOptions& options(const CaseSpec& spec) {
  using Kind = coupling::SchemeKindOf<coupling::SimultaneousKeys>;
  return dynamic_cast<const Kind&>(*spec.coupling.scheme).data;
}

TEST(SimultaneousKeys, AreReadWithTheirDefaults) {
  const CaseSpec spec = read("scheme = \"simultaneous\"");
  EXPECT_TRUE(spec.simultaneous());
  EXPECT_FALSE(spec.isentropic());
  EXPECT_EQ(options(spec).solver, linear::CoupledSolverKind::automatic);
  EXPECT_EQ(options(spec).integration, coupling::SimultaneousOptions::Integration::backward_euler);
  EXPECT_EQ(setup::mechanics_options(spec).mapping, mechanics::Mapping::simultaneous);
  EXPECT_EQ(refusal(spec), "");
  EXPECT_EQ(options(read("scheme = \"simultaneous\"\nsolver = \"field_split\"")).solver,
            linear::CoupledSolverKind::field_split);
}

TEST(SimultaneousKeys, OfItsSolverAndIntegrationAreRefusedWithOtherSchemes) {
  EXPECT_THAT(error("integration = \"sdirk2\""), HasSubstr("it needs scheme = simultaneous"));
  EXPECT_THAT(error("scheme = \"isothermal\"\nsolver = \"direct\""),
              HasSubstr("'solver' does not belong to [coupling] with scheme = \"isothermal\""));
}

TEST(SimultaneousKeys, ThatContradictEachOtherAreRefused) {
  const std::string two_stages = "scheme = \"simultaneous\"\nintegration = \"sdirk2\"";
  EXPECT_EQ(refusal(read(two_stages)), "");
  EXPECT_THAT(refusal(read(two_stages, "[mechanics]\nintegration = \"bdf2\"")),
              HasSubstr("two integrators of second order"));
  EXPECT_THAT(refusal(read(two_stages, "[dynamics]")), HasSubstr("quasi-statics"));
  EXPECT_THAT(refusal(read("scheme = \"simultaneous\"\nstructural_heating = \"literal\"")),
              HasSubstr("isothermal"));
}

}  // namespace
}  // namespace solidus::cases
