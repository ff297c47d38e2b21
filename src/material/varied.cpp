/// One row for each property that may vary; keys, spreads and the change itself are read from the rows.
#include "material/varied.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "material/laws/hardening_law.hpp"
#include "material/laws/kinematic_law.hpp"
#include "material/laws/perzyna.hpp"
#include "material/laws/rate_law.hpp"

namespace solidus::material {
namespace {

bool always(const Material&) {
  return true;
}
bool deforms(const Material& m) {
  return m.mechanical();
}
bool changes(const Material& m) {
  return !m.phase_changes.empty();
}
bool gives_off_latent_heat(const Material& m) {
  return std::any_of(m.phase_changes.begin(), m.phase_changes.end(),
                     [](const PhaseChange& change) { return change.latent_heat > 0; });
}
bool changes_its_volume(const Material& m) {
  return std::any_of(m.phase_changes.begin(), m.phase_changes.end(), [](const PhaseChange& change) {
    return change.volume_change < 0 || change.volume_change > 0;
  });
}
bool yields(const Material& m) {
  return m.flow.has_value();
}
/// A viscosity of its own; without one the flow has that of the melt, which is a numerical choice.
bool creeps(const Material& m) {
  return m.flow && m.flow->rate_dependence == RateDependence::perzyna &&
         m.flow->rate[Perzyna::viscosity].max_value() > 0;
}

/// Multiplies the parameters of a law that are stresses.
template <std::size_t N>
void multiply_stresses(std::array<Table, N>& tables, std::span<const LawParameter> parameters,
                       double factor) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (std::string_view(parameters[i].unit) == "Pa") tables[i] = tables[i].scaled(factor);
}

/// All stresses of the yield surface together: the curve of a tensile test is multiplied.
void strengthen(Material& m, double factor) {
  Flow& flow = *m.flow;
  flow.flow_stress = flow.flow_stress.scaled(factor);
  flow.kinematic_modulus = flow.kinematic_modulus.scaled(factor);
  multiply_stresses(flow.hardening, hardening_law(flow.isotropic).parameters(), factor);
  if (flow.curves.empty()) return;
  std::vector<double> stresses(flow.curves.stresses().begin(), flow.curves.stresses().end());
  for (double& stress : stresses) stress *= factor;
  flow.curves =
      FlowCurves({flow.curves.strains().begin(), flow.curves.strains().end()},
                 {flow.curves.temperatures().begin(), flow.curves.temperatures().end()}, std::move(stresses));
}

void shift_changes(Material& m, double shift) {
  for (PhaseChange& change : m.phase_changes) {
    std::vector<std::pair<double, double>> points = change.fraction.points();
    for (auto& point : points) point.first += shift;
    change.fraction = PhaseFraction::table(std::move(points));
  }
}

/// A spread in a share of the value, as data of such a kind have it.
Spread share(double relative) {
  return {.relative = relative, .factor = {}, .shift = {}, .source = {}, .estimate = true, .where = {}};
}

// One row a property: key, words, the factor and the spread that vary it, the usual spread where a card says
// nothing, whether a material has it, and what a factor does to the material.

/// Adds what heat and phase changes work with.
void add_thermal_properties(std::vector<VariedProperty>& rows) {
  using F = MaterialFactors;
  using S = MaterialSpreads;
  rows.push_back({"density", "density", "Of the density.", &F::density, &S::density, false, share(0.03),
                  always, [](Material& m, double f) { m.density *= f; }});
  rows.push_back({"conductivity", "conductivity", "Of the whole table of the conductivity.", &F::conductivity,
                  &S::conductivity, false, share(0.10), always,
                  [](Material& m, double f) { m.conductivity = m.conductivity.scaled(f); }});
  rows.push_back({"specific_heat", "specific heat", "Of the whole table of the specific heat.",
                  &F::specific_heat, &S::specific_heat, false, share(0.05), always,
                  [](Material& m, double f) { m.specific_heat = m.specific_heat.scaled(f); }});
  rows.push_back({"latent_heat", "latent heat", "Of the latent heat of all phase changes.", &F::latent_heat,
                  &S::latent_heat, false, share(0.07), gives_off_latent_heat, [](Material& m, double f) {
                    for (PhaseChange& change : m.phase_changes) change.latent_heat *= f;
                  }});
  rows.push_back({"freezing_temperatures",
                  "freezing temperatures",
                  "Of the temperatures of all phase changes, which move together.",
                  &F::freezing_temperatures,
                  &S::freezing_temperatures,
                  true,
                  {.relative = {}, .factor = {}, .shift = 5, .source = {}, .estimate = true, .where = {}},
                  changes,
                  shift_changes});
  rows.push_back({"volume_change", "volume change", "Of the volume change of all phase changes.",
                  &F::volume_change, &S::volume_change, false, share(0.20), changes_its_volume,
                  [](Material& m, double f) {
                    for (PhaseChange& change : m.phase_changes) change.volume_change *= f;
                  }});
}

/// Adds what deformation works with.
void add_mechanical_properties(std::vector<VariedProperty>& rows) {
  using F = MaterialFactors;
  using S = MaterialSpreads;
  rows.push_back({"young_modulus", "Young's modulus", "Of the whole table of Young's modulus.",
                  &F::young_modulus, &S::young_modulus, false, share(0.10), deforms,
                  [](Material& m, double f) { m.young_modulus = m.young_modulus.scaled(f); }});
  rows.push_back({"poisson_ratio", "Poisson's ratio", "Of the whole table of Poisson's ratio.",
                  &F::poisson_ratio, &S::poisson_ratio, false, share(0.05), deforms,
                  [](Material& m, double f) { m.poisson_ratio = m.poisson_ratio.scaled(f); }});
  rows.push_back({"expansion", "expansion", "Of the whole table of the thermal expansion.", &F::expansion,
                  &S::expansion, false, share(0.07), deforms,
                  [](Material& m, double f) { m.expansion = m.expansion.scaled(f); }});
  rows.push_back(
      {"strength", "strength",
       "Of all stresses of [plasticity] (flow stress, hardening, flow curves), which move together.",
       &F::strength, &S::strength, false, share(0.30), yields, strengthen});
  rows.push_back({"creep_viscosity",
                  "creep viscosity",
                  "Of the viscosity of [plasticity].",
                  &F::creep_viscosity,
                  &S::creep_viscosity,
                  false,
                  {.relative = {}, .factor = 3, .shift = {}, .source = {}, .estimate = true, .where = {}},
                  creeps,
                  [](Material& m, double f) {
                    Table& viscosity = m.flow->rate[Perzyna::viscosity];
                    viscosity = viscosity.scaled(f);
                  }});
}

/// Adds what criteria work with.
void add_casting_properties(std::vector<VariedProperty>& rows) {
  using F = MaterialFactors;
  using S = MaterialSpreads;
  rows.push_back({"arm_spacing", "arm spacing", "Of the arm spacing after one second.", &F::arm_spacing,
                  &S::arm_spacing, false, share(0.30),
                  [](const Material& m) { return m.casting.arm_spacing.has_value(); },
                  [](Material& m, double f) { *m.casting.arm_spacing *= f; }});
  rows.push_back({"melt_viscosity", "viscosity of the melt", "Of the viscosity of the melt in [casting].",
                  &F::melt_viscosity, &S::melt_viscosity, false, share(0.20),
                  [](const Material& m) { return m.casting.melt_viscosity.has_value(); },
                  [](Material& m, double f) { *m.casting.melt_viscosity *= f; }});
}

std::vector<VariedProperty> all_properties() {
  std::vector<VariedProperty> rows;
  add_thermal_properties(rows);
  add_mechanical_properties(rows);
  add_casting_properties(rows);
  return rows;
}

}  // namespace

