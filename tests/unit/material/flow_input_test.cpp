/// The section [plasticity] of a material file: every key read, everything that is wrong refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../../laws/hardening_parameter.hpp"
#include "input/document.hpp"
#include "input/key_docs.hpp"
#include "material/cards/library.hpp"
#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::material {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string k_elastic = R"(density = "2650 kg/m3"
conductivity = "200 W/m/K"
specific_heat = "900 J/kg/K"
young_modulus = "70 GPa"
poisson_ratio = 0.3
expansion = "2e-5 1/K"
)";

const std::string k_solidifies = R"(twice_shear_viscosity = "1e9 Pa s"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "395 kJ/kg"
fraction = { solidus = "900 K", liquidus = "930 K" }
)";

const std::string k_falling =
    R"(flow_stress = { argument_unit = "K", unit = "MPa", points = [[300, 60], [700, 20], [900, 1]], source = "test" }
)";

Material read(const std::string& text) {
  return make_material("test", material_section().read(parse_document(text, "test.toml")));
}

/// An elastic material with a section [plasticity].
Material with_flow(const std::string& keys) {
  return read(k_elastic + "[plasticity]\n" + keys);
}

/// The message for an input that must be refused; its place must be known.
std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    EXPECT_GT(error.where().line, 0) << error.what();
    EXPECT_EQ(error.where().file, "test.toml");
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

std::string flow_refusal(const std::string& keys) {
  return refusal(k_elastic + "[plasticity]\n" + keys);
}

TEST(FlowInput, WithoutTheSectionTheSolidIsElasticAndTheLiquidMaxwells) {
  const Material m = read(k_elastic);
  EXPECT_FALSE(m.flow);
  EXPECT_EQ(m.liquid_model, LiquidModel::maxwell);
}

TEST(FlowInput, AFlowStressAloneIsPerfectRateIndependentPlasticity) {
  const Material m = with_flow(k_falling);
  ASSERT_TRUE(m.flow);
  EXPECT_DOUBLE_EQ(m.flow->flow_stress.value(500), 40e6);
  EXPECT_EQ(m.flow->isotropic, IsotropicHardening::none);
  EXPECT_EQ(m.flow->kinematic, KinematicHardening::none);
  EXPECT_TRUE(m.flow->rate_independent());
  EXPECT_TRUE(m.flow->curves.empty());
}

TEST(FlowInput, ReadsLinearHardening) {
  const Flow f = *with_flow(k_falling + R"(isotropic_hardening = "linear"
hardening_modulus = "500 MPa")")
                      .flow;
  EXPECT_EQ(f.isotropic, IsotropicHardening::linear);
  EXPECT_DOUBLE_EQ(f.hardening[LinearHardening::modulus].value(300), 500e6);
}

TEST(FlowInput, ReadsSaturationWithAndWithoutALinearPart) {
  const std::string keys = k_falling + R"(isotropic_hardening = "saturation"
saturation_stress = "110 MPa"
saturation_rate = 12
)";
  const Flow f = *with_flow(keys + "hardening_modulus = \"5 MPa\"").flow;
  const auto parameter = [&](const char* key) {
    return material::test::hardening_parameter(f.isotropic, key);
  };
  EXPECT_EQ(f.isotropic, IsotropicHardening::saturation);
  EXPECT_DOUBLE_EQ(f.hardening[parameter("saturation_stress")].value(300), 110e6);
  EXPECT_DOUBLE_EQ(f.hardening[parameter("saturation_rate")].value(300), 12);
  EXPECT_DOUBLE_EQ(f.hardening[parameter("hardening_modulus")].value(300), 5e6);
  EXPECT_EQ(with_flow(keys).flow->hardening[parameter("hardening_modulus")].value(300), 0);
}

TEST(FlowInput, ReadsThePowerLaw) {
  const Flow f = *with_flow(k_falling + R"(isotropic_hardening = "power"
reference_strain = "0.1 percent"
hardening_exponent = 0.2)")
                      .flow;
  EXPECT_EQ(f.isotropic, IsotropicHardening::power);
  const auto parameter = [&](const char* key) {
    return material::test::hardening_parameter(f.isotropic, key);
  };
  EXPECT_DOUBLE_EQ(f.hardening[parameter("reference_strain")].value(300), 1e-3);
  EXPECT_DOUBLE_EQ(f.hardening[parameter("hardening_exponent")].value(300), 0.2);
}

