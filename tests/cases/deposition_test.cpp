/// Bodies that grow element by element: a closed form, the first law, bare faces, restart, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "../verification/analytic/stefan.hpp"
#include "case_folder.hpp"

namespace {

namespace analytic = solidus::analytic;
using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;
using ::testing::AllOf;
using ::testing::HasSubstr;

const CaseFolder k_here("deposition");

constexpr double k_density = 4000, k_capacity = 1000, k_conductivity = 40;
constexpr double k_diffusivity = k_conductivity / (k_density * k_capacity);  // 1e-5 m²/s

std::string metal() {
  return k_here.write("metal.toml",
                      "title = \"metal\"\ndensity = \"4000 kg/m3\"\nconductivity = \"40 W/m/K\"\n"
                      "specific_heat = \"1000 J/kg/K\"\n");
}

/// A block of one body that grows along its last axis, from the lowest row of elements on.
struct Grown {
  std::string size = "[\"5 mm\", \"40 mm\"]", divisions = "[1, 40]", kind = "plane_strain", element = "quad4";
  std::string start = "\"1000 degC\"", material = metal();
  std::string deposition, conditions, time;
  std::string text() const {
    return fmt::format(
        "title = \"A bar that grows\"\n[analysis]\nkind = \"{}\"\nphysics = \"heat\"\n"
        "[mesh]\nshape = \"block\"\nelement = \"{}\"\n[mesh.block]\nsize = {}\ndivisions = {}\n"
        "[[body]]\nname = \"block\"\nmaterial = \"{}\"\ninitial_temperature = {}\n{}{}{}",
        kind, element, size, divisions, material, start, deposition, conditions, time);
  }
};

const std::string k_front = R"([[deposition]]
name = "layers"
body = "block"
kind = "front"
from = ["0 mm", "5 mm"]
normal = [0, 1]
speed = "1 mm/s"
)";

std::string film_on(const std::string& group) {
  return fmt::format(
      "[[thermal_condition]]\nname = \"air\"\ngroup = \"{}\"\nkind = \"film\"\ncoefficient = \"500 W/m2/K\"\n"
      "ambient = \"20 degC\"\n",
      group);
}

/// Metal of the temperature T_m is added to a bar whose foot is held at T_0, so that the bar has the length
/// s = 2 λ √(α t). Heat that is conducted to the front cools what arrives:
///   T = T_0 + A erf(x/(2 √(α t))),  k T_x(s) = ρ c (ds/dt) (T_m − T(s)):
///   A = λ (T_m − T_0)/(exp(−λ²)/√π + λ erf λ).
/// Elements are born as their centre is passed; nothing of Rosenthal's or Goldak's is in it.
TEST(Deposition, CoolsAsTheClosedFormOfABarThatGrowsWithTheRootOfTime) {
  constexpr double k_lambda = 0.6, k_foot = 20, k_melt = 1000, k_length = 0.04;
  const double end = std::pow(k_length / (2 * k_lambda), 2) / k_diffusivity;
  const double a = k_lambda * (k_melt - k_foot) /
                   (std::exp(-k_lambda * k_lambda) / std::sqrt(M_PI) + k_lambda * std::erf(k_lambda));
  std::vector<double> errors;
  for (const int n : {40, 80}) {
    Grown bar;
    bar.divisions = fmt::format("[1, {}]", n);
    bar.deposition = fmt::format(
        "[[deposition]]\nname = \"bar\"\nbody = \"block\"\nkind = \"times\"\n"
        "time = {{ formula = \"(y/{})^2/{}\" }}\n",
        2 * k_lambda, k_diffusivity);
    bar.conditions =
        "[[thermal_condition]]\nname = \"foot\"\ngroup = \"y_min\"\nkind = \"temperature\"\ntemperature = "
        "\"20 degC\"\n"
        "[[probe]]\nname = \"low\"\nfield = \"temperature\"\nunit = \"degC\"\npoint = [\"2 mm\", \"10 mm\"]\n"
        "[[probe]]\nname = \"middle\"\nfield = \"temperature\"\nunit = \"degC\"\npoint = [\"2 mm\", \"20 "
        "mm\"]\n"
        "[[probe]]\nname = \"high\"\nfield = \"temperature\"\nunit = \"degC\"\npoint = [\"2 mm\", \"30 "
        "mm\"]\n";
    bar.time = fmt::format("[time]\nend = \"{} s\"\nstep = \"{} s\"\n", end, end / (20 * n));
    const CaseRun run = k_here.run(fmt::format("root_of_time_{}", n), bar.text());
    ASSERT_TRUE(run.finished) << run.reason;
    double worst = 0;
    for (const auto& [name, y] : {std::pair("low", 0.01), {"middle", 0.02}, {"high", 0.03}})
      worst = std::max(worst, std::abs(run.history.at(std::string(name) + "[degC]").back() - k_foot -
                                       a * std::erf(y / k_length * k_lambda)));
    errors.push_back(worst);
  }
  RecordProperty("kelvin_of_980", std::to_string(errors.back()));
  EXPECT_LT(errors[0], 0.01 * (k_melt - k_foot));
  EXPECT_LT(errors[1], 0.002 * (k_melt - k_foot));
}

