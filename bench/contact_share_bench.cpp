/// Share of contact in the cost of a step: search, projection, forces and tangent against the whole
/// mechanical step. Processor time, so that a busy machine does not matter; counters in percent of a step.
///
///   blocks    two blocks of 8-node hexahedra, friction, large sliding, 19 881 slave points (47 × 47 faces);
///   tangent symmetric or exact cylinder  casting in its mould, axisymmetric, 3-node triangles of 3 mm, small
///   sliding, cooling by 20 K a
///             step, so that the side opens
///
///   OMP_NUM_THREADS=1 ./contact_share_bench
#include <benchmark/benchmark.h>
#include <petscsys.h>

#include <ctime>

#include "contact/pair.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "mesh/making/parametric_meshes.hpp"

namespace solidus {
namespace {

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Adds up the time in a term.
class Timed : public linear::Contribution {
 public:
  explicit Timed(linear::Contribution& term) : term_(term) {}
  bool graph_may_change() const override { return term_.graph_may_change(); }
  bool graph_outdated() const override { return term_.graph_outdated(); }
  void add_to_graph(linear::NodeGraph& graph) const override { term_.add_to_graph(graph); }
  void bind(const linear::BlockMatrix& matrix) override {
    measure([&] { term_.bind(matrix); }, tangent);
  }
  void add_residual(std::span<const double> x, std::span<double> r) override {
    measure([&] { term_.add_residual(x, r); }, residual);
  }
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override {
    measure([&] { term_.add_tangent(x, matrix); }, tangent);
  }
  template <class Work>
  static void measure(Work work, double& seconds) {
    const double start = cpu_seconds();
    work();
    seconds += cpu_seconds() - start;
  }
  double residual = 0, tangent = 0;

 private:
  linear::Contribution& term_;
};

material::Material elastic(double young, double expansion) {
  material::Material m;
  m.name = "elastic";
  m.density = 7800;
  m.conductivity = 20.0;
  m.specific_heat = 500.0;
  m.young_modulus = young;
  m.poisson_ratio = 0.3;
  m.expansion = expansion;
  m.expansion_reference = 300;
  m.liquid_viscosity = 1.0;
  return m;
}

struct Problem {
  mesh::Mesh mesh;
  AnalysisKind kind;
  contact::ContactParameters contact;
  mechanics::MechanicalConditions conditions;
  mechanics::MechanicsOptions options;
  double warming = 0;  ///< of both bodies in a step [K]
};

void measure(benchmark::State& state, Problem problem) {
  const std::vector<material::Material> materials{elastic(70e9, 2e-5), elastic(70e9, 2e-5)};
  contact::ContactPair pair(problem.mesh, problem.kind, problem.contact, std::vector<double>{70e9, 70e9});
  Timed term(pair.parts().forces.term());
  const std::vector<double> start(problem.mesh.x.size(), 300.0);
  problem.options.symmetric = pair.parts().forces.symmetric();
  mechanics::MechanicalPhase phase(problem.mesh, problem.kind, materials, start, problem.conditions,
                                   problem.options, {&term});
  mechanics::MechanicalState now = phase.initial_state();
  contact::ContactState history = pair.parts().history.initial();
  double time = 0, update = 0, whole = 0;
  int iterations = 0;
  for (auto _ : state) {
    const double begin = cpu_seconds();
    const mechanics::MechanicalState old = now;
    const std::vector<double> temperature(start.size(), 300 + problem.warming * (time + 1));
    Timed::measure(
        [&] {
          pair.begin(
              history,
              {.time = time + 1, .dt = 1, .displacement = old.displacement, .temperature = temperature});
        },
        update);
    iterations += phase.solve(old, now, temperature, time + 1, 1).newton.iterations;
    Timed::measure([&] { pair.update(now.displacement); }, update);
    history = pair.state();
    time += 1;
    whole += cpu_seconds() - begin;
  }
  const auto per_cent = [&](double part) { return 100 * part / whole; };
  state.counters["points"] = static_cast<double>(contact::sums(pair.view(), {}).points);
  state.counters["nodes"] = static_cast<double>(problem.mesh.n_owned_nodes);
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(state.iterations());
  state.counters["forces"] = per_cent(term.residual);
  state.counters["tangent"] = per_cent(term.tangent);
  state.counters["update"] = per_cent(update);
  state.counters["contact"] = per_cent(term.residual + term.tangent + update);
}

void blocks(benchmark::State& state, bool symmetric) {
  Problem p;
  mesh::RawMesh raw = mesh::make_two_blocks(
      {{0.12, 0.12, 0.03}, {0.12, 0.12, 0.03}, {47, 47, 12}, {36, 36, 9}, 0}, mesh::Shape::hex8);
  p.mesh = mesh::distribute(raw, {"lower", "upper"}, {"lower_top", "upper_bottom"});
  p.kind = AnalysisKind::solid;
  p.contact.name = "interface";
  p.contact.slave = "lower_top";
  p.contact.master = "upper_bottom";
  p.contact.formulation = contact::Formulation::large_sliding;
  p.contact.integration = contact::IntegrationRule::gauss;
  p.contact.stabilisation = 1e-6;
  contact::FrictionParameters friction;
  friction.coefficient.terms = {Table(0.2)};
  friction.symmetric = symmetric;
  p.contact.friction = friction;
  for (int i = 0; i < 3; ++i) p.conditions.displacements.push_back({"lower_z_min", i, 0.0});
  p.conditions.displacements.push_back({"upper_z_max", 0, Table({0, 1, 10}, {0, 0, 9e-3})});
  p.conditions.displacements.push_back({"upper_z_max", 1, 0.0});
  p.conditions.displacements.push_back({"upper_z_max", 2, -3e-6});
  p.options.solver = linear::SolverKind::automatic;
  measure(state, std::move(p));
}

void cylinder(benchmark::State& state) {
  Problem p;
  const mesh::CylinderInMould shape{.radius = 0.1,
                                    .height = 0.2,
                                    .mould_wall = 0.05,
                                    .mould_bottom = 0.05,
                                    .mould_height = 0.25,
                                    .element_size = 3e-3,
                                    .mould_element_size = 6e-3};
  p.mesh = mesh::distribute(mesh::make_cylinder_in_mould(shape, mesh::Shape::tri3), {"part", "mould"},
                            {"part_surface", "mould_surface"});
  p.kind = AnalysisKind::axisymmetric;
  p.contact.name = "interface";
  p.contact.slave = "part_surface";
  p.contact.master = "mould_surface";
  p.conditions.displacements.push_back({"mould_bottom", 1, 0.0});
  p.conditions.gravity[1] = -9.81;
  p.warming = -20;
  measure(state, std::move(p));
}

}  // namespace

BENCHMARK_CAPTURE(blocks, symmetric, true)->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(blocks, exact, false)->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(cylinder)->Unit(benchmark::kMillisecond)->Iterations(5);

}  // namespace solidus

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (PetscInitialize(nullptr, nullptr, nullptr, nullptr) != 0) return 3;
  benchmark::RunSpecifiedBenchmarks();
  return PetscFinalize() == 0 ? 0 : 3;
}