const std::string k_curves = R"(isotropic_hardening = "table"
[[plasticity.flow_curve]]
temperature = "600 K"
stress = { unit = "MPa", points = [[0, 20], [0.2, 30]], source = "hot test" }
[[plasticity.flow_curve]]
temperature = "300 K"
stress = { argument_unit = "percent", unit = "MPa", points = [[0, 50], [5, 80], [10, 90]], source = "cold test" }
)";

TEST(FlowInput, MergesFlowCurvesAndTakesTheFlowStressFromThem) {
  const Material m = with_flow(k_curves);
  const Flow& f = *m.flow;
  EXPECT_EQ(f.isotropic, IsotropicHardening::table);
  EXPECT_DOUBLE_EQ(f.flow_stress.value(450), 35e6);
  EXPECT_DOUBLE_EQ(f.curves.at(0.05, 300).stress, 30e6);
  EXPECT_NEAR(f.curves.at(0.15, 300).stress, 40e6, 1e-6);
  EXPECT_NEAR(f.curves.at(0.1, 450).stress, 0.5 * (40e6 + 5e6), 1e-6);
  const PropertyNote& note = m.notes.back();
  EXPECT_EQ(note.property, "plasticity.flow_curve");
  EXPECT_EQ(note.source, "cold test; hot test");
  EXPECT_EQ(note.valid_from, 300);
  EXPECT_EQ(note.valid_to, 600);
}

TEST(FlowInput, ReadsKinematicHardening) {
  const Flow prager = *with_flow(k_falling + R"(kinematic_hardening = "linear"
kinematic_modulus = "2 GPa")")
                           .flow;
  EXPECT_EQ(prager.kinematic, KinematicHardening::linear);
  EXPECT_DOUBLE_EQ(prager.kinematic_modulus.value(300), 2e9);
  const Flow recovering = *with_flow(k_falling + R"(kinematic_hardening = "armstrong_frederick"
kinematic_modulus = "2 GPa"
recall = 100)")
                               .flow;
  EXPECT_EQ(recovering.kinematic, KinematicHardening::armstrong_frederick);
  EXPECT_DOUBLE_EQ(recovering.recall[0].value(300), 100);
}

TEST(FlowInput, ReadsTheRateDependence) {
  const Flow f = *with_flow(k_falling + R"(rate_dependence = "perzyna"
viscosity = "1e7 Pa s"
rate_exponent = { argument_unit = "K", points = [[300, 20], [900, 4]] }
drag_stress = "30 MPa")")
                      .flow;
  EXPECT_FALSE(f.rate_independent());
  EXPECT_FALSE(f.linear_rate());
  EXPECT_DOUBLE_EQ(f.rate[Perzyna::viscosity].value(300), 1e7);
  EXPECT_DOUBLE_EQ(f.rate[Perzyna::exponent].value(600), 12);
  EXPECT_DOUBLE_EQ(f.rate[Perzyna::drag_stress].value(300), 30e6);
  const Flow linear = *with_flow(k_falling + R"(rate_dependence = "perzyna"
viscosity = "1e7 Pa s")")
                           .flow;
  EXPECT_TRUE(linear.linear_rate());
  EXPECT_FALSE(linear.heat_share);
  const Flow steep = *with_flow(k_falling + R"(rate_dependence = "perzyna"
viscosity = "1e7 Pa s"
rate_exponent = 0.5
drag_stress = "30 MPa"
taylor_quinney = { argument_unit = "K", points = [[300, 0.9], [900, 0.7]] })")
                          .flow;
  EXPECT_DOUBLE_EQ(steep.rate[Perzyna::exponent].value(300), 0.5);
  EXPECT_DOUBLE_EQ(steep.heat_share->value(600), 0.8);
}

TEST(FlowInput, WithoutAViscosityTheLiquidsIsTaken) {
  const Material m =
      read(k_elastic + k_solidifies + "[plasticity]\n" + k_falling + "rate_dependence = \"perzyna\"");
  EXPECT_EQ(m.flow->rate[Perzyna::viscosity].value(500), 1e9);
  EXPECT_THAT(m.notes.back().source, HasSubstr("2.98"));
  EXPECT_THAT(flow_refusal(k_falling + "rate_dependence = \"perzyna\""),
              AllOf(HasSubstr("test.toml:7"), HasSubstr("'viscosity' is missing"),
                    HasSubstr("twice_shear_viscosity")));
}

