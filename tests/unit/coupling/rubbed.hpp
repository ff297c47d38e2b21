/// Two blocks in contact, mechanics alone, stepped by a scheme.
#pragma once

#include "../../verification/contact_bodies.hpp"
#include "../contact/friction_laws.hpp"
#include "coupling/isothermal_split.hpp"

namespace solidus::test {

/// Mechanics alone with one contact pair, stepped by a scheme.
struct Rubbed {
  std::vector<material::Material> materials;
  contact::ContactPair pair;
  mechanics::MechanicalPhase phase;
  coupling::Phases phases;
  coupling::IsothermalSplit scheme;
  coupling::State state;

  Rubbed(const mesh::Mesh& mesh, AnalysisKind kind, const contact::ContactParameters& spec,
         const mechanics::MechanicalConditions& conditions, mechanics::MechanicsOptions options)
      : materials{elastic(70e9, 0.3), elastic(70e9, 0.3)},
        pair(mesh, kind, spec, std::vector<double>{70e9, 70e9}),
        phase(mesh, kind, materials, std::vector<double>(mesh.x.size(), 300.0), conditions,
              for_pair(std::move(options), pair), {&pair.parts().forces.term()}),
        phases{.mechanics = &phase,
               .contacts = {&pair},
               .temperature = std::vector<double>(mesh.x.size(), 300.0),
               .ambient_temperature = {}},
        scheme(phases) {
    state.mechanics = phase.initial_state();
    state.contacts = {pair.parts().history.initial()};
  }
  Rubbed(const Rubbed&) = delete;

  coupling::StepEffort step(double dt) {
    coupling::State trial = state;
    const double time = state.time + dt;
    const coupling::StepEffort effort = scheme.advance(state, trial, time, dt);
    trial.time = time;
    state = std::move(trial);
    return effort;
  }

 private:
  static mechanics::MechanicsOptions for_pair(mechanics::MechanicsOptions options,
                                              const contact::ContactPair& pair) {
    options.symmetric = pair.parts().forces.symmetric();
    return options;
  }
};

/// The lower block is at rest; the upper one is pressed by 20 MPa and pulled along at 20 mm/s.
inline mechanics::MechanicalConditions pulled() {
  mechanics::MechanicalConditions c;
  c.displacements.push_back({"lower_y_min", 0, 0.0});
  c.displacements.push_back({"lower_y_min", 1, 0.0});
  c.displacements.push_back({"upper_y_max", 0, Table({0, 10}, {0, 0.2})});
  c.pressures.push_back({"upper_y_max", Table({0, 1}, {0, 20e6})});
  c.plane_faces = {{"upper_y_max"}};
  return c;
}

inline contact::ContactParameters rubbing() {
  contact::ContactParameters s = interface();
  s.formulation = contact::Formulation::large_sliding;
  s.search_distance = 0.02;
  s.penalty = 1e13;
  s.penalty_is_factor = false;
  s.friction = contact::friction_spec({0.2, 0.05}, 1e6);
  return s;
}

}  // namespace solidus::test
