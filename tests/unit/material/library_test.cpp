#include "material/cards/library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "input/document.hpp"
#include "material/cards/designations.hpp"
#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::material {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::array<fs::path, 1> k_library{fs::path(SOLIDUS_SOURCE_DIR) / "materials"};

TEST(MaterialLibrary, EveryPropertyOfEveryFileHasASourceAndEveryTableAValidityRange) {
  const auto names = material_names(k_library);
  EXPECT_GE(names.size(), 10u);
  for (const std::string& name : names) {
    const Material m = find_material(name, k_library);
    EXPECT_EQ(m.name, name);
    EXPECT_NE(m.title, name) << "no title";
    EXPECT_GE(m.notes.size(), 3u);
    for (const PropertyNote& note : m.notes) {
      EXPECT_FALSE(note.source.empty()) << name << " " << note.property;
      const bool change = std::any_of(m.phase_changes.begin(), m.phase_changes.end(),
                                      [&](const PhaseChange& one) { return one.name == note.property; });
      const bool always =
          change || note.property == "density" || note.property == "poisson_ratio" ||
          note.property == "twice_shear_viscosity" || note.property == "plasticity.rate_exponent" ||
          note.property == "plasticity.drag_stress" || note.property == "casting" || note.property == "gas" ||
          note.property == "graphite" || note.property == "granular" || note.property == "local";
      EXPECT_TRUE(always || note.valid_to > note.valid_from) << name << " " << note.property;
    }
    const EnthalpyCurve h = m.enthalpy();
    EXPECT_NEAR(h.temperature(h.upper(500)), 500, 1e-9);
  }
}

TEST(MaterialLibrary, AluminiumHasTheMonographsDataInSi) {
  const Material m = find_material("aluminium_99_7", k_library);
  EXPECT_NEAR(m.density, 2650, 1e-9);
  EXPECT_NEAR(m.conductivity.value(273.15 + 659), 209.34, 1e-9);
  EXPECT_NEAR(m.specific_heat.value(273.15 + 350), 1400, 1e-9);
  EXPECT_NEAR(m.young_modulus.value(273.15), 69.3e9, 1);
  EXPECT_NEAR(m.expansion.value(900), 1.47e-5, 1e-15);
  EXPECT_TRUE(m.chooses_viscosity());
  // That of table 7.6 belongs to the case that repeats section 7.3.
  const Material stiff = load_material(
      std::filesystem::path(SOLIDUS_SOURCE_DIR) / "cases/aluminium_cylinder/aluminium_99_7_stiff.toml",
      k_library);
  EXPECT_NEAR(stiff.liquid_viscosity.value(1000), 1e13, 1);
  ASSERT_NE(m.solidification(), nullptr);
  EXPECT_NEAR(m.solidification()->latent_heat, 3.95e5, 1e-9);
  EXPECT_NEAR(m.solidification()->fraction.solidus(), 932.15, 1e-12);
  EXPECT_NEAR(m.solidification()->fraction.liquidus(), 933.15, 1e-12);
  EXPECT_EQ(m.solid_fraction(900), 1);
  EXPECT_TRUE(m.mechanical());
  EXPECT_FALSE(find_material("green_sand", k_library).mechanical());
}

TEST(MaterialLibrary, HotIronHasTheHeatCapacityOfAusteniteAndOfTheMelt) {
  for (const char* name : {"grey_iron", "nodular_iron"}) {
    const Material m = find_material(name, k_library);
    for (const double celsius : {800.0, 1000.0, 1100.0}) {
      EXPECT_GE(m.specific_heat.value(273.15 + celsius), 650) << name;
      EXPECT_LE(m.specific_heat.value(273.15 + celsius), 700) << name;
    }
    EXPECT_GE(m.specific_heat.value(273.15 + 1350), 840) << name;
    EXPECT_LE(m.specific_heat.value(273.15 + 1350), 920) << name;
  }
}

