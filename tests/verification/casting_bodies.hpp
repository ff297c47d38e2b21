/// Bodies for tests of the first law: a bar of varying moduli, and a casting that freezes in a mould.
#pragma once

#include "../unit/contact/bodies.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "coupling_bodies.hpp"

namespace solidus::verification {

/// A clamped bar in plane strain, of elastic constants that vary with temperature; one side is chilled while
/// an end is pulled out and pushed back.
inline Coupled bar() {
  Coupled c;
  c.mesh = test::make_mesh(
      {.shape = mesh::Shape::quad4, .cells = {8, 4, 1}, .size = {0.1, 0.05, 1}, .distortion = 0.1});
  material::Material m = test::elastic_material(2e11, 0.3);
  m.young_modulus = Table({300, 900}, {2e11, 1.2e11});
  m.expansion = Table({300, 900}, {1.1e-5, 1.5e-5});
  c.materials = {m};
  c.start = {800};
  c.hold("left", 0);
  c.hold("left", 1);
  c.hold("right", 0, Table({0, 8, 16}, {0, 1e-4, -5e-5}));
  c.thermal.films.push_back({"chill", "top", {4000.0}, Table({0, 16}, {800, 300})});
  return c;
}

/// A molten block stands on a cold one, freezes and shrinks: latent heat, straining, viscous dissipation in
/// the mushy zone, weight, and an interface that conducts by its gap. Its meshes do not match.
///
///   ┌──────────────┐ p   casting: 60 × 20 mm, symmetric on the left, 940 K
///   │              │
///   ├──────────────┤     heat through contact and gap
///   │    mould     │     60 × 30 mm, 500 K, stands on its bottom
///   └──────────────┘
inline Coupled casting(double pressure) {
  Coupled c;
  c.mesh = test::distribute_blocks(
      test::raw_blocks({{0.06, 0.03}, {0.06, 0.02}, {8, 4}, {9, 3}, 0.0}, mesh::Shape::quad4));
  material::Material steel = test::elastic_material(1.96e11, 0.3, 1.2e-5);
  steel.conductivity = 45.0;
  material::Material melt;
  melt.name = "aluminium";
  melt.density = 2650;
  melt.conductivity = Table({373, 932}, {234.0, 209.0});
  melt.specific_heat = Table({623, 932}, {1400.0, 1500.0});
  melt.young_modulus = Table({273, 932}, {69e9, 26e9});
  melt.poisson_ratio = 0.37;
  melt.expansion = 1.47e-5;
  melt.liquid_viscosity = 1e10;
  melt.phase_changes.push_back({.name = "freezing",
                                .fraction = material::PhaseFraction::linear(900, 932),
                                .latent_heat = 3.95e5,
                                .volume_change = -0.01,
                                .solidification = true});
  c.materials = {steel, melt};
  c.start = {500, 940};
  c.contact.emplace();
  c.contact->name = "interface";
  c.contact->slave = "upper_bottom";
  c.contact->master = "lower_top";
  c.contact->heat.emplace();
  c.contact->heat->contact_law = contact::contact_law(contact::PowerContact{3000});
  c.contact->heat->gap_law =
      contact::gap_law(contact::GasGap{.conductivity = 0.06, .open_conductance = 3000});
  c.mechanical.gravity = {0, -9.81, 0};
  for (const char* side : {"lower_x_min", "upper_x_min"}) c.hold(side, 0);
  c.hold("lower_y_min", 1);
  if (pressure > 0)
    c.mechanical.pressures.push_back({"upper_y_max", Table({0, 8}, {0, pressure})});
  else
    c.ambient = 500;  // the lowest temperature of an insulated pair; its weight is a dead load
  return c;
}

}  // namespace solidus::verification