/// What arrives and what films take is all that changes the heat: bare faces cool from the first step on.
TEST(Deposition, ClosesTheFirstLawWithTheHeatThatArrives) {
  for (const bool adaptive : {false, true}) {
    Grown bar;
    bar.size = "[\"10 mm\", \"20 mm\"]", bar.divisions = "[4, 8]", bar.element = "tri3";
    bar.start = "{ formula = \"y < 0.004 ? 20 : 1000\", unit = \"degC\" }";
    bar.deposition = k_front + "bare = \"y_max\"\n";
    bar.conditions = film_on("y_max");
    bar.time = fmt::format("[time]\nend = \"30 s\"\nstep = \"0.5 s\"\nadaptive = {}\n", adaptive);
    const CaseRun run = k_here.run(adaptive ? "first_law_adaptive" : "first_law", bar.text());
    ASSERT_TRUE(run.finished) << run.reason;
    const auto last = [&](const char* column) { return run.history.at(column).back(); };
    EXPECT_NEAR(last("deposited_mass[kg]"), k_density * 0.01 * 0.02, 1e-9);
    // Three quarters of the bar arrive, at 1000 degC, counted from 20 degC.
    EXPECT_NEAR(last("heat_poured[J]"), k_density * k_capacity * 0.01 * 0.015 * 980,
                1e-6 * last("heat_poured[J]"));
    EXPECT_LT(std::abs(last("energy_defect[J]")), 1e-8 * last("heat_exchanged[J]"));
    // The content of all bodies is that at the start, what has arrived and what the film has taken.
    const double change = last("heat_of_bodies[J]") - run.history.at("heat_of_bodies[J]").front();
    EXPECT_NEAR(change, last("heat_poured[J]") + last("heat_in[J]"), 1e-8 * last("heat_poured[J]"));
    EXPECT_LT(solidus::testing::at(run.history, "heat_in[J]", 2), 0);
  }
}

/// The film acts on one face of the same area all the time, whatever lies below it: metal of one temperature
/// on metal of the same temperature, which conducts very well, cools as a lump that grows.
TEST(Deposition, LetsConditionsFollowTheBareFaceAndLeaveWhatIsCovered) {
  Grown bar;
  bar.deposition = k_front + "bare = \"y_max\"\n";
  bar.conditions = film_on("y_max");
  bar.time = "[time]\nend = \"40 s\"\nstep = \"0.1 s\"\n";
  const CaseRun with = k_here.run("bare", bar.text());
  bar.deposition = k_front;
  const CaseRun without = k_here.run("insulated", bar.text());
  ASSERT_TRUE(with.finished && without.finished);
  // Only once the last row is there the group has faces of its own.
  EXPECT_EQ(solidus::testing::at(without.history, "heat_in[J]", 30), 0);
  EXPECT_LT(without.history.at("heat_in[J]").back(), 0);
  // The front is at the temperature of what has just arrived, a little cooler: it gives at most h A ΔT.
  const double most = 500 * 0.005 * 980 * 30, given = -solidus::testing::at(with.history, "heat_in[J]", 30);
  EXPECT_LT(given, most);
  EXPECT_GT(given, 0.9 * most);
}

/// Nothing is there at the start, and conductivity follows temperature, so that a potential of no node is
/// asked for.
TEST(Deposition, MayBeginWithNothing) {
  Grown bar;
  bar.material = k_here.write("table.toml",
                              "title = \"table\"\ndensity = \"4000 kg/m3\"\nspecific_heat = \"1000 "
                              "J/kg/K\"\nconductivity = { argument_unit "
                              "= \"degC\", unit = \"W/m/K\", points = [[20, 40], [1000, 20]] }\n");
  bar.deposition =
      "[[deposition]]\nname = \"bar\"\nbody = \"block\"\nkind = \"times\"\ntime = { formula = \"5 + "
      "200*y\" }\n";
  bar.conditions = film_on("y_max");
  bar.time = "[time]\nend = \"16 s\"\nstep = \"1 s\"\n";
  const CaseRun run = k_here.run("nothing", bar.text());
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_EQ(run.history.at("deposited_mass[kg]").front(), 0);
  EXPECT_NEAR(run.history.at("deposited_mass[kg]").back(), k_density * 0.005 * 0.04, 1e-9);
  EXPECT_LT(std::abs(run.history.at("energy_defect[J]").back()),
            1e-8 * run.history.at("heat_exchanged[J]").back());
}

