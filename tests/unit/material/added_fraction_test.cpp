/// A curve of the phase fraction that the sources do not have, from a material file to its derivative.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../../laws/power_fraction.hpp"
#include "input/document.hpp"
#include "material/cards/library.hpp"

namespace solidus::material {
namespace {

using ::testing::HasSubstr;

const std::string k_file = R"(title = "An alloy"
density = "2700 kg/m3"
conductivity = "200 W/m/K"
specific_heat = "1000 J/kg/K"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "390 kJ/kg"
[phase_change.fraction]
)";

Material read(const std::string& fraction) {
  return make_material("alloy", material_section().read(parse_document(k_file + fraction, "alloy.toml")));
}

std::string error(const std::string& fraction) {
  try {
    read(fraction);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(AddedFractionLaw, IsReadSampledAndHasTheSlopeOfItsChords) {
  const Material m =
      read("kind = \"power\"\nsolidus = \"800 K\"\nliquidus = \"900 K\"\nfraction_exponent = 1.7\n");
  const PhaseFraction& f = m.solidification()->fraction;
  EXPECT_EQ(f.solidus(), 800);
  EXPECT_EQ(f.liquidus(), 900);
  for (const double t : {801.3, 833.0, 871.9, 899.2}) {
    EXPECT_NEAR(f.value(t), std::pow((900 - t) / 100, 1.7), 1e-6) << "the tolerance of sampling";
    EXPECT_NEAR(f.derivative(t), -0.017 * std::pow((900 - t) / 100, 0.7), 2e-4) << "of a chord";
    EXPECT_NEAR(f.derivative(t), (f.value(t + 1e-7) - f.value(t - 1e-7)) / 2e-7, 1e-6);
  }
}

TEST(AddedFractionLaw, StandsInTheDeclarationAndInMessages) {
  EXPECT_THAT(error("kind = \"powr\"\n"),
              HasSubstr("did you mean 'power'? one of: linear, table, lever_rule, "
                        "scheil, power"));
  EXPECT_THAT(error("kind = \"power\"\nsolidus = \"800 K\"\nliquidus = \"900 K\"\n"),
              HasSubstr("the key 'fraction_exponent' is missing"));
  EXPECT_THAT(
      error("kind = \"linear\"\nsolidus = \"800 K\"\nliquidus = \"900 K\"\nfraction_exponent = 2.0\n"),
      HasSubstr("it needs kind = power"));
  EXPECT_THAT(error("kind = \"power\"\nsolidus = \"900 K\"\nliquidus = \"800 K\"\nfraction_exponent = 2.0\n"),
              HasSubstr("the liquidus must lie above the solidus"));
}

}  // namespace
}  // namespace solidus::material
