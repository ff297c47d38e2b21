/// Bodies that grow element by element: a closed form, the first law, bare faces, restart, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "case_folder.hpp"

namespace {

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
  std::string start = "\"1000 degC\"";
  std::string deposition, conditions, time;
  std::string text() const {
    return fmt::format(
        "title = \"A bar that grows\"\n[analysis]\nkind = \"{}\"\nphysics = \"heat\"\n"
        "[mesh]\nshape = \"block\"\nelement = \"{}\"\n[mesh.block]\nsize = {}\ndivisions = {}\n"
        "[[body]]\nname = \"block\"\nmaterial = \"{}\"\ninitial_temperature = {}\n{}{}{}",
        kind, element, size, divisions, metal(), start, deposition, conditions, time);
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
  EXPECT_THAT(k_here.refusal("coupled", with("physics = \"heat\"", "physics = \"thermomechanical\"")),
              AllOf(HasSubstr("coupled.toml:"), HasSubstr("in heat alone so far")));
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
