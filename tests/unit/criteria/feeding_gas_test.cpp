/// Gas and graphite in the balance of feeding; on one process and on two.
#include <gtest/gtest.h>

#include <cmath>

#include "feeding_bodies.hpp"

namespace solidus {
namespace {

using criteria::FeedingTotals;
using mesh::Shape;
using test::FreezingBody;

constexpr double k_per_hundred_grams = 1e-5;  // [m³/kg] in a cm³ per 100 g

material::Material metal_with_gas(double shrinks, double solidus = 880) {
  material::Material m = test::shrinking_metal(solidus, 900);
  m.density = 2600;
  m.phase_changes[0].volume_change = -shrinks;
  m.gas = material::Gas{.name = "hydrogen",
                        .melt = {2.796, 2760},
                        .solid = {0.788, 2080},
                        .content = 0.25 * k_per_hundred_grams,
                        .surface_tension = 0.87,
                        .source = {}};
  return m;
}

FreezingBody block(material::Material metal, criteria::FeedingOptions options = {}) {
  return FreezingBody(test::feeding_block(Shape::quad4, {0.04, 0.1}, {8, 20}), AnalysisKind::plane_strain,
                      std::move(metal), std::move(options));
}

/// Freezes everywhere at once.
void freeze_evenly(FreezingBody& body, int steps = 200) {
  body.start([](const mesh::Point&) { return 0.0; });
  for (int k = 1; k <= steps; ++k)
    body.step(k, [=](const mesh::Point&) { return static_cast<double>(k) / steps; });
}

/// Freezes from the bottom up.
void freeze_upwards(FreezingBody& body, int steps = 200) {
  const auto solid = [=](int k) {
    return [=](const mesh::Point& x) { return std::clamp(2.0 * k / steps - x[1] / 0.1, 0.0, 1.0); };
  };
  body.start(solid(0));
  for (int k = 1; k <= steps; ++k) body.step(k, solid(k));
}

TEST(FeedingWithGas, OfASampleThatDoesNotShrinkIsSieverts) {
  for (const double bar : {0.08, 1.0, 10.0}) {
    criteria::FeedingOptions options;
    options.gas.ambient_pressure = 1e5 * bar;
    FreezingBody body = block(metal_with_gas(0), options);
    freeze_evenly(body);
    const double radius = 10e-6 * std::sqrt(200.0) / 2, p = 1e5 * bar + 2 * 0.87 / radius;
    const double dissolved = std::pow(10, 0.788 - 2080.0 / 880) * std::sqrt(p / 101325);
    const double gas = 2.6e-2 * (0.25 - dissolved) * (101325 / p) * (880 / 273.15);  // over volume of metal
    const FeedingTotals totals = body.totals();
    EXPECT_NEAR(totals.gas / totals.room, gas / (1 + gas), 0.01 * gas) << bar;
    EXPECT_LT(std::abs(totals.defect()), 1e-11);
  }
}

TEST(FeedingWithGas, GasTakesLessOutOfTheRiser) {
  material::Material without = metal_with_gas(0.05);
  without.gas.reset();
  FreezingBody dry = block(without), wet = block(metal_with_gas(0.05));
  freeze_upwards(dry);
  freeze_upwards(wet);
  const FeedingTotals a = dry.totals(), b = wet.totals();
  EXPECT_EQ(a.gas, 0);
  EXPECT_GT(b.gas, 1e-3 * b.room);
  const double holes_dry = a.pipe + a.sink + a.cavity + a.pores, holes = b.pipe + b.sink + b.cavity + b.pores;
  EXPECT_LT(holes, holes_dry);
  // What gas takes is missing from the holes, but for what it shrinks by.
  EXPECT_NEAR(holes_dry - holes, b.gas, 0.1 * b.gas);
  EXPECT_LT(std::abs(b.defect()), 1e-11);
}

TEST(FeedingWithGas, MushThatNoMeltReachesDrawsItsGasLarger) {
  FreezingBody shrinking = block(metal_with_gas(0.05)), still = block(metal_with_gas(0));
  freeze_evenly(shrinking);
  freeze_evenly(still);
  EXPECT_GT(shrinking.totals().gas, 1.2 * still.totals().gas);
  EXPECT_LT(std::abs(shrinking.totals().defect()), 1e-11);
}

material::Material iron(material::Graphite::Form form) {
  material::Material m = test::shrinking_metal(1393, 1423);
  m.graphite = material::Graphite{};
  m.graphite->carbon = 3.5;
  m.graphite->silicon = 2;
  m.graphite->form = form;
  m.phase_changes[0].volume_change = -0.035;
  m.phase_changes.push_back({.name = "graphite",
                             .fraction = material::PhaseFraction::linear(1393, 1423),
                             .volume_change = m.graphite->volume_change(),
                             .graphite = true});
  return m;
}

TEST(FeedingWithGraphite, ExpansionFeedsWhatTheMouldHolds) {
  const auto run = [](double rigidity, material::Graphite::Form form) {
    criteria::FeedingOptions options;
    options.mould_rigidity = rigidity;
    FreezingBody body = block(iron(form), options);
    freeze_upwards(body);
    EXPECT_LT(std::abs(body.totals().defect()), 1e-11);
    return body.totals();
  };
  using Form = material::Graphite::Form;
  const FeedingTotals rigid = run(1, Form::flake), soft = run(0, Form::flake), half = run(0.5, Form::flake),
                      nodules = run(0.5, Form::nodular);
  const auto holes = [](const FeedingTotals& t) { return (t.pipe + t.sink + t.cavity + t.pores) / t.room; };
  // 1.67 mass per cent of graphite add 5.3 %, the metal shrinks by 3.5 %.
  const double graphite = iron(Form::flake).graphite->volume_change();
  EXPECT_NEAR(graphite, 0.0535, 1e-4);
  EXPECT_EQ(rigid.wall, 0);
  EXPECT_LT(holes(rigid), 0);
  EXPECT_NEAR(soft.wall / soft.room, graphite, 0.06 * graphite);
  EXPECT_NEAR(holes(soft), 0.035, 0.003);
  EXPECT_LT(holes(rigid), holes(half));
  EXPECT_LT(holes(half), holes(nodules));
  EXPECT_LT(holes(nodules), holes(soft));
}

/// Holes over the room of a nodular iron whose wall moves by 0.25 mm at most in a mould that does not resist
/// before. No melt contracts: what is left is that of freezing.
double need_of_riser(double modulus) {
  FreezingBody unlimited = block(iron(material::Graphite::Form::nodular));
  criteria::FeedingOptions options;
  options.mould_rigidity = 0;
  options.wall_movement = 0.25e-3;
  double volume = 0;
  for (Index i = 0; i < unlimited.mesh.n_owned_nodes; ++i) volume += unlimited.storage.volume(i, 0);
  options.walled = {parallel::global_sum(volume) / modulus};
  FreezingBody body = block(iron(material::Graphite::Form::nodular), options);
  freeze_upwards(body);
  const FeedingTotals t = body.totals();
  EXPECT_LT(std::abs(t.defect()), 1e-11);
  EXPECT_LE(t.wall, 1.0001 * 0.25e-3 / modulus * t.room);
  return (t.pipe + t.sink + t.cavity + t.pores) / t.room;
}

// S. I. Karsay's rule for nodular iron (docs/theory/graphite.md): below a modulus of some 4 mm a riser as for
// steel, above 25 mm none, in between a smaller one.
TEST(FeedingWithGraphite, ThickerIronsNeedLessRiser) {
  const double graphite = iron(material::Graphite::Form::nodular).graphite->volume_change(), steel = 0.035;
  const double thin = need_of_riser(4e-3), middle = need_of_riser(8e-3), thick = need_of_riser(25e-3);
  EXPECT_NEAR(thin, steel, 0.1 * steel);
  EXPECT_NEAR(middle, steel - graphite + 0.25 / 8, 0.1 * steel);
  EXPECT_NEAR(thick, steel - graphite + 0.25 / 25, 0.1 * steel);
  EXPECT_LT(thick, 0);
}

}  // namespace
}  // namespace solidus