TEST(FlowInput, ReadsTheModelOfTheLiquid) {
  const std::string modified = "liquid_model = \"modified_shear\"\n",
                    degenerated = "liquid_model = \"degenerated\"\n";
  EXPECT_EQ(read(modified + k_elastic + k_solidifies).liquid_model, LiquidModel::modified_shear);
  EXPECT_EQ(read(degenerated + k_elastic + k_solidifies + "[plasticity]\n" + k_falling +
                 "rate_dependence = \"perzyna\"")
                .liquid_model,
            LiquidModel::degenerated);
  EXPECT_THAT(refusal(modified + k_elastic), HasSubstr("does not solidify"));
  EXPECT_THAT(refusal(degenerated + k_elastic), HasSubstr("does not solidify"));
  EXPECT_THAT(refusal(degenerated + k_elastic + k_solidifies),
              AllOf(HasSubstr("no viscosity"), HasSubstr("perzyna")));
  EXPECT_THAT(refusal(degenerated + k_elastic + k_solidifies + "[plasticity]\n" + k_falling),
              HasSubstr("does not depend on the rate"));
  EXPECT_THAT(refusal("liquid_model = \"maxwel\"\n" + k_elastic), HasSubstr("did you mean 'maxwell'?"));
}

TEST(FlowInput, AFlowStressThatRisesWithTemperatureIsRefusedWithTheIntervalAndTheReason) {
  const std::string rising =
      "flow_stress = { argument_unit = \"degC\", unit = \"MPa\", points = [[20, 60], [200, 40], [300, 45.5], "
      "[400, 10]] }\n";
  EXPECT_THAT(flow_refusal(rising),
              AllOf(HasSubstr("test.toml:8:15"), HasSubstr("from 40 MPa at 200 degC to 45.5 MPa at 300 degC"),
                    HasSubstr("2.121"), HasSubstr("entropy"), HasSubstr("allow_thermal_hardening = true")));
  EXPECT_TRUE(with_flow(rising + "allow_thermal_hardening = true").flow);

  std::string curves = k_curves;
  curves.replace(curves.find("[0, 20]"), 7, "[0, 55]").replace(curves.find("[0.2, 30]"), 9, "[0.2, 60]");
  EXPECT_THAT(flow_refusal(curves),
              AllOf(HasSubstr("test.toml:11:10"), HasSubstr("from 50 MPa at 26.85 degC"),
                    HasSubstr("to 55 MPa at 326.85 degC")));
}

struct Broken {
  const char *keys, *message;
};

