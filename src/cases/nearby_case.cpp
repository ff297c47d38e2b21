/// A neighbouring case differs in the few keys that set steps or elements, which are overridden by text.
#include "cases/nearby_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace solidus::cases {

namespace {

void set_length(NearbyCase& made, const std::string& key, double metres) {
  made.overrides.push_back(fmt::format("mesh.{}={} m", key, metres));
}

void set_divisions(NearbyCase& made, const std::string& key, const std::vector<int>& divisions,
                   double factor) {
  std::vector<int> fewer;
  for (const int n : divisions) fewer.push_back(std::max(1, static_cast<int>(std::lround(n / factor))));
  made.overrides.push_back(fmt::format("mesh.{}=[{}]", key, fmt::join(fewer, ", ")));
}

void coarsen_shape(NearbyCase& made, const MeshSpec& mesh, double factor) {
  if (mesh.cylinder_in_mould) {
    set_length(made, "cylinder_in_mould.element_size", factor * mesh.cylinder_in_mould->element_size);
    set_length(made, "cylinder_in_mould.mould_element_size",
               factor * mesh.cylinder_in_mould->mould_element_size);
  }
  if (mesh.block) set_divisions(made, "block.divisions", mesh.block->divisions, factor);
  if (mesh.two_blocks) {
    set_divisions(made, "two_blocks.lower_divisions", mesh.two_blocks->lower_divisions, factor);
    set_divisions(made, "two_blocks.upper_divisions", mesh.two_blocks->upper_divisions, factor);
  }
}

void coarsen_sizes(NearbyCase& made, const MeshSpec& mesh, double factor) {
  for (std::size_t i = 0; i < mesh.sizes.size(); ++i) {
    const MeshSizeSpec& size = mesh.sizes[i];
    const std::string key = fmt::format("size.{}.", i + 1);
    set_length(made, key + "size", factor * size.size);
    if (size.smallest) set_length(made, key + "smallest", factor * *size.smallest);
    made.overrides.push_back(fmt::format("mesh.{}across={}", key, size.across / factor));
  }
  for (std::size_t i = 0; i < mesh.layers.size(); ++i)
    if (mesh.layers[i].first)
      set_length(made, fmt::format("layers.{}.first", i + 1), factor * *mesh.layers[i].first);
}

}  // namespace

NearbyCase longer_steps(const CaseSpec& spec, double displacement_error) {
  constexpr double k_steps = 2, k_errors = k_steps * k_steps;  // local errors grow with the step squared
  const TimeSpec& t = spec.time;
  NearbyCase made;
  if (t.steady) {
    made.why_not = "a steady case has no steps";
    return made;
  }
  // Steps that must meet outputs are no longer than the time between them.
  if (t.end) made.overrides.push_back(fmt::format("output.every={} s", *t.end));
  // Adaptive steps get larger errors, as much as twice the step makes of them; fixed steps become twice as
  // long.
  if (t.adaptive && t.error_control != coupling::ErrorControl::none) {
    constexpr double k_default_largest = 10;  // times the first step (coupling::StepOptions::largest)
    if (t.max_step || t.step)
      made.overrides.push_back(fmt::format(
          "time.max_step={} s", k_steps * t.max_step.value_or(k_default_largest * t.step.value_or(0))));
    if (spec.has_heat()) {
      made.overrides.push_back(
          fmt::format("time.temperature_error={} K", k_errors * t.temperature_error.value_or(1.0)));
      if (t.solid_fraction_change || !spec.has_mechanics())
        made.overrides.push_back(fmt::format("time.solid_fraction_change={}",
                                             std::min(1.0, k_steps * t.solid_fraction_change.value_or(0.1))));
    }
    // Shares of the casting and of its skin that are not given follow the error of the displacement.
    if (t.skin_change)
      made.overrides.push_back(fmt::format("time.skin_change={}", std::min(1.0, k_steps * *t.skin_change)));
    if (spec.has_mechanics()) {
      made.overrides.push_back(fmt::format("time.displacement_error={} m", k_errors * displacement_error));
      made.overrides.push_back(
          fmt::format("time.stress_error={}", k_errors * t.stress_error.value_or(0.005)));
    }
    return made;
  }
  if (spec.stages.empty())
    made.overrides.push_back(fmt::format("time.step={} s", std::min(k_steps * *t.step, *t.end)));
  else if (t.step)
    made.overrides.push_back(fmt::format("time.step={} s", k_steps * *t.step));
  for (const StageSpec& stage : spec.stages) {
    if (stage.step)
      made.overrides.push_back(
          fmt::format("stage.{}.step={} s", stage.name, std::min(k_steps * *stage.step, stage.duration)));
    if (stage.steps)
      made.overrides.push_back(fmt::format("stage.{}.steps={}", stage.name, std::max(1, *stage.steps / 2)));
  }
  return made;
}

NearbyCase coarser_mesh(const CaseSpec& spec, bool from_geometry) {
  const MeshSpec& mesh = spec.mesh;
  // In three dimensions elements are many, so that they are made coarser by less.
  const double factor = spec.analysis.kind == AnalysisKind::solid ? 1.5 : 2.0;
  NearbyCase made;
  // A mesh that the run refines has its coarser neighbour in itself: the same with one halving less.
  if (mesh.refine > 0) {
    made.overrides.push_back(fmt::format("mesh.refine={}", mesh.refine - 1));
    return made;
  }
  coarsen_shape(made, mesh, factor);
  coarsen_sizes(made, mesh, factor);
  if (mesh.element_size) set_length(made, "element_size", factor * *mesh.element_size);
  // A geometry that gives its sizes itself is meshed with larger ones; of a mesh there is no coarser one.
  if (made.overrides.empty() && from_geometry)
    made.overrides.push_back(fmt::format("mesh.size_factor={}", factor * mesh.size_factor));
  if (made.overrides.empty())
    made.why_not = fmt::format(
        "'{}' holds a mesh, of which the program makes no coarser one; with mesh.refine = 1 it halves the "
        "elements and compares the two",
        mesh.file.value_or(mesh.shape.value_or("")));
  return made;
}

}  // namespace solidus::cases
