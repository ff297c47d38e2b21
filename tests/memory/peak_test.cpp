/// Memory a node at its greatest while a run of heat is set up and takes a step: what is made on the way,
/// lists of elements, geometry and rows of the pattern, must not exceed what the run keeps by much.
///
/// All that `new` gives is counted, the vectors of the linear solver included.
#include <gtest/gtest.h>

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <new>
#include <utility>

#include "check/body_measures.hpp"
#include "heat/thermal_phase.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/parts/distribute.hpp"

namespace {

std::size_t held = 0, most_held = 0;  // [bytes]

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  held += malloc_usable_size(memory);
  most_held = std::max(most_held, held);
  return memory;
}

void uncounted(void* memory) {
  if (memory != nullptr) held -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(std::malloc(std::max<std::size_t>(size, 1)));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {  // as std::stable_sort asks for it
  void* memory = std::malloc(std::max<std::size_t>(size, 1));
  return memory == nullptr ? nullptr : counted(memory);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* memory) noexcept {
  uncounted(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  uncounted(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  uncounted(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  uncounted(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  uncounted(memory);
}

namespace solidus {
namespace {

constexpr int k_divisions = 36;
constexpr double k_nodes = (k_divisions + 1.0) * (k_divisions + 1.0) * (k_divisions + 1.0);

/// The most that is held within the work, less what is held before it [bytes a node].
double most_by(const std::function<void()>& work) {
  const std::size_t before = held;
  most_held = held;
  work();
  return (static_cast<double>(most_held) - static_cast<double>(before)) / k_nodes;
}

mesh::RawMesh tetrahedra() {
  return mesh::make_block({{0.1, 0.1, 0.1}, {}, {k_divisions, k_divisions, k_divisions}, "block"},
                          mesh::Shape::tet4);
}

/// An alloy that freezes over 40 K, 100 W/(m K).
material::Material alloy() {
  material::Material m;
  m.name = "alloy";
  m.density = 2500;
  m.conductivity = Table(100.0);
  m.specific_heat = Table(1000.0);
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(860, 900), 4e5, 0.0, true}};
  return m;
}

TEST(Memory, CuttingAMeshTakesLessThanThreeMeshes) {
  mesh::RawMesh raw = tetrahedra();
  mesh::Mesh mesh;
  const double most = most_by([&] { mesh = mesh::distribute(std::move(raw), {"block"}, {}, {}); });
  EXPECT_TRUE(raw.x.empty());
  EXPECT_EQ(mesh.x.size(), static_cast<std::size_t>(k_nodes));
  EXPECT_LT(most, 480) << "bytes a node besides the mesh as it was made, 165";
}

TEST(Memory, MeasuringBodiesLooksAtAPartOfTheirElements) {
  const mesh::Mesh mesh = mesh::distribute(tetrahedra(), {"block"}, {}, {});
  std::vector<check::BodyMeasures> measures;
  const double most = most_by([&] { measures = check::measure_bodies(mesh, AnalysisKind::solid); });
  EXPECT_NEAR(measures[0].volume, 1e-3, 1e-15);
  EXPECT_NEAR(measures[0].skin, 0.06, 1e-12);
  EXPECT_LT(most, 220);  // of their faces a portion of the nodes, too, 275 bytes each
}

TEST(Memory, HeatIsSetUpAndStepsWithWhatItKeeps) {
  const mesh::Mesh mesh = mesh::distribute(tetrahedra(), {"block"}, {}, {});
  heat::ThermalConditions conditions;
  conditions.films.push_back({"cooling", "x_min", {Table(3000.0)}, Table(300.0)});
  std::unique_ptr<heat::ThermalPhase> phase;
  heat::HeatOptions options;
  options.alone = true;
  const double to_build = most_by([&] {
    phase = std::make_unique<heat::ThermalPhase>(mesh, AnalysisKind::solid, std::vector{alloy()}, conditions,
                                                 options);
  });
  heat::ThermalState state = phase->states().initial(std::vector{950.0});
  const double to_step = most_by(
      [&] { phase->solve(state, state, {.time = 2, .dt = 2, .stepping = heat::ThermalStepping::sdirk2}); });
  RecordProperty("to_build", std::to_string(to_build));
  RecordProperty("to_step", std::to_string(to_step));
  EXPECT_LT(to_build, 175);
  EXPECT_LT(to_step, 170);
}

}  // namespace
}  // namespace solidus
