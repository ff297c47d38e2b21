/// A bar between two walls, cooled from the melt until it is cold: what stabilised tetrahedra and triangles
/// carry is what Q1/P0 hexahedra and quads carry.
///
///       ▒┌──────────────┐▒   60 × 20 × 20 mm (plane strain: 60 × 20), a quarter of a bar between smooth
///       walls,
///     ▒x │ 677 °C → cold│ ▒  film on the outer sides. It freezes from its skin, shrinks, yields and pulls at
///     the
///       ▒└──────────────┘▒   walls with its yield force.
#include <gtest/gtest.h>

#include "coupling_bodies.hpp"
#include "mesh/raw_mesh.hpp"
#include "plasticity_bodies.hpp"
#include "simplex_bodies.hpp"

namespace solidus {
namespace {

using verification::Coupled;
using verification::Element;

constexpr double k_length = 0.06, k_width = 0.02;  // [m]

material::Material aluminium() {
  material::Material m =
      verification::plastic_material(6e10, 0.35, Table({300, 800, 880}, {80e6, 10e6, 1e6}), 2e-5);
  m.young_modulus = Table({300, 880}, {7e10, 2e10});
  m.density = 2500;
  m.conductivity = 150.0;
  m.specific_heat = 1000.0;
  m.liquid_viscosity = 1e7;
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(860, 900),
                             .latent_heat = 4e5,
                             .volume_change = -0.05,
                             .solidification = true});
  return m;
}

Coupled bar(const Element& element, mechanics::Mapping mapping) {
  const bool solid = mesh::dimension(element.shape) == 3;
  Coupled c;
  c.mesh = test::make_mesh({.shape = element.shape,
                            .cells = {solid ? 9 : 18, solid ? 4 : 8, 4},
                            .size = {k_length, k_width, k_width}});
  c.kind = solid ? AnalysisKind::solid : AnalysisKind::plane_strain;
  c.materials = {aluminium()};
  c.start = {950};
  c.form = mechanics::StructuralForm::energy;
  c.mapping = mapping;
  c.mechanics_tolerance = 1e-5;
  c.simplices = element.simplices;
  c.stabilisation = element.stabilisation;
  for (const char* wall : {"left", "right"}) c.hold(wall, 0);
  c.hold("bottom", 1);
  c.thermal.films.push_back({"top", "top", {2000.0}, Table(320.0)});
  if (solid) {
    c.hold("back", 2);
    c.thermal.films.push_back({"front", "front", {2000.0}, Table(320.0)});
  }
  return c;
}

/// The force on the right wall over its area, and the mean axial stress of the bar, after every step [Pa].
struct History {
  std::vector<double> pull, mean_stress, solid;
};

History cool(const Element& element, mechanics::Mapping mapping) {
  constexpr int n_steps = 40;
  constexpr double dt = 2;
  const Coupled c = bar(element, mapping);
  verification::Assembly assembly(c, n_steps * dt);
  History history;
  coupling::State state = assembly.start();
  assembly.scheme().synchronise(state);
  const auto components = static_cast<std::size_t>(assembly.mechanics().bodies().components);
  const verification::Cells cells(c.mesh, c.mesh.blocks[0], c.kind);
  for (int n = 1; n <= n_steps; ++n) {
    coupling::State trial;
    const coupling::StepEffort effort = assembly.advance(state, trial, n * dt, dt);
    state = std::move(trial);
    double force = 0;
    for (const Index node : c.mesh.surfaces.at("right").nodes)
      force += effort.fields.reactions[static_cast<std::size_t>(node) * components];
    history.pull.push_back(force / (components == 3 ? k_width * k_width : k_width));
    std::vector<double> axial;
    const test::ElementFields fields = test::element_fields(assembly.mechanics().mesh(), state.mechanics)[0];
    for (const auto& stress : fields.stress) axial.push_back(stress[0]);
    history.mean_stress.push_back(cells.mean(axial));
    history.solid.push_back(assembly.heat().states().mean_solid_fraction(state.heat));
  }
  return history;
}

// From where a tenth of the final force is there on: before, the force of a shell that is a row of elements
// thick depends on the mesh.
TEST(BarFromMeltToSolid, PullsWithStabilisedSimplicesAsWithHexesAndQuads) {
  struct Case {
    Element element, reference;
  };
  const std::vector<Case> cases{{verification::k_tet4, verification::k_hex8},
                                {verification::k_tet4_algebraic, verification::k_hex8},
                                {verification::k_tri3, verification::k_quad4},
                                {verification::k_tri3_algebraic, verification::k_quad4}};
  for (const mechanics::Mapping mapping : {mechanics::Mapping::isothermal, mechanics::Mapping::isentropic}) {
    const bool isothermal = mapping == mechanics::Mapping::isothermal;
    std::map<std::string, History> known;
    const auto history = [&](const Element& element) -> const History& {
      auto found = known.find(element.name);
      if (found == known.end()) found = known.emplace(element.name, cool(element, mapping)).first;
      return found->second;
    };
    for (const Case& c : cases) {
      const History &simplex = history(c.element), &reference = history(c.reference);
      const std::size_t last = simplex.pull.size() - 1;
      double worst = 0;
      for (std::size_t n = 0; n <= last; ++n)
        worst = std::max(worst, std::abs(simplex.pull[n] - reference.pull[n]) / reference.pull[last]);
      const double end = simplex.pull[last] / reference.pull[last] - 1;
      printf(
          "%s, %-16s against %-6s: end %.3f and %.3f MPa (%+.2f %%), mean stress %+.2f %%, worst %.2f %%\n",
          isothermal ? "isothermal" : "isentropic", c.element.name, c.reference.name,
          1e-6 * simplex.pull[last], 1e-6 * reference.pull[last], 100 * end,
          100 * (simplex.mean_stress[last] / reference.mean_stress[last] - 1), 100 * worst);
      EXPECT_NEAR(simplex.solid[last], 1, 1e-12);
      EXPECT_LT(std::abs(end), 0.01) << c.element.name;
      EXPECT_NEAR(simplex.mean_stress[last] / reference.mean_stress[last], 1, 0.01) << c.element.name;
      // The algebraic stabilisation of tetrahedra holds gradients of the pressure in a shell of one row.
      EXPECT_LT(worst, c.element.name == verification::k_tet4_algebraic.name ? 0.05 : 0.02) << c.element.name;
    }
    if (!isothermal) continue;
    auto out =
        verification::table("simplex_bar", "time[s],solid fraction,hex8,tet4_orthogonal,tet4_algebraic");
    for (std::size_t n = 0; n < history(verification::k_hex8).pull.size(); ++n)
      out << 2.0 * static_cast<double>(n + 1) << "," << history(verification::k_hex8).solid[n] << ","
          << 1e-6 * history(verification::k_hex8).pull[n] << ","
          << 1e-6 * history(verification::k_tet4).pull[n] << ","
          << 1e-6 * history(verification::k_tet4_algebraic).pull[n] << "\n";
  }
}

}  // namespace
}  // namespace solidus
