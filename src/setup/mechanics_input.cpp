/// Each mechanical condition becomes the conditions of the phase; options are copied with their checks.
#include "setup/mechanics_input.hpp"

#include <cmath>

#include "linear/active_set.hpp"
#include "mechanics/loads/section.hpp"
#include "setup/body_input.hpp"
#include "setup/dynamics_input.hpp"
#include "setup/load_laws.hpp"
#include "setup/place_input.hpp"
#include "setup/rotation_input.hpp"

namespace solidus::setup {

std::array<double, 3> gravity(const cases::AnalysisSpec& analysis) {
  std::array<double, 3> direction{};
  if (analysis.gravity_direction.empty()) {
    direction[analysis.kind == AnalysisKind::solid ? 2 : 1] = -1;
  } else {
    for (std::size_t i = 0; i < analysis.gravity_direction.size(); ++i)
      direction[i] = analysis.gravity_direction[i];
  }
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  for (double& d : direction) d *= analysis.gravity / length;
  return direction;
}

mechanics::MechanicalConditions mechanical_conditions(const cases::CaseSpec& spec,
                                                      const cases::StageRun* stage) {
  using Kind = cases::MechanicalConditionSpec::Kind;
  // Each condition that holds in this stage becomes one of the solver's. Components are numbered as
  // displacements are: r and z take 0 and 1 around an axis.
  mechanics::MechanicalConditions conditions;
  conditions.gravity = gravity(spec.analysis);
  conditions.turning = turning(spec);
  conditions.body_forces = centrifugal_forces(spec);
  conditions.absent_bodies = absent_from_mechanics(spec, stage);
  const bool axisymmetric = spec.analysis.kind == AnalysisKind::axisymmetric;
  for (const auto& c : spec.mechanical_conditions) {
    if (!cases::holds(c.stages, stage)) continue;
    // Loads are functions of place and time on the clock of the condition.
    const auto placed = [&](const Function& f) {
      return place_function(f, c.clock, stage, spec.analysis.kind);
    };
    // One function for each direction of the mesh.
    const auto directions = [&](const std::vector<Function>& of) {
      std::array<PlaceFunction, 3> all{0.0, 0.0, 0.0};
      for (std::size_t i = 0; i < of.size(); ++i) all[i] = placed(of[i]);
      return all;
    };
    const auto prescribe = [&](const std::optional<Function>& value, int component) {
      if (value) conditions.displacements.push_back({c.group, component, placed(*value), c.relative});
    };
    // Components are listed one by one, since each may be held or left free.
    switch (c.kind) {
      case Kind::displacement:
        prescribe(c.ux, 0);
        prescribe(c.ur, 0);
        prescribe(c.uy, 1);
        prescribe(c.uz, axisymmetric ? 1 : 2);
        break;
      case Kind::pressure:
        conditions.pressures.push_back({c.group, placed(c.pressure)});
        break;
      case Kind::metallostatic:
        conditions.pressures.push_back(
            {c.group,
             metallostatic_pressure(conditions.gravity, c.density, cases::on_clock(c.level, c.clock, stage),
                                    cases::on_clock(c.squeeze, c.clock, stage))});
        break;
      case Kind::traction:
        conditions.tractions.push_back({c.group, directions(c.traction)});
        break;
      case Kind::body_force:
        conditions.body_forces.push_back({c.group, directions(c.force)});
        break;
      case Kind::plane:
        conditions.plane_faces.push_back({c.group});
        break;
    }
  }
  return conditions;
}

mechanics::MechanicsOptions mechanics_options(const cases::CaseSpec& spec) {
  mechanics::MechanicsOptions options;
  // Tolerances and limits of the iteration come as they are in the case.
  options.newton.tolerance = spec.mechanics.tolerance;
  options.newton.step_tolerance = spec.mechanics.displacement_tolerance;
  options.newton.max_iterations = spec.mechanics.max_iterations;
  options.newton.line_search = spec.mechanics.line_search;
  options.newton.inexact = spec.mechanics.inexact;
  options.linear_tolerance = spec.mechanics.linear_tolerance;
  options.b_bar = spec.mechanics.b_bar;
  options.simplices = spec.mechanics.simplices;
  options.stabilisation = spec.mechanics.stabilisation;
  options.integration = spec.mechanics.integration;
  // The mapping of the mechanical phase follows the scheme of the coupling.
  options.mapping = spec.isentropic()     ? mechanics::Mapping::isentropic
                    : spec.simultaneous() ? mechanics::Mapping::simultaneous
                                          : mechanics::Mapping::isothermal;
  options.solver = spec.mechanics.solver;
  options.dynamics = dynamics_options(spec);
  return options;
}

std::vector<double> sections_of(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  if (!spec.has_mechanics()) return std::vector<double>(mesh.bodies.size(), 0.0);
  const linear::ActiveSet active(mesh, absent_from_mechanics(spec, nullptr));
  return mechanics::sections(mesh, spec.analysis.kind, mechanical_conditions(spec), active);
}

}  // namespace solidus::setup