// 298.15 K to 970 K of aluminium: 17.5 kJ/mol in the solid up to 933 K, 10.7 on melting, 1.2 in the melt
// (NIST-JANAF).
TEST(MaterialLibrary, HandbookAluminiumHasTheHeatContentOfTheTables) {
  const EnthalpyCurve h = find_material("aluminium_1070", k_library).enthalpy();
  const double per_mole = 0.0269815 / 2700;
  EXPECT_NEAR(per_mole * (h.upper(970) - h.upper(298.15)), 29.9e3, 0.02 * 29.9e3);
}

// A number that fits every casting there is not: the program finds one for the body and the step.
TEST(MaterialLibrary, NoCardHasAViscosityOfItsMelt) {
  for (const std::string& name : material_names(k_library)) {
    const Material m = find_material(name, k_library);
    const bool casts = m.mechanical() && m.solidification() != nullptr;
    EXPECT_EQ(m.chooses_viscosity(), casts) << name;
  }
}

TEST(MaterialLibrary, GreyIronGrowsAndAluminiumShrinksOnFreezing) {
  const auto growth = [](const char* name) {
    double sum = 0;
    for (const PhaseChange& change : find_material(name, k_library).phase_changes)
      sum += change.volume_change;
    return sum;
  };
  EXPECT_GT(growth("grey_iron"), 0);
  EXPECT_GT(growth("nodular_iron"), 0);
  EXPECT_LT(growth("aluminium_alsi7mg"), 0);
}

TEST(MaterialLibrary, TheMonographsMaterialsStayElastic) {
  EXPECT_FALSE(find_material("aluminium_99_7", k_library).flow);
  EXPECT_FALSE(find_material("steel_mould", k_library).flow);
}

TEST(MaterialLibrary, WhatSolidifiesAndYieldsKeepsASmallStrengthUpToTheLiquidus) {
  for (const char* name :
       {"aluminium_99_7_plastic", "aluminium_alsi7mg", "grey_iron", "nodular_iron", "low_carbon_steel"}) {
    const Material m = find_material(name, k_library);
    ASSERT_TRUE(m.flow) << name;
    const double liquidus = m.solidification()->fraction.liquidus();
    const double at_liquidus = m.flow->flow_stress.value(liquidus);
    EXPECT_GE(at_liquidus, 0.5e6) << name;
    EXPECT_LE(at_liquidus, 3e6) << name;
    EXPECT_GT(m.flow->flow_stress.value(293.15), 20 * at_liquidus) << name;
  }
}

TEST(MaterialLibrary, AnUnknownNameIsAnsweredWithTheNearestAndThePlace) {
  try {
    find_material("aluminum_99_7", k_library, {"case.toml", 12, 12});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("case.toml:12:12: there is no material 'aluminum_99_7'"),
                                    HasSubstr("did you mean 'aluminium_99_7'?")));
  }
  EXPECT_THROW(find_material("missing.toml", k_library), InputError);
}

TEST(MaterialLibrary, ADesignationIsAnsweredWithTheMaterialsThatHaveIt) {
  const auto names = material_names(k_library);
  const auto meant = [&](const char* name) { return designated(name, names, k_library); };
  EXPECT_THAT(meant("a356"), ElementsAre("aluminium_alsi7mg"));
  EXPECT_THAT(meant("A356-T6"), ElementsAre("aluminium_alsi7mg"));
  EXPECT_THAT(meant("EN-GJS 400 15"), ElementsAre("nodular_iron"));
  EXPECT_THAT(meant("1.4408"), ElementsAre("stainless_steel_316"));
  EXPECT_THAT(meant("zamak"), ElementsAre("zinc_zamak3", "zinc_zamak5"));
  EXPECT_THAT(meant("Inconel 718"), IsEmpty());
  EXPECT_THAT(meant("7"), IsEmpty());
  EXPECT_EQ(materials_meant("Zamak 5", names, k_library),
            "did you mean 'zinc_zamak5' (Zinc die-casting alloy Zamak 5 (ZnAl4Cu1))? `solidus materials` "
            "lists all");
  EXPECT_THAT(materials_meant("steel_mold", names, k_library),
              StartsWith("did you mean 'steel_mould'? one of: "));
}

