/// Nanoseconds per element of the mechanical tangent and residual, assembly into the block matrix included:
/// elastic, and J2 plasticity with all points flowing, by the isothermal and the isentropic mapping.
///
///   OMP_NUM_THREADS=1 ./mechanics_bench        (build with -DSOLIDUS_MARCH=native for the numbers of the
///   design)
#include <benchmark/benchmark.h>
#include <petscsys.h>

#include <cmath>

#include "lattice.hpp"
#include "material/external_law.hpp"
#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"
#include "material/outside/mfront_library.hpp"
#include "material/outside/shared_object.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/law_block.hpp"
#include "mechanics/elements/structural_points.hpp"

namespace solidus {
namespace {

material::Material steel() {
  material::Material m;
  m.density = 7800;
  m.specific_heat = 500;
  m.young_modulus = Table({280, 400, 600, 800}, {2.1e11, 2.0e11, 1.8e11, 1.5e11});
  m.poisson_ratio = 0.3;
  m.expansion = Table({280, 400, 600, 800}, {1.1e-5, 1.2e-5, 1.3e-5, 1.4e-5});
  m.liquid_viscosity = 1.0;
  return m;
}

/// Rate-independent, linear hardening: the return mapping is in closed form.
material::Material j2() {
  material::Material m = steel();
  material::Flow flow;
  flow.flow_stress = Table({280, 400, 600, 800}, {3e6, 2.5e6, 2e6, 1e6});
  flow.isotropic = material::IsotropicHardening::linear;
  set_hardening(flow, {{"hardening_modulus", 1e9}});
  flow.rate[material::Perzyna::viscosity] = 0.0;
  m.flow = flow;
  return m;
}

/// The same law with moduli that fall linearly, from a shared object: examples/external_laws/j2_generic.c.
material::Material external() {
  material::ExternalData data;
  data.library = SOLIDUS_J2_GENERIC;
  data.behaviour = "J2Generic";
  data.properties = {2.1e11, 0.3, 3e6, 1e9, 5e-4, 1e-3};
  material::trust_external_laws();
  const material::SharedObject object(data.library, data.where);
  material::Material m = j2();
  set_external_law(m, std::make_shared<material::ExternalLaw>(data, make_mfront_library(object, data)));
  return m;
}

/// Saturating and kinematic hardening: a Newton iteration in every point.
material::Material saturating() {
  material::Material m = j2();
  m.flow->isotropic = material::IsotropicHardening::saturation;
  set_hardening(*m.flow, {{"saturation_stress", Table({280, 400, 600, 800}, {6e6, 5e6, 4e6, 2e6})},
                          {"saturation_rate", 50.0},
                          {"hardening_modulus", 1e9}});
  m.flow->kinematic = material::KinematicHardening::linear;
  m.flow->kinematic_modulus = 2e9;
  return m;
}

/// The law with its tangent as a 6×6 matrix: what an element costs that knows nothing of its form.
struct General : material::Viscoplastic {
  using Viscoplastic::Viscoplastic;
  template <class T>
  struct Response {
    Sym<T> stress;
    State<T> state;
    Sym4<T> tangent;
    T dissipation, plastic_power, plastic_dissipation, thermal_dissipation;
    material::Status status;
  };
  template <class T>
  Response<T> update(const Properties<T>& p, const State<T>& start, const Sym<T>& strain,
                     const material::TimeStep& step) const {
    const auto r = Viscoplastic::update(p, start, strain, step);
    return {r.stress,
            r.state,
            full_tangent(r),
            r.dissipation,
            r.plastic_power,
            r.plastic_dissipation,
            r.thermal_dissipation,
            r.status};
  }
};

/// One block ready to compute, with its matrix.
struct Prepared {
  mesh::Mesh mesh;
  material::Material material;
  int components;
  std::unique_ptr<mechanics::BlockKernel> kernel;
  std::unique_ptr<linear::BlockMatrix> matrix;
  mechanics::BlockHistory history;
  std::vector<double> temperature, temperature_rate, u, forces;

