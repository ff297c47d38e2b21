/// Stability of one step, with and without inertia: the step of the scheme itself as a map of the state at
/// t_n to that at t_{n+1}, linearised by differences about the wall of monograph 7.1 at rest at 593 K,
/// without pressure, its surroundings at 593 K too. Its eigenvalues against those of a program of its own,
/// which has exact derivatives (reference/README.md), and against the theory
/// (docs/theory/coupling_stability.md, 5).
#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <map>

#include "linear/dense.hpp"
#include "thick_cylinder.hpp"

namespace solidus {
namespace {

using mechanics::DynamicsOptions;
using mechanics::Mapping;
using mechanics::MassKind;
using mechanics::Motion;
using mechanics::StructuralForm;
using verification::Assembly;
using verification::Coupled;
using verification::cylinder;
using verification::Variant;

constexpr double k_rest = 593;           // [K]
constexpr double k_temperature = 1;      // of a disturbance [K]
constexpr double k_displacement = 1e-6;  // [m], about what 1 K expands the wall by
const std::vector<double> k_steps{1e-3, 1e-2, 0.1, 1, 10, 100, 1000, 2000};  // [s]

/// Tolerance of an eigenvalue: Θ̄ is found to 1e-8 K or better, the reference has nine digits.
constexpr double k_rounding = 1e-8;

struct Scheme {
  std::string name;
  Mapping mapping = Mapping::isentropic;
  StructuralForm form = StructuralForm::energy;
  heat::SensibleForm sensible = heat::SensibleForm::enthalpy;
  bool double_pass = false;
  bool iterated = false;
  std::string reference{};  ///< its name in the reference's table; empty: not there
};
const Scheme k_isentropic{.name = "isentropic", .reference = "isentropic_energy"};
const Scheme k_isentropic_entropy{
    .name = "isentropic_entropy", .form = StructuralForm::entropy, .reference = "isentropic_enthalpy"};
const Scheme k_isentropic_printed{.name = "isentropic_printed",
                                  .form = StructuralForm::entropy,
                                  .sensible = heat::SensibleForm::entropy,
                                  .reference = "isentropic_printed"};
const Scheme k_isothermal{
    .name = "isothermal", .mapping = Mapping::isothermal, .reference = "isothermal_energy"};
const Scheme k_isothermal_printed{.name = "isothermal_printed",
                                  .mapping = Mapping::isothermal,
                                  .form = StructuralForm::literal,
                                  .sensible = heat::SensibleForm::entropy,
                                  .reference = "isothermal"};
const Scheme k_simultaneous{
    .name = "simultaneous", .mapping = Mapping::simultaneous, .reference = "simultaneous_energy"};
const Scheme k_double_pass{.name = "double_pass", .double_pass = true};
const Scheme k_iterated{.name = "block_iterative", .iterated = true};

/// At rest with its surroundings.
Coupled wall(const Scheme& scheme, double expansion_factor, int quads) {
  Coupled c = cylinder({.mapping = scheme.mapping, .form = scheme.form, .sensible = scheme.sensible}, quads);
  c.materials = {verification::steel(expansion_factor, false)};
  c.mechanical.pressures.clear();
  for (heat::Film& film : c.thermal.films) film.ambient = k_rest;
  c.ambient.reset();
  c.double_pass = scheme.double_pass;
  if (scheme.iterated) c.iteration.emplace();
  return c;
}

/// Of the disturbances that are the same at the lower and the upper nodes: temperatures and radial
/// displacements, with inertia velocities times Δt and accelerations times Δt² as well. (The stress that some
/// integrators remember enters their work, which is of second order here.)
class StepMap {
 public:
  explicit StepMap(const Coupled& c) : assembly_(c, 1), dynamic_(c.dynamics.has_value()) {
    std::map<double, std::vector<std::size_t>> by_radius;
    for (std::size_t n = 0; n < c.mesh.x.size(); ++n)
      by_radius[std::round(c.mesh.x[n][0] * 1e9)].push_back(n);
    for (const auto& entry : by_radius) places_.push_back(entry.second);
  }

  linear::dense::Matrix matrix(double dt) {
    linear::dense::Matrix m(size(), size());
    for (std::size_t i = 0; i < size(); ++i) {
      // fourth order: the curvature of the entropy in the temperature would be seen otherwise
      const auto ahead = step(i, 1, dt), back = step(i, -1, dt), far_ahead = step(i, 2, dt),
                 far_back = step(i, -2, dt);
      for (std::size_t j = 0; j < size(); ++j)
        m(j, i) = (8 * (ahead[j] - back[j]) - (far_ahead[j] - far_back[j])) / 12;
    }
    return m;
  }

