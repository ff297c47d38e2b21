/// The first law: in every step the change of the internal energy (enthalpy, structural energy, penalty
/// springs) against heat in and work of loads and supports; and of whole runs the energies of the first and
/// the last state, each computed from the fields of its moment.
#include <gtest/gtest.h>

#include "casting_bodies.hpp"
#include "contact/laws/constant_gap.hpp"
#include "contact/laws/power_contact.hpp"

namespace solidus {
namespace {

using mechanics::StructuralForm;
using verification::bar;
using verification::casting;
using verification::Coupled;
using verification::CoupledRun;

constexpr double k_end = 16;  // [s]

CoupledRun run(Coupled c, std::optional<StructuralForm> form, int n_steps) {
  c.form = form;
  return verification::march(c, k_end, n_steps);
}

/// Defects over the heat exchanged in the run: of all steps together and of the worst single one.
struct Defects {
  std::vector<double> sum, worst;
};
/// With the specific heat at constant pressure structural entropy is that of stresses alone, and the defect
/// of the entropy form so small that it has no order.
Coupled at_constant_strain(Coupled c) {
  for (material::Material& m : c.materials) m.specific_heat_at = material::SpecificHeatAt::constant_strain;
  return c;
}

Defects defects_of_entropy_form(const Coupled& c, const std::vector<int>& n_steps) {
  Defects d;
  for (int n : n_steps) {
    const CoupledRun r = run(c, StructuralForm::entropy, n);
    d.sum.push_back(std::abs(r.defect()) / r.exchanged());
    d.worst.push_back(r.worst_defect() / r.exchanged());
  }
  return d;
}

TEST(EntropyForm, HasADefectOfSecondOrderPerStepAndOfFirstOrderInSum) {
  const std::vector<int> n_steps{8, 16, 32, 64, 128};
  const Defects of_bar = defects_of_entropy_form(at_constant_strain(bar()), n_steps),
                of_casting = defects_of_entropy_form(at_constant_strain(casting(0)), n_steps);
  auto out = verification::table("coupling_first_law_order",
                                 "step[s],bar: sum,bar: worst step,casting: sum,casting: worst step");
  for (std::size_t i = 0; i < n_steps.size(); ++i) {
    out << k_end / n_steps[i] << "," << of_bar.sum[i] << "," << of_bar.worst[i] << "," << of_casting.sum[i]
        << "," << of_casting.worst[i] << "\n";
    if (i == 0) continue;
    EXPECT_NEAR(verification::order(of_bar.sum[i - 1], of_bar.sum[i]), 1, 0.12) << i;
    EXPECT_NEAR(verification::order(of_bar.worst[i - 1], of_bar.worst[i]), 2, 0.15) << i;
    EXPECT_NEAR(verification::order(of_casting.sum[i - 1], of_casting.sum[i]), 1, 0.25) << i;
    // The worst step is the first, in which hot metal meets the cold mould: not smooth, the order still
    // rises.
    EXPECT_GT(verification::order(of_casting.worst[i - 1], of_casting.worst[i]), i < 3 ? 1.2 : 1.5) << i;
    EXPECT_LT(verification::order(of_casting.worst[i - 1], of_casting.worst[i]), 2.2) << i;
  }
}

TEST(EntropyForm, LosesLittleAndMoreInLongSteps) {
  auto out = verification::table("coupling_first_law",
                                 "time[s],exact,entropy_2_s,entropy_1_s,entropy_0.5_s,energy_2_s");
  std::vector<CoupledRun> runs;
  for (int n : {8, 16, 32}) runs.push_back(run(casting(0), StructuralForm::entropy, n));
  runs.push_back(run(casting(0), StructuralForm::energy, 8));
  std::vector<double> sums(runs.size(), 0.0), largest(runs.size(), 0.0);
  out << "0,0,0,0,0,0\n";
  for (std::size_t row = 0; row < 8; ++row) {
    out << 2 * (row + 1) << ",0";
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const std::size_t steps = runs[r].steps.size() / 8;
      for (std::size_t i = 0; i < steps; ++i) sums[r] += runs[r].steps[row * steps + i].defect();
      largest[r] = std::max(largest[r], std::abs(sums[r]));
      out << "," << sums[r] / runs[r].exchanged();
    }
    out << "\n";
  }
  EXPECT_LT(largest[0], 5e-4 * runs[0].exchanged());
  EXPECT_LT(largest[1], largest[0]);
  EXPECT_LT(largest[2], largest[1]);
}

// Bound of the defect for the criteria of the phases: 1e-12 of the heat, 1e-11 of the forces.
constexpr double k_closed = 1e-8;

TEST(EnergyForm, ClosesTheFirstLawForAnyStepInBothSplits) {
  for (const auto mapping : {mechanics::Mapping::isothermal, mechanics::Mapping::isentropic})
    for (int n : {1, 2, 8, 64})
      for (Coupled c : {bar(), casting(0), casting(5e6)}) {
        c.mapping = mapping;
        const CoupledRun r = run(c, StructuralForm::energy, n);
        EXPECT_LT(std::abs(r.defect()), k_closed * r.exchanged()) << n;
        EXPECT_LT(r.worst_defect(), k_closed * r.exchanged()) << n;
      }
}

/// A casting that shrinks by 4 % while it freezes, with tables that bend within its temperatures.
Coupled bending_casting() {
  Coupled c = casting(5e6);
  c.contact->heat->contact_law = contact::contact_law(contact::PowerContact{2e4});
  c.contact->heat->gap_law = contact::gap_law(contact::ConstantGap{2e4});
  material::Material& melt = c.materials[1];
  melt.phase_changes[0].volume_change = -0.04;
  melt.young_modulus = Table({273, 750, 850, 932}, {69e9, 50e9, 30e9, 26e9});
  melt.expansion = Table({293, 700, 880, 932}, {2.2e-5, 2.6e-5, 2.5e-5, 2.7e-5});
  return c;
}

struct Variant {
  const char* name;
  mechanics::Mapping mapping;
  coupling::PhaseOrder order = coupling::PhaseOrder::mechanics_first;
  bool double_pass = false, iterates = false, two_stages = false;
};
const Variant k_variants[] = {
    {"isothermal", mechanics::Mapping::isothermal},
    {"isothermal, heat first", mechanics::Mapping::isothermal, coupling::PhaseOrder::heat_first},
    {"isentropic", mechanics::Mapping::isentropic},
    {"isentropic, heat first", mechanics::Mapping::isentropic, coupling::PhaseOrder::heat_first},
    {"double pass", mechanics::Mapping::isentropic, coupling::PhaseOrder::mechanics_first, true},
    {"double pass, isothermal", mechanics::Mapping::isothermal, coupling::PhaseOrder::mechanics_first, true},
    {"iterative", mechanics::Mapping::isentropic, coupling::PhaseOrder::mechanics_first, false, true},
    {"simultaneous", mechanics::Mapping::simultaneous},
    {"two stages", mechanics::Mapping::simultaneous, coupling::PhaseOrder::mechanics_first, false, false,
     true}};

// No sum over the steps enters the energies: what new phases and lines of tables drop would be seen.
TEST(InternalEnergy, OfTheFieldsAtTheEndLessThatAtTheStartIsHeatAndWork) {
  for (const Variant& variant : k_variants)
    for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
      for (Coupled c : {bar(), bending_casting()}) {
        c.form = StructuralForm::energy;
        c.mapping = variant.mapping;
        c.order = variant.order;
        c.integration = rule;
        c.double_pass = variant.double_pass;
        if (variant.iterates) c.iteration.emplace();
        if (variant.two_stages)
          c.simultaneous.integration = coupling::SimultaneousOptions::Integration::sdirk2;
        if (c.contact) c.contact->nodal_heat = rule == heat::HeatIntegration::closed;
        constexpr int k_steps = 8;
        verification::Assembly assembly(c, k_end);
        ASSERT_TRUE(coupling::has_internal_energy(assembly.phases()));
        coupling::State state = assembly.start();
        assembly.scheme().synchronise(state);
        const double first = coupling::internal_energy(assembly.phases(), state);
        coupling::EnergyAudit sum;
        for (int n = 1; n <= k_steps; ++n) {
          coupling::State trial;
          sum += assembly.advance(state, trial, k_end * n / k_steps, k_end / k_steps).energy;
          state = std::move(trial);
        }
        sum.internal = coupling::internal_energy(assembly.phases(), state) - first;
        EXPECT_LT(std::abs(sum.state_defect()), k_closed * sum.heat_exchanged)
            << variant.name << (c.contact ? " casting" : " bar")
            << (rule == heat::HeatIntegration::open ? " open" : "");
        const double solid = assembly.heat().states().mean_solid_fraction(state.heat);
        EXPECT_TRUE(!c.contact || solid > 0.3) << variant.name << ' ' << solid;
      }
}

TEST(InternalEnergy, IsNoFunctionOfTheFieldsWithTheSpecificHeatAtConstantStrain) {
  Coupled c = at_constant_strain(casting(0));
  c.form = StructuralForm::energy;
  EXPECT_FALSE(coupling::has_internal_energy(verification::Assembly(c, k_end).phases()));
}

TEST(WithoutStructuralHeat, TheBalanceClosesForAnyStepAcrossTheInterfaceToo) {
  for (int n : {1, 2, 8, 64})
    for (auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
      for (Coupled c : {bar(), casting(0), casting(5e6)}) {
        c.integration = rule;
        if (c.contact) c.contact->nodal_heat = rule == heat::HeatIntegration::closed;
        const CoupledRun r = run(c, {}, n);
        EXPECT_LT(std::abs(r.defect()), k_closed * r.exchanged()) << n;
      }
}

TEST(BothForms, TendToTheSameTemperaturesAtFirstOrder) {
  std::vector<double> difference;
  for (int n : {8, 16, 32, 64}) {
    const Coupled c = at_constant_strain(bar());
    const CoupledRun a = run(c, StructuralForm::entropy, n), b = run(c, StructuralForm::energy, n);
    double worst = 0;
    for (std::size_t i = 0; i < a.end.heat.temperature.size(); ++i)
      worst = std::max(worst, std::abs(a.end.heat.temperature[i] - b.end.heat.temperature[i]));
    difference.push_back(parallel::global_max(worst));
  }
  EXPECT_LT(difference.back(), 0.1);  // [K], of 500
  for (std::size_t i = 1; i < difference.size(); ++i)
    EXPECT_NEAR(verification::order(difference[i - 1], difference[i]), 1, 0.15) << i;
}

}  // namespace
}  // namespace solidus