  Prepared(mesh::Shape shape, int cells, AnalysisKind kind, material::Material of = steel(),
           bool general = false, mechanics::Mapping mapping = mechanics::Mapping::isothermal)
      : mesh(test::make_mesh({.shape = shape, .cells = {cells, cells, cells}, .distortion = 0.1})),
        material(std::move(of)),
        components(displacement_components(kind)),
        temperature(mesh.x.size(), 300.0),
        temperature_rate(mesh.x.size()),
        u(mesh.x.size() * static_cast<std::size_t>(components)),
        forces(u.size()) {
    const mesh::ElementBlock& block = mesh.blocks.front();
    if (general)
      kernel = std::make_unique<mechanics::LawBlock<General, 4, AnalysisKind::solid, false>>(mesh, block,
                                                                                             material);
    else
      kernel = mechanics::make_block_kernel(mesh, block, kind, material, mapping, true);
    linear::NodeGraph graph(mesh);
    graph.add_cliques(mesh.blocks.front().nodes, mesh::node_count(shape));
    matrix = std::make_unique<linear::BlockMatrix>(mesh, components, std::move(graph));
    kernel->bind(*matrix);
    history = kernel->initial_history();
    kernel->prepare({.temperature = temperature,
                     .pass_temperature = temperature,
                     .initial_temperature = temperature,
                     .old_displacement = u,
                     .held_displacement = u,
                     .held_history = &history,
                     .old_history = &history,
                     .start_history = &history,
                     .dt = 1.0,
                     .effective = 1.0});
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1e-4 * std::sin(static_cast<double>(i));
  }
  void report(benchmark::State& state) const {
    const auto n = static_cast<double>(mesh.blocks.front().size());
    state.counters["elements"] = n;
    state.counters["per_element"] =
        benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  }
};

void tangent(benchmark::State& state, mesh::Shape shape, int cells, AnalysisKind kind,
             material::Material material = steel(), bool general = false,
             mechanics::Mapping mapping = mechanics::Mapping::isothermal) {
  Prepared p(shape, cells, kind, std::move(material), general, mapping);
  for (auto _ : state) {
    p.matrix->set_zero();
    p.kernel->add_tangent(p.u, *p.matrix);
  }
  p.report(state);
}

/// The tangent, and PETSc's copy of it.
void hand_over(benchmark::State& state, mesh::Shape shape, int cells, AnalysisKind kind) {
  Prepared p(shape, cells, kind);
  p.kernel->add_tangent(p.u, *p.matrix);
  for (auto _ : state) benchmark::DoNotOptimize(p.matrix->matrix());
  p.report(state);
}

void residual(benchmark::State& state, mesh::Shape shape, int cells, AnalysisKind kind,
              material::Material material = steel(),
              mechanics::Mapping mapping = mechanics::Mapping::isothermal) {
  Prepared p(shape, cells, kind, std::move(material), false, mapping);
  for (auto _ : state) benchmark::DoNotOptimize(p.kernel->add_forces(p.u, p.forces));
  p.report(state);
}

/// Assembles as an iteration of Newton's method does: forces, then the tangent at the same displacements.
void assembly(benchmark::State& state, mesh::Shape shape, int cells, AnalysisKind kind,
              material::Material material, bool general = false) {
  Prepared p(shape, cells, kind, std::move(material), general);
  for (auto _ : state) {
    benchmark::DoNotOptimize(p.kernel->add_forces(p.u, p.forces));
    p.matrix->set_zero();
    p.kernel->add_tangent(p.u, *p.matrix);
  }
  p.report(state);
}

/// Cost of the evaluations at the mechanical points in each iteration of the thermal phase: tables of
/// temperature, eight lanes at once.
void structural_heat(benchmark::State& state, mesh::Shape shape, int cells, AnalysisKind kind) {
  Prepared p(shape, cells, kind);
  std::shared_ptr<const mechanics::StructuralPoints> points;
  p.kernel->finish(p.u, p.u, {.history = p.history, .deformation = &points});
  const mechanics::StructuralPoints::Stage stage{{1.0, 0}, {}};
  for (auto _ : state)
    points->add_heat(mechanics::StructuralForm::entropy, stage, p.temperature, false, p.temperature_rate);
  p.report(state);
}

constexpr auto k_solid = AnalysisKind::solid;
constexpr auto k_axisymmetric = AnalysisKind::axisymmetric;
constexpr auto k_isentropic = mechanics::Mapping::isentropic;
BENCHMARK_CAPTURE(tangent, tet4, mesh::Shape::tet4, 30, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hand_over, tet4, mesh::Shape::tet4, 30, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tet4, mesh::Shape::tet4, 30, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tet4_j2, mesh::Shape::tet4, 30, k_solid, j2())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tet4_j2, mesh::Shape::tet4, 30, k_solid, j2())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tet4_j2_general, mesh::Shape::tet4, 30, k_solid, j2(), true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assembly, tet4_j2, mesh::Shape::tet4, 30, k_solid, j2())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assembly, tet4_j2_general, mesh::Shape::tet4, 30, k_solid, j2(), true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assembly, tet4_external, mesh::Shape::tet4, 30, k_solid, external())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tet4_external, mesh::Shape::tet4, 30, k_solid, external())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assembly, hex8_j2, mesh::Shape::hex8, 30, k_solid, j2())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assembly, hex8_external, mesh::Shape::hex8, 30, k_solid, external())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tet4_saturating, mesh::Shape::tet4, 30, k_solid, saturating())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tet4_saturating, mesh::Shape::tet4, 30, k_solid, saturating())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, hex8_j2, mesh::Shape::hex8, 30, k_solid, j2())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, hex8_j2, mesh::Shape::hex8, 30, k_solid, j2())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, hex8, mesh::Shape::hex8, 30, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hand_over, hex8, mesh::Shape::hex8, 30, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, hex8, mesh::Shape::hex8, 30, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tet10, mesh::Shape::tet10, 12, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tet10, mesh::Shape::tet10, 12, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, hex20, mesh::Shape::hex20, 10, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, hex20, mesh::Shape::hex20, 10, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tri3, mesh::Shape::tri3, 200, k_axisymmetric)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tri3, mesh::Shape::tri3, 200, k_axisymmetric)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, quad4, mesh::Shape::quad4, 200, k_axisymmetric)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hand_over, quad4, mesh::Shape::quad4, 200, k_axisymmetric)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(structural_heat, tri3, mesh::Shape::tri3, 200, k_axisymmetric)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(structural_heat, tet4, mesh::Shape::tet4, 30, k_solid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, quad4, mesh::Shape::quad4, 200, k_axisymmetric)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tet4_isentropic, mesh::Shape::tet4, 30, k_solid, steel(), false, k_isentropic)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tet4_isentropic, mesh::Shape::tet4, 30, k_solid, steel(), k_isentropic)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, hex8_isentropic, mesh::Shape::hex8, 30, k_solid, steel(), false, k_isentropic)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, hex8_isentropic, mesh::Shape::hex8, 30, k_solid, steel(), k_isentropic)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tri3_isentropic, mesh::Shape::tri3, 200, k_axisymmetric, steel(), false,
                  k_isentropic)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tri3_isentropic, mesh::Shape::tri3, 200, k_axisymmetric, steel(), k_isentropic)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangent, tet4_isentropic_j2, mesh::Shape::tet4, 30, k_solid, j2(), false, k_isentropic)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(residual, tet4_isentropic_j2, mesh::Shape::tet4, 30, k_solid, j2(), k_isentropic)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace solidus

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (PetscInitialize(nullptr, nullptr, nullptr, nullptr) != 0) return 3;
  benchmark::RunSpecifiedBenchmarks();
  return PetscFinalize() == 0 ? 0 : 3;
}
