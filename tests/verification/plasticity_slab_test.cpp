/// Weiner and Boley's slab: a shell that freezes from a cold wall and yields, against the similarity solution
/// of analytic/solidifying_slab.hpp. A strip of one row of elements; its long sides stay plane, so it shrinks
/// in the plane of the slab and does not bend:
///
///            ┌──┬──┬──┬──┬──┬──┬──┬──┐   ← plane, moves as a whole
///   1000 °C ▒│  │  │  │  │  │  │  │  │   free, insulated
///            └──┴──┴──┴──┴──┴──┴──┴──┘
///             symmetry
///
/// Data as in S. Koric, B. G. Thomas, Efficient thermo-mechanical model for solidification processes, Int. J.
/// Numer. Meth. Engng 66 (2006) 1955–1989.
#include <gtest/gtest.h>

#include "analytic/solidifying_slab.hpp"
#include "coupling/isothermal.hpp"
#include "plasticity_bodies.hpp"

namespace solidus {
namespace {

using analytic::SolidifyingSlab;
using mesh::Shape;
using test::Lattice;

SolidifyingSlab steel() {
  return SolidifyingSlab({.conductivity = 33,
                          .specific_heat = 661,
                          .latent = 272e3,
                          .density = 7500,
                          .wall = 1000 + k_zero_celsius,
                          .melting = 1494.4 + k_zero_celsius,
                          .young = 40e9,
                          .poisson = 0.35,
                          .expansion = 2e-5,
                          .wall_yield = 20e6});
}

// The similarity solution by itself.

TEST(WeinerBoley, SolutionIsContinuousCarriesNoForceAndFlowsTheWayItIsStressed) {
  const SolidifyingSlab slab = steel();
  EXPECT_NEAR(slab.lambda() * std::exp(slab.lambda() * slab.lambda()) * std::erf(slab.lambda()),
              661 * 494.4 / (272e3 * std::sqrt(std::numbers::pi)), 1e-12);
  EXPECT_NEAR(slab.stress_at(slab.compressed_up_to() + 1e-9), slab.stress_at(slab.compressed_up_to() - 1e-9),
              1.0);
  EXPECT_NEAR(slab.stress_at(slab.stretched_from() + 1e-9), slab.stress_at(slab.stretched_from() - 1e-9),
              1.0);
  EXPECT_EQ(slab.stress_at(0), -20e6);
  double force = 0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double xi = (i + 0.5) / n;
    force += slab.stress_at(xi) / n;
    EXPECT_LE(std::abs(slab.stress_at(xi)), slab.yield(xi) * (1 + 1e-9));
    EXPECT_GE(slab.flow_at(xi) * slab.stress_at(xi), -1e-6);  // dissipation, zero at ξ_2
  }
  EXPECT_NEAR(force, 0, 1e-3 * 20e6 / n * 10);  // the kinks at ξ_1 and ξ_2
}

// The problem marched in time on a fine grid, without the similarity: elastic step, cut at the yield stress,
// the strain that leaves no net force.
TEST(WeinerBoley, SolutionIsWhatMarchingInTimeFinds) {
  const SolidifyingSlab slab = steel();
  constexpr int n = 400, steps = 4000;
  const double end = 1, first = 1e-3, ratio = std::pow(end / first, 1.0 / steps);
  const double modulus = 40e9 / 0.65, length = slab.front(end);
  std::vector<double> stress(n, 0.0), temperature(n, slab.melting), cut(n);
  double last = 0;
  for (double t = first * ratio; t < end * 1.000001; t *= ratio) {
    std::vector<double> next(n);
    for (int i = 0; i < n; ++i)
      next[static_cast<std::size_t>(i)] = slab.temperature((i + 0.5) / n * length, t);
    const auto force = [&](double strain) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const double yield = slab.wall_yield * (slab.melting - next[i]) / (slab.melting - slab.wall);
        const double trial = stress[i] + modulus * (strain - slab.expansion * (next[i] - temperature[i]));
        cut[i] = std::clamp(trial, -yield, yield);
        sum += cut[i];
      }
      return sum;
    };
    double low = -1e-3, high = 1e-3;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (force(middle) < 0 ? low : high) = middle;
    }
    stress = cut;
    temperature = next;
    last = low;
  }
  double squares = 0;
  for (int i = 0; i < n; ++i) {
    const double error = stress[static_cast<std::size_t>(i)] - slab.stress((i + 0.5) / n * length, end);
    squares += error * error / n;
  }
  EXPECT_LT(std::sqrt(squares), 0.002e6);  // first order in the step, 0.17 % of the time
  EXPECT_NEAR(2 * last / std::log(ratio), slab.strain_constant(), 2e-3 * std::abs(slab.strain_constant()));
}

// The finite elements.

material::Material material_of(const SolidifyingSlab& slab) {
  material::Material m = verification::plastic_material(
      slab.young, slab.poisson, Table({slab.wall, slab.melting}, {slab.wall_yield, 0}), slab.expansion);
  m.density = slab.density;
  m.conductivity = slab.conductivity;
  m.specific_heat = slab.specific_heat;
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(slab.melting, slab.melting),
                      slab.latent, 0.0, true}};
  m.liquid_viscosity = 1e5;  // stresses of kPa in the melt at the rates of this slab
  return m;
}

struct Strip {
  mesh::Mesh mesh;
  AnalysisKind kind;
  mechanics::Conditions conditions;
  std::size_t depth;     ///< the coordinate away from the wall
  std::size_t in_plane;  ///< the stress component that is compared
};

