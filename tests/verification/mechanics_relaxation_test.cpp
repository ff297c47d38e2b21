/// A Maxwell body in the mushy zone (2.50, 2.104): spring 2G/f_S in series with a dashpot η/λ, λ = 1 − f_S.
///
///   relaxation, strain γ held from t = 0:   s = (2G/f_S) γ exp(−t/τ),   τ = η f_S/(2G λ)
///   flow, strain rate γ̇ from t = 0:         s = (η/λ) γ̇ (1 − exp(−t/τ))
///
/// Backward Euler is exact in s_n = s_0 (1 + Δt/τ)^−n and of first order in Δt against the exponential. All
/// that the spring held is dissipated in the end.
#include <gtest/gtest.h>

#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Solved;

constexpr double k_fraction = 0.5, k_lambda = 0.5, k_eta = 5e10;  // [1], [1], [Pa s]
constexpr double k_shear = 2e11 / 2.6, k_gamma = 1e-3;            // [Pa], ε_xy
constexpr double k_tau = k_eta * k_fraction / (2 * k_shear * k_lambda);

/// A distorted square at a temperature with f_S = 1/2, sheared through its boundary: ε_xy(t).
Body mush(bool b_bar, const Table& shear) {
  material::Material m = test::elastic_material(2e11, 0.3);
  m.phase_changes.push_back(
      {.name = "freezing", .fraction = material::PhaseFraction::linear(390, 410), .solidification = true});
  m.liquid_viscosity = k_eta;
  Body body({.shape = Shape::quad4, .cells = {3, 3, 1}, .distortion = 0.15}, AnalysisKind::plane_strain, m);
  body.options.b_bar = b_bar;
  body.initial_temperature.assign(body.mesh.x.size(), 400.0);
  body.temperature = body.initial_temperature;
  for (const auto& [name, nodes] : body.mesh.node_sets) {
    if (name.rfind("node ", 0) != 0) continue;
    mesh::Point x{-1e300, -1e300, 0};
    bool boundary = false;
    for (const Index node : nodes) {
      x = body.mesh.x[static_cast<std::size_t>(node)];
      boundary = boundary || body.on_boundary(node);
    }
    if (!parallel::any_process(boundary)) continue;
    body.hold(name, 0, shear.scaled(parallel::global_max(x[1])));
    body.hold(name, 1, shear.scaled(parallel::global_max(x[0])));
  }
  return body;
}

/// σ_xy at the end of every step; every element must agree with the first.
struct History {
  std::vector<double> stress, dissipation, internal;
};
History march(const Body& body, double dt, int steps) {
  const auto phase = body.phase();
  mechanics::MechanicalState state = phase->initial_state();
  History h;
  for (int n = 1; n <= steps; ++n) {
    const mechanics::MechanicalState old = state;
    const mechanics::MechanicalReport report = phase->solve(old, state, body.temperature, n * dt, dt);
    double sum = 0, count = 0;
    for (const auto& fields : test::element_fields(phase->mesh(), state))
      for (const auto& stress : fields.stress) {
        sum += stress[3];
        count += 1;
      }
    const double mean = parallel::global_sum(sum) / parallel::global_sum(count);
    for (const auto& fields : test::element_fields(phase->mesh(), state))
      for (const auto& stress : fields.stress) EXPECT_NEAR(stress[3], mean, 1e-9 * std::abs(mean));
    h.stress.push_back(mean);
    h.dissipation.push_back(report.work.dissipation);
    h.internal.push_back(report.work.internal_work);
  }
  return h;
}

double sum(const std::vector<double>& values) {
  double s = 0;
  for (double v : values) s += v;
  return s;
}

const double k_first_stress = 2 * k_shear / k_fraction * k_gamma;