 private:
  std::size_t size() const { return places_.size() * (dynamic_ ? 4 : 2); }

  /// Every field with its scale, in the order of the state vector; axial components stay zero.
  template <class State, class Visit>
  void for_each_number(State& state, double dt, const Visit& visit) const {
    std::size_t i = 0;
    auto& m = state.mechanics;
    for (const auto& nodes : places_) visit(i++, state.heat.temperature, nodes, 1, k_temperature);
    for (const auto& nodes : places_) visit(i++, m.displacement, nodes, 2, k_displacement);
    if (!dynamic_) return;
    for (const auto& nodes : places_) visit(i++, m.velocity, nodes, 2, k_displacement / dt);
    for (const auto& nodes : places_) visit(i++, m.acceleration, nodes, 2, k_displacement / (dt * dt));
  }

  /// The state a step later where one of its numbers was disturbed.
  std::vector<double> step(std::size_t number, double disturbance, double dt) {
    coupling::State old = assembly_.start();
    for_each_number(old, dt, [&](auto i, auto& field, const auto& nodes, std::size_t stride, double scale) {
      for (const std::size_t n : nodes)
        if (i == number) field[n * stride] += scale * disturbance;
    });
    old.heat = assembly_.heat().states().initial_at_nodes(old.heat.temperature);
    coupling::State trial = old;
    assembly_.scheme().synchronise(old);
    assembly_.scheme().advance(old, trial, dt, dt);
    std::vector<double> after(size());
    for_each_number(trial, dt, [&](auto i, auto& field, const auto& nodes, std::size_t stride, double scale) {
      const double rest = stride == 1 ? k_rest : 0;
      after[i] = (field[nodes.front() * stride] - rest) / scale;
    });
    return after;
  }