TEST(MaterialLibrary, NoTwoMaterialsHaveADesignationInCommon) {
  const auto names = material_names(k_library);
  int known = 0;
  for (const std::string& name : names)
    for (const std::string& designation : designations(name, k_library)) {
      EXPECT_THAT(designated(designation, names, k_library), ElementsAre(name)) << designation;
      ++known;
    }
  EXPECT_GE(known, 80);
}

TEST(LeftRanges, NamesThePropertiesThatARunTookOutsideTheirRange) {
  const Material m = find_material("aluminium_99_7", k_library);
  EXPECT_TRUE(left_ranges(m, 273.15 + 360, 273.15 + 670).empty());
  const auto cold = left_ranges(m, 293.15, 900);
  ASSERT_EQ(cold.size(), 3u);
  EXPECT_EQ(cold[0].property, "conductivity");
  EXPECT_EQ(cold[1].property, "specific_heat");
  EXPECT_EQ(cold[2].property, "expansion");
  EXPECT_NEAR(cold[1].valid_from, 623.15, 1e-12);
  EXPECT_FALSE(cold[0].refused);
}

TEST(LeftRanges, ATableThatRefusesToContinueIsReportedByItsPoints) {
  Material m;
  m.conductivity = Table({300, 900}, {20, 30}, Extrapolation::error);
  m.notes.push_back({"conductivity", "test", 200, 1000});
  EXPECT_TRUE(left_ranges(m, 300, 900).empty());
  const auto left = left_ranges(m, 300, 950);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_TRUE(left[0].refused);
  EXPECT_EQ(left[0].valid_to, 900);
}

/// A complete material file; tests replace parts of it.
const std::string k_good = R"(density = "2650 kg/m3"
conductivity = "200 W/m/K"
specific_heat = { argument_unit = "degC", unit = "J/kg/K", points = [[20, 900], [600, 1100]] }
young_modulus = "70 GPa"
poisson_ratio = 0.3
expansion = "2e-5 1/K"
twice_shear_viscosity = "1e9 Pa s"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "395 kJ/kg"
fraction = { solidus = "900 K", liquidus = "930 K" }
)";

Material read(const std::string& text) {
  return make_material("test", material_section().read(parse_document(text, "test.toml")));
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  if (at == std::string::npos) ADD_FAILURE() << what;
  return text.replace(at, what.size(), with);
}

TEST(MaterialFile, ReadsWhatItShould) {
  const Material m = read(k_good);
  EXPECT_NEAR(m.specific_heat.value(273.15 + 310), 1000, 1e-9);
  EXPECT_NEAR(m.solid_fraction(915), 0.5, 1e-12);
  EXPECT_NEAR(m.expansion_reference, 293.15, 1e-12);
}

struct Broken {
  const char *what, *with, *message;
};

