/// A small body with its phase, for tests: conditions by formula, steel-like elastic material.
#pragma once

#include <memory>

#include "element_fields.hpp"
#include "lattice.hpp"
#include "mechanics/mechanical_phase.hpp"

namespace solidus::test {

inline material::Material elastic_material(double young, double poisson, double expansion = 0) {
  material::Material m;
  m.name = "elastic";
  m.density = 7800;
  m.conductivity = 20.0;
  m.specific_heat = 500.0;
  m.young_modulus = young;
  m.poisson_ratio = poisson;
  m.expansion = expansion;
  m.liquid_viscosity = 1.0;
  return m;
}

/// Linear elastic solves need a criterion at round-off to be compared with closed forms.
inline mechanics::MechanicsOptions strict() {
  mechanics::MechanicsOptions options;
  options.newton.tolerance = 1e-11;
  options.solver = linear::SolverKind::direct;
  return options;
}

struct Body {
  mesh::Mesh mesh;
  AnalysisKind kind;
  std::vector<material::Material> materials;
  mechanics::MechanicalConditions conditions;
  mechanics::MechanicsOptions options = strict();
  std::vector<double> initial_temperature, temperature;
  std::vector<linear::Contribution*> contributions;

  Body(mesh::Mesh m, AnalysisKind k, material::Material material)
      : mesh(std::move(m)),
        kind(k),
        materials{std::move(material)},
        initial_temperature(mesh.x.size(), 300.0),
        temperature(mesh.x.size(), 300.0) {}
  Body(const Lattice& lattice, AnalysisKind k, material::Material material)
      : Body(make_mesh(lattice), k, std::move(material)) {}

  void hold(const std::string& group, int component, Table value = 0.0) {
    conditions.displacements.push_back({group, component, std::move(value)});
  }
  /// u = f(x) on every node of the sides.
  void hold_boundary(const std::function<mesh::Point(const mesh::Point&)>& f) {
    // The values must be known on every process: an owner tells them through the global maximum.
    for (const auto& [name, nodes] : mesh.node_sets) {
      if (name.rfind("node ", 0) != 0) continue;
      mesh::Point u{-1e300, -1e300, -1e300};
      bool boundary = false;
      for (Index node : nodes) {
        u = f(mesh.x[static_cast<std::size_t>(node)]);
        boundary = boundary || on_boundary(node);
      }
      if (!parallel::any_process(boundary)) continue;
      for (int i = 0; i < displacement_components(kind); ++i)
        hold(name, i, parallel::global_max(u[static_cast<std::size_t>(i)]));
    }
  }
  bool on_boundary(Index node) const {
    for (const auto& [name, surface] : mesh.surfaces)
      if (std::binary_search(surface.nodes.begin(), surface.nodes.end(), node)) return true;
    return false;
  }

  std::unique_ptr<mechanics::MechanicalPhase> phase() const {
    return std::make_unique<mechanics::MechanicalPhase>(mesh, kind, materials, initial_temperature,
                                                        conditions, options, contributions);
  }
};

/// A phase and the state after its steps.
struct Solved {
  std::unique_ptr<mechanics::MechanicalPhase> phase;
  mechanics::MechanicalState state;
  mechanics::MechanicalReport report;

  explicit Solved(const Body& body) : phase(body.phase()), state(phase->initial_state()) {
    step(body, 1.0, 1.0);
  }
  void step(const Body& body, double time, double dt) {
    const mechanics::MechanicalState old = state;
    report = phase->solve(old, state, body.temperature, time, dt);
  }
  double u(const Body& body, Index node, int component) const {
    return state
        .displacement[static_cast<std::size_t>(node * displacement_components(body.kind) + component)];
  }
};

/// The fields of elements after its last step, [block].
inline std::vector<ElementFields> element_fields(const Solved& solved) {
  return element_fields(solved.phase->mesh(), solved.state);
}

}  // namespace solidus::test
