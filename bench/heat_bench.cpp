/// Nanoseconds per element of the thermal phase: residual and tangent of conduction with a conductivity that
/// varies, and nanoseconds per node of the closed rule's storage (phase change over a range) and per element
/// of the open rule's.
///
///   OMP_NUM_THREADS=1 ./heat_bench
#include <benchmark/benchmark.h>
#include <petscsys.h>

#include <cmath>
#include <memory>

#include "heat/conduction/conduction_block.hpp"
#include "heat/conduction/kirchhoff_potential.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "heat/storage/point_storage.hpp"
#include "lattice.hpp"

namespace solidus {
namespace {

constexpr double k_solidus = 860, k_liquidus = 900;  ///< [K]

material::Material metal() {
  material::Material m;
  m.density = 2500;
  m.conductivity = Table({300, 600, 860, 900}, {200, 180, 160, 90});
  m.specific_heat = Table({300, 600, 900}, {900, 1000, 1100});
  m.phase_changes = {
      {"solidification", material::PhaseFraction::linear(k_solidus, k_liquidus), 3.9e5, 0.0, true}};
  return m;
}

/// A mesh of one block with temperatures from cold solid to melt, so that a part of the nodes is freezing.
struct Body {
  mesh::Mesh mesh;
  material::Material material = metal();
  AnalysisKind kind;
  std::vector<double> temperature, heat;

  Body(mesh::Shape shape, int cells)
      : mesh(test::make_mesh({.shape = shape, .cells = {cells, cells, cells}, .distortion = 0.1})),
        kind(mesh.dimension == 3 ? AnalysisKind::solid : AnalysisKind::axisymmetric),
        heat(mesh.x.size()) {
    for (const mesh::Point& x : mesh.x) temperature.push_back(700 + 250 * x[0] + 20 * std::sin(30 * x[1]));
  }
  const mesh::ElementBlock& block() const { return mesh.blocks.front(); }
};

void report(benchmark::State& state, const char* what, double n) {
  state.counters["elements"] = n;
  state.counters[what] =
      benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

struct Conduction : Body {
  std::unique_ptr<heat::ConductionBlock> conduction;
  std::unique_ptr<linear::BlockMatrix> matrix;
  std::vector<double> k;

  Conduction(mesh::Shape shape, int cells) : Body(shape, cells) {
    conduction = heat::make_conduction_block(mesh, block(), kind, true);
    linear::NodeGraph graph(mesh);
    graph.add_cliques(block().nodes, mesh::node_count(shape));
    matrix = std::make_unique<linear::BlockMatrix>(mesh, 1, std::move(graph));
    conduction->bind(*matrix);
    const heat::KirchhoffPotential u(material.conductivity);
    for (double t : temperature) k.push_back(u.conductivity(t));
  }
};

void tangent(benchmark::State& state, mesh::Shape shape, int cells) {
  Conduction b(shape, cells);
  for (auto _ : state) {
    b.matrix->set_zero();
    b.conduction->add_tangent(1.0, b.k, *b.matrix);
    benchmark::ClobberMemory();
  }
  report(state, "per_element", static_cast<double>(b.block().size()));
}

/// Temperature and slope of every node from its heat: what an iteration of the closed rule asks of the
/// material.
void closed_storage(benchmark::State& state, mesh::Shape shape, int cells) {
  Body b(shape, cells);
  const heat::NodalEnthalpy storage(b.mesh, b.kind, {b.material});
  for (Index i = 0; i < storage.n_nodes(); ++i)
    b.heat[static_cast<std::size_t>(i)] = storage.lower(i, b.temperature[static_cast<std::size_t>(i)]);
  for (auto _ : state)
    for (Index i = 0; i < storage.n_nodes(); ++i) {
      const double h = b.heat[static_cast<std::size_t>(i)];
      benchmark::DoNotOptimize(storage.temperature(i, h) + storage.slope(i, h));
    }
  report(state, "per_node", static_cast<double>(storage.n_nodes()));
}

/// Residual and tangent of the heat content at Gauss points.
void open_storage(benchmark::State& state, mesh::Shape shape, int cells) {
  Conduction b(shape, cells);
  const auto points =
      heat::make_point_storage(b.mesh, b.block(), b.kind, b.material, heat::SensibleForm::enthalpy, 0);
  points->bind(*b.matrix);
  points->start(b.temperature, 1.0);
  for (double& t : b.temperature) t -= 5;
  for (auto _ : state) {
    points->add_residual(b.temperature, b.heat);
    points->add_tangent(b.temperature, *b.matrix);
    benchmark::ClobberMemory();
  }
  report(state, "per_element", static_cast<double>(b.block().size()));
}

using mesh::Shape;
constexpr auto k_unit = benchmark::kMillisecond;
BENCHMARK_CAPTURE(tangent, tet4, Shape::tet4, 30)->Unit(k_unit);
BENCHMARK_CAPTURE(tangent, hex8, Shape::hex8, 30)->Unit(k_unit);
BENCHMARK_CAPTURE(tangent, tri3, Shape::tri3, 200)->Unit(k_unit);
BENCHMARK_CAPTURE(tangent, quad4, Shape::quad4, 200)->Unit(k_unit);
BENCHMARK_CAPTURE(closed_storage, hex8, Shape::hex8, 30)->Unit(k_unit);
BENCHMARK_CAPTURE(open_storage, tet4, Shape::tet4, 30)->Unit(k_unit);
BENCHMARK_CAPTURE(open_storage, hex8, Shape::hex8, 30)->Unit(k_unit);
BENCHMARK_CAPTURE(open_storage, quad4, Shape::quad4, 200)->Unit(k_unit);

}  // namespace
}  // namespace solidus

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (PetscInitialize(nullptr, nullptr, nullptr, nullptr) != 0) return 3;
  benchmark::RunSpecifiedBenchmarks();
  return PetscFinalize() == 0 ? 0 : 3;
}
