/// Two bodies and a contact pair, step by step as the coupling schemes do it, with the history of every
/// Newton iteration.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contact_bodies.hpp"
#include "coupling/contact_states.hpp"
#include "mechanics_bodies.hpp"

namespace solidus::test {

/// A pair's term, and how many of its points changed between open, sticking and slipping at each residual.
class WatchedTerm : public linear::Contribution {
 public:
  explicit WatchedTerm(contact::ContactPair& pair) : pair_(pair), term_(pair.parts().forces.term()) {}
  bool graph_may_change() const override { return term_.graph_may_change(); }
  bool graph_outdated() const override { return term_.graph_outdated(); }
  void add_to_graph(linear::NodeGraph& graph) const override { term_.add_to_graph(graph); }
  void bind(const linear::BlockMatrix& matrix) override { term_.bind(matrix); }
  void add_residual(std::span<const double> x, std::span<double> r) override {
    term_.add_residual(x, r);
    changes.push_back(contact::changes(pair_.parts().forces.term()));
  }
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override {
    term_.add_tangent(x, matrix);
  }

  std::vector<GlobalIndex> changes;

 private:
  contact::ContactPair& pair_;
  linear::Contribution& term_;
};

/// Record of Newton's iteration in one augmentation of a step.
struct Iteration {
  std::vector<double> residuals;     ///< relative, before each solve and at the end
  std::vector<GlobalIndex> changes;  ///< of status, at each residual that was computed

  /// The first residual after which no point changed any more. Without line search only: there each residual
  /// belongs to an iterate.
  std::size_t settled() const {
    std::size_t k = residuals.size();
    while (k > 0 && changes[k - 1] == 0) --k;
    return k == 0 ? 0 : k - 1;
  }
};

/// Members in the order in which they need each other.
struct ContactSteps {
  std::vector<material::Material> materials;
  contact::ContactPair pair;
  WatchedTerm term;
  std::vector<double> temperature;
  mechanics::MechanicalPhase phase;
  coupling::Phases phases;
  mechanics::MechanicalState state;
  std::vector<contact::ContactState> history;
  double time = 0;
  mechanics::MechanicalWork work;  ///< of the last step
  std::vector<Iteration> turns;    ///< of the last step: more than one with the augmented Lagrangian

  /// @param m  one per body
  ContactSteps(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<material::Material> m,
               contact::ContactParameters spec, mechanics::MechanicalConditions conditions,
               const mechanics::MechanicsOptions& options = strict_mechanics())
      : materials(std::move(m)),
        pair(mesh, kind, std::move(spec), moduli(materials)),
        term(pair),
        temperature(mesh.x.size(), 300.0),
        phase(mesh, kind, materials, temperature, std::move(conditions), with_symmetry(options, pair),
              {&term}),
        phases{.mechanics = &phase, .contacts = {&pair}, .temperature = {}, .ambient_temperature = {}},
        state(phase.initial_state()) {}
  ContactSteps(const ContactSteps&) = delete;

  void step(double dt) {
    const mechanics::MechanicalState old = state;
    std::vector<double> start;
    mechanics::MechanicalPass pass{.time = time + dt, .dt = dt, .temperature = temperature};
    coupling::begin_contacts(phases, history, old, pass);
    turns.clear();
    do {
      pass.start = start;
      term.changes.clear();
      const mechanics::MechanicalReport report = phase.solve(old, state, pass);
      work = report.work;
      turns.push_back({report.newton.residuals, term.changes});
      pair.update(state.displacement);
      start = state.displacement;
    } while (!coupling::penetrations_small(phases, static_cast<int>(turns.size())));
    history = coupling::contact_states(phases);
    time += dt;
  }
  int iterations() const {
    std::size_t n = 0;
    for (const Iteration& turn : turns) n += turn.residuals.size() - 1;
    return static_cast<int>(n);
  }
  const std::vector<contact::ContactPointState>& points() const { return pair.state().points; }
  contact::ContactKinematics::Particle particle(std::size_t point) const {
    return pair.parts().geometry.kinematics().particle(static_cast<Index>(point));
  }

 private:
  static std::vector<double> moduli(const std::vector<material::Material>& materials) {
    std::vector<double> e;
    for (const material::Material& m : materials) e.push_back(m.young_modulus.value(300));
    return e;
  }
  static mechanics::MechanicsOptions with_symmetry(mechanics::MechanicsOptions options,
                                                   const contact::ContactPair& pair) {
    options.symmetric = pair.parts().forces.symmetric();
    return options;
  }
};

}  // namespace solidus::test
