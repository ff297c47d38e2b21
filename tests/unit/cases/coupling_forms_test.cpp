/// [coupling]: which form goes with which scheme, and what a run that stops is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/advice.hpp"
#include "setup/heat_input.hpp"
#include "setup/scheme_input.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CaseSpec read(const std::string& coupling) {
  const CaseSpec spec = test::bar_case("[coupling]\n" + coupling);
  setup::check_case(spec);
  return spec;
}

std::string error(const std::string& coupling) {
  return test::refusal(test::bar_case("[coupling]\n" + coupling));
}

TEST(CouplingForms, TheDefaultIsTheIsentropicSplitInTheEnergyForm) {
  const CaseSpec spec = read("");
  EXPECT_EQ(spec.coupling.scheme->name(), "isentropic");
  EXPECT_EQ(setup::structural_form(spec), mechanics::StructuralForm::energy);
  EXPECT_EQ(setup::heat_options(spec).sensible, heat::SensibleForm::enthalpy);
}

TEST(CouplingForms, AsPrintedTakesSensibleHeatInTheFormOfStructuralHeat) {
  EXPECT_EQ(setup::heat_options(read("structural_heating = \"entropy\"\nas_printed = true")).sensible,
            heat::SensibleForm::entropy);
  const CaseSpec spec =
      read("scheme = \"isothermal\"\nstructural_heating = \"temperature\"\nas_printed = true");
  EXPECT_EQ(setup::heat_options(spec).sensible, heat::SensibleForm::temperature);
  EXPECT_EQ(setup::structural_form(spec), mechanics::StructuralForm::temperature);
}

TEST(CouplingForms, OfTheIsothermalSplitAreRefusedByOthers) {
  for (const std::string form : {"literal", "temperature"}) {
    EXPECT_EQ(error("scheme = \"isothermal\"\nstructural_heating = \"" + form + "\""), "");
    for (const std::string scheme : {"isentropic", "simultaneous", "block_iterative", "double_pass"})
      EXPECT_THAT(error("scheme = \"" + scheme + "\"\nstructural_heating = \"" + form + "\""),
                  HasSubstr(form));
  }
}

TEST(CouplingForms, PrintedSensibleHeatNeedsAPrintedFormOfStructuralHeat) {
  EXPECT_THAT(error("as_printed = true"), HasSubstr("as_printed"));
}

TEST(CouplingForms, TheDoublePassHasBothEnergyFormsAndNoPrintedSensibleHeat) {
  const std::string scheme = "scheme = \"double_pass\"\nstructural_heating = ";
  EXPECT_EQ(error(scheme + "\"energy\""), "");
  EXPECT_EQ(error(scheme + "\"entropy\""), "");
  EXPECT_THAT(error(scheme + "\"entropy\"\nas_printed = true"), HasSubstr("two stages"));
}

TEST(CouplingForms, TheDoublePassGoesWithInertiaAndWithPassesOfBothKinds) {
  for (const std::string passes : {"isentropic", "isothermal"})
    EXPECT_EQ(error("scheme = \"double_pass\"\npasses = \"" + passes + "\"\n[dynamics]"), "");
  const CaseSpec spec = read("scheme = \"double_pass\"\npasses = \"isothermal\"");
  EXPECT_FALSE(spec.isentropic());
  EXPECT_TRUE(spec.coupling.scheme->traits().needs_weak_coupling);
}

TEST(CouplingForms, WithoutStructuralHeatEverySchemeGoesAndNoneHoldsEntropy) {
  for (const std::string scheme :
       {"isentropic", "isothermal", "double_pass", "block_iterative", "simultaneous"}) {
    const std::string text = "scheme = \"" + scheme + "\"\nstructural_heating = \"none\"";
    EXPECT_EQ(error(text), "") << scheme;
    EXPECT_FALSE(read(text).isentropic()) << scheme;
    EXPECT_FALSE(read(text).exchanges_heat()) << scheme;
  }
}

