/// Two bodies that press and rub, step by step: the mechanical phase with one contact pair.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "../unit/contact/friction_laws.hpp"
#include "contact_bodies.hpp"

namespace solidus::test {

/// Moves the nodes of one body of a mesh.
inline void map_body(mesh::RawMesh& raw, const std::string& body,
                     const std::function<mesh::Point(mesh::Point)>& map) {
  if (raw.x.empty()) return;
  std::vector<Index> nodes;
  for (const mesh::RawBlock& block : raw.groups.at(body).blocks)
    nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const Index node : nodes) {
    mesh::Point& x = raw.x[static_cast<std::size_t>(node)];
    x = map(x);
  }
}

/// The upper block is the slave and slides far.
inline contact::ContactParameters rubbing(contact::FrictionParameters friction, double penalty) {
  contact::ContactParameters s;
  s.name = "interface";
  s.slave = "upper_bottom";
  s.master = "lower_top";
  s.formulation = contact::Formulation::large_sliding;
  s.integration = contact::IntegrationRule::gauss;
  s.penalty = penalty;
  s.penalty_is_factor = false;
  s.friction = std::move(friction);
  return s;
}

/// Prescribes where every node of a body goes, at given times: straight from one to the next.
inline void move_rigidly(mesh::Mesh& mesh, const std::string& body, const std::vector<double>& times,
                         const std::function<mesh::Point(mesh::Point, double time)>& place,
                         mechanics::MechanicalConditions& conditions) {
  const std::vector<Index> nodes = mesh.node_sets.at(body);
  for (const Index node : nodes) {
    const std::string name = body + " node " + std::to_string(node);
    mesh.node_sets[name] = {node};
    const mesh::Point& x = mesh.x[static_cast<std::size_t>(node)];
    for (int i = 0; i < mesh.dimension; ++i) {
      std::vector<double> u;
      for (const double time : times)
        u.push_back(place(x, time)[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(i)]);
      conditions.displacements.push_back({name, i, Table(times, std::move(u))});
    }
  }
}

inline contact::FrictionParameters coulomb(double coefficient) {
  return contact::friction_spec({coefficient});
}

/// Two bodies in motion. Lower body first in `materials`.
class Rubbing {
 public:
  Rubbing(mesh::Mesh m, AnalysisKind analysis, std::vector<material::Material> laws,
          mechanics::MechanicalConditions conditions, contact::ContactParameters spec,
          mechanics::MechanicsOptions options = strict_mechanics())
      : mesh(std::move(m)),
        materials(std::move(laws)),
        temperature(mesh.x.size(), 300.0),
        pair(mesh, analysis, std::move(spec)) {
    options.symmetric = options.symmetric && pair.parts().forces.symmetric();
    phase = std::make_unique<mechanics::MechanicalPhase>(
        mesh, analysis, materials, temperature, std::move(conditions), options,
        std::vector<linear::Contribution*>{&pair.parts().forces.term()});
    state = phase->initial_state();
    contact = pair.parts().history.initial();
    pair.restore(contact, state.displacement, 0);
  }

  /// To t_{n+1}. Throws StepRejected and leaves everything at t_n.
  void step(double dt) {
    pair.begin(contact, {.time = time + dt,
                         .dt = dt,
                         .displacement = state.displacement,
                         .temperature = temperature,
                         .share = phase->bodies().force_share()});
    mechanics::MechanicalPass pass{.time = time + dt, .dt = dt, .temperature = temperature};
    mechanics::MechanicalState next;
    int iterations = 0;
    for (int turn = 0; turn < 60; ++turn) {
      report = phase->solve(state, next, pass);
      iterations += report.newton.iterations;
      pair.update(next.displacement);
      if (pair.parts().augmentations.excess() <= 1) break;
      pair.parts().augmentations.augment();
      pass.start = next.displacement;
    }
    contact_work = contact::work(pair.view(), 1);
    most_iterations = std::max(most_iterations, iterations);
    before = std::move(state);
    state = std::move(next);
    contact_before = std::move(contact);
    contact = pair.state();
    time += dt;
    ++n_steps;
  }
  /// Equal steps; those that jam are halved, down to a thousandth.
  void advance(double until, int steps) {
    const double whole = (until - time) / steps;
    for (double dt = whole; time < until - 1e-9 * whole;) {
      try {
        step(std::min(dt, until - time));
        dt = std::min(whole, 2 * dt);
      } catch (const StepRejected&) {
        ++n_cuts;
        dt *= 0.5;
        if (dt < 1e-3 * whole) throw;
      }
    }
  }

  contact::ContactSums sums() const { return contact::sums(pair.view(), {}); }
  /// The integral ∫ f dA of a point field over the slave, all processes.
  double integral(const std::function<double(const contact::ContactPointState&)>& f) const {
    double sum = 0;
    for (std::size_t p = 0; p < contact.points.size(); ++p) {
      const auto particle = pair.parts().geometry.kinematics().particle(static_cast<Index>(p));
      if (particle.counted) sum += particle.weight * f(contact.points[p]);
    }
    return parallel::global_sum(sum);
  }
  /// ½ u · f_int of the bodies: their elastic energy, where all materials are elastic and all loads are
  /// prescribed displacements [J].
  double elastic_energy() {
    std::vector<double> of_contact(report.reactions.size(), 0.0);
    pair.parts().forces.term().add_residual(state.displacement, of_contact);
    double energy = 0;
    for (std::size_t i = 0; i < of_contact.size(); ++i)
      energy += 0.5 * state.displacement[i] * (report.reactions[i] - of_contact[i]);
    return parallel::global_sum(energy);
  }
  /// The average over the slave.
  double mean(const std::function<double(const contact::ContactPointState&)>& f) const {
    return integral(f) / integral([](const contact::ContactPointState&) { return 1.0; });
  }

  mesh::Mesh mesh;
  std::vector<material::Material> materials;
  std::vector<double> temperature;
  contact::ContactPair pair;
  std::unique_ptr<mechanics::MechanicalPhase> phase;
  mechanics::MechanicalState state, before;
  contact::ContactState contact, contact_before;
  mechanics::MechanicalReport report;
  double time = 0, contact_work = 0;
  int n_steps = 0, n_cuts = 0, most_iterations = 0;
};

}  // namespace solidus::test
