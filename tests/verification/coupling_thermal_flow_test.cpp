/// Flow of metal that the thermal phase of a split maps again from the internal variables at t_n
/// (4.45, 4.49, 4.54; coupling/thermal_flow.hpp): first law, functional of stability, order, and melt, which
/// keeps its flow.
#include <gtest/gtest.h>

#include "casting_bodies.hpp"
#include "thick_cylinder.hpp"

namespace solidus {
namespace {

using coupling::PhaseOrder;
using coupling::ThermalFlow;
using mechanics::Mapping;
using verification::Coupled;
using verification::CoupledRun;

struct Scheme {
  const char* name;
  Mapping mapping;
  PhaseOrder order;
  bool double_pass = false;
};
const Scheme k_schemes[] = {{"isentropic, mechanics first", Mapping::isentropic, PhaseOrder::mechanics_first},
                            {"isentropic, heat first", Mapping::isentropic, PhaseOrder::heat_first},
                            {"isothermal, mechanics first", Mapping::isothermal, PhaseOrder::mechanics_first},
                            {"isothermal, heat first", Mapping::isothermal, PhaseOrder::heat_first},
                            {"double pass", Mapping::isentropic, PhaseOrder::mechanics_first, true}};

void choose(const Scheme& scheme, ThermalFlow flow, Coupled& c) {
  c.mapping = scheme.mapping;
  c.order = scheme.order;
  c.double_pass = scheme.double_pass;
  c.thermal_flow = flow;
}

/// The wall of section 7.1, perfectly plastic, whose flow stress falls by two thirds over its temperatures.
Coupled softening_wall() {
  Coupled c = verification::cylinder({.plastic = true}, 10);
  c.materials[0].flow->flow_stress = Table({293, 593}, {6e8, 2.5e8});
  return c;
}

TEST(ThermalFlow, ClosesTheFirstLawAndLowersTheFunctional) {
  for (const Scheme& scheme : k_schemes) {
    SCOPED_TRACE(scheme.name);
    Coupled c = softening_wall();
    choose(scheme, ThermalFlow::restarted, c);
    const CoupledRun run = verification::march(c, 200, 20);
    EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged());
    double dissipated = 0;
    for (const auto& step : run.steps) dissipated += step.plastic_dissipation;
    EXPECT_GT(dissipated, 0);
    if (scheme.mapping != Mapping::isentropic || scheme.double_pass) continue;
    for (const auto& stability : run.stability) EXPECT_LE(stability.increment(), stability.tolerance);
  }
}

/// The largest difference of the temperatures at the end [K].
double difference(const CoupledRun& a, const CoupledRun& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.end.heat.temperature.size(); ++i)
    largest = std::max(largest, std::abs(a.end.heat.temperature[i] - b.end.heat.temperature[i]));
  return parallel::global_max(largest);
}

TEST(ThermalFlow, TendsToTheSolutionThatKeepsTheFlowOfTheMechanicalPhase) {
  for (const Scheme& scheme : k_schemes) {
    SCOPED_TRACE(scheme.name);
    std::vector<double> differences;
    for (const int n : {20, 80}) {
      std::vector<CoupledRun> runs;
      for (const auto flow : {ThermalFlow::kept, ThermalFlow::restarted}) {
        Coupled c = softening_wall();
        choose(scheme, flow, c);
        runs.push_back(verification::march(c, 200, n));
      }
      differences.push_back(difference(runs[0], runs[1]));
    }
    EXPECT_GT(differences[0], 0);  // the flow is another one
    // With heat first the thermal phase that maps again changes temperatures by the heat of deformation
    // alone; what is left is the jump of the load in the first step.
    const bool heat_first = scheme.order == PhaseOrder::heat_first;
    EXPECT_LT(differences[1], heat_first ? 1e-3 : 0.5 * differences[0]);
  }
}

// Mapped again at a temperature at which it is solid, a point would take back the flow of its melt, and up to
// G ‖Δε^v‖² would be elastic energy.
TEST(ThermalFlow, LeavesMeltTheFlowThatItHas) {
  for (const Scheme& scheme : k_schemes) {
    SCOPED_TRACE(scheme.name);
    std::vector<CoupledRun> runs;
    for (const auto flow : {ThermalFlow::kept, ThermalFlow::restarted}) {
      Coupled c = verification::casting(0);
      c.form = mechanics::StructuralForm::energy;
      c.materials[1].flow.emplace().flow_stress = Table({500, 932}, {6e7, 2e6});
      choose(scheme, flow, c);
      runs.push_back(verification::march(c, 16, 16));
      EXPECT_LT(runs.back().worst_defect(), 1e-8 * runs.back().exchanged());
    }
    EXPECT_LT(difference(runs[0], runs[1]), 0.1);
  }
}

}  // namespace
}  // namespace solidus