TEST(Advice, NamesTheCouplingWhereItIsTooStrongForTheIsothermalSplitAndNoShorterSteps) {
  const CaseSpec spec = read("scheme = \"isothermal\"");
  const coupling::Stop stop{
      false, "heat: the temperature falls to -12 K", "node 1", 11, 1e-3, Failure::temperature};
  check::CouplingEstimate estimate;
  estimate.body = "block";
  estimate.plane = true;
  estimate.at_worst.plane = 2.0;
  const std::string strong = run::stop_text(stop, spec, 3, "there", std::vector{estimate});
  EXPECT_THAT(strong, HasSubstr("too strong for the isothermal split: block: delta"));
  EXPECT_THAT(strong, HasSubstr("coupling.scheme = \"isentropic\""));
  EXPECT_THAT(strong, Not(HasSubstr("time.min_step")));
  estimate.at_worst.plane = 0.1;
  const std::string weak = run::stop_text(stop, spec, 3, "there", std::vector{estimate});
  EXPECT_THAT(weak, Not(HasSubstr("too strong")));
  EXPECT_THAT(weak, HasSubstr("time.min_step"));
}

TEST(Advice, NamesTheLinearSolverWhereItFails) {
  CaseSpec spec = read("scheme = \"isothermal\"");
  coupling::Stop stop{
      false, "mechanics: linear solver: DIVERGED_ITS", "node 1", 11, 1e-3, Failure::linear_solver};
  EXPECT_THAT(run::stop_text(stop, spec, 3, "there", {}), Not(HasSubstr("mechanics.solver")));
  spec.mechanics.solver = linear::SolverKind::multigrid;
  EXPECT_THAT(run::stop_text(stop, spec, 3, "there", {}), HasSubstr("mechanics.solver = \"direct\""));
  spec.contacts.emplace_back().friction.emplace();
  EXPECT_THAT(run::stop_text(stop, spec, 3, "there", {}), HasSubstr("friction makes the matrix unsymmetric"));
  stop.failure = Failure::equilibrium;
  EXPECT_THAT(run::stop_text(stop, spec, 3, "there", {}), Not(HasSubstr("mechanics.solver")));
}

std::string advised(coupling::Physics physics, Failure failure) {
  coupling::Stop stop{false, "mechanics: no convergence in 25 iterations", "node 1", 11, 1e-3, failure};
  stop.diagnosis.physics = physics;
  stop.diagnosis.body = "block";
  stop.diagnosis.size = 1;
  stop.diagnosis.contact_name = "mould";
  return run::stop_text(stop, read(""), 3, "there");
}

TEST(Advice, FollowsFromThePhysicsAndSaysTheEquationsBehindIt) {
  using coupling::Physics;
  const Failure forces = Failure::equilibrium;
  const std::string falls = advised(Physics::nothing_carries, forces);
  EXPECT_THAT(falls, HasSubstr("reason: nothing carries body 'block'"));
  EXPECT_THAT(falls, HasSubstr("equations: mechanics: no convergence in 25 iterations"));
  EXPECT_THAT(falls, HasSubstr("a support against moving and turning"));
  for (const char* misleading : {"limit load", "max_iterations", "min_step", "tables"})
    EXPECT_THAT(falls, Not(HasSubstr(misleading)));
  EXPECT_THAT(advised(Physics::comes_off, forces), HasSubstr("contact pushes and does not hold"));
  EXPECT_THAT(advised(Physics::melt_flows, forces),
              HasSubstr("does a mould, a support or a plane of symmetry"));
  EXPECT_THAT(advised(Physics::limit_load, forces), HasSubstr("beyond its limit load"));
  EXPECT_THAT(advised(Physics::law, Failure::law), HasSubstr("tables and parameters of that material"));
  EXPECT_THAT(advised(Physics::no_equilibrium, forces), HasSubstr("mechanics.max_iterations (now "));
  EXPECT_THAT(advised(Physics::contact_heat, Failure::heat),
              HasSubstr("conductance and gap law of contact 'mould'"));
  EXPECT_THAT(advised(Physics::heat, Failure::heat), Not(HasSubstr("gap law")));
}

}  // namespace
}  // namespace solidus::cases
