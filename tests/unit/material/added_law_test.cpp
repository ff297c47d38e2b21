/// A law of isotropic hardening that the sources do not name: keys, documentation, consistency, both
/// mappings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../laws/consistency.hpp"
#include "../../laws/logarithmic.hpp"
#include "input/document.hpp"
#include "input/key_docs.hpp"
#include "material/cards/library.hpp"
#include "thermal_cases.hpp"

namespace solidus::material::test {
namespace {

using solidus::test::k_logarithmic;
using solidus::test::Logarithmic;
using ::testing::HasSubstr;

const std::string k_file = R"(density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1.2e-5 1/K"
[plasticity]
flow_stress = "100 MPa"
isotropic_hardening = "logarithmic"
)";

Material read(const std::string& keys) {
  return make_material("test", material_section().read(parse_document(k_file + keys, "test.toml")));
}

/// Everything varies with temperature.
Material logarithmic_material() {
  Material m = varying_material({});
  m.flow->isotropic = k_logarithmic.kind;
  m.flow->hardening = {Table({300, 1000}, {60e6, 20e6}), Table({300, 1000}, {1e-3, 3e-3})};
  return m;
}

TEST(AddedLaw, IsReadFromAMaterialFileWithItsParametersChecked) {
  const Material m = read("log_factor = \"50 MPa\"\nlog_strain = 0.002\n");
  EXPECT_EQ(m.flow->isotropic, k_logarithmic.kind);
  EXPECT_DOUBLE_EQ(m.flow->hardening[Logarithmic::factor].value(300), 50e6);
  EXPECT_DOUBLE_EQ(m.flow->hardening[Logarithmic::strain].value(300), 0.002);
  std::vector<std::string> names;
  for (const Property& property : m.flow->properties()) names.push_back(property.name);
  EXPECT_THAT(names, ::testing::ElementsAre("plasticity.flow_stress", "plasticity.log_factor",
                                            "plasticity.log_strain"));
  const auto refusal = [](const std::string& keys) {
    try {
      read(keys);
    } catch (const InputError& error) {
      EXPECT_GT(error.where().line, 0);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal("log_factor = \"50 MPa\"\n"), HasSubstr("log_strain"));
  EXPECT_THAT(refusal("log_factor = \"50 MPa\"\nlog_strain = 0\n"), HasSubstr("log_strain"));
  EXPECT_THAT(refusal("log_factor = \"50 s\"\nlog_strain = 0.002\n"), HasSubstr("log_factor"));
  EXPECT_THAT(refusal("log_factor = \"50 MPa\"\nlog_strain = 0.002\nsaturation_rate = 3\n"),
              HasSubstr("saturation_rate"));
}

TEST(AddedLaw, StandsInTheReferencePageAndTheSchema) {
  const std::string manual = reference_manual(material_section().info(), "Material files");
  for (const char* text : {"logarithmic", "B ln(1 + xi/eps_0)", "log_factor", "the initial slope is B/eps_0"})
    EXPECT_THAT(manual, HasSubstr(text));
  EXPECT_THAT(json_schema(material_section().info(), "Material files"), HasSubstr("log_strain"));
}

TEST(AddedLaw, LawsAreAddedBeforeTheKeysAreMadeOnly) {
  static const HardeningLawOf<Logarithmic> late;
  EXPECT_GE(hardening_laws().size(), 6u);
  EXPECT_THROW(add_hardening_law(late), std::logic_error);
}

TEST(HardeningLaws, AreConsistentWithTheirPotentials) {
  for (const auto kind :
       {IsotropicHardening::linear, IsotropicHardening::saturation, IsotropicHardening::power})
    solidus::test::expect_consistent_potential(*varying_material({kind}).flow, 500);
  solidus::test::expect_consistent_potential(*logarithmic_material().flow, 500);
}

TEST(HardeningLaws, HaveTangentsThatAreTheDerivativesOfTheStressInBothMappings) {
  const Sym<double> strain{{1e-3, -2e-3, 4e-3, 1e-3, 2e-3, -1e-3}};
  for (const auto kind :
       {IsotropicHardening::linear, IsotropicHardening::saturation, IsotropicHardening::power})
    solidus::test::expect_consistent_tangents(varying_material({kind}), 500, strain);
  solidus::test::expect_consistent_tangents(logarithmic_material(), 500, strain);
}

TEST(AddedLaw, StoredEnergyCoolsWhereItFallsWithTemperature) {
  // −K_Θ = −B_Θ [(ε_0 + ξ) ln(1 + ξ/ε_0) − ξ] raises the entropy at fixed Θ, so Θ̄ falls
  Material m = flow_material({});
  m.phase_changes.clear();
  m.specific_heat = 480;
  m.young_modulus = 210e9;
  m.poisson_ratio = 0.3;
  m.expansion = 0.0;
  m.flow->flow_stress = 100e6;
  m.flow->isotropic = k_logarithmic.kind;
  m.flow->hardening = {Table({300, 1300}, {100e6, 0}), 1e-3};
  const Isentropic law(m);
  auto p = law.properties_at(400.0, 300.0);
  p.entropy = law.entropy(p, Sym<double>{}, {});
  const auto r = law.update(p, {}, Sym<double>{{0, 0, 0, 0.05, 0, 0}}, 1.0);
  const double xi = r.state.hardening;
  EXPECT_GT(xi, 0.05);
  const double stored = 1e5 * ((1e-3 + xi) * std::log(1 + xi / 1e-3) - xi);
  EXPECT_NEAR(r.temperature, 400 * std::exp(-stored / (480 * m.density)), 1e-9);
}

}  // namespace
}  // namespace solidus::material::test
