/// Hot tears by the strain that mush takes, of a block that cools and is stretched evenly.
#include "criteria/mush_strain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "../mechanics/lattice.hpp"
#include "criteria/longest_sides.hpp"

namespace solidus::criteria {
namespace {

using mesh::Point;
using mesh::Shape;

constexpr double k_solidus = 800, k_liquidus = 900;                 // [K]
constexpr double k_gradient = 0.2, k_cooling = 0.5, k_rate = 1e-4;  // [K/m], [K/s], [1/s]
constexpr double k_time = 700, k_step = 0.1;                        // [s]

material::Material metal() {
  material::Material m;
  m.name = "metal";
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(k_solidus, k_liquidus),
                             .volume_change = -0.05,
                             .solidification = true});
  m.casting.arm_spacing = 1e-3;
  m.casting.arm_spacing_exponent = 0;  // elements that a gradient crosses freeze for longer
  m.casting.melt_viscosity = 1e-3;
  m.casting.crack_strain = 0.02821;
  return m;
}

/// Fields at the end of freezing.
struct Values {
  std::vector<double> tendency, cracking;
  std::vector<CriterionResult> findings;
};

Values freeze(const std::vector<material::Material>& materials, AnalysisKind kind, Shape shape, double rate,
              double gradient = k_gradient) {
  const mesh::Mesh mesh = test::make_mesh({.shape = shape, .cells = {3, 2, 2}, .distortion = 0.1});
  MushStrain criterion(mesh, mesh, kind, materials);
  const auto components = static_cast<std::size_t>(displacement_components(kind));
  struct Moment {
    heat::ThermalState heat;
    mechanics::MechanicalState mechanics;
    std::vector<double> plateau;
  };
  const auto at = [&](double time) {
    Moment m;
    for (const Point& x : mesh.x) {
      m.heat.temperature.push_back(910 + gradient * x[0] - k_cooling * time);
      const double e = rate * time;
      const Point u{e * x[0], kind == AnalysisKind::solid ? -0.5 * e * x[1] : -e * x[1], -0.5 * e * x[2]};
      m.mechanics.displacement.insert(m.mechanics.displacement.end(), u.begin(),
                                      u.begin() + static_cast<std::ptrdiff_t>(components));
    }
    return m;
  };
  Moment now = at(0);
  const auto input = [](double time, const Moment& m) {
    return CriterionInput{time, m.heat, m.mechanics, {}, m.plateau};
  };
  CriterionRecord record = criterion.initial(input(0, now));
  const int steps = static_cast<int>(std::lround(k_time / k_step));
  for (int k = 1; k <= steps; ++k) {
    Moment next = at(k * k_step);
    criterion.step(input((k - 1) * k_step, now), input(k * k_step, next), record);
    now = std::move(next);
  }
  std::size_t cells = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) cells += static_cast<std::size_t>(block.size());
  Values values{std::vector<double>(cells), std::vector<double>(cells), criterion.findings(record)};
  const std::vector<std::span<double>> spans{values.tendency, values.cracking};
  criterion.fill(input(k_time, now), record, spans);
  return values;
}

const std::vector<std::pair<AnalysisKind, Shape>> k_kinds{{AnalysisKind::plane_strain, Shape::quad4},
                                                          {AnalysisKind::plane_strain, Shape::tri6},
                                                          {AnalysisKind::solid, Shape::tet4},
                                                          {AnalysisKind::solid, Shape::hex8}};

// With a gradient of which the mush is shorter than the block, and with next to none, where it is as long.
TEST(MushStrain, IsWhatRappazDrezetGremaudSayAtTheRateThatIsTaken) {
  constexpr double k_steep = 200, k_root = 802;  // [K/m], [K] at f = 0.98
  const std::vector<material::Material> materials{metal()};
  const double spacing = *materials[0].casting.secondary_arm_spacing(1);
  const TearingLaw law = *TearingLaw::of(materials[0]);
  for (const auto& [kind, shape] : k_kinds) {
    const double longest = longest_sides(test::make_mesh({.shape = shape, .cells = {3, 2, 2}}))[0];
    const double least = (k_liquidus - k_root) / longest;
    ASSERT_LT(least, k_steep);
    for (const auto& [gradient, counts] : {std::pair{k_steep, k_steep}, std::pair{k_gradient, least}})
      for (const double rate : {k_rate, 0.0}) {
        const double expected = law.tendency({counts, k_cooling, spacing}, rate);
        ASSERT_LT(expected, k_most_tendency);
        for (const double value : freeze(materials, kind, shape, rate, gradient).tendency)
          EXPECT_NEAR(value / expected, 1, 0.02);
      }
  }
}

TEST(MushStrain, IsWhatWonYeoSeolOhSay) {
  const std::vector<material::Material> materials{metal()};
  // From f = 0.90 to 0.99, a width of 9 K.
  const double strain = k_rate * 9 / k_cooling;
  const double expected = strain / critical_crack_strain(materials[0].casting, k_rate, 9);
  for (const auto& [kind, shape] : k_kinds) {
    const Values values = freeze(materials, kind, shape, k_rate);
    for (const double value : values.cracking) EXPECT_NEAR(value / expected, 1, 0.02);
    for (const CriterionResult& result : values.findings)
      if (result.name == "cracking_index_max") EXPECT_NEAR(result.value / expected, 1, 0.02);
    for (const double value : freeze(materials, kind, shape, 0).cracking) EXPECT_EQ(value, 0);
  }
}

TEST(MushStrain, TellsTheShareBeyondTheThreshold) {
  const std::vector<material::Material> materials{metal()};
  const auto share = [&](double rate) {
    for (const CriterionResult& result : freeze(materials, AnalysisKind::solid, Shape::hex8, rate).findings)
      if (result.name == "cracking_index_beyond") return result.value;
    return -1.0;
  };
  EXPECT_EQ(share(k_rate), 0);
  EXPECT_NEAR(share(100 * k_rate), 1, 1e-12);
}

TEST(MushStrain, SaysNothingOfMaterialsWithoutData) {
  material::Material silent = metal();
  silent.casting.crack_strain.reset();
  silent.casting.arm_spacing.reset();
  EXPECT_FALSE(MushStrain::has_something_to_say({silent}));
  EXPECT_TRUE(MushStrain::has_something_to_say({metal()}));
}

}  // namespace
}  // namespace solidus::criteria
