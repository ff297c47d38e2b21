/// Heat through a Hertz contact: a warm ball pressed on a cold block of the same metal by a given force, as
/// case files that set nothing but the interface.
///
///          │ 120 °C, F
///          │ upper  ╱
///   x = 0  │     _╱
///          ├───''─────────
///          │ lower
///          │ 20 °C
///
/// Resistance of the contact, of radius a, between two half spaces: 1/(2 k a) where the contact is at one
/// temperature, 0.6/(k a) between the mean temperatures of the faces where the flux goes as Hertz's pressure,
/// q = q_0 √(1 − r²/a²). Both bodies are cylinders of radius b and length L: with ε = a/b that takes away
/// 2 · 0.35245 ε/(k a), and L/(π k b²) is added for each.
///
/// R. Holm, Electric Contacts, 1967 (half spaces); M. M. Yovanovich, IEEE Trans. Compon. Packag. Technol. 28
/// (2005) 182 (the cylinder: ψ = 1 − 1.40978 ε + 0.34406 ε³ of 1/(4 k a) each). With the flux of Hertz's
/// pressure the temperature of a face is π q_0 (2 a² − r²)/(8 k a), as its displacement under that pressure;
/// weighted by the flux it makes 0.3/(k a) each.
///
/// Both bodies expand with heat. The temperature is the mean of both ends and a part that changes sign with
/// z. The expansion by that part moves both faces alike, so that pressures and radius of the contact remain
/// those of Hertz, however much heat passes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "../cases/case_folder.hpp"
#include "ball_on_block.hpp"
#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using testing::at;
using testing::CaseFolder;
using testing::CaseRun;
using verification::BallOnBlock;

constexpr double k_conductivity = 40, k_warmer = 100;                           // [W/(m K)], [K]
constexpr double k_star = 200e9 / (1 - 0.3 * 0.3) / 2;                          // E* [Pa]
constexpr double k_contact = 0.01;                                              // a [m]
constexpr double k_force = 4 * k_star * k_contact * k_contact * k_contact / 3;  // of R = 1 m [N]
constexpr double k_area = std::numbers::pi * k_contact * k_contact;
constexpr double k_pressure = 1.5 * k_force / k_area;  // p_0 [Pa]
constexpr double k_width = BallOnBlock{}.width, k_slender = k_contact / k_width;

const double k_through_bodies =
    2 * k_width / (k_conductivity * std::numbers::pi * k_width * k_width);  // [K/W]

const std::string k_metal = R"(
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1.2e-5 1/K"
expansion_reference = "70 degC"
)";

std::string ball_case(const std::string& time, const std::string& heat, bool penalty) {
  return fmt::format(R"(
title = "A warm ball pressed on a cold block"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
[mesh]
file = "ball.msh"
unit = "mm"
[time]
{}
[[body]]
name = "upper"
material = "metal.toml"
initial_temperature = "120 degC"
[[body]]
name = "lower"
material = "metal.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "above"
group = "upper_far"
kind = "temperature"
temperature = "120 degC"
[[thermal_condition]]
name = "below"
group = "lower_far"
kind = "temperature"
temperature = "20 degC"
[[mechanical_condition]]
name = "foot"
group = "lower_far"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "axis_below"
group = "lower_axis"
kind = "displacement"
ur = "0 mm"
[[mechanical_condition]]
name = "axis_above"
group = "upper_axis"
kind = "displacement"
ur = "0 mm"
[[mechanical_condition]]
name = "head"
group = "upper_far"
kind = "plane"
[[mechanical_condition]]
name = "load"
group = "upper_far"
kind = "pressure"
pressure = "{} Pa"
[[probe]]
name = "p_0"
kind = "maximum"
field = "contact_pressure"
group = "upper_face"
unit = "Pa"
[[contact]]
name = "interface"
slave = "upper_face"
master = "lower_face"
{}
[contact.heat]
{}
)",
                     time, k_force / (std::numbers::pi * k_width * k_width),
                     penalty ? "normal = \"penalty\"" : "", heat);
}

const std::string k_steady = "steady = true";

struct Ball {
  CaseFolder folder{"hertz_heat"};
  CaseRun run(const std::string& name, int n, const std::string& time, const std::string& heat,
              bool penalty) const {
    folder.write("metal.toml", k_metal);
    folder.write("ball.msh", BallOnBlock{.n = n}.mesh());
    const std::string law = penalty ? "penalty" : "default";
    return folder.run(fmt::format("{}_{}_{}", name, n, law), ball_case(time, heat, penalty));
  }
};