  Assembly assembly_;
  bool dynamic_;
  std::vector<std::vector<std::size_t>> places_;  ///< the nodes of every radius
};

using Values = std::vector<std::complex<double>>;

Values eigenvalues(const linear::dense::Matrix& matrix) {
  return linear::dense::eigensystem(matrix.all()).values;
}
Values eigenvalues(const Coupled& c, double dt) {
  return eigenvalues(StepMap(c).matrix(dt));
}
double radius(const Values& values) {
  double largest = 0;
  for (const auto& value : values) largest = std::max(largest, std::abs(value));
  return largest;
}
double least_real_part(const Values& values) {
  double least = values.front().real();
  for (const auto& value : values) least = std::min(least, value.real());
  return least;
}

/// The number that follows `start` in a table of the reference.
double reference(const std::string& table, const std::string& start) {
  std::ifstream file(SOLIDUS_SOURCE_DIR "/tests/verification/reference/" + table + ".csv");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(start, 0) == 0) return std::stod(line.substr(start.size()));
  ADD_FAILURE() << "no line " << start << " in " << table;
  return 0;
}
std::string text(double number) {
  std::ostringstream out;
  out << number;
  return out.str();
}

constexpr int k_quads = 10;  // the reference has 50

TEST(SpectralRadius, OfOneStepIsBelowOneButForTheIsothermalSplitUnderStrongCoupling) {
  auto all = verification::table("coupling_spectral_radius_schemes",
                                 "scheme,expansion_factor,step[s],radius,one_minus_radius,reference");
  std::map<std::string, std::vector<double>> curves;
  for (const Scheme& scheme : {k_isentropic, k_isentropic_entropy, k_isentropic_printed, k_isothermal,
                               k_isothermal_printed, k_simultaneous, k_double_pass})
    for (const int factor : {1, 3, 6}) {
      const Coupled c = wall(scheme, factor, k_quads);
      StepMap map(c);
      const bool alternates = scheme.mapping == Mapping::isothermal && factor == 6;
      for (const double dt : k_steps) {
        SCOPED_TRACE(scheme.name + " " + std::to_string(factor) + " " + text(dt));
        const double r = radius(eigenvalues(map.matrix(dt)));
        curves[scheme.name + std::to_string(factor)].push_back(r);
        double there = std::nan("");
        if (!scheme.reference.empty()) {
          there = reference("spectral_radius",
                            scheme.reference + "," + std::to_string(factor) + "," + text(dt) + ",");
          // A fifth of the reference's elements: 1 − r, the decay of the slowest mode, to half a percent; the
          // modes that alternate are shorter and feel it more.
          const double mesh = 5e-3 * std::abs(1 - there) + (alternates ? 2e-3 : 0);
          EXPECT_NEAR(r, there, mesh + k_rounding);
        }
        if (alternates) {
          EXPECT_EQ(r > 1, dt < 2000);
        } else {
          EXPECT_LT(r, 1);
        }
        all << scheme.name << "," << factor << "," << dt << "," << r << "," << 1 - r << "," << there << "\n";
      }
    }
  auto out = verification::table("coupling_spectral_radius",
                                 "step[s],isothermal_α,isothermal_3α,isothermal_6α,isentropic_6α,"
                                 "simultaneous_6α,double_pass_6α");
  for (std::size_t i = 0; i < k_steps.size(); ++i) {
    out << k_steps[i];
    for (const char* curve :
         {"isothermal1", "isothermal3", "isothermal6", "isentropic6", "simultaneous6", "double_pass6"})
      out << "," << curves.at(curve)[i];
    out << "\n";
  }
}

TEST(SpectralRadius, OfTheIsothermalSplitIsTheReferencesOnItsMesh) {
  const Values values = eigenvalues(wall(k_isothermal, 6, 50), 10);
  EXPECT_NEAR(radius(values), reference("spectral_radius", "isothermal_energy,6,10,"), 1e-6);
  EXPECT_NEAR(least_real_part(values), -radius(values), k_rounding);  // it alternates
}

TEST(SpectralRadius, OfTheIsothermalSplitPassesOneAtTheThresholdOfTheCouplingNumber) {
  auto out = verification::table("coupling_threshold", "step[s],threshold_on_alpha,reference");
  for (const double dt : {1e-3, 1.0, 10.0, 50.0}) {
    double low = 4, high = 5;
    while (high - low > 1e-4) {
      const double middle = 0.5 * (low + high);
      const double worst = least_real_part(eigenvalues(wall(k_isothermal, middle, k_quads), dt));
      (worst > -1 ? low : high) = middle;
    }
    const double there = reference("threshold", "isothermal_energy," + text(dt) + ",0.04002332,0.056032648,");
    EXPECT_NEAR(low, there, 2e-3) << dt;
    out << dt << "," << low << "," << there << "\n";
  }
}

TEST(SpectralRadius, OfConvergedBlockIterationsIsTheSimultaneousSchemes) {
  // iterations end at 1e-8 of the step's change
  constexpr double k_agreement = 1e-6;
  for (const int factor : {1, 6})
    for (const double dt : {1.0, 100.0, 2000.0})
      EXPECT_NEAR(radius(eigenvalues(wall(k_iterated, factor, k_quads), dt)),
                  radius(eigenvalues(wall(k_simultaneous, factor, k_quads), dt)), k_agreement)
          << factor << " " << dt;
}

TEST(SpectralRadius, WithInertiaIsTheReferencesForEveryIntegrator) {
  constexpr double dt = 2e-6;      // [s]
  constexpr int quads = 50;        // the highest frequencies matter, and they are the mesh's
  constexpr double k_same = 1e-6;  // the reference's derivatives are exact
  auto out =
      verification::table("coupling_dynamic_radius", "integrator,scheme,expansion_factor,radius,reference");
  const std::map<std::string, Motion> integrators{{"be", Motion::backward_euler()},
                                                  {"newmark", Motion::newmark(0.6, 0.3025)},
                                                  {"trapezoidal", Motion::trapezoidal()}};
  for (const auto& [integrator, motion] : integrators)
    for (const Scheme& scheme : {k_isentropic, k_isothermal})
      for (const int factor : {1, 3, 6}) {
        if (scheme.mapping == Mapping::isentropic && factor == 3) continue;
        Coupled c = wall(scheme, factor, quads);
        c.dynamics = DynamicsOptions{MassKind::consistent, motion, {}};
        const double r = radius(eigenvalues(c, dt));
        const std::string name = scheme.mapping == Mapping::isothermal ? "isothermal" : scheme.reference;
        const double there =
            reference("dynamic_radius", integrator + "," + name + "," + std::to_string(factor) + ",2e-06,");
        EXPECT_NEAR(r, there, k_same) << integrator << " " << scheme.name << " " << factor;
        out << integrator << "," << scheme.name << "," << factor << "," << r << "," << there << "\n";
      }
}

}  // namespace
}  // namespace solidus