TEST(Deposition, IsTheWholeBodyWhereAllIsThereFromTheStart) {
  Grown bar;
  bar.conditions = film_on("y_max");
  bar.time = "[time]\nend = \"20 s\"\nstep = \"1 s\"\n";
  const CaseRun whole = k_here.run("whole", bar.text());
  bar.deposition =
      "[[deposition]]\nname = \"bar\"\nbody = \"block\"\nkind = \"times\"\ntime = { formula = \"y - 1\" }\n";
  const CaseRun grown = k_here.run("all_at_once", bar.text());
  EXPECT_EQ(whole.history.at("heat_in[J]"), grown.history.at("heat_in[J]"));
  EXPECT_EQ(whole.history.at("T_min[degC]"), grown.history.at("T_min[degC]"));
}

/// A bead of two passes along a path, in space, with a source that follows it.
std::string bead() {
  Grown wall;
  wall.kind = "solid", wall.element = "hex8";
  wall.size = "[\"24 mm\", \"6 mm\", \"6 mm\"]", wall.divisions = "[8, 2, 4]";
  wall.start = "{ formula = \"z < 0.0029 ? 20 : 1200\", unit = \"degC\" }";
  k_here.write("path.csv",
               "t[s],x[mm],y[mm],z[mm],on\n-1,0,3,3,1\n0,24,3,3,0\n2,0,3,4.5,1\n8,24,3,4.5,0\n10,0,3,6,1\n16,"
               "24,3,6,0\n");
  wall.deposition =
      "[[deposition]]\nname = \"bead\"\nbody = \"block\"\nkind = \"path\"\nwidth = \"7 mm\"\ndepth = \"3.2 "
      "mm\"\n"
      "bare = \"z_max\"\ninterval = \"1 s\"\n[deposition.path]\nfile = \"path.csv\"\n"
      "[[source]]\nname = \"torch\"\ngroup = \"block\"\nkind = \"double_ellipsoid\"\npower = \"800 W\"\n"
      "efficiency = 0.7\nwidth = \"3 mm\"\ndepth = \"2 mm\"\nfront = \"2 mm\"\nrear = \"5 mm\"\n"
      "[source.path]\nfile = \"path.csv\"\n";
  wall.conditions = film_on("z_max");
  wall.time = "[time]\nend = \"9 s\"\nstep = \"0.5 s\"\n";
  return wall.text();
}

TEST(Deposition, AlongAPathWithASourceGoesOnExactlyAfterARestart) {
  k_here.expect_exact_restart("bead", bead(), 7);
  const auto history = solidus::testing::read_csv(k_here.root() / "bead_whole" / "history.csv");
  EXPECT_LT(std::abs(history.at("energy_defect[J]").back()), 1e-8 * history.at("heat_exchanged[J]").back());
  EXPECT_GT(solidus::testing::at(history, "torch_power[W]", 5), 100);
  EXPECT_EQ(history.at("torch_power[W]").back(), 0);
}

/// The metal of metal() as an alloy that freezes between 600 and 620 degC.
std::string alloy() {
  return k_here.write(
      "alloy.toml",
      "title = \"alloy\"\ndensity = \"4000 kg/m3\"\nconductivity = \"40 W/m/K\"\n"
      "specific_heat = \"1000 J/kg/K\"\n[[phase_change]]\nname = \"freezing\"\nsolidification = "
      "true\nlatent_heat = \"200 kJ/kg\"\n[phase_change.fraction]\nkind = \"linear\"\nsolidus = "
      "\"600 degC\"\nliquidus = \"620 degC\"\n");
}

std::string temperature_probe(const std::string& name, const std::string& point) {
  return fmt::format("[[probe]]\nname = \"{}\"\nfield = \"temperature\"\nunit = \"degC\"\npoint = {}\n", name,
                     point);
}

