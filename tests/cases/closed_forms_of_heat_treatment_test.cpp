/// Stages of a heat treatment with a closed form: a plate that sinks into a bath whose film boils, and a bar
/// whose stress a furnace relieves. The answers after each stage are those of the closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;
using solidus::testing::Columns;
using solidus::testing::read_csv;

struct Point {
  double temperature, film;  ///< [°C], [W/(m² K)]
};
/// Film boiling above the Leidenfrost temperature of 300 °C, nucleate boiling below it, convection at last.
constexpr std::array<Point, 4> k_boiling = {{{70, 800}, {150, 2500}, {300, 1000}, {520, 300}}};
constexpr double k_bath = 50, k_hot = 500;                   // [°C]
constexpr double k_thick = 2e-3, k_capacity = 2700 * 1000.;  // half the plate [m], [J/(m³ K)]
constexpr double k_speed = 0.2, k_long = 0.4;                // of immersion [m/s], [m]

/// Time in which a thin plate cools from one temperature to another between two points of the table, where
/// the film is h = a + b T: C ∫ dT/(h (T − T_b)) = C/(a + b T_b) [ln((T − T_b)/h)].
double time_between(double from, double to, const Point& low, const Point& high) {
  const double b = (high.film - low.film) / (high.temperature - low.temperature);
  const double a = low.film - b * low.temperature;
  const auto primitive = [&](double t) { return std::log((t - k_bath) / (a + b * t)) / (a + b * k_bath); };
  return k_capacity * k_thick * (primitive(from) - primitive(to));
}

/// The temperature of a place so long after the water has reached it.
double after(double seconds) {
  double temperature = k_hot;
  for (std::size_t i = k_boiling.size() - 1; i > 0 && seconds > 0; --i) {
    const Point &low = k_boiling[i - 1], &high = k_boiling[i];
    const double all = time_between(temperature, low.temperature, low, high);
    if (all <= seconds) {
      seconds -= all;
      temperature = low.temperature;
      continue;
    }
    double cold = low.temperature, hot = temperature;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (cold + hot);
      (time_between(temperature, middle, low, high) > seconds ? cold : hot) = middle;
    }
    return 0.5 * (cold + hot);
  }
  // Below its first point the table keeps that value.
  return k_bath + (temperature - k_bath) *
                      std::exp(-k_boiling.front().film * std::max(0.0, seconds) / (k_capacity * k_thick));
}

TEST(ClosedFormsOfHeatTreatment, APlateThatSinksIntoABoilingBathCoolsPlaceByPlaceByTheTableOfItsFilm) {
  const CaseFolder folder("closed_forms_quench");
  folder.write("metal.toml",
               "density = \"2700 kg/m3\"\nconductivity = \"150 W/m/K\"\nspecific_heat = \"1000 J/kg/K\"\n");
  std::string points, probes;
  for (const Point& p : k_boiling) points += fmt::format("[{}, {}], ", p.temperature, p.film);
  const std::array<double, 3> heights = {0.04, 0.2, 0.36};
  for (const double y : heights)
    probes += fmt::format(
        "[[probe]]\nname = \"T_{0:.0f}\"\nfield = \"temperature\"\npoint = [\"1 mm\", \"{0} mm\"]\nunit = "
        "\"degC\"\n",
        1e3 * y);
  const CaseRun run = folder.run("quench", fmt::format(R"(title = "A plate sinks into a bath"
stage = [
  {{ name = "hold",   duration = "5 s",  step = "1 s" }},
  {{ name = "quench", duration = "20 s", step = "0.05 s" }},
]
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["2 mm", "400 mm"]
divisions = [1, 200]
[time]
[[body]]
name = "block"
material = "metal.toml"
initial_temperature = "500 degC"
[[thermal_condition]]
name = "water"
group = "x_max"
kind = "film"
ambient = "{} degC"
coefficient = {{ of = "temperature", argument_unit = "degC", unit = "W/m2/K", points = [{}] }}
factor = {{ formula = "y < v*t", constants = {{ v = "{} m/s" }} }}
time = "stage"
stages = "quench"
{})",
                                                       k_bath, points, k_speed, probes));
  ASSERT_TRUE(run.finished) << run.reason;
  double worst = 0;
  for (const double y : heights)
    for (const double time : {1.0, 2.0, 4.0, 8.0, 12.0, 20.0}) {
      const double exact = after(time - y / k_speed);
      const double found = at(run.history, fmt::format("T_{:.0f}[degC]", 1e3 * y), 5 + time);
      worst = std::max(worst, std::abs(found - exact));
      EXPECT_NEAR(found, exact, 2) << 1e3 * y << " mm, " << time << " s";  // Biot's number is up to 0.03
    }
  RecordProperty("worst", fmt::format("{:.3g} K", worst));
  const Columns stages = read_csv(folder.root() / "quench/stages.csv");
  ASSERT_EQ(stages.at("time[s]"), (std::vector<double>{5, 25}));
  EXPECT_NEAR(stages.at("lowest_temperature[degC]")[0], k_hot, 1e-6);
  EXPECT_NEAR(stages.at("lowest_temperature[degC]")[1], after(20), 2);
  EXPECT_NEAR(stages.at("highest_temperature[degC]")[1], after(20 - k_long / k_speed), 2);
}

