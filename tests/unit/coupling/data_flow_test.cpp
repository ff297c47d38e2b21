/// Data flow that one can see: what a pass hands out stays as it is whatever is solved after it, and the same
/// pass from the same state gives the same bits whatever has been solved before it. The same of whole steps:
/// tests/verification/coupling_data_flow_test.cpp.
#include <gtest/gtest.h>

#include "../contact/bodies.hpp"
#include "../mechanics/plastic_material.hpp"
#include "answers.hpp"
#include "heat/thermal_phase.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/mechanical_restart.hpp"
#include "rubbing_interface.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::MechanicalPass;
using mesh::Shape;
using test::Answers;

/// A field that varies in space, around a mean.
std::vector<double> uneven(const mesh::Mesh& mesh, double mean) {
  std::vector<double> t;
  for (const mesh::Point& x : mesh.x) t.push_back(mean + 15 * x[0] - 9 * x[1]);
  return t;
}

// Mechanics: metal that flows, in quads with B-bar and in mixed triangles.

struct Element {
  Shape shape;
  Mapping mapping;
};

class MechanicalDataFlow : public ::testing::TestWithParam<Element> {
 protected:
  struct Solution {
    mechanics::MechanicalState state;
    mechanics::MechanicalReport report;
  };

  MechanicalDataFlow() : body_(pulled(GetParam())), phase_(body_.phase()) {
    for (const auto form : {mechanics::StructuralForm::entropy, mechanics::StructuralForm::energy})
      heat_.push_back(std::make_unique<mechanics::StructuralHeat>(*phase_, form));
    const mechanics::MechanicalState start = phase_->initial_state();
    phase_->solve(start, old_, body_.temperature, 1.0, 1.0);
  }

  static test::Body pulled(const Element& element) {
    test::Body body({.shape = element.shape, .cells = {3, 2, 1}, .distortion = 0.1},
                    AnalysisKind::plane_strain, test::plastic_material());
    body.options.mapping = element.mapping;
    body.options.simplices = mechanics::Simplices::mixed;
    body.hold("left", 0);
    body.hold("bottom", 1);
    body.hold("top", 1, Table({0, 1, 3}, {0, 1e-3, 4e-3}));
    return body;
  }
  /// To a time and at temperatures around a mean, which must outlive the pass.
  static MechanicalPass pass(double time, const std::vector<double>& temperature) {
    return {.time = time, .dt = time - 1, .temperature = temperature, .stores_stress = true};
  }
  Solution solve(const MechanicalPass& pass) {
    Solution s;
    s.report = phase_->solve(old_, s.state, pass);
    return s;
  }
  Answers answers(const Solution& s) {
    Answers a;
    test::add(body_.mesh, s.state, a);
    test::add(s.report, a);
    for (std::size_t i = 0; i < heat_.size(); ++i) {
      Answers of_form;
      test::add(*heat_[i], s.report.deformation, uneven(body_.mesh, 350), of_form);
      for (auto& [name, values] : of_form) a[name + (i == 0 ? ", entropy" : ", energy")] = std::move(values);
      heat_[i]->release();
    }
    return a;
  }

  test::Body body_;
  std::unique_ptr<mechanics::MechanicalPhase> phase_;
  std::vector<std::unique_ptr<mechanics::StructuralHeat>> heat_;
  mechanics::MechanicalState old_;
};

TEST_P(MechanicalDataFlow, APassIsAFunctionOfItsArguments) {
  const std::vector<double> warm = uneven(body_.mesh, 310), hot = uneven(body_.mesh, 380);
  const Solution first = solve(pass(2, warm));
  const Answers once = answers(first);
  EXPECT_GT(first.report.work.plastic_dissipation, 0);
  const Solution other = solve(pass(3, hot));
  EXPECT_NE(answers(other).at("displacement"), once.at("displacement"));
  EXPECT_NE(answers(other).at("heat of deformation, energy"), once.at("heat of deformation, energy"));
  mechanics::held_deformation(*phase_, old_, hot);
  test::expect_same(answers(first), once, "handed out before", false);
  test::expect_same(answers(solve(pass(2, warm))), once, "solved again");
}

TEST_P(MechanicalDataFlow, TheReturnMappingOfTheThermalPhaseGoesOnFromWhatItIsGiven) {
  const std::vector<double> warm = uneven(body_.mesh, 310), hot = uneven(body_.mesh, 380),
                            end = uneven(body_.mesh, 325);
  const Solution solved = solve(pass(2, warm));
  const Answers before = answers(solved);
  const auto restart = [&](Solution s) {
    const mechanics::FlowChange change =
        mechanics::restart_flow(*phase_, old_, pass(2, warm), end, s.state, s.report.deformation);
    EXPECT_TRUE(change.flows);
    Answers a = answers(s);
    a["change"] = {change.work.dissipation, change.work.plastic_work, change.work.inelastic_entropy};
    return a;
  };
  const Answers once = restart(solved);
  EXPECT_NE(once.at("history"), before.at("history"));
  solve(pass(3, hot));
  test::expect_same(restart(solved), once, "restarted again", false);
  test::expect_same(answers(solved), before, "handed out before", false);
}

