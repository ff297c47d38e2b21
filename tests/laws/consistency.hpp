/// Checks that every law of isotropic hardening must pass, built in or added: its stress is the derivative of
/// its energy and its slope that of its stress, it answers alike on all number types, and the tangents of
/// both mappings are the derivatives of their stresses, by automatic differentiation.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "material/derivatives/isentropic_impl.hpp"

namespace solidus {

/// Functions of a number that the laws need besides exp and log.
inline Jet<double> sqrt(const Jet<double>& a) {
  const double root = std::sqrt(a.v);
  return Jet<double>::chain(a, {root, 0.5 / root, -0.25 / (root * a.v)});
}

}  // namespace solidus

namespace solidus::test {

/// The law of a material at one temperature.
inline void expect_consistent_potential(const material::Flow& flow, double temperature) {
  using J = Jet<double>;
  const material::HardeningLaw& law = hardening_law(flow.isotropic);
  const auto p = flow_properties_at(flow, temperature);
  const auto held = flow_properties_at(flow, J(temperature));
  const auto moving = flow_properties_at(flow, J::variable(temperature));
  const auto lanes = flow_properties_at(flow, Lane(temperature));
  material::FlowProperties<double> slopes{};
  slopes.hardening_origin = flow.flow_stress.derivative(temperature);
  for (std::size_t i = 0; i < material::k_hardening_parameters; ++i)
    slopes.hardening[i] = flow.hardening[i].derivative(temperature);
  EXPECT_EQ(law.energy(flow.curves, p, 0.0), 0);
  EXPECT_EQ(law.stress(flow.curves, p, 0.0).stress, 0);
  for (const double xi : {1e-6, 1e-4, 3e-3, 0.02, 0.3}) {
    const auto k = law.stress(flow.curves, p, xi);
    const auto along_strain = law.stress(flow.curves, held, J::variable(xi));
    const J energy = law.energy(flow.curves, held, J::variable(xi));
    const double size = k.slope * xi + 1e-9 * p.flow_stress;
    EXPECT_NEAR(energy.d, k.stress, 1e-9 * size) << law.name() << " at " << xi;
    EXPECT_NEAR(energy.dd, k.slope, 1e-9 * k.slope);
    EXPECT_NEAR(along_strain.stress.d, k.slope, 1e-12 * k.slope);
    EXPECT_GE(k.slope, 0);

    const J stored = law.energy(flow.curves, moving, J(xi)),
            stress = law.stress(flow.curves, moving, J(xi)).stress;
    const auto s = law.slopes(flow.curves, p, slopes, temperature, temperature, xi);
    EXPECT_NEAR(s.entropy, -stored.d, 1e-12 * std::abs(stored.d));
    EXPECT_NEAR(s.entropy_theta, -stored.dd, 1e-12 * std::abs(stored.dd) + 1e-20 * size);
    EXPECT_NEAR(s.stress, k.stress, 1e-12 * size);
    EXPECT_NEAR(s.stress_theta, stress.d, 1e-12 * std::abs(stress.d));
    EXPECT_NEAR(s.slope, k.slope, 1e-12 * k.slope);
    EXPECT_NEAR(law.stress(flow.curves, lanes, Lane(xi)).stress[3], k.stress, 1e-12 * size);
    EXPECT_NEAR(law.energy(flow.curves, lanes, Lane(xi))[5], energy.v, 1e-9 * size * xi);
  }
}

/// The largest difference of a tangent to the derivatives of the stress, in parts of 2G, the stress of one
/// component of strain after another carrying its derivative.
/// @param stress  of a strain of Jets
template <class Response, class Stress>
double tangent_error(const Response& r, const Sym<double>& strain, double twice_shear, Stress stress) {
  const auto tangent = full_tangent(r);
  double error = 0;
  for (int b = 0; b < 6; ++b) {
    Sym<Jet<double>> varied;
    for (int i = 0; i < 6; ++i) varied[i] = Jet<double>(strain[i]);
    varied[b].d = b < 3 ? 1.0 : 0.5;  // half an engineering strain
    const Sym<Jet<double>> s = stress(varied);
    for (int a = 0; a < 6; ++a)
      error = std::max(error, std::abs(tangent[a][static_cast<std::size_t>(b)] - s[a].d));
  }
  return error / twice_shear;
}

/// Both mappings.
/// @param start  the state at the start of the step
inline void expect_consistent_tangents(const material::Material& m, double temperature,
                                       const Sym<double>& strain,
                                       const material::Viscoplastic::State<double>& start = {}) {
  using J = Jet<double>;
  constexpr double k_start = 300, k_step = 0.1;
  const material::Isentropic law(m);
  const material::Viscoplastic& isothermal = law.isothermal();
  const auto p = isothermal.properties_at(temperature, k_start);
  const auto p_jet = isothermal.properties_at(J(temperature), J(k_start));
  material::Viscoplastic::State<J> start_jet;
  for (int i = 0; i < 6; ++i) {
    start_jet.viscous_strain[i] = J(start.viscous_strain[i]);
    start_jet.plastic_strain[i] = J(start.plastic_strain[i]);
    start_jet.back_strain[i] = J(start.back_strain[i]);
  }
  start_jet.hardening = J(start.hardening);
  const auto r = isothermal.update(p, start, strain, k_step);
  EXPECT_GT(r.flow_increment, 0);
  EXPECT_LT(
      tangent_error(r, strain, 2 * p.elastic.shear,
                    [&](const Sym<J>& e) { return isothermal.update(p_jet, start_jet, e, k_step).stress; }),
      1e-9);

  auto q = law.properties_at(temperature, k_start);
  q.entropy = law.entropy(q, Sym<double>{}, start);
  auto q_jet = law.properties_at(J(temperature), J(k_start));
  q_jet.entropy = J(q.entropy);
  const auto s = law.update(q, start, strain, k_step);
  EXPECT_EQ(s.status, material::Status::converged);
  EXPECT_NE(s.temperature, temperature);
  EXPECT_LT(tangent_error(s, strain, 2 * p.elastic.shear,
                          [&](const Sym<J>& e) { return law.update(q_jet, start_jet, e, k_step).stress; }),
            1e-9);
}

}  // namespace solidus::test