// The bar is pulled by 0.05 % when it is cold, where its metal does not creep, and held at its length. In the
// furnace its stress falls by σ' = −E √⅔ D/η (√⅔ σ/D)^n (F. H. Norton, The Creep of Steel at High
// Temperatures, 1929); what is left stays when it is cold again. It does not expand, so that nothing else
// changes the stress.
TEST(ClosedFormsOfHeatTreatment, AFurnaceRelievesTheStressOfABarByThePowerLawAndColdMetalKeepsTheRest) {
  const CaseFolder folder("closed_forms_relief");
  constexpr double young = 200e3, n = 4, drag = 100, viscosity = 1e7, pulled = 100;  // [MPa], [MPa s]
  const double share = std::sqrt(2.0 / 3);
  const double rate = young * share * drag / viscosity * std::pow(share / drag, n);
  const auto exact = [&](double t) {
    return std::pow(std::pow(pulled, 1 - n) + (n - 1) * rate * t, 1 / (1 - n));
  };
  folder.write("creeping.toml",
               "density = \"7800 kg/m3\"\nconductivity = \"40 W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
               "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\nexpansion = \"0 1/K\"\n"
               "[plasticity]\nflow_stress = \"1 kPa\"\nrate_dependence = \"perzyna\"\nrate_exponent = 4\n"
               "drag_stress = \"100 MPa\"\nviscosity = { of = \"temperature\", argument_unit = \"degC\", "
               "unit = \"Pa s\", points = [[20, 1e25], [500, 1e13]] }\n");
  const std::string text = R"(title = "A bar is relieved of its stress"
stage = [
  { name = "pull",   duration = "10 s" },
  { name = "relief", duration = "1000 s" },
  { name = "cold",   duration = "1000 s" },
]
[analysis]
kind = "solid"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["10 mm", "10 mm", "10 mm"]
divisions = [1, 1, 1]
[time]
step = "1 s"
adaptive = true
stress_error = 0.0005
[[body]]
name = "block"
material = "creeping.toml"
initial_temperature = "20 degC"
)";
  const auto wall = [](const std::string& face, const std::string& direction, const std::string& length) {
    return fmt::format(
        "[[mechanical_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"displacement\"\n{1} = \"{2}\"\n",
        face, direction, length);
  };
  const auto heated = [](const std::string& name, const std::string& degrees, const std::string& stages) {
    std::string all;
    for (const char* face : {"x_min", "x_max"})
      all += fmt::format(
          "[[thermal_condition]]\nname = \"{0} {1}\"\ngroup = \"{1}\"\nkind = \"temperature\"\n"
          "temperature = \"{2} degC\"\nstages = {3}\n",
          name, face, degrees, stages);
    return all;
  };
  const CaseRun run = folder.run("relief", text + wall("x_min", "ux", "0 mm") + wall("y_min", "uy", "0 mm") +
                                               wall("z_min", "uz", "0 mm") + wall("x_max", "ux", "0.005 mm") +
                                               heated("furnace", "500", "\"relief\"") +
                                               heated("air", "20", R"(["pull", "cold"])"));
  ASSERT_TRUE(run.finished) << run.reason;
  const Columns stages = read_csv(folder.root() / "relief/stages.csv");
  ASSERT_EQ(stages.at("time[s]"), (std::vector<double>{10, 1010, 2010}));
  for (const char* column : {"largest_von_mises[Pa]", "mean_von_mises[Pa]"}) {
    const std::vector<double>& stress = stages.at(column);
    EXPECT_NEAR(stress[0], 1e6 * pulled, 1e-6 * 1e6 * pulled) << column;
    EXPECT_NEAR(stress[1], 1e6 * exact(1000), 0.01 * 1e6 * exact(1000)) << column;
    EXPECT_NEAR(stress[2], stress[1], 1e-3 * stress[1]) << column;
  }
  EXPECT_NEAR(stages.at("highest_temperature[degC]")[1], 500, 1e-6);
}

}  // namespace
