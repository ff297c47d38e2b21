/// A block of an alloy that freezes at one temperature is cooled evenly, by a heat sink in its volume. While
/// the temperature is constant the heat drawn alone says how much is solid: the block shrinks in proportion
/// to it, every node alike, in every step.
///
///    │▒▒▒▒▒▒│     free to shrink, insulated, from 900 K on, the temperature of its change;
///   r│▒ −q ▒│     q = 8e7 W/m³ against ρ L = 1e9 J/m³, ΔV/V = −6 %
///    └──────┘     axisymmetric, or a box on three planes
///
/// In the splits mechanics works with the phases of t_n (4.81): after step n the block has the size of the
/// heat drawn up to t_{n−1}, u(x) = ⅓ ΔV/V Q_{n−1}/(ρ L) x. The monolithic schemes end with those of t_{n+1}.
#include <gtest/gtest.h>

#include "coupling_bodies.hpp"
#include "simplex_bodies.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;
using verification::Element;

constexpr double k_size = 0.01;          // [m]
constexpr double k_freezing = 900;       // [K]
constexpr double k_power = -8e7;         // [W/m³]
constexpr double k_latent = 2500 * 4e5;  // ρ L [J/m³]
constexpr double k_volume_change = -0.06;
constexpr int k_steps = 10;

const Element k_elements[] = {
    verification::k_tri3_locking, verification::k_tri3,          verification::k_tri3_algebraic,
    verification::k_quad4,        {"tri6", mesh::Shape::tri6},   {"quad8", mesh::Shape::quad8},
    verification::k_tet4_locking, verification::k_tet4,          verification::k_tet4_algebraic,
    verification::k_hex8,         {"tet10", mesh::Shape::tet10}, {"hex20", mesh::Shape::hex20}};

material::Material alloy() {
  material::Material m = test::elastic_material(6e10, 0.35, 2e-5);
  m.density = 2500;
  m.conductivity = 100.0;
  m.specific_heat = 1000.0;
  m.liquid_viscosity = 1e9;
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(k_freezing, k_freezing),
                             .latent_heat = 4e5,
                             .volume_change = k_volume_change,
                             .solidification = true});
  return m;
}

Coupled block(const Element& element) {
  const bool solid = mesh::dimension(element.shape) == 3;
  Coupled c;
  c.mesh = test::make_mesh({.shape = element.shape,
                            .cells = {solid ? 2 : 3, solid ? 2 : 3, 2},
                            .size = {k_size, k_size, k_size},
                            .distortion = 0.15});
  c.kind = solid ? AnalysisKind::solid : AnalysisKind::axisymmetric;
  c.materials = {alloy()};
  c.start = {k_freezing};
  c.simplices = element.simplices;
  c.stabilisation = element.stabilisation;
  c.hold("left", 0);
  c.hold("bottom", 1);
  if (solid) c.hold("back", 2);
  c.thermal.sources.push_back({"sink", "body", Table(k_power)});
  return c;
}

/// The largest difference of a displacement to that of a free change of volume, over the largest one.
double difference(const Coupled& c, const coupling::State& state, double volume_change) {
  const auto n = static_cast<std::size_t>(displacement_components(c.kind));
  double worst = 0;
  for (std::size_t i = 0; i < c.mesh.x.size(); ++i)
    for (std::size_t k = 0; k < n; ++k)
      worst = std::max(
          worst, std::abs(state.mechanics.displacement[i * n + k] - volume_change / 3 * c.mesh.x[i][k]));
  return parallel::global_max(worst) / std::abs(k_volume_change / 3 * k_size);
}

/// Error of the block's size, largest over the steps, and the sum of the defects over the heat drawn.
struct Result {
  double size = 0, defect = 0, frozen = 0;
};

/// @param by_latent_heat  the size counts from the latent heat that is gone, not from all heat drawn
Result cool(const Coupled& c, bool by_latent_heat) {
  verification::Assembly assembly(c, k_steps);
  coupling::State state = assembly.start();
  assembly.scheme().synchronise(state);
  Result result;
  double drawn = 0;
  for (int step = 1; step <= k_steps; ++step) {
    const double before = assembly.heat().states().mean_solid_fraction(state.heat);
    coupling::State trial;
    const coupling::StepEffort effort = assembly.advance(state, trial, step, 1.0);
    state = std::move(trial);
    drawn += effort.energy.heat_exchanged;
    const double after = assembly.heat().states().mean_solid_fraction(state.heat);
    const double by_heat = -k_power * (step - 1) / k_latent;
    const bool monolithic = c.iteration || c.mapping == Mapping::simultaneous;
    const double frozen = !by_latent_heat ? by_heat : c.double_pass || monolithic ? after : before;
    result.size = std::max(result.size, difference(c, state, k_volume_change * frozen));
    result.defect += std::abs(effort.energy.defect());
    const std::vector<double> fractions = assembly.heat().states().solid_fraction(state.heat);
    for (const double f : fractions) EXPECT_NEAR(f, after, 1e-11) << step;
  }
  result.defect /= drawn;
  result.frozen = assembly.heat().states().mean_solid_fraction(state.heat);
  return result;
}

class IsothermalShrinkage : public testing::TestWithParam<Element> {};

TEST_P(IsothermalShrinkage, IsInProportionToTheHeatDrawnWithBothRules) {
  for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
    for (const bool of_the_program : {false, true}) {
      Coupled c = block(GetParam());
      c.integration = rule;
      if (of_the_program) c.materials[0].liquid_viscosity = {};
      const Result r = cool(c, false);
      // Mush of the program resists compaction with its bulk viscosity, which stretches it elastically while
      // it shrinks: in mixed elements by ζ div u̇/k, 4e-6 of the shrinkage.
      EXPECT_LE(r.size, of_the_program ? 1e-5 : 1e-10);
      EXPECT_NEAR(r.frozen, -k_power * k_steps / k_latent, 1e-11);
    }
}

/// Deformation and heat exchange energy: the block is free of stress, so what is drawn is latent heat and
/// nothing else, although the fraction is brought up to date before the block contracts. The second half of a
/// double pass works with the phases that its thermal phase has found: its size is that of the end of the
/// step but for the heat of that half.
TEST_P(IsothermalShrinkage, FollowsTheLatentHeatInEverySchemeAndClosesTheFirstLaw) {
  struct Scheme {
    const char* name;
    Mapping mapping;
    bool double_pass, iterates;
    double tolerance = 1e-10;
  };
  for (const Scheme& scheme : {Scheme{"isothermal", Mapping::isothermal, false, false},
                               Scheme{"isentropic", Mapping::isentropic, false, false},
                               Scheme{"simultaneous", Mapping::simultaneous, false, false, 1e-8},
                               Scheme{"double pass", Mapping::isentropic, true, false, 2e-3},
                               Scheme{"iterative", Mapping::isothermal, false, true, 1e-7},
                               Scheme{"iterative, isentropic", Mapping::isentropic, false, true, 1e-7}})
    for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open}) {
      Coupled c = block(GetParam());
      c.integration = rule;
      c.form = StructuralForm::energy;
      c.mapping = scheme.mapping;
      c.double_pass = scheme.double_pass;
      if (scheme.iterates) c.iteration.emplace();
      const Result r = cool(c, true);
      EXPECT_LE(r.size, scheme.tolerance) << scheme.name;
      EXPECT_LE(r.defect, 1e-8) << scheme.name;
      EXPECT_NEAR(r.frozen, -k_power * k_steps / k_latent, 2e-3) << scheme.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Elements, IsothermalShrinkage, testing::ValuesIn(k_elements),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace solidus