/// Metal is withdrawn along a wall that is held at one temperature from the moment on that the meniscus has
/// passed it: each slice freezes as a half-space does (Neumann), its shell grows with the root of the
/// distance below the meniscus, x = 2 ξ √(s/v). Conduction along the strand is left out there; here it is
/// small.
TEST(Deposition, AShellBelowTheMeniscusGrowsWithTheRootOfTheDistanceAsNeumannsDoes) {
  constexpr double k_speed = 0.02, k_end = 5.25, k_start = 640, k_wall = 100;
  const analytic::Stefan slab(
      {k_conductivity, k_density * k_capacity, k_density * 200e3, k_wall, 600, 620, k_start});
  Grown strand;
  strand.size = "[\"40 mm\", \"104 mm\"]", strand.divisions = "[40, 52]";
  strand.material = alloy();
  strand.start = "\"640 degC\"";
  strand.deposition =
      "[[deposition]]\nname = \"melt\"\nbody = \"block\"\nkind = \"front\"\nfrom = [\"0 mm\", \"0 "
      "mm\"]\nnormal = [0, 1]\nspeed = \"20 mm/s\"\n";
  strand.conditions =
      "[[thermal_condition]]\nname = \"wall\"\ngroup = \"x_min\"\nkind = \"temperature\"\ntemperature = "
      "\"100 "
      "degC\"\n[criteria]\nfollow = false\n";
  // Distances below the meniscus of 60, 80 and 100 mm, each at two depths of its shell.
  std::vector<std::pair<double, double>> points;  // x, y [m]
  for (const double below : {0.06, 0.08, 0.1})
    for (const double depth : {0.002, 0.005}) {
      const double y = k_speed * k_end - below;
      strand.conditions +=
          temperature_probe(fmt::format("p{}", points.size()), fmt::format("[\"{} m\", \"{} m\"]", depth, y));
      points.emplace_back(depth, y);
    }
  strand.time = "[time]\nend = \"5.25 s\"\nstep = \"0.05 s\"\n";
  const CaseRun run = k_here.run("shell", strand.text());
  ASSERT_TRUE(run.finished) << run.reason;
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y] = points[i];
    const double found = run.history.at(fmt::format("p{}[degC]", i)).back();
    worst = std::max(worst, std::abs(found - slab.temperature(x, k_end - y / k_speed)));
  }
  RecordProperty("kelvin_of_540", std::to_string(worst));
  EXPECT_LT(worst, 0.02 * (k_start - k_wall));
}

/// What is born in layers is, on the mean, born half a layer too late: the difference to births row by row
/// falls with the layer.
TEST(Deposition, ElementByElementIsTheLimitOfLayers) {
  Grown bar;
  bar.conditions =
      "[[thermal_condition]]\nname = \"foot\"\ngroup = \"y_min\"\nkind = \"temperature\"\ntemperature = \"20 "
      "degC\"\n" +
      temperature_probe("middle", "[\"2 mm\", \"20 mm\"]");
  bar.time = "[time]\nend = \"60 s\"\nstep = \"0.25 s\"\n";
  const auto middle = [&](const std::string& interval) {
    bar.deposition = k_front + (interval.empty() ? "" : "interval = \"" + interval + "\"\n");
    const CaseRun run = k_here.run("layers" + interval.substr(0, 1), bar.text());
    EXPECT_TRUE(run.finished) << run.reason;
    return run.history.at("middle[degC]").back();
  };
  const double rows = middle(""), thin = std::abs(middle("2 s") - rows),
               thick = std::abs(middle("4 s") - rows);
  RecordProperty("kelvin_of_layers_of_4_and_2_rows", fmt::format("{} {}", thick, thin));
  EXPECT_LT(thin, 5);
  EXPECT_GT(thick, 2 * thin);
  EXPECT_LT(thick, 6 * thin);
}

/// Criteria follow metal from its birth on, in elements and nodes that come while they do.
TEST(Deposition, IsFollowedByTheCriteriaOfFreezing) {
  Grown bar;
  bar.size = "[\"10 mm\", \"20 mm\"]", bar.divisions = "[4, 8]";
  bar.material = alloy();
  bar.start = "\"640 degC\"";
  bar.deposition = k_front;
  bar.conditions =
      "[[thermal_condition]]\nname = \"side\"\ngroup = \"x_min\"\nkind = \"film\"\ncoefficient = \"2000 "
      "W/m2/K\"\nambient = \"20 degC\"\n"
      "[[probe]]\nname = \"low\"\nfield = \"local_solidification_time\"\nunit = \"s\"\npoint = [\"5 mm\", "
      "\"2.5 mm\"]\n"
      "[[probe]]\nname = \"high\"\nfield = \"local_solidification_time\"\nunit = \"s\"\npoint = [\"5 mm\", "
      "\"17.5 mm\"]\n"
      "[[probe]]\nname = \"frozen\"\nfield = \"solidified_at\"\nunit = \"s\"\npoint = [\"5 mm\", \"17.5 "
      "mm\"]\n";
  bar.time = "[time]\nend = \"60 s\"\nstep = \"0.5 s\"\n";
  k_here.expect_exact_restart("freezes", bar.text(), 30);
  const auto history = solidus::testing::read_csv(k_here.root() / "freezes_whole" / "history.csv");
  // Every slice freezes as long as every other one, from its birth on: at 1 mm/s the upper one 15 s later.
  const double low = history.at("low[s]").back(), high = history.at("high[s]").back();
  EXPECT_GT(low, 5);
  EXPECT_NEAR(high, low, 0.1 * low);
  EXPECT_GT(history.at("frozen[s]").back(), 11.25 + high);  // its first element is born then
}