// The open gap conducts next to nothing, so that heat follows the radius of what is closed, which the mesh
// resolves to an element: 10 % of it with 24 elements along a side, 6 % with 40.
TEST(HertzHeat, ThroughAContactThatConductsWellIsThatOfHolm) {
  auto out = verification::table("contact_hertz_heat", "law,n,heat[exact],p0[exact]");
  constexpr double conductance = 1e6;  // [W/(m² K)], 0.3 % of the resistance
  const double psi = 1 - 1.40978 * k_slender + 0.34406 * std::pow(k_slender, 3);
  const double exact =
      k_warmer / (k_through_bodies + psi / (2 * k_conductivity * k_contact) + 1 / (conductance * k_area));
  for (const bool penalty : {false, true})
    for (const int n : {24, 40}) {
      const CaseRun run = Ball().run(
          "holm", n, k_steady,
          "conductance = \"1e6 W/m2/K\"\ngap_law = \"gas\"\ngas_conductivity = \"1e-7 W/m/K\"", penalty);
      ASSERT_TRUE(run.finished) << run.reason;
      const double heat = run.history.at("contact_heat[W]").back() / exact,
                   pressure = run.history.at("p_0[Pa]").back() / k_pressure;
      EXPECT_NEAR(heat, 1, n == 24 ? 0.1 : 0.02) << penalty << ", " << n;
      EXPECT_NEAR(pressure, 1, n == 24 ? 5e-3 : 3e-3) << penalty << ", " << n;
      out << (penalty ? "penalty," : "default,") << n << "," << heat << "," << pressure << "\n";
    }
}

// h = h_co p/H: all of the contact conducts h_co F/H together, wherever it is.
TEST(HertzHeat, ThroughAConductanceThatGrowsWithPressureIsThatOfTheForce) {
  auto out = verification::table("contact_hertz_heat_of_pressure", "law,n,heat[exact]");
  constexpr double resistance = 20, hardness = 1e9;  // [K/W], [Pa]
  const double exact =
      k_warmer /
      (k_through_bodies + (0.6 - 2 * 0.35245 * k_slender) / (k_conductivity * k_contact) + resistance);
  for (const bool penalty : {false, true}) {
    double coarse = 0;
    for (const int n : {16, 32}) {
      const CaseRun run = Ball().run("pressure", n, k_steady,
                                     fmt::format("conductance = \"{} W/m2/K\"\nexponent = 1\n"
                                                 "hardness = \"1 GPa\"\ngap_law = \"constant\"\n"
                                                 "open_conductance = \"1e-4 W/m2/K\"",
                                                 hardness / (resistance * k_force)),
                                     penalty);
      ASSERT_TRUE(run.finished) << run.reason;
      const double heat = run.history.at("contact_heat[W]").back() / exact;
      out << (penalty ? "penalty," : "default,") << n << "," << heat << "\n";
      if (n == 16)
        coarse = heat;
      else
        EXPECT_LT(std::abs(heat - 1), 0.6 * std::abs(coarse - 1)) << penalty;
      EXPECT_NEAR(heat, 1, n == 16 ? 2e-3 : 1e-3) << penalty << ", " << n;
    }
  }
}

// Whether points at the edge of the contact are open or closed is decided in every step again.
TEST(HertzHeat, StandsStillWhenTheBodiesHaveWarmed) {
  auto out = verification::table("contact_hertz_heat_in_time", "law,spread[steady],off[steady]");
  const std::string heat =
      "conductance = \"1e4 W/m2/K\"\ngap_law = \"gas\"\ngas_conductivity = \"0.03 W/m/K\"";
  for (const bool penalty : {false, true}) {
    const CaseRun steady = Ball().run("rest", 24, k_steady, heat, penalty),
                  in_time = Ball().run("time", 24, "end = \"20000 s\"\nstep = \"500 s\"", heat, penalty);
    ASSERT_TRUE(steady.finished && in_time.finished) << steady.reason << in_time.reason;
    const double exact = steady.history.at("contact_heat[W]").back();
    const auto& found = in_time.history.at("contact_heat[W]");
    const auto [low, high] = std::minmax_element(found.end() - 10, found.end());
    EXPECT_LT(*high - *low, 1e-4 * exact) << penalty;
    EXPECT_NEAR(found.back(), exact, 1e-4 * exact) << penalty;
    out << (penalty ? "penalty," : "default,") << (*high - *low) / exact << "," << found.back() / exact - 1
        << "\n";
  }
}

}  // namespace
}  // namespace solidus
