/// Elements get the stress of their middle; what cannot start with a stress is refused before a file is read.
#include "setup/initial_stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/roles.hpp"
#include "mesh/nearest_point.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/formats/stress_reader.hpp"
#include "setup/place_input.hpp"
#include "system/common_failure.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

using Components = std::array<const std::optional<Function>*, 6>;

Components components_of(const cases::InitialStressSpec& s) {
  return {&s.xx, &s.yy, &s.zz, &s.xy, &s.yz, &s.xz};
}

/// Refuses bodies that cannot start with a stress (no mechanics, inertia, metal that is not solid), and input
/// that is doubled or missing.
void check(const cases::CaseSpec& spec, const cases::BodySpec& body, const material::Material& material,
           const InitialTemperatureRange& start) {
  const cases::InitialStressSpec& s = *body.initial_stress;
  const auto refuse = [&](const std::string& why, const std::string& allowed) {
    throw InputError(s.where, fmt::format("the initial stress of '{}': {}", body.name, why), allowed);
  };
  if (!spec.has_mechanics() || cases::only_conducts(body))
    refuse("the body does not deform", "physics that has mechanics");
  if (spec.dynamics) refuse("a run with inertia cannot start with a stress yet", "no [dynamics]");
  if (const auto* change = material.solidification();
      change != nullptr && start.high > change->fraction.solidus())
    refuse(fmt::format("the body starts at {:.4g} K, above its solidus of {:.4g} K", start.high,
                       change->fraction.solidus()),
           "solid metal");
  // Components, or a file that has them.
  const Components all = components_of(s);
  const bool any = std::ranges::any_of(all, [](const auto* c) { return c->has_value(); });
  if (any == !s.file.empty())
    refuse(any ? "both a file and components are given" : "neither a file nor a component is given",
           "file = \"fields.vtu\", or xx, yy, zz, xy, yz, xz");
  if (spec.analysis.kind != AnalysisKind::solid && (s.yz || s.xz))
    refuse("yz and xz are zero in this analysis", "xx, yy, zz, xy");
}

/// Elements have one stress: that of the mean of their vertices.
std::vector<Position> middles(const mesh::Mesh& mesh, const mesh::ElementBlock& block) {
  std::vector<Position> x(as_size(block.size()));
  const int n = mesh::vertex_count(block.shape);
  for (Index e = 0; e < block.size(); ++e)
    for (int a = 0; a < n; ++a)
      for (std::size_t i = 0; i < 3; ++i)
        x[as_size(e)][i] += mesh.x[as_size(block.element(e)[a])][i] / static_cast<double>(n);
  return x;
}

/// The values of functions at the middles of elements.
std::vector<double> of_functions(const cases::InitialStressSpec& s, std::span<const Position> x,
                                 AnalysisKind kind) {
  std::vector<double> stress(6 * x.size(), 0.0), values(x.size());
  const Components all = components_of(s);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!*all[k]) continue;
    place_function(**all[k], cases::TimeOrigin::run, nullptr, kind).values(x, 0, values);
    for (std::size_t e = 0; e < x.size(); ++e) stress[6 * e + k] = values[e];
  }
  return stress;
}

/// A file with a search for its places.
class StressFile {
 public:
  explicit StressFile(const cases::InitialStressSpec& s)
      : read_(results::read_stress(s.file, s.field, s.body, s.length_unit.empty() ? 1.0 : in_metres(s),
                                   s.where)),
        nearest_(read_.x) {
    // The unit of the case takes precedence over that of the file; a file without one is in pascals.
    const std::string unit = !s.unit.empty() ? s.unit : read_.unit.empty() ? "Pa" : read_.unit;
    try {
      conversion_ = units::conversion(unit, "Pa");
    } catch (const std::invalid_argument& error) {
      throw InputError(s.where, fmt::format("the unit of the stress: {}", error.what()));
    }
  }
  /// The stress of the nearest place of the file, and how far away that was at most.
  std::vector<double> at(std::span<const Position> x) {
    std::vector<double> stress(6 * x.size());
    for (std::size_t e = 0; e < x.size(); ++e) {
      const std::size_t place = nearest_.find(x[e]);
      double squares = 0;
      for (std::size_t i = 0; i < 3; ++i) squares += std::pow(x[e][i] - read_.x[place][i], 2);
      farthest_ = std::max(farthest_, std::sqrt(squares));
      for (std::size_t k = 0; k < 6; ++k) stress[6 * e + k] = conversion_(read_.values[place][k]);
    }
    return stress;
  }
  double farthest() const { return farthest_; }  ///< from an element to its place of the file [m]

 private:
  static double in_metres(const cases::InitialStressSpec& s) {
    try {
      return units::convert(1.0, s.length_unit, "m");
    } catch (const std::invalid_argument& error) {
      throw InputError(s.where, fmt::format("length_unit of the stress: {}", error.what()));
    }
  }
  results::ReadStress read_;
  mesh::NearestPoint nearest_;
  units::Conversion conversion_;
  double farthest_ = 0;
};

void fill(const cases::InitialStressSpec& s, const mesh::Mesh& mesh, int body, AnalysisKind kind,
          std::vector<std::vector<double>>& stress) {
  std::optional<StressFile> file;
  // A file that only one process cannot read has to end the run on all of them.
  run_collectively([&] {
    if (!s.file.empty()) file.emplace(s);
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      if (mesh.blocks[b].body != body) continue;
      const std::vector<Position> x = middles(mesh, mesh.blocks[b]);
      stress[b] = file ? file->at(x) : of_functions(s, x, kind);
    }
  });
  if (file)
    logging::info("stress of '{}': elements have that of the nearest place of '{}', {:.3g} m away at most",
                  mesh.bodies[as_size(body)].name, s.file, parallel::global_max(file->farthest()));
}

}  // namespace

std::vector<std::vector<double>> initial_stress(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                                const std::vector<material::Material>& materials,
                                                const std::vector<InitialTemperatureRange>& start) {
  std::vector<std::vector<double>> stress;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (!spec.bodies[b].initial_stress) continue;
    check(spec, spec.bodies[b], materials[b], start[b]);
    stress.resize(mesh.blocks.size());
    fill(*spec.bodies[b].initial_stress, mesh, static_cast<int>(b), spec.analysis.kind, stress);
  }
  return stress;
}

}  // namespace solidus::setup
