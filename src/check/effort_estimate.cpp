// Estimates the effort of a run. The figures are those of one core of a server of 2020, measured on the
// project's cases (docs/guide/findings.md); another machine differs by its speed.

#include <algorithm>
#include <cmath>

#include "cases/stage_input.hpp"
#include "check/case_measures.hpp"
#include "setup/body_input.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/time_input.hpp"
#include "system/processes.hpp"

namespace solidus::check {

namespace {

/// By node: of a step [s], and of memory [bytes].
struct Cost {
  double heat, mechanics, heat_bytes, mechanics_bytes;
};
constexpr Cost k_plane{2.2e-6, 6e-6, 0.7e3, 5.5e3};
constexpr Cost k_solid_direct{6e-6, 80e-6, 1.2e3, 65e3};
constexpr Cost k_solid_iterative{6e-6, 150e-6, 1.2e3, 48e3};

Cost cost(const cases::CaseSpec& spec, double nodes_of_mechanics) {
  if (spec.analysis.kind != AnalysisKind::solid) return k_plane;
  constexpr double k_direct_unknowns = 50000;  // from which on the costs of an iteration were measured
  const bool direct =
      spec.mechanics.solver == linear::SolverKind::direct ||
      (spec.mechanics.solver == linear::SolverKind::automatic && 3 * nodes_of_mechanics < k_direct_unknowns);
  return direct ? k_solid_direct : k_solid_iterative;
}

/// The work of a scheme in a step, relative to one pass of each phase.
double passes(const cases::CaseSpec& spec) {
  return spec.coupled() ? spec.coupling.scheme->traits().effort : 1;
}

double fixed_steps(const cases::CaseSpec& spec, const setup::Assembly& a) {
  if (a.stages.empty()) return std::ceil(*spec.time.end / *spec.time.step - 1e-9);
  double steps = 0;
  for (const cases::StageRun& run : a.stages)
    steps += std::ceil(run.stage->duration / cases::first_step(*run.stage, spec.time) - 1e-9);
  return steps;
}

/// What the run passes through [K]: from the warmest start to the coldest one or surrounding.
double range_of_temperature(const cases::CaseSpec& spec, const setup::Assembly& a) {
  double high = 0, low = 1e300;
  for (const setup::InitialTemperatureRange& r : a.start)
    high = std::max(high, r.high), low = std::min(low, r.low);
  using Kind = cases::ThermalConditionSpec::Kind;
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    const Function& f = c.kind == Kind::temperature ? c.temperature : c.ambient;
    if ((c.kind == Kind::temperature || c.kind == Kind::film || c.kind == Kind::radiation) &&
        f.place == nullptr)
      low = std::min(low, f.table.min_value()), high = std::max(high, f.table.max_value());
  }
  return std::max(0.0, high - low);
}

/// Whether everything around what is poured takes heat as sand does: its effusivity √(k ρ c) is less than a
/// fifth of that of the metal.
bool in_sand(const setup::Assembly& a, const CaseMeasures& m) {
  constexpr double k_share = 0.2;
  const auto effusivity = [&](std::size_t body) {
    const material::Material& of = a.materials[body];
    const double at = a.start[body].low;
    return std::sqrt(of.conductivity.value(at) * of.density * of.specific_heat.value(at));
  };
  double metal = 1e300, around = 0;
  for (std::size_t b = 0; b < a.materials.size(); ++b)
    if (m.is_poured(b))
      metal = std::min(metal, effusivity(b));
    else
      around = std::max(around, effusivity(b));
  return around < k_share * metal;
}

/// Whether graphite precipitates in what is poured: the last melt then takes more steps (decision 0090).
bool precipitates_graphite(const setup::Assembly& a, const CaseMeasures& m) {
  for (std::size_t b = 0; b < a.materials.size(); ++b)
    for (const material::PhaseChange& change : a.materials[b].phase_changes)
      if (m.is_poured(b) && change.graphite) return true;
  return false;
}

/// Errors go with the square of a step, so that steps go with the root of what the run passes through over
/// the error allowed: measured 6 to 10 times that with heat alone. Castings that deform take 2 to 6.7 times
/// that until they are solid, in sand 0.4, because their temperatures are even, and besides steps in which a
/// skin lets go and in which the last melt freezes (twenty castings, decision 0075).
double adaptive_steps(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m) {
  constexpr double k_of_heat = 7.5, k_of_casting = 5, k_until_solid = 4, k_in_sand = 0.4;
  constexpr double k_of_skin = 1.1, k_last_melt = 15, k_last_melt_with_graphite = 25, k_least = 20;
  const double error = spec.time.temperature_error.value_or(1.0);
  const double n_stages = std::max(1.0, static_cast<double>(a.stages.size()));
  const double root = std::sqrt(range_of_temperature(spec, a) / error);
  double steps = 5 * k_least;
  if (spec.has_heat() && spec.has_mechanics() && !m.pours.empty()) {
    const bool solid = spec.time.until == cases::TimeSpec::Until::solid;
    const double of_root = !solid ? k_of_casting : in_sand(a, m) ? k_in_sand : k_until_solid;
    const std::vector<double> sections =
        spec.time.displacement_error ? setup::sections_of(spec, a.mesh) : std::vector<double>{};
    steps = of_root * root + k_of_skin / setup::skin_change(spec.time, sections) +
            (precipitates_graphite(a, m) ? k_last_melt_with_graphite : k_last_melt) *
                std::sqrt(coupling::StepLimits{}.temperature / error);
  } else if (spec.has_heat()) {
    steps = k_of_heat * root;
  }
  steps = std::max(steps, k_least * n_stages);
  if (spec.time.max_step) steps = std::max(steps, *spec.time.end / *spec.time.max_step);
  return steps;
}

}  // namespace

Effort estimate_effort(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m) {
  Effort effort;
  // Steady runs are one solution; adaptive steps are guessed, and said to be.
  if (spec.time.steady) {
    effort.steps = 1;
  } else {
    effort.steps_known = !spec.time.adaptive;
    effort.steps = effort.steps_known ? fixed_steps(spec, a) : adaptive_steps(spec, a, m);
  }
  const int n_processes = processes::count();
  // Nodes that carry heat and displacements, times the cost of a node in a step.
  double heat = 0, mechanics = 0;  // nodes
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const auto nodes = static_cast<double>(m.bodies[b].nodes);
    if (spec.has_heat()) heat += nodes;
    if (spec.has_mechanics() && !cases::only_conducts(spec.bodies[b])) mechanics += nodes;
  }
  // The cost is per node and step, as measured on one core; passes of the coupling repeat all of
  // it.
  const Cost by_node = cost(spec, mechanics);
  constexpr double k_start = 0.5, k_output = 1e-3, k_program = 95e6;  // [s], [s] a step, [bytes]
  const double step = by_node.heat * heat + by_node.mechanics * mechanics;
  // Time falls with the number of processes while memory of the program itself grows with it.
  effort.seconds = k_start + effort.steps * (k_output + passes(spec) * step / n_processes);
  effort.bytes = n_processes * k_program + by_node.heat_bytes * heat + by_node.mechanics_bytes * mechanics;
  return effort;
}

}  // namespace solidus::check
