/// [casting] of material files.
#include <gtest/gtest.h>

#include <array>

#include "input/document.hpp"
#include "material/cards/library.hpp"
#include "system/errors.hpp"

namespace solidus::material {
namespace {

Casting read(const std::string& keys) {
  const std::string text =
      "density = \"2700 kg/m3\"\nconductivity = \"100 W/m/K\"\nspecific_heat = \"900 J/kg/K\"\n[casting]\n";
  return make_material("test", material_section().read(parse_document(text + keys, "test.toml"))).casting;
}

TEST(CastingData, AreReadInSiAndSayNothingWhereNothingIsKnown) {
  const Casting given = read("arm_spacing = \"10 um\"\nmelt_viscosity = \"1.3 mPa s\"\n");
  EXPECT_DOUBLE_EQ(given.arm_spacing.value(), 10e-6);
  EXPECT_DOUBLE_EQ(given.melt_viscosity.value(), 1.3e-3);
  const Casting none = read("");
  EXPECT_FALSE(none.arm_spacing);
  EXPECT_FALSE(none.melt_viscosity);
  EXPECT_DOUBLE_EQ(none.critical_pressure_drop, 101325);
}

TEST(CastingData, RefuseABrittleRangeThatDoesNotFollowCoherency) {
  EXPECT_THROW(read("brittle_range = [0.99, 0.9]\n"), InputError);
  EXPECT_THROW(read("coherency_fraction = 0.95\n"), InputError);
}

TEST(CastingData, OfTheLibraryAreThereForTheAlloysThatAreCast) {
  const std::array<std::filesystem::path, 1> library{std::filesystem::path(SOLIDUS_SOURCE_DIR) / "materials"};
  for (const char* name : {"aluminium_alsi7mg", "low_carbon_steel", "grey_iron", "nodular_iron"})
    EXPECT_TRUE(find_material(name, library).casting.arm_spacing) << name;
}

}  // namespace
}  // namespace solidus::material
