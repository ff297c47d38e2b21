/// The first law as a statement about two states (column internal_energy_defect): with interfaces that store
/// heat, friction, inertia, stages in which bodies leave, and the specific heat at constant strain.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;

std::string steel(const std::string& more = "") {
  return "density = \"7800 kg/m3\"\nconductivity = \"25 W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
         "poisson_ratio = 0.3\nexpansion = \"1.2e-5 1/K\"\n" +
         (more.empty() ? "young_modulus = \"200 GPa\"\n" : more);
}

/// A hot block lies on a cold one and is pressed on.
struct Blocks {
  std::string time = "end = \"10 s\"\nstep = \"1 s\"\n";
  std::string lower = {}, contact = {},
              more = {};  ///< keys of the lower body and of the contact; further sections
  std::string head = "pressure = \"10 MPa\"";
};

std::string blocks(const Blocks& b) {
  return fmt::format(R"(title = "Two blocks"
{}
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["20 mm", "10 mm"]
lower_divisions = [4, 2]
upper = ["10 mm", "10 mm"]
upper_divisions = [3, 2]
[heat]
tolerance = 1e-12
[mechanics]
tolerance = 1e-11
[[body]]
name = "upper"
material = "steel.toml"
initial_temperature = "400 degC"
[[body]]
name = "lower"
material = "steel.toml"
initial_temperature = "20 degC"
{}
[[mechanical_condition]]
name = "table"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "press"
group = "upper_y_max"
kind = "pressure"
{}
{}
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
{}
)",
                     b.time.starts_with("stage") ? b.time : "", b.lower, b.head, b.more, b.contact) +
         (b.time.starts_with("stage") ? "" : "[time]\n" + b.time);
}

const std::string k_heat = "[contact.heat]\nconductance = \"10000 W/m2/K\"\ngap_law = \"constant\"\n";
const std::string k_stores = k_heat + "[contact.interface]\nheat_capacity = \"500 J/m2/K\"\n";
const std::string k_guided =
    "[[mechanical_condition]]\nname = \"guide\"\ngroup = \"upper_y_max\"\nkind = \"displacement\"\nux = \"0 "
    "mm\"\n";
const std::string k_drawn =
    "[[mechanical_condition]]\nname = \"drawn\"\ngroup = \"upper_y_max\"\nkind = \"displacement\"\n"
    "ux = { of = \"time\", argument_unit = \"s\", unit = \"mm\", points = [[0, 0], [10, 0.5]] }\n";
const std::string k_hardens =
    "[contact.friction]\ninternal_variable_unit = \"kN/mm\"\n"
    "[[contact.friction.curve]]\ntemperature = \"20 degC\"\ninternal_variable = [0, 0.01]\n"
    "coefficient = [0.1, 0.2]\n"
    "[[contact.friction.curve]]\ntemperature = \"400 degC\"\ninternal_variable = [0, 0.01]\n"
    "coefficient = [0.1, 0.15]\n";

struct Variant {
  std::string name = {};
  Blocks blocks = {};
  std::string material = {};
  std::vector<std::string> settings = {};
};

class InternalEnergyOfBlocks : public ::testing::TestWithParam<Variant> {};

TEST_P(InternalEnergyOfBlocks, ChangesByHeatAndWork) {
  const Variant& v = GetParam();
  const CaseFolder folder("internal_energy_" + v.name);
  folder.write("steel.toml", v.material);
  const CaseRun run = folder.run("blocks", blocks(v.blocks), v.settings);
  ASSERT_TRUE(run.finished) << run.reason;
  ASSERT_TRUE(run.history.contains("internal_energy_defect[J]"));
  const double exchanged = run.history.at("heat_exchanged[J]").back();
  EXPECT_GT(exchanged, 1.0);
  for (const double defect : run.history.at("internal_energy_defect[J]"))
    EXPECT_LT(std::abs(defect), 1e-8 * exchanged);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, InternalEnergyOfBlocks,
    ::testing::Values(
        Variant{"capacity", {.contact = k_stores, .more = k_guided}, steel(), {}},
        Variant{"capacity_mechanics_first",
                {.contact = k_stores, .more = k_guided},
                steel(),
                {"coupling.order=mechanics_first"}},
        Variant{"friction",
                {.contact = k_heat + "[contact.friction]\ncoefficient = 0.2\n", .more = k_drawn},
                steel(),
                {}},
        Variant{"friction_stores", {.contact = k_stores + k_hardens, .more = k_drawn}, steel(), {}},
        Variant{"friction_stores_heat_first",
                {.contact = k_stores + k_hardens, .more = k_drawn},
                steel(),
                {"coupling.order=heat_first"}},
        Variant{"inertia",
                {.time = "end = \"1 ms\"\nstep = \"20 us\"\n",
                 .contact = k_stores,
                 .more = k_guided + "[dynamics]\nmethod = \"generalised_alpha\"\n"},
                steel(),
                {}},
        Variant{"stages",
                {.time = "stage = [{ name = \"press\", duration = \"10 s\", step = \"1 s\" }, "
                         "{ name = \"alone\", duration = \"5 s\", step = \"1 s\" }]\n",
                 .lower = "stages = \"press\"",
                 .contact = "stages = \"press\"\n" + k_stores,
                 .more = k_guided + "uy = \"0 mm\"\n",
                 .head = "stages = \"press\"\npressure = \"10 MPa\""},
                steel(),
                {}},
        Variant{"constant_strain",
                {.contact = k_stores, .more = k_guided},
                steel() + "specific_heat_at = \"constant_strain\"\n[plasticity]\nflow_stress = \"50 MPa\"\n"
                          "isotropic_hardening = \"linear\"\nhardening_modulus = \"2 GPa\"\n",
                {}}),
    [](const auto& of) { return of.param.name; });

// The energy at fixed strain is evaluated again where a modulus bends: no function of the fields.
TEST(InternalEnergy, HasNoColumnAtConstantStrainWhereAModulusFollowsTheTemperature) {
  const CaseFolder folder("internal_energy_none");
  folder.write("steel.toml",
               steel("young_modulus = { argument_unit = \"degC\", unit = \"GPa\", points = [[20, 210], [400, "
                     "180]] }\nspecific_heat_at = \"constant_strain\"\n"));
  const CaseRun run = folder.run("blocks", blocks({.contact = k_stores, .more = k_guided}));
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_FALSE(run.history.contains("internal_energy_defect[J]"));
}

}  // namespace