constexpr double k_length = 0.03;
/// Melt at its freezing point itself would be half solid without yield stress: it could not bear any
/// deviator, and its shape would be left to rounding. A tenth of a kelvin is 0.02 % of the heat that freezing
/// takes.
constexpr double k_superheat = 0.1;

/// Hexahedra with the depth along x.
Strip solid(Shape shape, int n) {
  Strip s{
      test::make_mesh({.shape = shape, .cells = {n, 1, 1}, .size = {k_length, k_length / n, k_length / n}}),
      AnalysisKind::solid,
      {},
      0,
      1};
  s.conditions.displacements = {{"left", 0, 0.0}, {"bottom", 1, 0.0}, {"back", 2, 0.0}};
  s.conditions.plane_faces = {{"top"}, {"front"}};
  return s;
}
/// A round disc that freezes from below: the depth is the axis, the rim is the plane face.
Strip disc(int n) {
  Strip s{test::make_mesh({.shape = Shape::quad4, .cells = {1, n, 1}, .size = {k_length / n, k_length, 1}}),
          AnalysisKind::axisymmetric,
          {},
          1,
          0};
  s.conditions.displacements = {{"bottom", 1, 0.0}};
  s.conditions.plane_faces = {{"right"}};
  return s;
}

/// rms of the error over the shell at 5 and at 21 s [Pa], front error [m].
struct Result {
  double rms[2], front_error;
};

Result freeze(const Strip& strip, double dt, const std::string& table = {}) {
  const SolidifyingSlab slab = steel();
  const double start = slab.melting + k_superheat;
  const std::vector<material::Material> materials{material_of(slab)};
  const std::vector<double> initial(strip.mesh.x.size(), start);
  mechanics::MechanicsOptions options = test::strict();
  options.newton.tolerance = 1e-6;
  mechanics::MechanicalPhase mechanics(strip.mesh, strip.kind, materials, initial, strip.conditions, options);
  heat::Conditions thermal;
  thermal.temperatures.push_back({"wall", strip.depth == 0 ? "left" : "bottom", Table(slab.wall)});
  heat::HeatOptions heat_options;
  heat::ThermalPhase heat(strip.mesh, strip.kind, materials, thermal, heat_options);
  coupling::Phases phases;
  phases.heat = &heat;
  phases.mechanics = &mechanics;
  coupling::IsothermalSplit split(phases);

  coupling::State state;
  state.heat = heat.initial_state(std::vector<double>{start});
  state.mechanics = mechanics.initial_state();
  Result result{};
  const mesh::Block& block = strip.mesh.blocks[0];
  const auto compare = [&](double time) {
    auto out = table.empty() ? std::ofstream{}
                             : verification::table(table + "_" + std::to_string(std::lround(time)) + "s",
                                                   "distance[mm],exact_stress[MPa],stress[MPa]");
    const auto fields = mechanics.element_fields();
    double squares = 0;
    int n = 0;
    for (Index e = 0; e < block.size(); ++e) {
      const double x = verification::centre(strip.mesh, block, e)[strip.depth];
      const double stress = fields[0].stress[static_cast<std::size_t>(e)][strip.in_plane];
      const double exact = slab.stress(x, time);
      out << 1e3 * x << "," << 1e-6 * exact << "," << 1e-6 * stress << "\n";
      if (x > slab.front(time)) continue;
      squares += (stress - exact) * (stress - exact);
      ++n;
    }
    return std::sqrt(squares / n);
  };
  const int steps = static_cast<int>(std::lround(21 / dt));
  for (int i = 1; i <= steps; ++i) {
    coupling::State trial = state;
    trial.time = i * dt;
    split.advance(state, trial, trial.time, dt);
    state = std::move(trial);
    if (i == std::lround(5 / dt)) result.rms[0] = compare(5);
  }
  result.rms[1] = compare(21);
  result.front_error = k_length * heat.mean_solid_fraction(state.heat, 0) - slab.front(21);
  printf("%s, step %g s: rms %.3f MPa at 5 s, %.3f MPa at 21 s, front %.3f mm off\n",
         std::string(mesh::name(block.shape)).c_str(), dt, 1e-6 * result.rms[0], 1e-6 * result.rms[1],
         1e3 * result.front_error);
  return result;
}

TEST(WeinerBoley, StressProfilesAtFiveAndTwentyOneSecondsAreWithinHalfAMegapascal) {
  const Result result = freeze(solid(Shape::hex8, 150), 0.05, "plasticity_slab");
  EXPECT_LT(result.rms[0], 0.5e6);
  EXPECT_LT(result.rms[1], 0.5e6);
}

// Size of the elements and step are halved together. The mechanical phase sees the temperatures of the last
// step (isothermal split), and the front stands between two nodes: both of first order, which the stress,
// steep where it is elastic, shows.
TEST(WeinerBoley, ARoundDiscOfAxisymmetricElementsConvergesToTheProfiles) {
  auto out = verification::table("plasticity_slab_order", "h[mm],stress_at_5_s[MPa],stress_at_21_s[MPa]");
  std::vector<Result> results;
  for (const int n : {75, 150, 300}) {
    results.push_back(freeze(disc(n), 7.5 / n));
    out << 1e3 * k_length / n << "," << 1e-6 * results.back().rms[0] << "," << 1e-6 * results.back().rms[1]
        << "\n";
  }
  for (std::size_t at = 0; at < 2; ++at) {
    EXPECT_LT(results[1].rms[at], 0.5e6);
    EXPECT_GT(verification::order(results[0].rms[at], results[2].rms[at]) / 2, 0.7);
  }
}

}  // namespace
}  // namespace solidus