TEST(FlowInput, WhatDoesNotFitTogetherIsRefusedWithItsPlace) {
  const std::string saturation = "isotropic_hardening = \"saturation\"\nsaturation_rate = 10\n";
  const Broken cases[] = {
      {"", "'flow_stress' is missing in [plasticity]"},
      {"flow_stress = \"0 MPa\"", "'flow_stress'"},
      {"flow_stress = \"-5 MPa\"", "out of range"},
      {"flow_stress = \"5 mm\"", "stress"},
      {"flow_stress = \"199.1E+3 MPa\"", "more than a tenth of Young's modulus"},
      {"flow_stress = { argument_unit = \"K\", unit = \"MPa\", extrapolation = \"linear\", points = [[300, "
       "60], [700, 20]] }",
       "cannot be continued linearly"},
      {"flow_stress = \"50 MPa\"\nflow_stres = \"1 MPa\"", "did you mean 'flow_stress'?"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"linear\"", "'hardening_modulus' is missing"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"linear\"\nhardening_modulus = \"-1 MPa\"",
       "out of range"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"linear\"\nhardening_modulus = \"1 MPa\"\n"
       "saturation_rate = 3",
       "'saturation_rate' does not belong"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"linea\"", "did you mean 'linear'?"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"saturation\"\nsaturation_rate = 10",
       "'saturation_stress' is missing"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"saturation\"\nsaturation_stress = \"90 MPa\"",
       "'saturation_rate' is missing"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"saturation\"\nsaturation_stress = \"90 MPa\"\n"
       "saturation_rate = 0",
       "'saturation_rate'"},
      {"flow_stress = { argument_unit = \"K\", unit = \"MPa\", points = [[300, 60], [700, 20]] }\n"
       "isotropic_hardening = \"saturation\"\nsaturation_rate = 10\n"
       "saturation_stress = { argument_unit = \"K\", unit = \"MPa\", points = [[300, 100], [500, 30]] }",
       "at 226.85 degC is 30 MPa, below the flow stress 40 MPa"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"power\"\nreference_strain = 0.01",
       "'hardening_exponent' is missing"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"power\"\nreference_strain = 0\n"
       "hardening_exponent = 0.2",
       "'reference_strain'"},
      {"flow_stress = \"50 MPa\"\nisotropic_hardening = \"power\"\nreference_strain = 0.01\n"
       "hardening_exponent = 1.2",
       "'hardening_exponent'"},
      {"flow_stress = \"50 MPa\"\nkinematic_hardening = \"linear\"", "'kinematic_modulus' is missing"},
      {"flow_stress = \"50 MPa\"\nkinematic_hardening = \"linear\"\nkinematic_modulus = \"1 GPa\"\nrecall = "
       "5",
       "'recall' does not belong"},
      {"flow_stress = \"50 MPa\"\nkinematic_hardening = \"armstrong_frederick\"\nkinematic_modulus = \"1 "
       "GPa\"",
       "'recall' is missing"},
      {"flow_stress = \"50 MPa\"\nviscosity = \"1e7 Pa s\"", "'viscosity' does not belong"},
      {"flow_stress = \"50 MPa\"\nrate_dependence = \"perzyna\"\nviscosity = \"0 Pa s\"", "'viscosity'"},
      {"flow_stress = \"50 MPa\"\nrate_dependence = \"perzyna\"\nviscosity = \"1e7 Pa s\"\nrate_exponent = "
       "0.05\ndrag_stress = \"1 MPa\"",
       "'rate_exponent'"},
      {"flow_stress = \"50 MPa\"\nrate_dependence = \"perzyna\"\nviscosity = \"1e7 Pa s\"\nrate_exponent = 3",
       "there is no 'drag_stress'"},
      {"flow_stress = \"50 MPa\"\nrate_dependence = \"perzyna\"\nviscosity = \"1e7 Pa s\"\nrate_exponent = "
       "3\ndrag_stress = \"0 MPa\"",
       "'drag_stress'"},
      {"flow_stress = \"50 MPa\"\ntaylor_quinney = 1.2", "'taylor_quinney'"},
      {"isotropic_hardening = \"table\"", "has no flow curves"},
      {"isotropic_hardening = \"table\"\nflow_stress = \"50 MPa\"", "'flow_stress' does not belong"},
  };
  for (const Broken& broken : cases)
    EXPECT_THAT(flow_refusal(broken.keys), HasSubstr(broken.message)) << broken.keys;
}

TEST(FlowInput, AFlowCurveThatIsNoneIsRefusedWithItsPlace) {
  const auto curve = [](const std::string& stress) {
    return "isotropic_hardening = \"table\"\n[[plasticity.flow_curve]]\ntemperature = \"300 K\"\nstress = " +
           stress + "\n";
  };
  EXPECT_THAT(flow_refusal(curve("{ unit = \"MPa\", points = [[0.002, 50], [0.1, 60]] }")),
              AllOf(HasSubstr("test.toml:11:10"), HasSubstr("starts at the plastic strain 0.002")));
  EXPECT_THAT(flow_refusal(curve("{ unit = \"MPa\", points = [[0, 50], [0.1, 60], [0.3, 55]] }")),
              AllOf(HasSubstr("falls from 60 MPa at the plastic strain 0.1 to 55 MPa at 0.3"),
                    HasSubstr("softening is not supported")));
  EXPECT_THAT(flow_refusal(curve("{ unit = \"MPa\", points = [[0, 50], [0.1, 60], [0.1, 65]] }")),
              HasSubstr("must increase"));
  EXPECT_THAT(
      flow_refusal(curve("{ unit = \"MPa\", extrapolation = \"linear\", points = [[0, 5], [1, 6]] }")),
      HasSubstr("has an extrapolation"));
  EXPECT_THAT(flow_refusal(curve("{ unit = \"MPa\", valid = [0, 0.5], points = [[0, 5], [1, 6]] }")),
              HasSubstr("in 'valid'"));
  EXPECT_THAT(flow_refusal(curve("\"50 MPa\"\n[[plasticity.flow_curve]]\ntemperature = \"300 K\"\n"
                                 "stress = \"40 MPa\"")),
              HasSubstr("two flow curves at 26.85 degC"));
  EXPECT_THAT(flow_refusal(k_falling + "[[plasticity.flow_curve]]\ntemperature = \"300 K\"\n"
                                       "stress = \"40 MPa\""),
              HasSubstr("'flow_curve' does not belong"));
}

