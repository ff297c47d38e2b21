/// Laws of kinematic hardening and of rate dependence and a model of the liquid that the sources do not name:
/// keys, documentation, consistency by automatic differentiation, both mappings, derivatives with respect to
/// temperature.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../laws/consistency.hpp"
#include "../../laws/hyperbolic_sine.hpp"
#include "../../laws/late_strength.hpp"
#include "../../laws/marquis.hpp"
#include "input/document.hpp"
#include "input/key_docs.hpp"
#include "material/cards/library.hpp"
#include "material/derivatives/thermal_derivatives.hpp"
#include "material/tensile.hpp"
#include "thermal_cases.hpp"

namespace solidus::material::test {
namespace {

using solidus::test::HyperbolicSine;
using solidus::test::k_hyperbolic_sine;
using solidus::test::k_late_strength;
using solidus::test::k_marquis;
using solidus::test::LateStrength;
using solidus::test::Marquis;
using ::testing::HasSubstr;
using J = Jet<double>;

const std::string k_file = R"(density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1.2e-5 1/K"
liquid_model = "late_strength"
strength_power = 1.5
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "2e5 J/kg"
fraction = { kind = "linear", solidus = "880 K", liquidus = "930 K" }
[plasticity]
flow_stress = "100 MPa"
kinematic_hardening = "marquis"
kinematic_modulus = "5 GPa"
marquis_recall = 80
marquis_share = 3
rate_dependence = "hyperbolic_sine"
sinh_stress = "20 MPa"
sinh_rate = "1e-3 1/s"
)";

Material read(std::string text, const std::string& line = {}, const std::string& instead = {}) {
  if (!line.empty()) text.replace(text.find(line), line.size(), instead);
  return make_material("test", material_section().read(parse_document(text, "test.toml")));
}
std::string refusal(const std::string& line, const std::string& instead) {
  try {
    read(k_file, line, instead);
  } catch (const InputError& error) {
    EXPECT_GT(error.where().line, 0);
    return error.what();
  }
  return "accepted";
}

/// Everything varies with temperature.
Material added_material() {
  Material m = varying_material({IsotropicHardening::saturation, KinematicHardening::linear});
  m.flow->kinematic = k_marquis.kind;
  m.flow->recall = {Table({300, 1000}, {80, 150}), Table({300, 1000}, {3, 2})};
  m.flow->rate_dependence = k_hyperbolic_sine.kind;
  m.flow->rate = {Table({300, 1000}, {30e6, 10e6}), Table({300, 1000}, {1e-3, 2e-2}), Table(0.0)};
  return m;
}
Viscoplastic::State<double> loaded_state() {
  Viscoplastic::State<double> state;
  state.plastic_strain = Sym<double>{{2e-3, -1e-3, -1e-3, 1e-3, 0, 5e-4}};
  state.back_strain = Sym<double>{{-2e-3, 1.5e-3, 0.5e-3, -1e-3, 0, 0}};
  state.hardening = 4e-3;
  return state;
}
const Sym<double> k_strain{{4e-3, -3e-3, 4e-3, 1e-3, 2e-3, -1e-3}};

TEST(AddedFlowLaws, AreReadFromAMaterialFileWithTheirParametersChecked) {
  const Material m = read(k_file);
  EXPECT_EQ(m.flow->kinematic, k_marquis.kind);
  EXPECT_DOUBLE_EQ(m.flow->recall[Marquis::recall_at_end].value(300), 80);
  EXPECT_DOUBLE_EQ(m.flow->recall[Marquis::first_share].value(300), 3);
  EXPECT_EQ(m.flow->rate_dependence, k_hyperbolic_sine.kind);
  EXPECT_DOUBLE_EQ(m.flow->rate[HyperbolicSine::scale].value(300), 20e6);
  EXPECT_FALSE(m.flow->rate_independent());
  EXPECT_EQ(m.liquid_model, k_late_strength.model);
  EXPECT_DOUBLE_EQ(m.liquid_numbers[0], 1.5);
  EXPECT_FALSE(m.chooses_viscosity());
  std::vector<std::string> names;
  for (const Property& property : m.flow->properties()) names.push_back(property.name);
  EXPECT_THAT(names, ::testing::ElementsAre("plasticity.flow_stress", "plasticity.kinematic_modulus",
                                            "plasticity.marquis_recall", "plasticity.marquis_share",
                                            "plasticity.sinh_stress", "plasticity.sinh_rate"));
  EXPECT_THAT(refusal("marquis_recall = 80\n", ""), HasSubstr("marquis_recall"));
  EXPECT_THAT(refusal("marquis_share = 3", "marquis_share = -1"), HasSubstr("marquis_share"));
  EXPECT_THAT(refusal("\"20 MPa\"", "\"20 mm\""), HasSubstr("sinh_stress"));
  EXPECT_THAT(refusal("strength_power = 1.5", "strength_power = 0.5"), HasSubstr("strength_power"));
  EXPECT_THAT(refusal("strength_power = 1.5\n", ""), HasSubstr("strength_power"));
  EXPECT_THAT(refusal("sinh_rate = ", "viscosity = \"1e9 Pa s\"\nsinh_rate = "), HasSubstr("viscosity"));
  EXPECT_THAT(
      refusal("rate_dependence = \"hyperbolic_sine\"\nsinh_stress = \"20 MPa\"\nsinh_rate = \"1e-3 1/s\"\n",
              ""),
      HasSubstr("does not depend on the rate"));
}

TEST(AddedFlowLaws, StandInTheReferencePageAndTheSchema) {
  const std::string manual = reference_manual(material_section().info(), "Material files");
  for (const char* text :
       {"marquis", "r falling to marquis_recall", "a, r at first in parts of r_inf", "hyperbolic_sine",
        "gamma' = f_S A sinh(Phi/S)", "sinh_rate", "late_strength", "strength_power"})
    EXPECT_THAT(manual, HasSubstr(text));
  EXPECT_THAT(json_schema(material_section().info(), "Material files"), HasSubstr("strength_power"));
}

TEST(AddedFlowLaws, LawsAreAddedBeforeTheKeysAreMadeOnly) {
  static const KinematicLawOf<Marquis> late_kinematic;
  static const RateLawOf<HyperbolicSine> late_rate;
  static const LiquidLawOf<LateStrength> late_liquid;
  material_section();
  EXPECT_THROW(add_kinematic_law(late_kinematic), std::logic_error);
  EXPECT_THROW(add_rate_law(late_rate), std::logic_error);
  EXPECT_THROW(add_liquid_law(late_liquid), std::logic_error);
}

TEST(KinematicLaws, HaveTheSlopeOfTheirRecallOnEveryTypeOfNumbers) {
  Material m = added_material();
  for (const auto kind : {KinematicHardening::armstrong_frederick, k_marquis.kind}) {
    const KinematicLaw& law = kinematic_law(kind);
    EXPECT_TRUE(law.recalls());
    const auto p = flow_properties_at(*m.flow, 500.0);
    const auto held = flow_properties_at(*m.flow, J(500.0));
    const auto lanes = flow_properties_at(*m.flow, Lane(500.0));
    for (const double xi : {0.0, 1e-4, 0.01, 0.3}) {
      const Recall<double> r = law.recall(p, xi);
      EXPECT_GE(r.value, 0);
      const Recall<J> along = law.recall(held, J::variable(xi));
      EXPECT_DOUBLE_EQ(along.value.v, r.value);
      EXPECT_NEAR(along.value.d, r.slope, 1e-12 * std::abs(r.slope));
      EXPECT_NEAR(law.recall(lanes, Lane(xi)).value[3], r.value, 1e-14 * r.value);
    }
  }
}

TEST(RateLaws, HaveTheSlopeOfTheirOverstressOnEveryTypeOfNumbers) {
  const Material perzyna = varying_material({IsotropicHardening::none, KinematicHardening::none, 1e9, 4});
  for (const Material& m : {perzyna, added_material()}) {
    const RateLaw& law = rate_law(m.flow->rate_dependence);
    const auto p = flow_properties_at(*m.flow, 500.0);
    const auto held = flow_properties_at(*m.flow, J(500.0));
    const auto lanes = flow_properties_at(*m.flow, Lane(500.0));
    for (const double rate : {1e-8, 1e-4, 1e-2, 3.0}) {
      const Overstress<double> x = law.overstress(p, rate);
      EXPECT_GT(x.stress, 0);
      const Overstress<J> along = law.overstress(held, J::variable(rate));
      EXPECT_NEAR(along.stress.d, x.slope, 1e-11 * x.slope);
      EXPECT_NEAR(law.overstress(lanes, Lane(rate)).stress[5], x.stress, 1e-12 * x.stress);
    }
    EXPECT_NEAR(tensile_overstress(*m.flow, 1e-3, 500),
                std::sqrt(1.5) * law.overstress(p, std::sqrt(1.5) * 1e-3).stress, 1e-6);
  }
}

TEST(AddedFlowLaws, HaveTangentsThatAreTheDerivativesOfTheStressInBothMappings) {
  solidus::test::expect_consistent_tangents(added_material(), 500, k_strain);
  solidus::test::expect_consistent_tangents(added_material(), 500, k_strain, loaded_state());
  EXPECT_FALSE(Viscoplastic(added_material()).symmetric());
  Material viscous = added_material();  // symmetric, and far beyond the yield surface
  viscous.flow->kinematic = KinematicHardening::linear;
  viscous.flow->rate[HyperbolicSine::scale] = 300e6;
  EXPECT_TRUE(Viscoplastic(viscous).symmetric());
  solidus::test::expect_consistent_tangents(viscous, 500, k_strain, loaded_state());
}

TEST(AddedFlowLaws, HaveTangentsInAModelOfTheLiquidThatTheSourcesDoNotName) {
  Material m = added_material();
  m.liquid_model = k_late_strength.model;
  m.liquid_numbers = {1.5};
  for (const double theta : {885.0, 905.0, 928.0})
    solidus::test::expect_consistent_tangents(m, theta, k_strain, loaded_state());
}

TEST(AddedFlowLaws, HaveTheDerivativesWithRespectToTemperatureOfTheUpdate) {
  for (const double theta : {420.0, 650.0, 905.0})
    for (const auto model : {LiquidModel::maxwell, k_late_strength.model}) {
      Material m = added_material();
      m.liquid_model = model;
      m.liquid_numbers = {1.5};
      const Viscoplastic law(m);
      const Sym<double> strain = k_strain;
      const double dt = 0.1;
      const auto p = law.properties_at(theta, k_start_temperature);
      const auto r = law.update(p, loaded_state(), strain, dt);
      ASSERT_GT(r.flow_increment, 0);
      const auto d = thermal_derivatives(law, thermal_properties(law, theta, k_start_temperature, {}),
                                         loaded_state(), strain, dt, r);
      const auto along = law.update<J>(law.properties_at(J::variable(theta), J(k_start_temperature)),
                                       convert<J>(loaded_state()), convert<J>(strain), dt);
      const double size = std::abs(along.stress[0].d) + 1e3;
      for (int i = 0; i < 6; ++i) EXPECT_NEAR(d.stress[i], along.stress[i].d, 1e-8 * size) << theta;
      EXPECT_NEAR(d.flow_increment.temperature, along.flow_increment.d,
                  1e-8 * std::abs(along.flow_increment.d));
      EXPECT_NEAR(d.dissipation.temperature, along.dissipation.d, 1e-7 * std::abs(along.dissipation.d));
      for (int b = 0; b < 6; ++b) {
        Sym<J> varied = convert<J>(strain);
        varied[b].d = b < 3 ? 1.0 : 0.5;
        const auto jets = law.update<J>({{J(p.elastic.bulk), J(p.elastic.shear), J(p.elastic.thermal_strain),
                                          J(p.elastic.solid_fraction), J(p.elastic.viscosity)},
                                         convert<J>(p).flow},
                                        convert<J>(loaded_state()), varied, dt);
        EXPECT_NEAR(d.dissipation.strain[b], jets.dissipation.d, 1e-7 * norm(d.dissipation.strain)) << b;
      }
    }
}

TEST(AddedFlowLaws, AnswerOnLanesAsOnNumbers) {
  const Material m = added_material();
  const Viscoplastic law(m);
  const auto one = law.update(law.properties_at(500.0, 300.0), loaded_state(), k_strain, 0.1);
  const auto eight = law.update(law.properties_at(Lane(500.0), Lane(300.0)), convert<Lane>(loaded_state()),
                                convert<Lane>(k_strain), 0.1);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(eight.stress[i][2], one.stress[i], 1e-9 * norm(one.stress));
  EXPECT_EQ(eight.status, Status::converged);
}

}  // namespace
}  // namespace solidus::material::test
