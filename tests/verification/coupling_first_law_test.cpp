/// The first law in the splits: in every step the change of the internal energy (enthalpy,
/// structural energy, penalty springs) against heat in and work of loads and supports.
#include <gtest/gtest.h>

#include "casting_bodies.hpp"

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
  std::vector<double> sums(runs.size(), 0.0);
  out << "0,0,0,0,0,0\n";
  for (std::size_t row = 0; row < 8; ++row) {
    out << 2 * (row + 1) << ",0";
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const std::size_t steps = runs[r].steps.size() / 8;
      for (std::size_t i = 0; i < steps; ++i) sums[r] += runs[r].steps[row * steps + i].defect();
      out << "," << sums[r] / runs[r].exchanged();
    }
    out << "\n";
  }
  EXPECT_LT(std::abs(sums[0]), 5e-4 * runs[0].exchanged());
  EXPECT_LT(std::abs(sums[1]), std::abs(sums[0]));
  EXPECT_LT(std::abs(sums[2]), std::abs(sums[1]));
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

TEST(WithoutStructuralHeat, TheBalanceClosesForAnyStepAcrossTheInterfaceToo) {
  for (int n : {1, 2, 8, 64})
    for (auto rule : {heat::Integration::closed, heat::Integration::open})
      for (Coupled c : {bar(), casting(0), casting(5e6)}) {
        c.integration = rule;
        if (c.contact) c.contact->nodal_heat = rule == heat::Integration::closed;
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
    difference.push_back(algebra::global_max(worst));
  }
  EXPECT_LT(difference.back(), 0.1);  // [K], of 500
  for (std::size_t i = 1; i < difference.size(); ++i)
    EXPECT_NEAR(verification::order(difference[i - 1], difference[i]), 1, 0.15) << i;
}

}  // namespace
}  // namespace solidus
