/// The first law with plastic flow in the isothermal split: dissipation heats, hardening stores.
#include <gtest/gtest.h>

#include "../laws/logarithmic.hpp"
#include "../laws/marquis.hpp"
#include "coupling_bodies.hpp"
#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus {
namespace {

using material::IsotropicHardening;
using material::KinematicHardening;
using mechanics::StructuralForm;
using mesh::Shape;
using verification::Coupled;
using verification::CoupledRun;

constexpr double k_end = 16;  // [s]

/// A bar in plane strain, pulled by 1 % and pushed back by 2 % while one side is chilled: plastic everywhere,
/// both ways. Everything softens with temperature.
Coupled bar(IsotropicHardening isotropic, KinematicHardening kinematic) {
  Coupled c;
  c.mesh =
      test::make_mesh({.shape = Shape::quad4, .cells = {8, 4, 1}, .size = {0.1, 0.05, 1}, .distortion = 0.1});
  material::Material m = test::elastic_material(2e11, 0.3);
  m.young_modulus = Table({300, 900}, {2e11, 1.2e11});
  m.expansion = Table({300, 900}, {1.1e-5, 1.5e-5});
  material::Flow flow;
  flow.flow_stress = Table({300, 900}, {2.5e8, 8e7});
  flow.isotropic = isotropic;
  set_hardening(flow, {{"saturation_stress", Table({300, 900}, {4e8, 1.2e8})},
                       {"saturation_rate", 60.0},
                       {"hardening_modulus", Table({300, 900}, {2e9, 5e8})},
                       {"reference_strain", 2e-3},
                       {"hardening_exponent", Table({300, 900}, {0.2, 0.1})},
                       {"log_factor", Table({300, 900}, {8e7, 3e7})},
                       {"log_strain", 2e-3}});
  flow.kinematic = kinematic;
  if (kinematic != KinematicHardening::none) flow.kinematic_modulus = Table({300, 900}, {1e10, 4e9});
  flow.recall = {80.0, 2.0};
  flow.rate[material::Perzyna::viscosity] = 1e9;
  m.flow = flow;
  c.materials = {m};
  c.start = {800};
  c.hold("left", 0);
  c.hold("left", 1);
  c.hold("right", 0, Table({0, 8, 16}, {0, 1e-3, -1e-3}));
  c.thermal.films.push_back({"chill", "top", {4000.0}, Table({0, 16}, {800, 300})});
  return c;
}

CoupledRun run(Coupled c, StructuralForm form, int n_steps) {
  c.form = form;
  return verification::march(c, k_end, n_steps);
}

const std::pair<IsotropicHardening, KinematicHardening> k_kinds[] = {
    {IsotropicHardening::none, KinematicHardening::none},
    {IsotropicHardening::saturation, KinematicHardening::none},
    {IsotropicHardening::linear, KinematicHardening::linear},
    {IsotropicHardening::power, KinematicHardening::armstrong_frederick},
    {test::k_logarithmic.kind, KinematicHardening::linear},
    {IsotropicHardening::linear, test::k_marquis.kind}};

TEST(EnergyForm, ClosesTheFirstLawWithPlasticFlowAndHardening) {
  for (const auto& [isotropic, kinematic] : k_kinds)
    for (int n : {4, 16}) {
      const CoupledRun r = run(bar(isotropic, kinematic), StructuralForm::energy, n);
      double work = 0, dissipation = 0;
      for (const auto& step : r.steps) {
        work += step.plastic_work;
        dissipation += step.plastic_dissipation;
      }
      EXPECT_GT(dissipation, 0);
      EXPECT_EQ(work > 1.001 * dissipation, isotropic != IsotropicHardening::none);
      // The criteria of the phases: 1e-12 of the heat, 1e-11 of the forces.
      EXPECT_LT(std::abs(r.defect()), 1e-11 * r.exchanged()) << n;
      EXPECT_LT(r.worst_defect(), 1e-11 * r.exchanged()) << n;
    }
}

TEST(EntropyForm, HasADefectOfFirstOrderInSumWithPlasticFlow) {
  const Coupled c = bar(IsotropicHardening::saturation, KinematicHardening::linear);
  auto out = verification::table("coupling_plasticity_order", "step[s],defect,difference[K]");
  std::vector<double> defect, difference;
  for (int n : {16, 32, 64, 128}) {
    const CoupledRun a = run(c, StructuralForm::entropy, n), b = run(c, StructuralForm::energy, n);
    defect.push_back(std::abs(a.defect()) / a.exchanged());
    double worst = 0;
    for (std::size_t i = 0; i < a.end.heat.temperature.size(); ++i)
      worst = std::max(worst, std::abs(a.end.heat.temperature[i] - b.end.heat.temperature[i]));
    difference.push_back(parallel::global_max(worst));
    out << k_end / n << "," << defect.back() << "," << difference.back() << "\n";
  }
  for (std::size_t i = 1; i < defect.size(); ++i) {
    EXPECT_NEAR(verification::order(defect[i - 1], defect[i]), 1, 0.2) << i;
    EXPECT_NEAR(verification::order(difference[i - 1], difference[i]), 1, 0.25) << i;
  }
}

}  // namespace
}  // namespace solidus
