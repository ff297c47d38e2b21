/// A column of melt that freezes from below under its own weight: 60 mm wide, 80 mm high, smooth walls that
/// conduct no heat, a chilled bottom.
#pragma once

#include <array>

#include "coupling_bodies.hpp"
#include "plasticity_bodies.hpp"
#include "simplex_bodies.hpp"

namespace solidus::verification {

inline constexpr double k_column_width = 0.06, k_column_height = 0.08;  // [m]
inline constexpr double k_gravity = 9.81;
inline constexpr double k_poured_at = 950, k_solidus = 860, k_liquidus = 900;  // [K]

/// @param viscosity  of the melt [Pa s]; an empty table: the program chooses it, and pores may open
inline material::Material column_metal(const Table& viscosity = 1e7) {
  material::Material m = plastic_material(6e10, 0.35, Table({300, 800, 880}, {80e6, 10e6, 1e6}), 2e-5);
  m.density = 2500;
  m.conductivity = 100.0;
  m.specific_heat = 1000.0;
  m.liquid_viscosity = viscosity;
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(k_solidus, k_liquidus),
                             .latent_heat = 4e5,
                             .volume_change = -0.05,
                             .solidification = true});
  return m;
}

/// @param cells  the third number with tetrahedra and hexahedra alone
inline Coupled freezing_column(const Element& element, mechanics::Mapping mapping, std::array<int, 3> cells,
                               const Table& viscosity = 1e7) {
  const bool solid = mesh::dimension(element.shape) == 3;
  Coupled c;
  c.mesh = test::make_mesh({.shape = element.shape,
                            .cells = cells,
                            .size = {k_column_width, k_column_height, k_column_width},
                            .distortion = 0.1});
  c.kind = solid ? AnalysisKind::solid : AnalysisKind::plane_strain;
  c.materials = {column_metal(viscosity)};
  c.start = {k_poured_at};
  c.form = mechanics::StructuralForm::energy;
  c.mapping = mapping;
  c.mechanics_tolerance = 1e-5;
  c.simplices = element.simplices;
  c.stabilisation = element.stabilisation;
  for (const char* wall : {"left", "right"}) c.hold(wall, 0);
  c.hold("bottom", 1);
  if (solid)
    for (const char* wall : {"back", "front"}) c.hold(wall, 2);
  c.mechanical.gravity = {0, -k_gravity, 0};
  c.thermal.films.push_back({"chill", "bottom", {5000.0}, Table(300.0)});
  return c;
}

}  // namespace solidus::verification
