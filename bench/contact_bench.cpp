/// Large sliding: nanoseconds per slave point for finding all partners again after a step, with and without
/// averaged normals, how that grows with the number of points, and for the rates of a point.
///
///   OMP_NUM_THREADS=1 ./contact_bench
#include <benchmark/benchmark.h>
#include <petscsys.h>

#include <cmath>

#include "contact/points/sliding_kinematics.hpp"
#include "contact/surfaces/master_mesh.hpp"

namespace solidus::contact {
namespace {

constexpr double k_step = 0.4;  ///< of a slave face per configuration

/// Two wavy sheets of quads, a slave of n × n faces above a master of ⅘ as many a side, one point a face.
struct Sheets {
  mesh::Mesh mesh;
  std::vector<double> u;
  double size;

  explicit Sheets(int n) : size(1.0 / n) {
    mesh.dimension = 3;
    add("master", std::max(2, n * 4 / 5), 0, false);
    add("slave", n, -1e-4, true);
    mesh.n_owned_nodes = mesh.n_nodes();
    for (Index i = 0; i < mesh.n_nodes(); ++i) mesh.input_node.push_back(i);
    mesh.global_node = mesh.input_node;
    mesh.n_global_nodes = mesh.n_nodes();
    u.resize(mesh.x.size() * 3);
  }
  void add(const std::string& name, int n, double z, bool down) {
    const Index first = mesh.n_nodes();
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
        mesh.x.push_back({a, b, z + 0.02 * std::sin(9 * a) * std::cos(7 * b)});
      }
    mesh::ElementBlock faces;
    faces.shape = mesh::Shape::quad4;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Index a = first + i * (n + 1) + j, b = a + n + 1;
        if (down)
          faces.nodes.insert(faces.nodes.end(), {a, a + 1, b + 1, b});
        else
          faces.nodes.insert(faces.nodes.end(), {a, b, b + 1, a + 1});
      }
    mesh.surfaces[name].faces.push_back(faces);
  }
  /// The slave carried along by `way`, and both sheets bent.
  void move(double way) {
    const std::size_t slave = static_cast<std::size_t>(mesh.surfaces.at("slave").faces[0].nodes[0]);
    for (std::size_t i = 0; i < mesh.x.size(); ++i) {
      u[3 * i] = i >= slave ? way : 0;
      u[3 * i + 2] = 0.1 * way * mesh.x[i][1];
    }
  }
  SlidingKinematics kinematics(bool smoothing) const {
    return {mesh,
            AnalysisKind::solid,
            ContactSurface(mesh, "slave"),
            std::make_unique<MeshMaster>(3, ContactSurface(mesh, "master"),
                                         MeshMasterOptions{.search_distance = 0.05, .smoothing = smoothing}),
            {.gauss_degree = 1}};
  }
};

void place(benchmark::State& state, bool smoothing) {
  const int n = static_cast<int>(std::lround(std::sqrt(static_cast<double>(state.range(0)))));
  Sheets sheets(n);
  SlidingKinematics kinematics = sheets.kinematics(smoothing);
  int step = 0;
  for (auto _ : state) {
    state.PauseTiming();
    // There and back, so that the sheets always overlap.
    step = (step + 1) % 64;
    sheets.move(k_step * sheets.size * std::min(step, 64 - step));
    state.ResumeTiming();
    kinematics.place(sheets.u);
  }
  state.SetComplexityN(state.range(0));
  state.SetItemsProcessed(state.iterations() * kinematics.n_points());
}

// The tree of as many faces, as it is built when the surface has moved beyond the margin.
void build_tree(benchmark::State& state) {
  const Sheets sheets(static_cast<int>(std::lround(std::sqrt(static_cast<double>(state.range(0))))));
  const std::vector<Face> faces = reference_faces(ContactSurface(sheets.mesh, "slave"));
  for (auto _ : state) {
    const SlidingSearch search(faces, sheets.size);
    benchmark::DoNotOptimize(&search);
  }
  state.SetComplexityN(state.range(0));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(faces.size()));
}

void rates(benchmark::State& state, bool smoothing) {
  Sheets sheets(100);
  const SlidingKinematics kinematics = sheets.kinematics(smoothing);
  ContactPointState old;
  old.anchored = true;
  old.master_normal = {0, 0, 1};
  old.traction = {1, 0, 0};
  std::vector<Tensor> tangent;
  for (auto _ : state)
    for (Index p = 0; p < kinematics.n_points(); ++p) {
      const PointMotion m = kinematics.motion(p, old, ContactKinematics::Asked::rates);
      if (!m.partnered) continue;
      tangent.assign(m.nodes.size() * m.nodes.size(), Tensor{});
      kinematics.add_geometric_tangent(p, 1, m.carried, tangent);
      benchmark::DoNotOptimize(tangent.data());
    }
  state.SetItemsProcessed(state.iterations() * kinematics.n_points());
}

}  // namespace

BENCHMARK_CAPTURE(place, closest_point, false)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oNLogN);
BENCHMARK_CAPTURE(place, averaged_normals, true)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oNLogN);
BENCHMARK(build_tree)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oNLogN);
BENCHMARK_CAPTURE(rates, closest_point, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rates, averaged_normals, true)->Unit(benchmark::kMillisecond);

}  // namespace solidus::contact

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (PetscInitialize(nullptr, nullptr, nullptr, nullptr) != 0) return 3;
  benchmark::RunSpecifiedBenchmarks();
  return PetscFinalize() == 0 ? 0 : 3;
}