TEST(MaxwellRelaxation, EqualsBackwardEulersOwnClosedForm) {
  const double dt = 0.8 * k_tau;
  for (bool b_bar : {false, true}) {
    const History h = march(mush(b_bar, k_gamma), dt, 6);
    for (int n = 1; n <= 6; ++n) {
      const double exact = k_first_stress / std::pow(1 + dt / k_tau, n);
      const auto i = static_cast<std::size_t>(n - 1);
      EXPECT_NEAR(h.stress[i], exact, 1e-9 * exact);
      // the body is of unit volume: D = λ/η s:s with s:s = 2 σ_xy²
      EXPECT_NEAR(h.dissipation[i], dt * k_lambda / k_eta * 2 * exact * exact, 1e-8 * h.dissipation[i]);
    }
    EXPECT_GT(sum(h.internal), sum(h.dissipation));  // some is still stored
  }
}

TEST(MaxwellRelaxation, ConvergesToTheExponentialAtFirstOrderInTheStep) {
  const Body body = mush(true, k_gamma);
  std::vector<History> runs;
  std::vector<double> errors, energy_errors;
  const double stored = k_gamma * k_first_stress;  // ½ s : ε per volume, s:ε = 2 σ_xy ε_xy
  for (int parts : {2, 4, 8, 16}) {
    const double dt = k_tau / parts;
    runs.push_back(march(body, dt, 8 * parts));
    double worst = 0;
    for (std::size_t i = 0; i < runs.back().stress.size(); ++i) {
      const double t = static_cast<double>(i + 1) * dt;
      worst = std::max(worst, std::abs(runs.back().stress[i] / k_first_stress - std::exp(-t / k_tau)));
    }
    errors.push_back(worst);
    energy_errors.push_back(std::abs(sum(runs.back().dissipation) / stored - 1));
  }
  auto rates =
      verification::table("mechanics_relaxation_order", "step / relaxation time,stress,dissipated_energy");
  for (std::size_t i = 0; i < errors.size(); ++i) {
    rates << 0.5 / (1 << i) << "," << errors[i] << "," << energy_errors[i] << "\n";
    if (i == 0) continue;
    EXPECT_NEAR(verification::order(errors[i - 1], errors[i]), 1, 0.15);
    EXPECT_NEAR(verification::order(energy_errors[i - 1], energy_errors[i]), 1, 0.25);
  }
  auto curve = verification::table(
      "mechanics_relaxation",
      "time / relaxation time,exact_stress[MPa],step_tau/2[MPa],step_tau/4[MPa],step_tau/16[MPa]");
  for (std::size_t row = 0; row < 8; ++row) {
    const double t = 0.5 * static_cast<double>(row + 1);
    curve << t << "," << 1e-6 * k_first_stress * std::exp(-t);
    for (std::size_t run : {0u, 1u, 3u}) curve << "," << 1e-6 * runs[run].stress[((row + 1) << run) - 1];
    curve << "\n";
  }
}

TEST(MaxwellFlow, TendsToTheStressOfTheDashpotAtFirstOrderInTheStep) {
  const double rate = k_gamma / k_tau;
  const Body body = mush(true, Table({0, 100 * k_tau}, {0, 100 * k_gamma}));
  std::vector<double> errors;
  for (int parts : {4, 8, 16}) {
    const double dt = k_tau / parts;
    const History h = march(body, dt, 10 * parts);
    double worst = 0;
    for (std::size_t i = 0; i < h.stress.size(); ++i) {
      const double t = static_cast<double>(i + 1) * dt;
      worst = std::max(worst, std::abs(h.stress[i] / (k_eta / k_lambda * rate) - (1 - std::exp(-t / k_tau))));
    }
    errors.push_back(worst);
    // steady flow after ten relaxation times
    EXPECT_NEAR(h.stress.back(), k_eta / k_lambda * rate, 1e-3 * k_eta / k_lambda * rate);
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(verification::order(errors[i - 1], errors[i]), 1, 0.15);
}

}  // namespace
}  // namespace solidus
