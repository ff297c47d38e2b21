#include "heat/loads/surface_heats.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"

namespace solidus::heat {

SurfaceHeats::SurfaceHeats(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                           bool closed, const ThermalConditions& conditions) {
  // Fluxes, films and radiation have one kind of object, whose law differs.
  const auto add = [&](const auto& condition) {
    surfaces_.emplace_back(mesh, kind,
                           active.part(mesh, named_group(mesh.surfaces, condition.surface, "surface")),
                           condition.name, SurfaceLaw(condition), closed);
  };
  for (const Flux& flux : conditions.fluxes) add(flux);
  for (const Film& film : conditions.films) add(film);
  for (const Radiation& radiation : conditions.radiations) add(radiation);
  powers_.resize(surfaces_.size());
}

void SurfaceHeats::bind(const linear::BlockMatrix& matrix) {
  for (SurfaceHeat& surface : surfaces_) surface.bind(matrix);
}

void SurfaceHeats::add_residual(std::span<const double> temperature, std::span<double> out, double& moved) {
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
    powers_[s] = surfaces_[s].add_residual(temperature, out, moved);
}

double SurfaceHeats::add_residual_of(std::size_t surface, std::span<const double> temperature,
                                     std::span<double> out) const {
  double moved = 0;
  return surfaces_[surface].add_residual(temperature, out, moved);
}

void SurfaceHeats::add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const {
  for (const SurfaceHeat& surface : surfaces_) surface.add_tangent(temperature, matrix);
}

void SurfaceHeats::clear_powers() {
  std::fill(powers_.begin(), powers_.end(), 0.0);
}

std::vector<NamedPower> SurfaceHeats::powers() const {
  std::vector<NamedPower> all;
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
    all.push_back({surfaces_[s].name(), parallel::global_sum(powers_[s])});
  return all;
}

bool placed(const SurfaceHeats& surfaces) {
  return std::ranges::any_of(surfaces.each(), [](const SurfaceHeat& s) { return s.law().placed(); });
}

bool diagonal(const SurfaceHeats& surfaces) {
  return std::ranges::all_of(surfaces.each(), [](const SurfaceHeat& s) { return s.diagonal(); });
}

double lasting(const SurfaceHeats& surfaces, double from, double to) {
  double longest = HUGE_VAL;
  for (const SurfaceHeat& surface : surfaces.each()) longest = std::min(longest, surface.lasting(from, to));
  return longest;
}

}  // namespace solidus::heat