TEST(MaterialFile, WhatIsWrongIsRefusedWithItsPlace) {
  const Broken cases[] = {
      {"2650 kg/m3", "-2650 kg/m3", "test.toml:1:11: 'density'"},
      {"2650 kg/m3", "2650 kg/m2", "expected a density"},
      {"2650 kg/m3", "2650 kq/m3", "not a known unit"},
      {"density = \"2650 kg/m3\"", "density = 2650", "without a unit"},
      {"density =", "densty =", "did you mean 'density'?"},
      {"density = \"2650 kg/m3\"\n", "", "'density' is missing"},
      {"200 W/m/K", "0 W/m/K", "test.toml:2:16: 'conductivity'"},
      {"[600, 1100]", "[20, 1100]", "test.toml:3"},
      {"[600, 1100]", "[10, 1100]", "must increase"},
      {"[600, 1100]", "[600, -5]", "out of range"},
      {"[600, 1100]", "[600, nan]", "test.toml:3"},
      {"unit = \"J/kg/K\", ", "", "without a unit"},
      {"poisson_ratio = 0.3", "poisson_ratio = 0.5", "test.toml:5:17: 'poisson_ratio'"},
      {"poisson_ratio = 0.3", "poisson_ratio = -1", "out of range"},
      {"poisson_ratio = 0.3\n", "", "belong together"},
      {"twice_shear_viscosity = ", "twice_shear_viscosty = ", "did you mean 'twice_shear_viscosity'?"},
      {"\"395 kJ/kg\"", "\"-1 J/kg\"", "'latent_heat'"},
      {"solidus = \"900 K\"", "solidus = \"931 K\"", "the solidus lies above the liquidus"},
      {"solidus = \"900 K\", ", "", "'solidus' is missing"},
      {"{ solidus", "{ kind = \"lineal\", solidus", "did you mean 'linear'?"},
      {"{ solidus", "{ kind = \"scheil\", solidus", "'solidus' does not belong"},
      {"{ solidus = \"900 K\", liquidus = \"930 K\" }",
       "{ kind = \"scheil\", melting_point = \"900 K\", liquidus = \"930 K\", eutectic = \"850 K\", "
       "partition = 0.1 }",
       "test.toml:12:12: the fraction of the phase change 'solidification': the melting point"},
      {"{ solidus = \"900 K\", liquidus = \"930 K\" }",
       "{ kind = \"table\", temperatures = [\"900 K\", \"930 K\"], fractions = [1] }",
       "2 temperatures and 1 fractions"},
      {"{ solidus = \"900 K\", liquidus = \"930 K\" }",
       "{ kind = \"table\", temperatures = [\"900 K\", \"930 K\"], fractions = [1, 0.2] }",
       "1 at its coldest point"},
  };
  for (const Broken& broken : cases) {
    try {
      read(replaced(k_good, broken.what, broken.with));
      ADD_FAILURE() << "accepted: " << broken.with;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(broken.message)) << broken.with;
      EXPECT_GT(error.where().line, 0) << error.what();
    }
  }
}

TEST(MaterialFile, TwoSolidificationsOrTwoChangesOfOneNameAreRefused) {
  const std::string change = k_good.substr(k_good.find("[[phase_change]]"));
  EXPECT_THROW(read(k_good + change), InputError);
  EXPECT_THROW(read(k_good + replaced(change, "\"solidification\"", "\"again\"")), InputError);
  EXPECT_EQ(read(k_good + replaced(replaced(change, "\"solidification\"", "\"again\""), "= true", "= false"))
                .phase_changes.size(),
            2u);
}

class MaterialOnDisk : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("solidus_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  fs::path folder_;
};

TEST_F(MaterialOnDisk, TakesFromTheMaterialThatItIsLikeWhatItDoesNotGive) {
  write("soft.toml",
        "like = \"aluminium_99_7\"\ntitle = \"Soft melt\"\ntwice_shear_viscosity = \"1e6 Pa s\"\n");
  write("softer.toml", "like = \"soft.toml\"\npoisson_ratio = 0.25\n");
  const Material base = find_material("aluminium_99_7", k_library);
  const Material m = find_material("softer.toml", k_library, {(folder_ / "case.toml").string(), 3, 1});
  EXPECT_EQ(m.name, "softer");
  EXPECT_EQ(m.title, "Soft melt");
  EXPECT_EQ(m.liquid_viscosity.value(1000), 1e6);
  EXPECT_EQ(m.poisson_ratio.value(300), 0.25);
  EXPECT_EQ(m.density, base.density);
  EXPECT_EQ(m.phase_changes.size(), 1u);
}

TEST_F(MaterialOnDisk, RefusesASpecificHeatThatExpansionAloneExceeds) {
  const std::string card = R"(
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1.2e-4 1/K"
)";
  write("swelling.toml", card);  // ten times that of steel
  try {
    load_material(folder_ / "swelling.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is less than what expansion against its stiffness takes up"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("[[phase_change]]"), std::string::npos) << error.what();
  }
  write("held.toml", card + "specific_heat_at = \"constant_strain\"\n");
  EXPECT_EQ(load_material(folder_ / "held.toml").specific_heat_at, SpecificHeatAt::constant_strain);
}

