/// Weiner and Boley's slab in finite elements: a shell that freezes from a cold wall and yields. A strip of
/// one row of elements; its long sides stay plane, so it shrinks in the plane of the slab and does not bend:
///
///            ┌──┬──┬──┬──┬──┬──┬──┬──┐   ← plane, moves as a whole
///   1000 °C ▒│  │  │  │  │  │  │  │  │   free, insulated
///            └──┴──┴──┴──┴──┴──┴──┴──┘
///             symmetry
///
/// Data as in S. Koric, B. G. Thomas, Efficient thermo-mechanical model for solidification processes, Int. J.
/// Numer. Meth. Engng 66 (2006) 1955–1989.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "analytic/solidifying_slab.hpp"
#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "plasticity_bodies.hpp"

namespace solidus::verification {

inline analytic::SolidifyingSlab steel() {
  return analytic::SolidifyingSlab({.conductivity = 33,
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

inline material::Material material_of(const analytic::SolidifyingSlab& slab) {
  material::Material m = plastic_material(
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
  mechanics::MechanicalConditions conditions;
  std::size_t depth;     ///< the coordinate away from the wall
  std::size_t in_plane;  ///< the stress component that is compared
};

inline constexpr double k_length = 0.03;
/// Melt at its freezing point itself would be half solid without yield stress: it could not bear any
/// deviator, and its shape would be left to rounding. A tenth of a kelvin is 0.02 % of the heat that freezing
/// takes.
inline constexpr double k_superheat = 0.1;

/// Hexahedra with the depth along x.
inline Strip solid(mesh::Shape shape, int n) {
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
inline Strip disc(int n) {
  Strip s{
      test::make_mesh({.shape = mesh::Shape::quad4, .cells = {1, n, 1}, .size = {k_length / n, k_length, 1}}),
      AnalysisKind::axisymmetric,
      {},
      1,
      0};
  s.conditions.displacements = {{"bottom", 1, 0.0}};
  s.conditions.plane_faces = {{"right"}};
  return s;
}

/// How a slab is computed.
struct SlabRun {
  material::Material material;
  double dt;          ///< [s]
  std::string table;  ///< of the profiles; empty: none
  mechanics::Mapping mapping = mechanics::Mapping::isothermal;
  std::optional<mechanics::StructuralForm> form{};  ///< absent: deformation exchanges nothing with heat
  std::function<std::unique_ptr<coupling::CouplingScheme>(coupling::Phases)> scheme{};
};

struct SlabResult {
  double rms[2];       ///< of the error of the stress over the shell at 5 and at 21 s [Pa]
  double front_error;  ///< at 21 s [m]
  int iterations;      ///< between the phases, all steps
  int cuts;            ///< how often a step was halved
  double rise;         ///< of 𝓛 beyond its rounding, the largest of a step; Θ_a is the wall's [J]
};

inline SlabResult freeze(const Strip& strip, const SlabRun& run) {
  const analytic::SolidifyingSlab slab = steel();
  const double start = slab.melting + k_superheat;
  const std::vector<material::Material> materials{run.material};
  const std::vector<double> initial(strip.mesh.x.size(), start);
  mechanics::MechanicsOptions options = test::strict();
  options.newton.tolerance = 1e-6;
  options.mapping = run.mapping;
  mechanics::MechanicalPhase mechanics(strip.mesh, strip.kind, materials, initial, strip.conditions, options);
  std::optional<mechanics::StructuralHeat> structural;
  std::vector<linear::Contribution*> stored;
  if (run.form) stored.push_back(&structural.emplace(mechanics, *run.form));
  heat::ThermalConditions thermal;
  thermal.temperatures.push_back({"wall", strip.depth == 0 ? "left" : "bottom", Table(slab.wall)});
  heat::ThermalPhase heat(strip.mesh, strip.kind, materials, thermal, {}, stored);
  coupling::Phases phases;
  phases.heat = &heat;
  phases.mechanics = &mechanics;
  phases.structural = structural ? &*structural : nullptr;
  if (run.form) phases.ambient_temperature = slab.wall;
  const auto scheme = run.scheme(phases);

  coupling::State state;
  state.heat = heat.states().initial(std::vector<double>{start});
  state.mechanics = mechanics.initial_state();
  scheme->synchronise(state);
  SlabResult result{};
  const mesh::ElementBlock& block = strip.mesh.blocks[0];
  const auto compare = [&](double time) {
    auto out = run.table.empty() ? std::ofstream{}
                                 : table(run.table + "_" + std::to_string(std::lround(time)) + "s",
                                         "distance[mm],exact_stress[MPa],stress[MPa]");
    const auto fields = test::element_fields(strip.mesh, state.mechanics);
    double squares = 0;
    int n = 0;
    for (Index e = 0; e < block.size(); ++e) {
      const double x = centre(strip.mesh, block, e)[strip.depth];
      const double stress = fields[0].stress[static_cast<std::size_t>(e)][strip.in_plane];
      const double exact = slab.stress(x, time);
      out << 1e3 * x << "," << 1e-6 * exact << "," << 1e-6 * stress << "\n";
      if (x > slab.front(time)) continue;
      squares += (stress - exact) * (stress - exact);
      ++n;
    }
    return std::sqrt(squares / n);
  };
  // As a run does: what does not converge is done in two halves. Perfectly plastic metal at its freezing
  // point turns rounding into other iterates; at fewer than one step in a hundred of the simultaneous scheme
  // they end.
  const std::function<void(double, int)> advance = [&](double dt, int cuts) {
    coupling::State trial = state;
    trial.time = state.time + dt;
    coupling::StepEffort effort;
    try {
      effort = scheme->advance(state, trial, trial.time, dt);
    } catch (const StepRejected&) {
      if (cuts == 3) throw;
      ++result.cuts;
      advance(0.5 * dt, cuts + 1);
      advance(0.5 * dt, cuts + 1);
      return;
    }
    result.iterations += effort.coupling_iterations;
    result.rise = std::max(result.rise, effort.stability.increment() - effort.stability.tolerance);
    state = std::move(trial);
  };
  const int steps = static_cast<int>(std::lround(21 / run.dt));
  for (int i = 1; i <= steps; ++i) {
    advance(run.dt, 0);
    if (i == std::lround(5 / run.dt)) result.rms[0] = compare(5);
  }
  result.rms[1] = compare(21);
  result.front_error = k_length * heat.states().mean_solid_fraction(state.heat, 0) - slab.front(21);
  printf("%s, step %g s: rms %.3f MPa at 5 s, %.3f MPa at 21 s, front %.3f mm off\n",
         std::string(mesh::name(block.shape)).c_str(), run.dt, 1e-6 * result.rms[0], 1e-6 * result.rms[1],
         1e3 * result.front_error);
  return result;
}

}  // namespace solidus::verification
