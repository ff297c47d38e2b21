/// Roles of bodies, the library of interface laws, interfaces of a mesh, and one case for heat alone and for
/// heat and mechanics.
#include "cases/roles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "cases/case_materials.hpp"
#include "cases/interface_library.hpp"
#include "cases/physics_switch.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "material/cards/library.hpp"
#include "setup/mesh_input.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string k_case = R"(title = "A cylinder in its mould"
[analysis]
kind = "axisymmetric"
[mesh]
shape = "cylinder_in_mould"
element = "quad4"
[mesh.cylinder_in_mould]
radius = "10 mm"
height = "20 mm"
mould_wall = "10 mm"
mould_bottom = "10 mm"
mould_height = "30 mm"
element_size = "5 mm"
mould_element_size = "5 mm"
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "part"
material = "aluminium_alsi7mg"
initial_temperature = "670 degC"
[[body]]
name = "mould"
material = "green_sand"
initial_temperature = "20 degC"
)";

CaseSpec read(const std::string& more) {
  CaseSpec spec = case_keys().read(parse_document(k_case + more, "case.toml"));
  setup::check_case(spec);
  decide_physics(spec);
  return spec;
}

std::string error(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

TEST(Roles, NamesTellThem) {
  EXPECT_EQ(role_in_name("Riser_2"), Role::riser);
  EXPECT_EQ(role_in_name("Speiser"), Role::riser);
  EXPECT_EQ(role_in_name("iron_chill"), Role::chill);
  EXPECT_EQ(role_in_name("lower die"), Role::die);
  EXPECT_EQ(role_in_name("diesel"), std::nullopt);
  EXPECT_EQ(role_in_name("body_1"), std::nullopt);
}

TEST(Roles, SandOnlyConductsWhereNothingElseIsSaid) {
  const CaseSpec spec = read("");
  EXPECT_EQ(spec.bodies[0].physics, BodySpec::ActivePhysics::all);
  EXPECT_EQ(spec.bodies[1].physics, BodySpec::ActivePhysics::heat);
  EXPECT_NO_THROW(load_materials(spec));
  CaseSpec asked = read("physics = \"all\"\n");
  EXPECT_THAT(error([&] { load_materials(asked); }), HasSubstr("has no elastic properties"));
}

TEST(Roles, AChillOfAnAlloyThatCanMeltIsNoCasting) {
  const CaseSpec spec = read(
      "role = \"chill\"\n[[body]]\nname = \"x\"\ngroup = \"mould\"\nrole = \"chill\"\n"
      "material = \"grey_iron\"\ninitial_temperature = \"20 degC\"\n");
  const auto materials = load_materials(spec);
  EXPECT_NE(materials[0].solidification(), nullptr);
  EXPECT_EQ(materials[2].solidification(), nullptr);
  EXPECT_FALSE(materials[2].phase_changes.empty());  // it still takes its latent heat
}

TEST(InterfaceLibrary, HasALawForEveryPairOfACastingAndEachMaterialOfTheLibrary) {
  const std::vector<InterfaceCard> cards = interface_cards();
  ASSERT_GE(cards.size(), 15U);
  for (const InterfaceCard& card : cards) {
    EXPECT_FALSE(card.source.empty()) << card.name;
    EXPECT_NO_THROW(contact::HeatTransferLaw(card.heat)) << card.name;
  }
  const auto law = [&](const char* a, Role ra, const char* b, Role rb) {
    const InterfaceCard* card = best_card(cards, {a, ra}, {b, rb});
    return card == nullptr ? std::string("none") : card->name;
  };
  EXPECT_EQ(law("aluminium_alsi7mg", Role::casting, "green_sand", Role::mould), "aluminium_in_sand");
  EXPECT_EQ(law("green_sand", Role::core, "aluminium_alsi7mg", Role::riser), "aluminium_in_sand");
  EXPECT_EQ(law("grey_iron", Role::casting, "furan_sand", Role::mould), "iron_in_sand");
  EXPECT_EQ(law("tables/my_alloy.toml", Role::casting, "green_sand", Role::mould), "metal_in_sand");
  EXPECT_EQ(law("grey_iron", Role::casting, "grey_iron", Role::chill), "metal_on_chill");
  EXPECT_EQ(law("iron_chill", Role::chill, "green_sand", Role::mould), "chill_in_sand");
  EXPECT_EQ(law("green_sand", Role::core, "green_sand", Role::mould), "core_in_sand");
  EXPECT_EQ(law("aluminium_alsi7mg", Role::casting, "h13_tool_steel", Role::die), "metal_in_die");
  for (const std::string& material : material::material_names(material_folders()))
    for (const Role role : {Role::mould, Role::core, Role::chill, Role::sleeve, Role::die, Role::insulation})
      EXPECT_NE(best_card(cards, {"aluminium_alsi7mg", Role::casting}, {material, role}), nullptr)
          << material;
}

/// The first and the last number of a text such as "40 (over a gap) to 3000 W/m2/K".
std::array<double, 2> ends_of(const std::string& range) {
  const std::size_t to = range.find(" to ");
  EXPECT_NE(to, std::string::npos) << range;
  EXPECT_THAT(range, ::testing::EndsWith(" W/m2/K"));
  return {std::stod(range), std::stod(range.substr(to + 4))};
}

TEST(InterfaceLibrary, RangesHoldTheConductanceOfTheirCardAndWhatWasPublished) {
  int published = 0;
  for (const InterfaceCard& card : interface_cards()) {
    const auto [low, high] = ends_of(card.range);
    const double closed = contact::HeatTransferLaw(card.heat).at(0, 101325, 700).value;
    EXPECT_TRUE(low <= closed && closed <= high) << card.name << ": " << closed;
    for (const PublishedConductance& p : card.published) {
      EXPECT_TRUE(low <= p.lowest && p.lowest <= p.highest && p.highest <= high)
          << card.name << ": " << p.what;
      EXPECT_FALSE(p.by.empty() || p.what.empty()) << card.name;
    }
    published += card.published.empty() ? 0 : 1;
  }
  EXPECT_GE(published, 6);
}

TEST(InterfaceLibrary, PatternsHaveStars) {
  EXPECT_TRUE(matches("*sand*", "green_sand"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_FALSE(matches("*iron", "iron_chill"));
}

TEST(Interfaces, BecomeContactsBetweenTheFacesThatTouch) {
  CaseSpec spec = read(
      "[[interface]]\nbodies = \"all\"\n[[thermal_condition]]\nname = \"air\"\ngroup = \"mould_free\"\n"
      "kind = \"film\"\ncoefficient = \"10 W/m2/K\"\nambient = \"20 degC\"\n");
  const mesh::Mesh mesh = setup::load_mesh(spec);
  ASSERT_EQ(spec.contacts.size(), 1U);
  EXPECT_EQ(spec.contacts[0].name, "part_mould");
  EXPECT_EQ(spec.contacts[0].law, "aluminium_in_sand");
  EXPECT_DOUBLE_EQ(contact::HeatTransferLaw(*spec.contacts[0].heat).at(0, 0, 300).value, 1000);
  EXPECT_TRUE(mesh.surfaces.contains("part_to_mould"));
  EXPECT_TRUE(mesh.surfaces.at("mould_to_part").replicated);
  EXPECT_TRUE(mesh.surfaces.contains("part_free"));  // its top and the axis
}

TEST(Interfaces, SayWhatIsWrong) {
  EXPECT_THAT(error([] { read("[[interface]]\nbodies = [\"part\", \"mold\"]\n"); }), HasSubstr("mould"));
  EXPECT_THAT(error([] { read("[[interface]]\nbodies = \"part\"\n"); }), HasSubstr("between two bodies"));
  CaseSpec spec = read("[[interface]]\nbodies = \"all\"\nlaw = \"aluminum_in_sand\"\n");
  EXPECT_THAT(error([&] { setup::load_mesh(spec); }), HasSubstr("did you mean 'aluminium_in_sand'"));
}

TEST(PhysicsSwitch, LeavesOutOfACaseWhatHeatAloneDoesNotTakeAndNamesIt) {
  Value document = parse_document(k_case + R"(physics = "heat"
[[contact]]
name = "wall"
slave = "part_surface"
master = "mould_surface"
[contact.heat]
conductance = "1000 W/m2/K"
gap_law = "constant"
[contact.friction]
coefficient = 0.2
[[mechanical_condition]]
name = "support"
group = "part_axis"
kind = "displacement"
ur = "0 mm"
[[probe]]
name = "s"
kind = "point"
field = "von_mises"
unit = "MPa"
point = ["0 mm", "0 mm"]
[[probe]]
name = "pores"
kind = "point"
field = "pore_fraction"
point = ["0 mm", "0 mm"]
[[probe]]
name = "T"
kind = "point"
field = "temperature"
unit = "degC"
point = ["0 mm", "0 mm"]
[mechanics]
max_iterations = 30
[output]
fields = ["temperature", "stress"]
)",
                                  "case.toml");
  const std::string left_out = switch_physics(document, Physics::heat);
  for (const char* what :
       {"[mechanics]", "'support'", "friction of contact 'wall'", "probe 's', 'pores'", "stress"})
    EXPECT_THAT(left_out, HasSubstr(what));
  EXPECT_THAT(left_out, Not(HasSubstr("'T'")));
  const CaseSpec spec = case_keys().read(document);
  EXPECT_NO_THROW(setup::check_case(spec));
  EXPECT_EQ(spec.analysis.physics, Physics::heat);
  ASSERT_EQ(spec.probes.size(), 1U);
  ASSERT_EQ(spec.contacts.size(), 1U);
  EXPECT_FALSE(spec.contacts[0].friction);
}

TEST(PhysicsSwitch, InterfacesWithoutANameAreCalledByTheirBodies) {
  Value document = parse_document(R"([[interface]]
bodies = ["casting", "die"]
[interface.friction]
coefficient = 0.3
[[interface]]
bodies = "all"
[interface.friction]
coefficient = 0.3
)",
                                  "case.toml");
  EXPECT_EQ(switch_physics(document, Physics::heat),
            "friction of interface of 'casting' and 'die'; friction of interface of all bodies");
}

TEST(PhysicsSwitch, MakesACaseOfHeatACoupledOne) {
  Value document = parse_document(k_case, "case.toml");
  EXPECT_EQ(switch_physics(document, Physics::heat), "");
  EXPECT_EQ(switch_physics(document, Physics::thermomechanical), "");
  EXPECT_TRUE(case_keys().read(document).coupled());
}

TEST(Roles, SpruesRunnersAndGatesAreGatingWhichIsPoured) {
  for (const char* name : {"sprue", "runner_2", "ingate", "gating", "pouring_cup", "Einguss"})
    EXPECT_EQ(role_in_name(name), Role::gating) << name;
  EXPECT_TRUE(is_poured(Role::gating));
  EXPECT_EQ(name(Role::gating), "gating");
}

TEST(Interfaces, OfGatingAreThoseOfTheCasting) {
  const std::vector<InterfaceCard> cards = interface_cards();
  const InterfacePartner sand{"green_sand", Role::mould};
  const InterfaceCard* of_casting = best_card(cards, {"aluminium_alsi7mg", Role::casting}, sand);
  ASSERT_NE(of_casting, nullptr);
  EXPECT_EQ(best_card(cards, {"aluminium_alsi7mg", Role::gating}, sand), of_casting);
}

}  // namespace
}  // namespace solidus::cases
