// A ring that freezes on a core and then shrinks onto it, with the penalty that the program chooses: soft
// next to the melt, stiff where the skin is solid.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_folder.hpp"

namespace solidus {
namespace {

using testing::at;
using testing::CaseFolder;
using testing::CaseRun;

constexpr double k_core = 0.02, k_bore = 0.04, k_rim = 0.06, k_height = 0.01;  // radii, height [m]
constexpr double k_young = 70e9, k_poisson = 0.33, k_core_young = 210e9, k_core_poisson = 0.3;
constexpr double k_contraction = 2e-5 * 500;  // from the solidus at 600 °C to 100 °C

/// Two tubes with faces that do not match, r and z.
const std::string k_tubes = R"(
Macro Tube
  Point(p) = {ri, 0, 0}; Point(p+1) = {ro, 0, 0}; Point(p+2) = {ro, 0.01, 0}; Point(p+3) = {ri, 0.01, 0};
  Line(p) = {p, p+1}; Line(p+1) = {p+1, p+2}; Line(p+2) = {p+2, p+3}; Line(p+3) = {p+3, p};
  Curve Loop(p) = {p:p+3}; Plane Surface(p) = {p};
  Transfinite Curve{p, p+2} = n + 1; Transfinite Curve{p+1, p+3} = m + 1;
  Transfinite Surface{p}; Recombine Surface{p};
Return
p = 100; ri = 0.02; ro = 0.04; n = 10; m = 3; Call Tube;
p = 200; ri = 0.04; ro = 0.06; n = 10; m = 5; Call Tube;
Physical Surface("core") = {100}; Physical Surface("casting") = {200};
Physical Curve("core_outside") = {101}; Physical Curve("casting_bore") = {203};
Physical Curve("foot") = {100, 200};
)";

const std::string k_elastic = R"(
density = "2700 kg/m3"
conductivity = "100 W/m/K"
specific_heat = "1000 J/kg/K"
)";

std::string ring(bool rigid_core) {
  return fmt::format(R"(
title = "A ring on a core"
[analysis]
kind = "axisymmetric"
[mesh]
file = "tubes.geo"
[time]
end = "110 s"
step = "0.4 s"
[[body]]
name = "core"
material = "core.toml"
initial_temperature = "20 degC"
{}
[[body]]
name = "casting"
material = "casting.toml"
initial_temperature = "650 degC"
[[thermal_condition]]
name = "furnace"
group = "casting"
kind = "temperature"
temperature = {{ of = "time", argument_unit = "s", unit = "degC", points = [[0, 650], [110, 100]] }}
[[mechanical_condition]]
name = "foot"
group = "foot"
kind = "displacement"
uz = "0 mm"
[[contact]]
name = "fit"
slave = "casting_bore"
master = "core_outside"
[[probe]]
name = "gap"
kind = "minimum"
field = "gap"
group = "casting_bore"
unit = "um"
[[probe]]
name = "moved"
kind = "minimum"
field = "displacement"
component = "r"
group = "casting_bore"
unit = "um"
)",
                     rigid_core ? "physics = \"heat\"" : "");
}

/// Plane stress of thick rings (Lamé): the bore of the ring yields by a pressure as much as its contraction
/// is more than that of the core.
double pressure(bool rigid_core) {
  const auto square = [](double x) { return x * x; };
  const double a = square(k_core), b = square(k_bore), c = square(k_rim);
  const double of_ring = ((c + b) / (c - b) + k_poisson) / k_young,
               of_core = rigid_core ? 0 : ((b + a) / (b - a) - k_core_poisson) / k_core_young;
  return k_contraction / (of_ring + of_core);
}

/// The overlap that the summary of a run tells [um].
double told_overlap(const CaseFolder& folder, const std::string& run) {
  const std::string summary = testing::read_text(folder.root() / run / "summary.json");
  const std::string key = "\"value[m]\":";
  const std::size_t value = summary.find(key, summary.find("\"deepest_overlaps\""));
  return value == std::string::npos ? NAN : 1e6 * std::strtod(summary.c_str() + value + key.size(), nullptr);
}

void write_tubes(const CaseFolder& folder, int solidus) {
  folder.write("tubes.geo", k_tubes);
  folder.write("core.toml", k_elastic +
                                "expansion = \"0 1/K\"\nyoung_modulus = \"210 GPa\"\n"
                                "poisson_ratio = 0.3\n");
  folder.write("casting.toml", k_elastic + fmt::format(R"(
expansion = "2e-5 1/K"
young_modulus = "70 GPa"
poisson_ratio = 0.33
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "390 kJ/kg"
fraction = {{ solidus = "{} degC", liquidus = "602 degC" }}
)",
                                                       solidus));
}

TEST(HinderedContraction, ARingThatShrinksOntoACoreHasItsPressureAndDoesNotSinkIn) {
  const CaseFolder folder("hindered_contraction");
  write_tubes(folder, 600);
  for (const bool rigid : {true, false}) {
    const CaseRun run = folder.run(rigid ? "rigid" : "elastic", ring(rigid));
    ASSERT_TRUE(run.finished) << run.reason;
    const double area = 2 * std::numbers::pi * k_bore * k_height, exact = pressure(rigid);
    EXPECT_NEAR(run.history.at("contact_force[N]").back() / area, exact, 0.01 * exact) << rigid;
    const double shrinks = 1e6 * k_contraction * k_bore;  // freely [um]
    EXPECT_GT(run.history.at("gap[um]").back(), -0.01 * shrinks) << rigid;
  }
}

TEST(HinderedContraction, TheOverlapThatIsToldHasWhatASoftSkinSankIn) {
  const CaseFolder folder("hindered_contraction_mushy");
  write_tubes(folder, 500);
  const CaseRun run = folder.run("rigid", ring(true));
  ASSERT_TRUE(run.finished) << run.reason;
  // Into a core that does not move the bore has gone as far as it moved; overlaps are means around nodes.
  const double moved = -run.history.at("moved[um]").back(), told = told_overlap(folder, "rigid");
  EXPECT_NEAR(told, moved, 0.005 * moved);
  EXPECT_LT(-run.history.at("gap[um]").back(), 0.7 * told) << "a third of it while soft";
}

}  // namespace
}  // namespace solidus