// The length that instantaneous coefficients add up to, inside of their table and beyond its ends.
TEST_F(MaterialOnDisk, IntegratesInstantaneousCoefficientsOfExpansion) {
  const std::string card = R"(
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion_as = "instantaneous"
expansion_reference = "20 degC"
expansion = { of = "temperature", argument_unit = "degC", unit = "1/K", points = [[0, 1.1e-5], [400, 1.5e-5], [700, 1.3e-5]] }
)";
  write("tangent.toml", card);
  const Material m = load_material(folder_ / "tangent.toml");
  const Table tangent({273.15, 673.15, 973.15}, {1.1e-5, 1.5e-5, 1.3e-5});
  for (double celsius = -100; celsius <= 1200; celsius += 7) {
    const double t = 273.15 + celsius, exact = tangent.integral(293.15, t);
    EXPECT_NEAR(m.expansion.value(t) * (t - 293.15), exact, 1e-4 * std::abs(exact) + 1e-12) << celsius;
  }
  write("secant.toml", std::string(card).replace(card.find("instantaneous"), 13, "mean"));
  EXPECT_EQ(load_material(folder_ / "secant.toml").expansion.value(673.15), 1.5e-5);
}

const std::string k_plastic_child = "like = \"aluminium_99_7_plastic\"\n[plasticity]\n";

TEST_F(MaterialOnDisk, TakesPlasticityKeyByKey) {
  write("slow.toml", k_plastic_child + "viscosity = \"1e5 Pa s\"\n");
  const Flow base = *find_material("aluminium_99_7_plastic", k_library).flow;
  const Flow slow = *load_material(folder_ / "slow.toml", k_library).flow;
  EXPECT_EQ(slow.rate[Perzyna::viscosity].value(800), 1e5);
  EXPECT_EQ(slow.isotropic, base.isotropic);
  EXPECT_EQ(slow.flow_stress.value(500), base.flow_stress.value(500));
  EXPECT_EQ(slow.rate[Perzyna::exponent].value(500), base.rate[Perzyna::exponent].value(500));
}

TEST_F(MaterialOnDisk, AnotherKindDropsTheKeysOfTheOldOneButNotOfItsChildren) {
  write("fast.toml", k_plastic_child +
                         "rate_dependence = \"none\"\nisotropic_hardening = \"linear\"\n"
                         "hardening_modulus = \"100 MPa\"\n");
  const Flow fast = *load_material(folder_ / "fast.toml", k_library).flow;
  EXPECT_TRUE(fast.rate_independent());
  EXPECT_EQ(fast.isotropic, IsotropicHardening::linear);
  EXPECT_EQ(fast.hardening[LinearHardening::modulus].value(300), 100e6);
  EXPECT_EQ(fast.hardening[1].value(300), 0);
  EXPECT_GT(fast.flow_stress.value(300), 0);
  write("wrong.toml", "like = \"fast.toml\"\n[plasticity]\nsaturation_rate = 3\n");
  try {
    load_material(folder_ / "wrong.toml", k_library);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("wrong.toml:3"), HasSubstr("'saturation_rate' does not belong")));
  }
}

TEST_F(MaterialOnDisk, APlasticityWrittenInlineReplacesTheInheritedOne) {
  write("ideal.toml", "like = \"aluminium_99_7_plastic\"\nplasticity = { flow_stress = \"20 MPa\" }\n");
  const Flow ideal = *load_material(folder_ / "ideal.toml", k_library).flow;
  EXPECT_EQ(ideal.isotropic, IsotropicHardening::none);
  EXPECT_TRUE(ideal.rate_independent());
  EXPECT_EQ(ideal.flow_stress.value(900), 20e6);
}

TEST_F(MaterialOnDisk, RefusesACircleOfLikesAndAnUnknownOneWithThePlace) {
  write("a.toml", "like = \"b.toml\"\n");
  write("b.toml", "like = \"a.toml\"\n");
  write("c.toml", "like = \"steel_mold\"\n");
  EXPECT_THROW(load_material(folder_ / "a.toml"), InputError);
  try {
    load_material(folder_ / "c.toml", k_library);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("c.toml:1:8"), HasSubstr("did you mean 'steel_mould'?")));
  }
}

}  // namespace
}  // namespace solidus::material
