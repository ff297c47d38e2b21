/// Spreads on material cards, and materials that are varied by factors.
#include "material/varied.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "material/cards/library.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::material {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::array<fs::path, 1> k_library{fs::path(SOLIDUS_SOURCE_DIR) / "materials"};

/// A card in a folder of its own, which goes with the object.
class CardFile {
 public:
  explicit CardFile(const std::string& text)
      : folder_(fs::temp_directory_path() / ("solidus_spread_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(file()) << text;
  }
  ~CardFile() { fs::remove_all(folder_); }
  CardFile(const CardFile&) = delete;
  CardFile& operator=(const CardFile&) = delete;
  fs::path file() const { return folder_ / "own.toml"; }

 private:
  fs::path folder_;
};

const std::string k_card = R"(density = "1000 kg/m3"
conductivity = "1 W/m/K"
specific_heat = "1000 J/kg/K"
[spread]
)";

std::string refusal(const std::string& spread) {
  const CardFile card(k_card + spread);
  try {
    load_material(card.file(), k_library);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Spread, EveryCardOfTheLibraryHasOneForEveryPropertyThatMayBeVaried) {
  for (const std::string& name : material_names(k_library)) {
    const Material m = find_material(name, k_library);
    const MaterialSpreads spreads = find_spreads(name, k_library);
    for (const VariedProperty& row : varied_properties()) {
      const std::optional<Spread>& spread = spreads.*row.spread;
      EXPECT_EQ(spread.has_value(), row.has(m)) << name << " " << row.key;
      if (!spread) continue;
      EXPECT_GT(spread->relative.value_or(0) + spread->factor.value_or(1) - 1 + spread->shift.value_or(0), 0)
          << name << " " << row.key;
    }
  }
}

TEST(Spread, OfACardIsRefusedWithItsLine) {
  EXPECT_EQ(refusal("density = { relative = 0.02, estimate = true }"), "");
  EXPECT_THAT(refusal("density = { relative = -0.02, estimate = true }"),
              AllOf(HasSubstr("own.toml:5:"), HasSubstr("-0.02")));
  EXPECT_THAT(refusal("expansion = { relative = 0.02, estimate = true }"),
              AllOf(HasSubstr("own.toml:5:"), HasSubstr("'expansion', which the material 'own' has not"),
                    HasSubstr("density, conductivity, specific_heat")));
  EXPECT_THAT(refusal("densiti = { relative = 0.02, estimate = true }"), HasSubstr("did you mean 'density'"));
  EXPECT_THAT(refusal("density = { estimate = true }"), HasSubstr("no width"));
  EXPECT_THAT(refusal("density = { relative = 0.1, factor = 2, estimate = true }"),
              HasSubstr("more than one"));
  EXPECT_THAT(refusal("density = { relative = 0.1 }"), HasSubstr("not where it comes from"));
  EXPECT_THAT(refusal("density = { shift = \"3 K\", estimate = true }"), HasSubstr("no temperature"));
}

TEST(Spread, IsInheritedAndDroppedWithAPropertyThatTheOwnCardHasNot) {
  const CardFile card(R"(like = "aluminium_alsi7mg"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "389 kJ/kg"
fraction = { kind = "linear", solidus = "560 degC", liquidus = "610 degC" }
[spread]
density = { relative = 0.001, source = "weighed" }
)");
  const MaterialSpreads own = find_spreads(card.file().string(), k_library),
                        base = find_spreads("aluminium_alsi7mg", k_library);
  EXPECT_EQ(own.density->relative, 0.001);
  EXPECT_EQ(own.conductivity->relative, base.conductivity->relative);
  EXPECT_TRUE(base.volume_change);
  EXPECT_FALSE(own.volume_change) << "the own phase change has none";
}

TEST(VariedMaterial, HasItsTablesMultipliedAndItsFreezingMoved) {
  const Material given = find_material("aluminium_alsi7mg", k_library);
  Material m = given;
  MaterialFactors by;
  by.density = 1.1;
  by.conductivity = 0.9;
  by.latent_heat = 1.2;
  by.freezing_temperatures = 3;
  by.strength = 2;
  by.creep_viscosity = 4;
  by.arm_spacing = 0.5;
  vary(m, by, {});
  EXPECT_DOUBLE_EQ(m.density, 1.1 * given.density);
  EXPECT_DOUBLE_EQ(m.conductivity.value(600), 0.9 * given.conductivity.value(600));
  EXPECT_DOUBLE_EQ(m.specific_heat.value(600), given.specific_heat.value(600));
  EXPECT_DOUBLE_EQ(m.solidification()->latent_heat, 1.2 * given.solidification()->latent_heat);
  EXPECT_NEAR(m.solidification()->fraction.liquidus(), given.solidification()->fraction.liquidus() + 3, 1e-9);
  EXPECT_NEAR(m.solid_fraction(863), given.solid_fraction(860), 1e-9);
  // The whole curve of a tensile test: flow stress and the stress it saturates at, not the rate at which.
  EXPECT_DOUBLE_EQ(m.flow->flow_stress.value(500), 2 * given.flow->flow_stress.value(500));
  for (std::size_t i = 0; i < m.flow->hardening.size(); ++i) {
    const double before = given.flow->hardening[i].value(500), after = m.flow->hardening[i].value(500);
    EXPECT_TRUE(after == 2 * before || (after == before && before < 1e4)) << i;
  }
  EXPECT_DOUBLE_EQ(m.flow->rate[Perzyna::viscosity].value(700),
                   4 * given.flow->rate[Perzyna::viscosity].value(700));
  EXPECT_DOUBLE_EQ(*m.casting.arm_spacing, 0.5 * *given.casting.arm_spacing);
}

TEST(VariedMaterial, ThatNoMaterialCanBeIsRefused) {
  Material sand = find_material("green_sand", k_library),
           metal = find_material("aluminium_alsi7mg", k_library);
  MaterialFactors by;
  by.young_modulus = 1.1;
  EXPECT_THROW(vary(sand, by, {}), InputError);
  by = {};
  by.poisson_ratio = 1.6;
  EXPECT_THROW(vary(metal, by, {}), InputError);
}

// Measured curves: all stresses move together.
TEST(VariedMaterial, HasItsFlowCurvesMultiplied) {
  const Material given = find_material("low_carbon_steel", k_library);
  ASSERT_FALSE(given.flow->curves.empty());
  Material m = given;
  MaterialFactors by;
  by.strength = 0.5;
  vary(m, by, {});
  for (const double strain : {0.0, 0.01, 0.2})
    EXPECT_NEAR(m.flow->curves.at(strain, 500).stress, 0.5 * given.flow->curves.at(strain, 500).stress, 1e-6);
  EXPECT_DOUBLE_EQ(m.flow->flow_stress.value(500), 0.5 * given.flow->flow_stress.value(500));
}

}  // namespace
}  // namespace solidus::material
