/// Heat into a rigid tool of given temperature, which has no mesh.
///
///   ┌──────────────┐ ───► v
///   │    block     │    Pressed on the plane y = 0 by δ from above.
///   └──────────────┘
///   ═══════════════════ tool, Θ_m
#include <gtest/gtest.h>

#include <cmath>

#include "contact/laws/power_contact.hpp"
#include "contact_bodies.hpp"
#include "coupling_bodies.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;

constexpr double k_width = 0.01, k_height = 0.02;  // [m]
constexpr double k_tool = 320;                     // Θ_m [K]
constexpr double k_conductance = 2e4;              // h [W/(m² K)]

contact::ContactParameters on_tool() {
  contact::ContactParameters s = test::interface();
  s.slave = "lower_y_min";
  s.master = "tool";
  s.formulation = contact::Formulation::large_sliding;
  s.integration = contact::IntegrationRule::gauss;
  s.rigid_master = contact::RigidSurface{.temperature = Table(k_tool)};
  s.heat = contact::HeatTransferSpec{};
  s.heat->contact_law = contact::contact_law(contact::PowerContact{k_conductance});
  return s;
}

Coupled block(double start) {
  Coupled c;
  const mesh::RawMesh raw =
      test::raw_blocks({{k_width, k_height}, {k_width, 0.001}, {2, 8}, {1, 1}, 0.01}, mesh::Shape::quad4);
  c.mesh = mesh::distribute(raw, {"lower"}, {"lower_y_min"});
  c.materials = {test::elastic(2e11, 0.0, 0, 40)};
  c.start = {start};
  c.hold("lower_top", 1, -1e-5);
  c.hold("lower_top", 0);
  return c;
}

TEST(RigidTool, CoolsABodyAsAFilmDoes) {
  for (const bool nodal : {true, false}) {
    Coupled c = block(900);
    c.integration = nodal ? heat::HeatIntegration::closed : heat::HeatIntegration::open;
    c.contact = on_tool();
    c.contact->nodal_heat = nodal;
    c.contact->heat->slave_emissivity = 0.6;
    c.contact->heat->master_emissivity = 1.0;
    Coupled film = block(900);
    film.integration = c.integration;
    film.thermal.films = {{"film", "lower_y_min", {k_conductance}, k_tool}};
    film.thermal.radiations = {{"radiation", "lower_y_min", {0.6}, k_tool}};
    const auto touched = verification::march(c, 2, 10), blown = verification::march(film, 2, 10);
    double heat = 0, expected = 0;
    for (std::size_t n = 0; n < touched.steps.size(); ++n) {
      heat += touched.steps[n].heat_in;
      expected += blown.steps[n].heat_in;
      EXPECT_DOUBLE_EQ(touched.steps[n].entropy_in, touched.steps[n].heat_in / k_tool)
          << "at the tool's temperature";
    }
    EXPECT_NEAR(heat, expected, 1e-9 * std::abs(expected));
    EXPECT_LT(touched.worst_defect(), 1e-9 * touched.exchanged());
    for (std::size_t i = 0; i < touched.end.heat.temperature.size(); ++i)
      EXPECT_NEAR(touched.end.heat.temperature[i], blown.end.heat.temperature[i], 1e-7);
  }
}

// In the end all heat of friction goes into the tool, through its half of the resistance, 1/(2 h).
TEST(RigidTool, TakesTheHeatOfFriction) {
  for (const Mapping mapping : {Mapping::isothermal, Mapping::isentropic}) {
    constexpr double end = 400, speed = 1e-3;
    Coupled c = block(k_tool);
    c.mechanical.displacements.pop_back();
    c.hold("lower_top", 0, Table({0, end}, {0, speed * end}));
    c.form = StructuralForm::energy;
    c.mapping = mapping;
    c.contact = on_tool();
    c.contact->friction = contact::FrictionParameters{};
    c.contact->friction->coefficient.terms = {Table(0.3)};
    double power = 0;
    const auto run =
        verification::march(c, end, 200, [&](const coupling::State&, const coupling::StepEffort& effort) {
          power = effort.energy.friction / (end / 200);
        });
    EXPECT_GT(power, 0);
    const double flux = power / k_width;
    // The slowest time constant is 18 s: 4 H²/(π² κ) of conduction and ρ c H/(2 h) of the interface.
    // Friction bends the block, so pressure and heat differ along it: half a percent at its edge.
    const double rise = flux / (2 * k_conductance);
    EXPECT_NEAR(run.end.heat.temperature[0], k_tool + rise, 1e-2 * rise);
    EXPECT_NEAR(run.steps.back().heat_in, -power * end / 200, 1e-6 * power * end / 200);
    for (const auto& step : run.steps)
      EXPECT_LT(std::abs(step.defect()), 1e-8 * (step.heat_exchanged + step.friction));
  }
}

}  // namespace
}  // namespace solidus
