/// The heat of plastic flow and the energy that hardening stores, in both forms of structural heat.
#include <gtest/gtest.h>

#include "../../laws/hardening_parameter.hpp"
#include "heated.hpp"
#include "material/free_energy.hpp"
#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"
#include "mechanics/structural_heat.hpp"
#include "plastic_material.hpp"

namespace solidus {
namespace {

using material::KinematicHardening;
using mechanics::StructuralForm;
using mechanics::StructuralHeat;
using mesh::Shape;
using test::Body;
using Solved = test::Heated;

material::Material material_of(material::IsotropicHardening isotropic, KinematicHardening kinematic) {
  material::Material m = test::plastic_material(kinematic);
  m.young_modulus = Table({300, 500}, {2e11, 1.5e11});
  m.expansion = Table({300, 500}, {1.0e-5, 1.4e-5});
  m.flow->isotropic = isotropic;
  if (kinematic == KinematicHardening::none) m.flow->kinematic_modulus = 0.0;
  set_hardening(*m.flow, {{"saturation_stress", Table({300, 500}, {9e7, 5e7})},
                          {"saturation_rate", 200.0},
                          {"hardening_modulus", Table({300, 500}, {1e9, 7e8})},
                          {"reference_strain", 1e-3},
                          {"hardening_exponent", Table({300, 500}, {0.3, 0.2})}});
  m.flow->rate[material::Perzyna::viscosity] = 0.0;
  return m;
}

/// A block in uniform tension, plastic from a fraction of its first step on.
struct Pulled {
  Body body;
  explicit Pulled(const material::Material& m, Table pull = Table({0, 1}, {0, 1e-3}, Extrapolation::linear))
      : body({.shape = Shape::quad4, .cells = {3, 2, 1}, .distortion = 0.1}, AnalysisKind::plane_strain, m) {
    body.hold("bottom", 1);
    body.hold("top", 1, std::move(pull));
    body.hold("left", 0);
    set_temperature(320);
    body.initial_temperature = body.temperature;
  }
  void set_temperature(double theta) { body.temperature = uniform(theta); }
  std::vector<double> uniform(double theta) const { return std::vector<double>(body.mesh.x.size(), theta); }
};

std::vector<double> residual(StructuralHeat& heat, const Solved& solved,
                             const std::vector<double>& temperature) {
  std::vector<double> r(static_cast<std::size_t>(solved.phase->mesh().n_owned_nodes), 0.0);
  heat.set_deformation(solved.report.deformation);
  heat.add_residual(temperature, r);
  return r;
}
double total(const std::vector<double>& r) {
  double s = 0;
  for (double value : r) s += value;
  return parallel::global_sum(s);
}

constexpr std::pair<material::IsotropicHardening, KinematicHardening> k_kinds[] = {
    {material::IsotropicHardening::none, KinematicHardening::none},
    {material::IsotropicHardening::linear, KinematicHardening::none},
    {material::IsotropicHardening::saturation, KinematicHardening::linear},
    {material::IsotropicHardening::power, KinematicHardening::armstrong_frederick}};

TEST(PlasticHeat, TheTangentIsTheDerivativeOfTheResidual) {
  for (const auto& [isotropic, kinematic] : k_kinds)
    for (StructuralForm form : {StructuralForm::entropy, StructuralForm::energy}) {
      const Pulled p(material_of(isotropic, kinematic));
      const Solved solved(p.body);
      StructuralHeat heat(*solved.phase, form);
      linear::BlockMatrix matrix(p.body.mesh, 1, linear::NodeGraph(p.body.mesh));
      heat.bind(matrix);
      matrix.set_zero();
      heat.set_deformation(solved.report.deformation);
      heat.add_tangent(p.uniform(321), matrix);
      const double h = 1e-2;
      const auto plus = residual(heat, solved, p.uniform(321 + h)),
                 minus = residual(heat, solved, p.uniform(321 - h));
      double size = 0;
      for (std::size_t i = 0; i < plus.size(); ++i)
        size = std::max(size, std::abs(plus[i] - minus[i]) / (2 * h));
      for (Index i = 0; i < p.body.mesh.n_owned_nodes; ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_NEAR(*matrix.diagonal_block(i), (plus[k] - minus[k]) / (2 * h), 1e-5 * size);
      }
    }
}

TEST(PlasticHeat, AtFixedTemperatureOfConstantPropertiesTheHeatReleasedIsTheDissipation) {
  material::Material m = test::plastic_material();
  const auto parameter = [&](const char* key) {
    return &m.flow->hardening[material::test::hardening_parameter(m.flow->isotropic, key)];
  };
  for (Table* table : {&m.flow->flow_stress, parameter("saturation_stress"), parameter("hardening_modulus"),
                       &m.flow->kinematic_modulus})
    *table = table->value(300);
  m.expansion = 0.0;
  const Pulled p(m);
  const Solved solved(p.body);
  StructuralHeat heat(*solved.phase, StructuralForm::entropy);
  const auto& work = solved.report.work;  // Δt = 1
  EXPECT_GT(work.plastic_work, 1.1 * work.dissipation);
  EXPECT_NEAR(total(residual(heat, solved, p.uniform(320))), -work.dissipation, 1e-9 * work.dissipation);
}

TEST(PlasticHeat, TheEnergyFormGivesExactlyEnergyMinusWork) {
  for (const auto& [isotropic, kinematic] : k_kinds) {
    const Pulled p(material_of(isotropic, kinematic));
    const Solved solved(p.body);
    StructuralHeat heat(*solved.phase, StructuralForm::energy);
    const auto end = p.uniform(325);
    const double stored = structural_change(solved.report.deformation, end).energy -
                          solved.report.work.internal_work;  // Δt = 1
    EXPECT_NEAR(total(residual(heat, solved, end)), stored, 1e-11 * solved.report.work.internal_work);
  }
}

// Three steps of loading and unloading at changing temperature against the energy of the last state alone.
TEST(PlasticHeat, TheEnergyStoredIsThatOfTheStateReached) {
  for (const auto& [isotropic, kinematic] : k_kinds) {
    Pulled p(material_of(isotropic, kinematic), Table({0, 1, 2, 3}, {0, 1e-3, -1e-3, 2e-3}));
    const auto phase = p.body.phase();
    StructuralHeat heat(*phase, StructuralForm::energy);
    mechanics::MechanicalState state = phase->initial_state();
    double theta = 320, stored = 0;
    for (int step = 1; step <= 3; ++step) {
      const mechanics::MechanicalState old = state;
      p.set_temperature(theta);
      const auto report = phase->solve(old, state, p.body.temperature, step, 1.0);
      theta += 15;
      stored += structural_change(report.deformation, p.uniform(theta)).energy;
    }
    const material::Viscoplastic law(p.body.materials[0]);
    const auto flow = law.properties_at(320.0 + 2 * 15, 320.0).flow;  // at which the back stress was found
    double energy = -1e300;
    for (const auto& fields : test::element_fields(phase->mesh(), state))
      for (std::size_t e = 0; e < fields.strain.size(); ++e) {
        const Sym<double> plastic{fields.plastic_strain[e]}, back{fields.back_stress[e]};
        material::StateVariables<double> v{
            Sym<double>{fields.strain[e]} - plastic, fields.equivalent_plastic_strain[e], {}};
        if (kinematic != KinematicHardening::none) v.back_strain = (-1.5 / flow.kinematic_modulus) * back;
        const double sensible = 7800 * 500 * (theta - 320);
        energy = material::thermal_state(law, v, theta, 320.0).internal_energy - sensible;
      }
    // Of the sensible heat that is subtracted: 1e-16 × 2e8 against some 1e5.
    EXPECT_NEAR(stored, parallel::global_max(energy), 1e-9 * std::abs(stored));
  }
}

TEST(PlasticHeat, BothFormsDifferAtSecondOrderInTheStep) {
  for (const auto& [isotropic, kinematic] : k_kinds) {
    double difference[2];
    for (int k = 0; k < 2; ++k) {
      const double part = k == 0 ? 1.0 : 0.5;
      // small against the elastic strains, so that the turning of the stress is resolved
      Pulled p(material_of(isotropic, kinematic), Table({0, 1, 2}, {0, 1e-3, 1e-3 + 2e-5 * part}));
      Solved solved(p.body);
      solved.step(p.body, 2, 1);  // plastic from its start
      const auto end = p.uniform(320 + 0.2 * part);
      StructuralHeat entropy(*solved.phase, StructuralForm::entropy),
          energy(*solved.phase, StructuralForm::energy);
      difference[k] = total(residual(entropy, solved, end)) - total(residual(energy, solved, end));
    }
    EXPECT_NEAR(std::log2(difference[0] / difference[1]), 2, 0.2) << static_cast<int>(isotropic);
  }
}

}  // namespace
}  // namespace solidus
