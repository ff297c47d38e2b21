/// The wall of monograph 7.1 with inertia, 250 steps of 2 µs, pressure at once, against a program of its own
/// (reference/dynamics.py).
#include <gtest/gtest.h>

#include <map>

#include "thick_cylinder.hpp"

namespace solidus {
namespace {

using mechanics::DynamicsOptions;
using mechanics::Mapping;
using mechanics::MassKind;
using mechanics::Motion;
using verification::Coupled;
using verification::CoupledRun;
using verification::Surfaces;
using verification::Variant;

constexpr double k_step = 2e-6;  // [s]
constexpr int k_steps = 250;

const std::map<std::string, Motion> k_integrators = {{"be", Motion::backward_euler()},
                                                     {"newmark", Motion::newmark(0.6, 0.3025)},
                                                     {"trapezoidal", Motion::trapezoidal()}};

/// The steps of the reference's table that went through.
std::map<int, Surfaces> moving_reference(const std::string& run) {
  std::ifstream file(SOLIDUS_SOURCE_DIR "/tests/verification/reference/dynamic_histories.csv");
  std::map<int, Surfaces> steps;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(run, 0) != 0) continue;
    std::istringstream rest(line.substr(run.size()));
    std::string step, status;
    std::getline(rest, step, ',');
    std::getline(rest, status, ',');
    if (status != "ok") continue;
    Surfaces& s = steps[std::stoi(step)];
    char comma = 0;
    rest >> s.u[0] >> comma >> s.u[1] >> comma >> s.temperature[0] >> comma >> s.temperature[1];
  }
  EXPECT_FALSE(steps.empty()) << run;
  return steps;
}

struct Tolerance {
  double u, temperature;  ///< [mm], [K]
};

void expect_reference(const Variant& v, const std::string& integrator, const std::string& scheme,
                      const Tolerance& tolerance, std::ofstream& out) {
  const std::string run = std::string(v.plastic ? "tp," : "te,") + std::to_string(v.expansion_factor) + "," +
                          integrator + "," + scheme + ",";
  SCOPED_TRACE(run);
  const std::map<int, Surfaces> there = moving_reference(run);
  Coupled c = verification::cylinder(v);
  c.dynamics = DynamicsOptions{MassKind::consistent, k_integrators.at(integrator), {}};
  c.ambient = 293;
  Tolerance worst{0, 0};
  int step = 0;
  const CoupledRun here =
      verification::march(c, k_step * k_steps, k_steps, [&](const coupling::State& state) {
        const auto found = there.find(++step);
        if (found == there.end()) return;
        const Surfaces s = verification::surfaces(c.mesh, state);
        for (std::size_t i = 0; i < 2; ++i) {
          EXPECT_NEAR(s.u[i], found->second.u[i], tolerance.u) << step;
          EXPECT_NEAR(s.temperature[i], found->second.temperature[i], tolerance.temperature) << step;
          worst.u = std::max(worst.u, std::abs(s.u[i] - found->second.u[i]));
          worst.temperature =
              std::max(worst.temperature, std::abs(s.temperature[i] - found->second.temperature[i]));
        }
      });
  double energy = here.exchanged();
  for (const auto& audit : here.steps) energy += std::abs(audit.kinetic);
  out << run << worst.u << "," << worst.temperature << "," << here.worst_defect() / energy << "\n";
  if (v.form != mechanics::StructuralForm::energy) return;
  EXPECT_LT(here.worst_defect(), 1e-8 * energy);
  // Proved for backward Euler; the reference finds it with the mean stress of the others too.
  for (const auto& stability : here.stability) EXPECT_LE(stability.increment(), stability.tolerance);
}

constexpr Tolerance k_digits{1e-8, 1e-5};  // nine digits are in the table
constexpr const char* k_columns =
    "law,expansion_factor,integrator,scheme,u[mm],T[K],first_law[energy exchanged]";

TEST(IsentropicSplit, GivesTheReferenceWithInertiaForEveryIntegratorAndCoupling) {
  auto out = verification::table("dynamics_thick_cylinder_isentropic", k_columns);
  for (const auto& [integrator, motion] : k_integrators)
    for (const int factor : {1, 3, 6}) {
      expect_reference({.expansion_factor = factor}, integrator, "isentropic_energy", k_digits, out);
      expect_reference(
          {.plastic = true, .expansion_factor = factor, .flow = coupling::ThermalFlow::restarted}, integrator,
          "isentropic_energy", k_digits, out);
    }
}

TEST(SimultaneousScheme, GivesTheReferenceWithInertiaForEveryIntegratorAndCoupling) {
  auto out = verification::table("dynamics_thick_cylinder_simultaneous", k_columns);
  for (const auto& [integrator, motion] : k_integrators)
    for (const int factor : {1, 6})
      expect_reference({.expansion_factor = factor, .mapping = Mapping::simultaneous}, integrator,
                       "simultaneous_energy", k_digits, out);
}

TEST(IsothermalSplit, GivesTheReferenceWithInertiaAsFarAsItIsStable) {
  auto out = verification::table("dynamics_thick_cylinder_isothermal", k_columns);
  for (const char* integrator : {"be", "newmark"})
    expect_reference({.mapping = Mapping::isothermal,
                      .form = mechanics::StructuralForm::literal,
                      .sensible = heat::SensibleForm::entropy},
                     integrator, "isothermal", k_digits, out);
}

}  // namespace
}  // namespace solidus
