// Slips of a first-time user on a small casting, each found with its own words; the casting itself gives
// none.
#include "model/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/log.hpp"
#include "model/run.hpp"

namespace {

using namespace solidus;
using namespace solidus::model;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* k_casting = R"(title = "An aluminium block on a steel mould"
[analysis]
kind = "plane_strain"
physics = "heat"
gravity = "9.81 m/s2"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
lower_divisions = [8, 4]
upper = ["40 mm", "20 mm"]
upper_divisions = [8, 4]
[time]
end = "60 s"
step = "1 s"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "air"
group = "lower_y_min"
kind = "film"
coefficient = "20 W/m2/K"
ambient = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
contact_law = "power"
conductance = "2000 W/m2/K"
exponent = 0
gap_law = "constant"
)";

/// `text` with the first `what` replaced; a test that changes nothing would prove nothing.
std::string changed(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

class FindingsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    logging::set_level(logging::Level::silent);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    logging::set_level(logging::Level::info);
    std::filesystem::remove_all(folder_);
  }
  /// What `check` says of a case: its warnings, or the message of its error.
  std::vector<std::string> said_of(const std::string& text) const {
    std::ofstream(folder_ / "case.toml") << text;
    logging::clear_warnings();
    try {
      check_run(load_case(folder_ / "case.toml"));
    } catch (const InputError& error) {
      return {std::string("error: ") + error.what()};
    }
    return logging::warnings();
  }
  std::filesystem::path folder_ = std::filesystem::path(SOLIDUS_BINARY_DIR) / "findings";
};

TEST_F(FindingsTest, ANormalPourGivesNone) {
  EXPECT_THAT(said_of(k_casting), IsEmpty());
}

TEST_F(FindingsTest, EachSlipIsNamed) {
  struct Slip {
    std::string what, with, said;
  };
  const std::string contact = std::string(k_casting).substr(std::string(k_casting).find("[[contact]]"));
  const std::string heat = std::string(k_casting).substr(std::string(k_casting).find("[contact.heat]"));
  const std::vector<Slip> slips = {
      {contact, "", "no contact joins them"},
      {heat, "", "has no [contact.heat]"},
      {contact, contact + changed(contact, "\"interface\"", "\"again\""), "join the same two surfaces"},
      {"\"2000 W/m2/K\"", "\"2000 W/mm2/K\"", "error"},
      {"\"2000 W/m2/K\"", "\"2 W/m2/K\"", "conducts 2 W/m2/K"},
      {"gap_law = \"constant\"", "gap_law = \"gas\"\ngas_conductivity = \"50 W/m/K\"", "the gas in the gap"},
      {"group = \"lower_y_min\"", "group = \"lower_top\"", "which the contact 'interface' cools too"},
      {"[[contact]]",
       "[[thermal_condition]]\nname = \"air again\"\ngroup = \"lower_y_min\"\nkind = \"film\"\n"
       "coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\n[[contact]]",
       "lie on the same surface"},
      {"\"700 degC\"", "\"500 degC\"", "below the liquidus"},
      {"\"700 degC\"", "\"700 K\"", "below the liquidus"},
      {"\"700 degC\"", "\"1700 degC\"", "above the liquidus"},
      {"ambient = \"20 degC\"", "ambient = \"20 K\"", "surroundings of -253 degC"},
      {"ambient = \"20 degC\"", "ambient = \"2000 degC\"", "surroundings of 2000 degC"},
      {"\"20 W/m2/K\"", "\"2000 W/mm2/K\"", "error"},
      {"\"9.81 m/s2\"", "\"9.81 mm/s2\"", "gravity is 0.00981"},
      {"\"9.81 m/s2\"", "\"98.1 m/s2\"", "gravity is 98.1"},
      {"step = \"1 s\"", "step = \"60 s\"", "one step of 60 s"},
      {"lower = [\"40 mm\", \"20 mm\"]", "lower = [\"160 m\", \"20 m\"]", "the mesh is 160 m"}};
  for (const Slip& slip : slips) {
    const std::vector<std::string> said = said_of(changed(k_casting, slip.what, slip.with));
    EXPECT_THAT(said, ::testing::Contains(HasSubstr(slip.said))) << slip.with;
  }
  const std::string swapped =
      changed(changed(changed(k_casting, "steel_mould", "x"), "aluminium_alsi7mg", "steel_mould"), "\"x\"",
              "\"aluminium_alsi7mg\"");
  EXPECT_THAT(said_of(swapped), ::testing::Contains(HasSubstr("swapped")));
}

TEST_F(FindingsTest, PropertiesThatNoMaterialHasAreNamed) {
  const auto said_of_material = [&](const std::string& change, const std::string& to) {
    std::string card = changed(R"(title = "Own"
density = "2700 kg/m3"
conductivity = "159 W/m/K"
specific_heat = "1000 J/kg/K"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "389 kJ/kg"
[phase_change.fraction]
kind = "linear"
solidus = "550 degC"
liquidus = "613 degC"
)",
                               change, to);
    std::ofstream(folder_ / "own.toml") << card;
    return said_of(changed(k_casting, "\"aluminium_alsi7mg\"", "\"own.toml\""));
  };
  EXPECT_THAT(said_of_material("\"Own\"", "\"Mine\""), IsEmpty());
  EXPECT_THAT(said_of_material("389 kJ/kg", "389 J/kg"),
              ::testing::Contains(HasSubstr("latent heat of 389")));
  EXPECT_THAT(said_of_material("159 W/m/K", "159 kW/m/K"), ::testing::Contains(HasSubstr("conductivity of")));
  EXPECT_THAT(said_of_material("159 W/m/K", "0.159 W/m/K"),
              ::testing::Contains(HasSubstr("conductivity of")));
  EXPECT_THAT(said_of_material("2700 kg/m3", "2.7 kg/m3"), ::testing::Contains(HasSubstr("density of")));
}

}  // namespace
