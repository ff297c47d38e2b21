/// A column of melt that freezes from below under its own weight, followed by the strain criteria.
///
///   ▒│≈≈≈≈│▒   60 mm wide, 80 mm high, smooth walls that conduct no heat, chilled bottom, both splits.
///   ▒│melt│▒   Between the walls strains are uniaxial: ε_yy = e^θ + p/k, and so closed forms of the strain
///   in ▒│────│▒   the melt and since coherency are known from the temperatures, ▒└────┘▒ strain_in_liquid =
///   ⅔ |e^θ(Θ_c)|,   strain_since_coherency = ⅔ |e^θ(Θ) − e^θ(Θ_c)|,
///    chilled     Θ_c the temperature of the step in which the element became coherent.
#include <gtest/gtest.h>

#include "criteria/strain_criteria.hpp"
#include "freezing_column.hpp"
#include "material/elasticity.hpp"

namespace solidus {
namespace {

using verification::Coupled;
using verification::Element;
using verification::k_column_height;
using verification::k_gravity;
using verification::k_poured_at;

/// e^θ of the law, from the temperature at the start.
double thermal_strain(const material::Material& m, double temperature) {
  return material::properties_at(m, temperature, k_poured_at).thermal_strain;
}

struct Pour {
  double early_pressure = 0;        ///< largest error of the melt's pressure in the first step, over ρ g H
  double in_liquid = 0, since = 0;  ///< errors of the mean strains at the end, over those of the closed form
  double scatter = 0;  ///< root mean square of the difference of single elements, of strain in the melt
  double sinking = 0;  ///< error of the sinking of the surface, over that of the closed form
  double most_in_liquid = 0, most_since = 0, most_brittle = 0, most_distortion = 0;
  double solid = 0;
  double defect = 0;  ///< of the first law, over the heat moved
};

Pour pour(const Element& element, mechanics::Mapping mapping, const Table& viscosity = 1e7) {
  constexpr int n_steps = 60;
  constexpr double dt = 2;
  const bool is_solid = mesh::dimension(element.shape) == 3;
  const Coupled c = verification::freezing_column(
      element, mapping, is_solid ? std::array{3, 8, 3} : std::array{6, 16, 3}, viscosity);
  verification::Assembly assembly(c, n_steps * dt);
  const material::Material& metal = c.materials[0];
  criteria::StrainCriteria strains(c.mesh, c.mesh, c.kind, c.materials);
  coupling::State state = assembly.start();
  assembly.scheme().synchronise(state);
  criteria::CriterionRecord record = strains.initial({0, state.heat, state.mechanics});
  const mesh::ElementBlock& block = c.mesh.blocks[0];
  const verification::Cells cells(c.mesh, block, c.kind);
  const std::size_t n_elements = cells.volume.size();
  const auto mean = [&](const std::vector<double>& nodal, std::size_t e) {
    double sum = 0;
    const int n = mesh::node_count(block.shape);
    for (int a = 0; a < n; ++a)
      sum += nodal[static_cast<std::size_t>(block.element(static_cast<Index>(e))[a])] / n;
    return sum;
  };

  Pour result;
  double defect = 0, moved = 0;
  // The strain follows the temperature of t_n: that of the last step that began as melt, and of the last one.
  std::vector<double> at_coherency(n_elements, k_poured_at), last(n_elements, k_poured_at);
  for (int n = 1; n <= n_steps; ++n) {
    coupling::State trial;
    const coupling::StepEffort effort = assembly.advance(state, trial, n * dt, dt);
    strains.step({state.time, state.heat, state.mechanics}, {trial.time, trial.heat, trial.mechanics},
                 record);
    defect += effort.energy.defect();
    moved += effort.energy.heat_exchanged;
    for (std::size_t e = 0; e < n_elements; ++e) {
      last[e] = mean(state.heat.temperature, e);
      if (metal.solid_fraction(last[e]) < metal.casting.coherency_fraction) at_coherency[e] = last[e];
    }
    if (n == 1) {
      const std::vector<double> pressure =
          test::element_fields(assembly.mechanics().mesh(), trial.mechanics)[0].pressure;
      const double weight = metal.density * k_gravity;
      for (std::size_t e = 0; e < n_elements; ++e)
        result.early_pressure = std::max(
            result.early_pressure,
            std::abs(pressure[e] / weight - (k_column_height - cells.centre[e][1])) / k_column_height);
    }
    state = std::move(trial);
  }
  std::vector<double> in_liquid(n_elements), since(n_elements), brittle(n_elements),
      distortion(state.mechanics.displacement.size());
  const std::vector<std::span<double>> fields{in_liquid, since, brittle, distortion};
  strains.fill({state.time, state.heat, state.mechanics}, record, fields);
  const auto all_finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  };
  for (const auto& values : {in_liquid, since, brittle, distortion, state.mechanics.displacement})
    EXPECT_TRUE(all_finite(values));
  std::vector<double> exact_in_liquid, exact_since, difference, volume_change;
  for (std::size_t e = 0; e < n_elements; ++e) {
    const double melt = thermal_strain(metal, at_coherency[e]), now = thermal_strain(metal, last[e]);
    exact_in_liquid.push_back(2.0 / 3 * std::abs(melt));
    exact_since.push_back(2.0 / 3 * std::abs(now - melt));
    difference.push_back(in_liquid[e] - exact_in_liquid.back());
    volume_change.push_back(now);
    result.most_in_liquid = std::max(result.most_in_liquid, in_liquid[e]);
    result.most_since = std::max(result.most_since, since[e]);
    result.most_brittle = std::max(result.most_brittle, brittle[e]);
  }
  result.in_liquid = std::abs(cells.mean(in_liquid) / cells.mean(exact_in_liquid) - 1);
  result.since = std::abs(cells.mean(since) / cells.mean(exact_since) - 1);
  result.scatter = cells.spread(difference);
  double sinking = 0;
  const std::vector<Index>& surface = c.mesh.surfaces.at("top").nodes;
  const auto components = static_cast<std::size_t>(assembly.mechanics().bodies().components);
  for (const Index node : surface)
    sinking += state.mechanics.displacement[static_cast<std::size_t>(node) * components + 1] /
               static_cast<double>(surface.size());
  result.sinking = std::abs(sinking / (cells.mean(volume_change) * k_column_height) - 1);
  for (const double u : distortion) result.most_distortion = std::max(result.most_distortion, std::abs(u));
  result.solid = assembly.heat().states().mean_solid_fraction(state.heat);
  result.defect = std::abs(defect) / moved;
  return result;
}

TEST(FreezingMeltColumn, IsHydrostaticFirstAndKeepsTheStrainOfTheMeltApartFromThatOfTheSolid) {
  for (const mechanics::Mapping mapping : {mechanics::Mapping::isothermal, mechanics::Mapping::isentropic})
    for (const Element& element :
         {verification::k_quad4, verification::k_tri3, verification::k_tri3_algebraic, verification::k_tet4,
          verification::k_tet4_algebraic}) {
      const bool simplex = element.shape == mesh::Shape::tri3 || element.shape == mesh::Shape::tet4;
      const Pour p = pour(element, mapping);
      printf(
          "%s, %-16s: first pressure off by %.1e, solid %.3f; mean strain in liquid off by %.1f %%, since "
          "coherency %.1f %%, scatter %.1e, sinking %.2f %%; most in liquid %.4f, since %.4f, brittle %.4f, "
          "distortion %.3f mm, first law %.1e\n",
          mapping == mechanics::Mapping::isothermal ? "isothermal" : "isentropic", element.name,
          p.early_pressure, p.solid, 100 * p.in_liquid, 100 * p.since, p.scatter, 100 * p.sinking,
          p.most_in_liquid, p.most_since, p.most_brittle, 1e3 * p.most_distortion, p.defect);
      EXPECT_LT(p.defect, 1e-8) << element.name;
      EXPECT_GT(p.solid, 0.3) << element.name;
      // The surface sinks by what the metal shrinks, whatever single elements do.
      EXPECT_LT(p.sinking, element.shape == mesh::Shape::tet4 ? 0.03 : 0.02) << element.name;
      if (simplex) {
        EXPECT_LT(p.early_pressure, 1e-4) << element.name;
      }
    }
}

// With the melt and the mush of the program an open column sinks by what it shrinks: melt flows down between
// the dendrites that the walls hold.
TEST(FreezingMeltColumn, OfTheProgramsMeltIsFedBetweenItsDendrites) {
  for (const Element& element : {verification::k_tri3, verification::k_tet4}) {
    const Pour p = pour(element, mechanics::Mapping::isentropic, Table{});
    printf("%-16s: solid %.3f, sinking %.2f %% off, first law %.1e\n", element.name, p.solid, 100 * p.sinking,
           p.defect);
    EXPECT_LT(p.defect, 1e-8) << element.name;
    EXPECT_LT(p.early_pressure, 1e-4) << element.name;
    EXPECT_LT(p.sinking, 0.06) << element.name;
  }
}

}  // namespace
}  // namespace solidus