std::span<const VariedProperty> varied_properties() {
  static const std::vector<VariedProperty> rows = all_properties();
  return rows;
}

Section<MaterialSpreads> material_spread_keys() {
  Section<MaterialSpreads> s(
      "spread",
      "How far the true values may lie from those of the card: half widths that hold 95 % (two standard "
      "deviations), of whole tables by one factor. `solidus uncertain` computes the spreads of the answers "
      "from them; where one is missing it uses a typical one and reports it.");
  for (const VariedProperty& row : varied_properties())
    s.section(row.key, row.spread, spread_keys()).doc(row.doc);
  return s;
}

void vary(Material& material, const MaterialFactors& factors, const SourceLocation& where) {
  constexpr MaterialFactors k_none;
  // A factor that is not neutral needs the property that it acts on; Poisson's ratio may not leave its range.
  for (const VariedProperty& row : varied_properties()) {
    const double by = factors.*row.factor;
    if (by == k_none.*row.factor) continue;
    if (!row.has(material))
      throw InputError(where,
                       fmt::format("'{}' cannot vary: the material '{}' has none", row.key, material.name));
    row.apply(material, by);
  }
  // After all factors: the combination may have left what an elastic material can be.
  constexpr double k_incompressible = 0.4999;
  if (material.mechanical() &&
      !(material.poisson_ratio.max_value() <= k_incompressible && material.poisson_ratio.min_value() > -1))
    throw InputError(where,
                     fmt::format("Poisson's ratio of '{}' becomes {:.4g}", material.name,
                                 material.poisson_ratio.max_value()),
                     "between -1 and 0.4999");
}

void check_spreads(MaterialSpreads& spreads, const Material& material, const std::string& file) {
  std::vector<std::string> there;
  for (const VariedProperty& row : varied_properties())
    if (row.has(material)) there.emplace_back(row.key);
  // A spread of this file names only properties that the material has; one inherited from another card is
  // left out.
  for (const VariedProperty& row : varied_properties()) {
    std::optional<Spread>& spread = spreads.*row.spread;
    if (!spread) continue;
    check_spread(*spread, row.shift, fmt::format("'{}'", row.key));
    if (row.has(material)) continue;
    if (spread->where.file == file)
      throw InputError(
          spread->where,
          fmt::format("[spread] has '{}', which the material '{}' has not", row.key, material.name),
          fmt::format("one of: {}", fmt::join(there, ", ")));
    spread.reset();
  }
}

}  // namespace solidus::material
