/// Data flow that one can see, of coupling schemes: a step is a function of the state it starts from, and
/// what it hands out stays as it is whatever is solved after it. The same of single passes:
/// tests/unit/coupling/data_flow_test.cpp.
#include <gtest/gtest.h>

#include "../unit/contact/bodies.hpp"
#include "../unit/coupling/answers.hpp"
#include "../unit/coupling/rubbing_interface.hpp"
#include "../unit/mechanics/plastic_material.hpp"
#include "coupling_bodies.hpp"

namespace solidus {
namespace {

using coupling::State;
using mechanics::Mapping;
using test::Answers;

struct Scheme {
  const char* name;
  void (*choose)(verification::Coupled& c);
};

std::ostream& operator<<(std::ostream& out, const Scheme& scheme) {
  return out << scheme.name;
}

class SchemeDataFlow : public ::testing::TestWithParam<Scheme> {};

verification::Coupled hot_on_cold() {
  verification::Coupled c;
  c.mesh = test::two_blocks(mesh::Shape::quad4);
  c.materials = {test::plastic_material(), test::plastic_material()};
  c.start = {320, 420};
  c.contact = test::rubbing_interface();
  c.form = mechanics::StructuralForm::energy;
  c.mechanics_tolerance = 1e-9;
  for (int i = 0; i < 2; ++i) c.hold("lower_y_min", i);
  c.hold("upper_y_max", 0, Table({0, 4}, {0, 2e-5}));
  c.hold("upper_y_max", 1, Table({0, 1, 4}, {0, -1e-4, -4e-4}));
  return c;
}

TEST_P(SchemeDataFlow, AStepIsAFunctionOfTheStateItStartsFrom) {
  verification::Coupled c = hot_on_cold();
  GetParam().choose(c);
  verification::Assembly assembly(c, 4);
  State start = assembly.start(), old;
  assembly.scheme().synchronise(start);
  assembly.advance(start, old, 1, 1);
  const auto step = [&](State& trial, double dt) {
    assembly.scheme().synchronise(old);
    Answers a;
    test::add(assembly.advance(old, trial, 1 + dt, dt), a);
    return a;
  };
  const auto answers = [&](const State& state, Answers a) {
    test::add(c.mesh, state.mechanics, a);
    test::add(state.heat, a);
    test::add(state.contacts, a);
    return a;
  };
  State first, other, again;
  const Answers of_step = step(first, 1), once = answers(first, of_step);
  step(other, 3);
  EXPECT_NE(other.heat.temperature, first.heat.temperature);
  test::expect_same(answers(first, of_step), once, "handed out before", false);
  const Answers of_same_step = step(again, 1);
  test::expect_same(answers(again, of_same_step), once, "taken again");
}

INSTANTIATE_TEST_SUITE_P(
    All, SchemeDataFlow,
    ::testing::Values(
        Scheme{"isentropic_mechanics_first",
               [](verification::Coupled& c) { c.mapping = Mapping::isentropic; }},
        Scheme{"isentropic_heat_first",
               [](verification::Coupled& c) {
                 c.mapping = Mapping::isentropic;
                 c.order = coupling::PhaseOrder::heat_first;
                 c.gap_tolerance = 0.02;
                 c.stepping = heat::ThermalStepping::sdirk2;
               }},
        Scheme{"isothermal_restarted",
               [](verification::Coupled& c) { c.thermal_flow = coupling::ThermalFlow::restarted; }},
        Scheme{"double_pass",
               [](verification::Coupled& c) {
                 c.mapping = Mapping::isentropic;
                 c.double_pass = true;
               }},
        Scheme{"double_pass_isothermal_restarted",
               [](verification::Coupled& c) {
                 c.double_pass = true;
                 c.thermal_flow = coupling::ThermalFlow::restarted;
               }},
        Scheme{"block_iterative",
               [](verification::Coupled& c) { c.iteration = coupling::IterationOptions{}; }},
        Scheme{"simultaneous", [](verification::Coupled& c) { c.mapping = Mapping::simultaneous; }},
        Scheme{"simultaneous_sdirk2",
               [](verification::Coupled& c) {
                 c.mapping = Mapping::simultaneous;
                 c.simultaneous.integration = coupling::SimultaneousOptions::Integration::sdirk2;
               }}),
    [](const auto& chosen) { return std::string(chosen.param.name); });

}  // namespace
}  // namespace solidus