TEST(Deposition, WarnsOfMetalThatComesToNothing) {
  Grown bar;
  bar.time = "[time]\nend = \"30 s\"\nstep = \"10 s\"\n";
  const auto warnings = [&](const std::string& name, const std::string& deposition) {
    bar.deposition = deposition;
    k_here.run(name, bar.text());
    return solidus::logging::warnings();
  };
  using ::testing::Contains;
  using ::testing::Not;
  const std::string path =
      "[[deposition]]\nname = \"bead\"\nbody = \"block\"\nkind = \"path\"\nwidth = \"12 mm\"\ndepth = \"5.1 "
      "mm\"\ndirection = [-1, 0]\n";
  // The path runs up along the bar and on above it for as long again.
  EXPECT_THAT(
      warnings("above", path + "path = { from = [\"5 mm\", \"0 mm\"], to = [\"5 mm\", \"80 mm\"], speed = "
                               "\"4 mm/s\" }\n"),
      Contains(AllOf(HasSubstr("lays nothing down from t = "), HasSubstr("outside of 'block'"))));
  // It comes back where it has been.
  k_here.write("twice.csv", "t[s],x[mm],y[mm]\n0,5,0\n10,5,40\n20,5,0\n");
  EXPECT_THAT(warnings("twice_over", path + "path = { file = \"twice.csv\" }\n"),
              Contains(HasSubstr("laid down before")));
  EXPECT_THAT(
      warnings("once", path + "path = { from = [\"5 mm\", \"0 mm\"], to = [\"5 mm\", \"40 mm\"], speed = "
                              "\"4 mm/s\" }\n"),
      Not(Contains(HasSubstr("lays nothing down"))));
  // A front that needs 35 s for the bar, and one that leaves a gap of time behind it.
  EXPECT_THAT(warnings("late", k_front),
              Contains(HasSubstr("5 elements of 'block' are born after the run has ended")));
  EXPECT_THAT(warnings("floats",
                       "[[deposition]]\nname = \"two\"\nbody = \"block\"\nkind = \"times\"\n"
                       "time = { formula = \"y > 0.03 ? 5 : y < 0.01 ? 0 : 10\" }\n"),
              Contains(AllOf(HasSubstr("10 elements of 'block' touch nothing"), HasSubstr("at 5 s"))));
}

TEST(Deposition, RefusesWhatItCannotYetWithItsPlace) {
  Grown bar;
  bar.deposition = k_front;
  bar.time = "[time]\nend = \"1 s\"\nstep = \"1 s\"\n";
  std::string text = bar.text();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(k_here.refusal("twice", text + k_front), HasSubstr("the name 'layers' is used by two"));
  EXPECT_THAT(k_here.refusal("mechanics", with("physics = \"heat\"", "physics = \"mechanics\"")),
              AllOf(HasSubstr("mechanics.toml:"), HasSubstr("mechanics alone does not follow")));
  EXPECT_THAT(k_here.refusal("normal", with("normal = [0, 1]", "normal = [0, 0]")),
              HasSubstr("no complete front"));
  EXPECT_THAT(k_here.refusal("body", with("body = \"block\"", "body = \"wall\"")), HasSubstr("wall"));
  EXPECT_THAT(k_here.refusal("far", with("speed = \"1 mm/s\"\n", "speed = \"1 mm/s\"\nbare = \"nowhere\"\n")),
              HasSubstr("nowhere"));
  const std::string path =
      with("kind = \"front\"\nfrom = [\"0 mm\", \"5 mm\"]\nnormal = [0, 1]\nspeed = \"1 mm/s\"\n",
           "kind = \"path\"\nwidth = \"5 mm\"\ndepth = \"2 mm\"\npath = { from = [\"0 m\", \"1 m\"],"
           " to = [\"1 m\", \"1 m\"], speed = \"1 mm/s\" }\n");
  EXPECT_THAT(k_here.refusal("beside", path), HasSubstr("reaches none of the 40 elements"));
}

}  // namespace