INSTANTIATE_TEST_SUITE_P(Elements, MechanicalDataFlow,
                         ::testing::Values(Element{Shape::quad4, Mapping::isothermal},
                                           Element{Shape::quad4, Mapping::isentropic},
                                           Element{Shape::tri3, Mapping::isothermal},
                                           Element{Shape::tri3, Mapping::isentropic}));

// Heat: metal that freezes next to a film whose temperature changes.

material::Material freezing() {
  material::Material m = test::elastic_material(2e11, 0.3, 1e-5);
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(540, 560),
                             .latent_heat = 2e5,
                             .solidification = true});
  return m;
}

TEST(ThermalDataFlow, APassIsAFunctionOfItsArguments) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  heat::ThermalConditions conditions;
  conditions.films = {{"film", "lower_y_min", {Table(3000.0)}, Table({0, 10}, {300, 500})}};
  for (const auto integration : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
    for (const auto stepping : {heat::ThermalStepping::backward_euler, heat::ThermalStepping::sdirk2}) {
      heat::HeatOptions options;
      options.integration = integration;
      heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {freezing(), freezing()}, conditions,
                               options);
      heat::ThermalState old = phase.states().initial(std::vector<double>{570, 565});
      const heat::ThermalReport earlier = phase.solve(old, old, {.time = 2, .dt = 2, .stepping = stepping});
      const bool flows = earlier.flows.known();
      const std::vector<double> flow =
          flows ? heat::flow_at_end(phase, earlier.flows) : std::vector<double>{};
      heat::ThermalState now;
      const auto solve = [&](heat::ThermalState& trial, double dt, bool adiabatic) {
        return phase.solve(old, trial,
                           {.time = 2 + dt, .dt = dt, .stepping = stepping, .adiabatic = adiabatic});
      };
      const auto answers = [&](const heat::ThermalState& state, const heat::ThermalReport& report) {
        Answers a;
        test::add(state, a);
        test::add(report, a);
        if (flows) a["error"] = heat::time_error(phase, state, report.flows, flow);
        const heat::TemperatureRange around = heat::ambient_range(phase, 5);
        a["around"] = {around.lowest, around.highest};
        return a;
      };
      const heat::ThermalReport report = solve(now, 3, false);
      const Answers once = answers(now, report);
      heat::ThermalState other;
      solve(other, 6, false);
      EXPECT_NE(other.temperature, now.temperature);
      solve(other, 1, stepping == heat::ThermalStepping::backward_euler);
      test::expect_same(answers(now, report), once, "handed out before");
      heat::ThermalState again;
      const heat::ThermalReport report_again = solve(again, 3, false);
      test::expect_same(answers(again, report_again), once, "solved again");
    }
}

// Contact: blocks that press, rub and conduct.

TEST(ContactDataFlow, AnUpdateIsAFunctionOfTheStartOfTheStepAndTheDisplacement) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, test::rubbing_interface());
  const auto moved = [&](double slip, double press) {
    return test::nodal_field(mesh, 2, [&](const mesh::Point& x, bool upper) {
      return upper ? std::vector{slip, -press * (1 - 2 * x[0])} : std::vector{0.0, 0.0};
    });
  };
  const std::vector<double> rest = moved(0, 1e-6), warm = uneven(mesh, 400);
  pair.begin({}, {.time = 1, .dt = 1, .displacement = moved(0, 0), .temperature = warm});
  const contact::ContactState old = pair.update(rest);
  const auto solve = [&](double time, const std::vector<double>& u) {
    pair.begin(old, {.time = time, .dt = time - 1, .displacement = rest, .temperature = warm});
    pair.update(u);
    Answers a;
    const auto n = static_cast<std::size_t>(mesh.n_owned_nodes);
    a["forces"].assign(2 * n, 0.0);
    pair.parts().forces.term().add_residual(u, a["forces"]);
    pair.parts().heat.begin(time - 1, false);
    a["heat at nodes"] = pair.parts().heat.nodal(warm);
    const contact::InterfaceSums heat = pair.parts().heat.commit(warm);
    a["interface"] = {heat.energy, heat.entropy, heat.plastic_entropy, heat.mechanical_energy};
    test::add({pair.state()}, a);
    const contact::ContactSums sums = contact::sums(pair.view(), warm);
    a["sums"] = {sums.force, sums.friction, sums.energy, sums.work, sums.dissipation, sums.heat};
    a["work"] = {contact::work(pair.view(), 0.5), contact::work(pair.view(), 1)};
    const contact::ContactNodalFields fields = contact::nodal_fields(pair.view(), warm);
    a["pressure at nodes"] = fields.pressure;
    return a;
  };
  const Answers once = solve(2, moved(1e-5, 2e-6));
  EXPECT_GT(once.at("sums")[4], 0);
  const Answers other = solve(4, moved(-3e-5, -1e-6));
  EXPECT_NE(other.at("heat at nodes"), once.at("heat at nodes"));
  test::expect_same(solve(2, moved(1e-5, 2e-6)), once, "updated again");
}

}  // namespace
}  // namespace solidus