TEST(FlowInput, PlasticityNeedsElasticProperties) {
  EXPECT_THAT(refusal(k_elastic.substr(0, k_elastic.find("young")) + "[plasticity]\n" + k_falling),
              AllOf(HasSubstr("test.toml:4"), HasSubstr("no elastic properties")));
}

TEST(FlowInput, AMaxwellsLiquidWithoutAViscosityLeavesItToTheProgram) {
  const std::string change = k_solidifies.substr(k_solidifies.find("[["));
  EXPECT_TRUE(read(k_elastic + change).chooses_viscosity());
  EXPECT_FALSE(read(k_elastic + k_solidifies).chooses_viscosity());
  EXPECT_FALSE(read("liquid_model = \"modified_shear\"\n" + k_elastic + change).chooses_viscosity());
}

TEST(FlowInput, TheFlowDataLeaveTheirRangeLikeTheOthers) {
  const Material m = with_flow(R"(isotropic_hardening = "saturation"
flow_stress = { argument_unit = "K", unit = "MPa", points = [[300, 60], [700, 20]], extrapolation = "error" }
saturation_stress = { value = "90 MPa", valid = ["300 K", "600 K"] }
saturation_rate = 10)");
  EXPECT_TRUE(left_ranges(m, 300, 600).empty());
  const auto left = left_ranges(m, 300, 800);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].property, "plasticity.flow_stress");
  EXPECT_TRUE(left[0].refused);
  EXPECT_EQ(left[0].valid_to, 700);
  EXPECT_EQ(left[1].property, "plasticity.saturation_stress");
  EXPECT_FALSE(left[1].refused);

  const auto beyond_curves = left_ranges(with_flow(k_curves), 280, 500);
  ASSERT_EQ(beyond_curves.size(), 1u);
  EXPECT_EQ(beyond_curves[0].property, "plasticity.flow_curve");
  EXPECT_EQ(beyond_curves[0].valid_from, 300);
}

TEST(FlowInput, EveryTableThatAKindReadsIsAProperty) {
  const auto names = [](const Material& m) {
    std::vector<std::string> result;
    for (const Property& p : m.properties()) result.emplace_back(p.name);
    return result;
  };
  EXPECT_THAT(names(read(k_elastic)), ::testing::ElementsAre("conductivity", "specific_heat", "young_modulus",
                                                             "poisson_ratio", "expansion"));
  EXPECT_THAT(names(with_flow(k_falling + R"(isotropic_hardening = "power"
reference_strain = 0.01
hardening_exponent = 0.2
kinematic_hardening = "armstrong_frederick"
kinematic_modulus = "2 GPa"
recall = 100
rate_dependence = "perzyna"
viscosity = "1e7 Pa s"
rate_exponent = 3
drag_stress = "30 MPa")")),
              ::testing::IsSupersetOf({"plasticity.flow_stress", "plasticity.reference_strain",
                                       "plasticity.hardening_exponent", "plasticity.kinematic_modulus",
                                       "plasticity.recall", "plasticity.viscosity",
                                       "plasticity.rate_exponent", "plasticity.drag_stress"}));
}

TEST(FlowInput, TheExamplesOfTheGuideAreRead) {
  std::ifstream guide(SOLIDUS_SOURCE_DIR "/docs/guide/materials.md");
  ASSERT_TRUE(guide);
  int examples = 0;
  bool inside = false;
  std::string block;
  for (std::string line; std::getline(guide, line);) {
    if (inside && line == "```") {
      const bool whole_card = block.rfind("title", 0) == 0;
      const Material m = read(whole_card ? block : k_elastic + k_solidifies + block);
      EXPECT_EQ(m.flow.has_value(), block.find("plasticity") != std::string::npos) << block;
      ++examples;
      inside = false;
    } else if (inside) {
      block += line + "\n";
    } else if (line == "```toml") {
      inside = true;
      block.clear();
    }
  }
  EXPECT_GE(examples, 7);
}

TEST(FlowInput, EveryKeyIsExplainedWithItsFormula) {
  const SectionInfo& keys = material_section().info();
  EXPECT_THAT(explain(keys, "plasticity.isotropic_hardening"),
              HasSubstr("sigma_0 + (sigma_inf - sigma_0)(1 - exp(-delta xi)) + H xi"));
  EXPECT_THAT(explain(keys, "plasticity.viscosity"), HasSubstr("3/2 eta"));
  for (const Key& key : flow_section().info().keys) EXPECT_FALSE(key.doc_text.empty()) << key.name;
}

}  // namespace
}  // namespace solidus::material
