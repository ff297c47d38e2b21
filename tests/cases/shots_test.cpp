/// Shots in whole runs: castings that are new in every round of a cycle, in a die that keeps its heat; its
/// periodic state, balances, restart, two processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::CaseRun;
using solidus::testing::Columns;
using solidus::testing::read_csv;
using solidus::testing::read_text;
using ::testing::HasSubstr;

const solidus::testing::CaseFolder k_here("shots");

/// A casting on a die that is cooled from behind, and sprayed when the casting has left.
const std::string k_shots = R"(title = "Shots"
stage = [
  { name = "pour",     duration = "2 s",  step = "0.5 s" },
  { name = "solidify", duration = "16 s", step = "2 s" },
  { name = "eject",    duration = "4 s",  step = "2 s" },
  { name = "spray",    duration = "2 s",  step = "1 s" },
  { name = "close",    duration = "4 s",  step = "2 s" },
]
[[cycle]]
name = "shots"
stages = ["pour", "solidify", "eject", "spray", "close"]
repeat = 5
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["20 mm", "50 mm"]
upper = ["20 mm", "5 mm"]
lower_divisions = [2, 12]
upper_divisions = [2, 4]
[time]
[heat]
tolerance = 1e-10
[[body]]
name = "die"
group = "lower"
material = "steel_mould"
initial_temperature = "150 degC"
[[body]]
name = "casting"
group = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "680 degC"
stages = ["pour", "solidify"]
[[thermal_condition]]
name = "channels"
group = "lower_y_min"
kind = "film"
coefficient = "600 W/m2/K"
ambient = "20 degC"
[[thermal_condition]]
name = "spray"
group = "lower_top"
kind = "film"
coefficient = "2000 W/m2/K"
ambient = "25 degC"
stages = "spray"
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
penalty = "1e13 N/m3"
[contact.heat]
conductance = "4000 W/m2/K"
gap_law = "constant"
[[probe]]
name = "solid_at"
kind = "maximum"
field = "solidified_at"
group = "upper"
unit = "s"
[[probe]]
name = "T_die"
kind = "mean"
field = "temperature"
group = "lower"
unit = "degC"
)";

/// The same, coupled: the casting shrinks away from a die that yields and expands.
const std::vector<std::string> k_coupled = {"analysis.physics=thermomechanical"};
const std::string k_supports = R"(
[[mechanical_condition]]
name = "ground"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "axis"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "axis_of_casting"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "wall_of_casting"
group = "upper_x_max"
kind = "displacement"
ux = "0 mm"
stages = "pour"
[[probe]]
name = "u_casting"
kind = "maximum"
field = "displacement"
component = "y"
group = "upper_y_max"
unit = "mm"
)";

Columns shots(const std::string& name) {
  return read_csv(k_here.root() / name / "shots.csv");
}

/// What is in the bodies is what came in through boundaries, with castings and by the search, less what left.
void expect_balance(const CaseRun& r, double tolerance) {
  const Columns& h = r.history;
  const double start = h.at("heat_of_bodies[J]").front();
  ASSERT_GT(h.at("heat_poured[J]").back(), 0);
  ASSERT_GT(h.at("heat_ejected[J]").back(), 0);
  for (std::size_t i = 0; i < h.at("time[s]").size(); ++i) {
    const double carried =
        h.at("heat_poured[J]")[i] - h.at("heat_ejected[J]")[i] + h.at("heat_corrected[J]")[i];
    const double scale = std::max(1.0, h.at("heat_exchanged[J]")[i]);
    EXPECT_NEAR(h.at("heat_of_bodies[J]")[i] - start, h.at("stored_heat[J]")[i] + carried, tolerance * scale)
        << h.at("time[s]")[i];
    EXPECT_NEAR(h.at("energy_defect[J]")[i], 0, tolerance * scale) << h.at("time[s]")[i];
  }
}

TEST(Shots, EveryCastingIsNewAndTheDieKeepsItsHeat) {
  const CaseRun r = k_here.run("plain", k_shots);
  ASSERT_TRUE(r.finished) << r.reason;
  const Columns &h = r.history, table = shots("plain");
  expect_balance(r, 1e-8);
  ASSERT_EQ(table.at("shot[1]").size(), 5u);
  ASSERT_EQ(h.at("time[s]").size(), 1u + 5 * (4 + 8 + 2 + 2 + 2));
  for (std::size_t i = 1; i < h.at("time[s]").size(); ++i) {
    EXPECT_EQ(h.at("shot[1]")[i], h.at("cycle[1]")[i]);
    EXPECT_NEAR(h.at("time_since_pouring[s]")[i], h.at("time[s]")[i] - 28 * (h.at("shot[1]")[i] - 1), 1e-9);
  }
  for (std::size_t s = 0; s < 5; ++s) {
    EXPECT_EQ(table.at("poured_at[s]")[s], 28.0 * static_cast<double>(s));
    // Times of criteria count from the pour of their shot, and a warmer die takes longer.
    EXPECT_GT(table.at("time_to_solidify[s]")[s], 2);
    EXPECT_LT(table.at("time_to_solidify[s]")[s], 18);
    if (s == 0) continue;
    EXPECT_GT(table.at("time_to_solidify[s]")[s], table.at("time_to_solidify[s]")[s - 1]);
    EXPECT_EQ(table.at("die_at_start_mean[degC]")[s], table.at("die_at_end_mean[degC]")[s - 1]);
    EXPECT_GT(table.at("die_at_start_mean[degC]")[s], table.at("die_at_start_mean[degC]")[s - 1]);
    EXPECT_EQ(table.at("heat_poured[J]")[s], table.at("heat_poured[J]")[1]);
  }
  EXPECT_NEAR(table.at("die_at_end_mean[degC]")[4], h.at("T_die[degC]").back(), 1e-6);
  EXPECT_THAT(read_text(k_here.root() / "plain/summary.json"), HasSubstr("\"time_to_solidify[s]\""));
}

// A die that is held at its temperature gives every shot the same history.
TEST(Shots, AreAllAlikeInADieThatIsHeldAtItsTemperature) {
  const std::string held = k_shots + R"(
[[thermal_condition]]
name = "held"
group = "lower"
kind = "temperature"
temperature = "150 degC"
)";
  const CaseRun r = k_here.run("held", held);
  ASSERT_TRUE(r.finished) << r.reason;
  const Columns& h = r.history;
  const std::size_t n = 18;
  for (const char* column : {"T_max[degC]", "solid_fraction[1]", "solid_at[s]"})
    for (std::size_t i = 1; i <= n; ++i)
      for (std::size_t s = 1; s < 5; ++s)
        EXPECT_NEAR(h.at(column)[s * n + i], h.at(column)[i], 1e-7)
            << column << " in row " << i << ", shot " << s;
}

// A die without a casting at first is warmed up; a body may also come into a stage that is not of a cycle.
TEST(Shots, MayBeginWithAStageBeforeThePour) {
  std::string warmed = k_shots;
  const std::string first = "stage = [\n";
  warmed.insert(warmed.find(first) + first.size(),
                "  { name = \"warm\", duration = \"10 s\", step = \"5 s\" },\n");
  const CaseRun r = k_here.run("warmed", warmed, {"cycle.shots.repeat=2"});
  ASSERT_TRUE(r.finished) << r.reason;
  expect_balance(r, 1e-8);
  const Columns& h = r.history;
  EXPECT_EQ(h.at("shot[1]")[2], 0);
  EXPECT_EQ(h.at("time[s]")[2], 10);
  EXPECT_LT(h.at("T_max[degC]")[2], 151);
  EXPECT_GT(h.at("T_max[degC]")[3], 600);
  EXPECT_EQ(h.at("shot[1]")[3], 1);
  EXPECT_EQ(h.at("time_since_pouring[s]")[3], 0.5);
  EXPECT_EQ(shots("warmed").at("poured_at[s]")[1], 38);
}

std::vector<std::string> periodic(const std::string& tolerance, const std::string& search,
                                  std::vector<std::string> more = {}) {
  more.insert(more.end(), {"cycle.shots.repeat=400", "cycle.shots.periodic=" + tolerance,
                           "cycle.shots.search=" + search});
  return more;
}

TEST(Shots, AndersonFindsThePeriodicStateInAThirdOfTheShots) {
  ASSERT_TRUE(k_here.run("repetition", k_shots, periodic("0.1 K", "repetition")).finished);
  ASSERT_TRUE(k_here.run("long", k_shots, periodic("1e-4 K", "repetition")).finished);
  const CaseRun r = k_here.run("anderson", k_shots, periodic("0.1 K", "anderson"));
  ASSERT_TRUE(r.finished);
  expect_balance(r, 1e-8);
  const Columns plain = shots("repetition"), found = shots("anderson"), exact = shots("long");
  const std::size_t n = found.at("shot[1]").size();
  EXPECT_LE(3 * n, plain.at("shot[1]").size()) << n;
  EXPECT_EQ(found.at("periodic[1]").back(), 1);
  EXPECT_LE(found.at("largest_change[K]").back(), 0.1);
  for (const char* column : {"die_at_end_mean[degC]", "die_at_end_min[degC]", "die_at_end_max[degC]"})
    EXPECT_NEAR(found.at(column).back(), exact.at(column).back(), 0.5) << column;
  EXPECT_NEAR(found.at("heat_ejected[J]").back(), exact.at("heat_ejected[J]").back(),
              1e-3 * exact.at("heat_ejected[J]").back());
  // In the periodic state what comes with castings leaves with them and through the boundaries.
  const Columns& h = r.history;
  const std::size_t last = h.at("time[s]").size() - 1, before = last - 18;
  const double in = h.at("heat_in[J]")[last] - h.at("heat_in[J]")[before];
  const double poured = h.at("heat_poured[J]")[last] - h.at("heat_poured[J]")[before],
               ejected = h.at("heat_ejected[J]")[last] - h.at("heat_ejected[J]")[before];
  EXPECT_LT(in, 0);
  EXPECT_NEAR(poured - ejected + in, 0, 0.002 * poured);
}

// Two lumps: a casting that does not freeze and a die, both of so large a conductivity that each has one
// temperature. While they touch T_c − T_d falls with (1/C_c + 1/C_d) h, in the air T_d − T_a with h_a/C_d: a
// linear map T_d → a T_d + b per shot, whose fixed point is b/(1 − a).
TEST(Shots, OfTwoLumpsHaveThePeriodicStateOfTheClosedForm) {
  k_here.write("slug.toml", R"(title = "A slug of one temperature"
[density]
value = "2500 kg/m3"
[conductivity]
value = "1e6 W/m/K"
[specific_heat]
value = "1000 J/kg/K"
)");
  k_here.write("lump.toml", R"(title = "A die of one temperature"
[density]
value = "8000 kg/m3"
[conductivity]
value = "1e6 W/m/K"
[specific_heat]
value = "500 J/kg/K"
)");
  std::string lumps = k_shots;
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"\"steel_mould\"", "\"lump.toml\""},
           {"\"aluminium_alsi7mg\"", "\"slug.toml\""},
           {"step = \"0.5 s\"", "step = \"0.1 s\""},
           {"step = \"2 s\"", "step = \"0.2 s\""},
           {"step = \"1 s\"", "step = \"0.2 s\""},
           {"name = \"solid_at\"", "name = \"T_casting\""},
           {"\"solidified_at\"", "\"temperature\""},
           {"group = \"upper\"\nunit = \"s\"", "group = \"upper\"\nunit = \"degC\""}})
    for (std::size_t at = lumps.find(from); at != std::string::npos; at = lumps.find(from, at + to.size()))
      lumps.replace(at, from.size(), to);
  const CaseRun r =
      k_here.run("lumps", lumps, periodic("1e-5 K", "anderson", {"thermal_condition.channels.stages=spray"}));
  ASSERT_TRUE(r.finished) << r.reason;
  // Per metre of thickness and of width: C in J/K, h in W/K.
  const double c_casting = 2500 * 1000 * 0.005, c_die = 8000 * 500 * 0.05, h = 4000, pouring = 680;
  const double share = c_casting / (c_casting + c_die);  // of the casting in the mean
  const double touch = std::exp(-h * (1 / c_casting + 1 / c_die) * 18);
  // T_d after touching: the mean less the casting's share of the difference that is left.
  const double a_touch = 1 - share + share * touch, b_touch = share * pouring * (1 - touch);
  // Two films at once, of 600 W/K to 20 degC and 2000 W/K to 25 degC.
  const double air = std::exp(-2600 / c_die * 2), ambient = (600 * 20.0 + 2000 * 25.0) / 2600;
  const double a = air * a_touch, b = air * b_touch + (1 - air) * ambient;
  EXPECT_NEAR(shots("lumps").at("die_at_end_mean[degC]").back(), b / (1 - a), 0.02);
  EXPECT_LE(shots("lumps").at("shot[1]").size(), 5u);  // a map of one dimension: the third shot is there
}

TEST(Shots, GoOnWithTheSameBitsInAnyShot) {
  k_here.expect_exact_restart("inside_four", k_shots, 3 * 18 + 7);
  k_here.expect_exact_restart("between", k_shots, 3 * 18);
  for (const char* table : {"shots.csv", "pools.csv"})
    EXPECT_EQ(read_text(k_here.root() / "inside_four_whole" / table),
              read_text(k_here.root() / "inside_four_parts" / table));
  // Before the first step of a stage that bodies have left, with no checkpoint at its beginning.
  k_here.expect_exact_restart("between_stages", k_shots, 3 * 18 + 12, {"output.stage_ends=false"});
  k_here.expect_exact_restart("between_shots", k_shots, 3 * 18, {"output.stage_ends=false"});
  for (const int stop : {4 * 18 + 7, 4 * 18})
    k_here.expect_exact_restart("search_" + std::to_string(stop), k_shots, stop,
                                periodic("0.1 K", "anderson"));
}

TEST(Shots, AFinishedSearchGoesOnToASmallerTolerance) {
  const std::string file = k_here.write("smaller.toml", k_shots);
  const auto go = [&](const std::string& tolerance, bool restart) {
    solidus::run::RunOptions options;
    options.folder = k_here.root() / "smaller";
    options.restart = restart;
    return solidus::run::run_case(solidus::setup::load_case(file, periodic(tolerance, "anderson")), options)
        .finished;
  };
  ASSERT_TRUE(go("1 K", false));
  EXPECT_THROW(go("1 K", true), solidus::InputError);
  ASSERT_TRUE(go("0.1 K", true));
  ASSERT_TRUE(k_here.run("smaller_whole", k_shots, periodic("0.1 K", "anderson")).finished);
  EXPECT_EQ(read_text(k_here.root() / "smaller/history.csv"),
            read_text(k_here.root() / "smaller_whole/history.csv"));
}

TEST(Shots, DeformingCastingsAreNewInADeformingDie) {
  const CaseRun r = k_here.run("coupled", k_shots + k_supports, k_coupled);
  ASSERT_TRUE(r.finished) << r.reason;
  const Columns& h = r.history;
  const std::size_t n = 18;
  for (std::size_t s = 1; s < 5; ++s) {
    // What moved with the die and shrank has left; the next casting begins where it is drawn, on the wall of
    // a die that has grown.
    double moved = 0;
    for (std::size_t step = 2; step <= 12; ++step)
      moved = std::max(moved, std::abs(h.at("u_casting[mm]")[(s - 1) * n + step] - h.at("u_casting[mm]")[1]));
    EXPECT_GT(moved, 0.02) << s;
    EXPECT_NEAR(h.at("u_casting[mm]")[s * n + 1], h.at("u_casting[mm]")[1], 0.01) << s;
    EXPECT_EQ(h.at("closed_fraction[1]")[s * n + 1], 1) << s;
    EXPECT_EQ(h.at("closed_fraction[1]")[s * n + 14], 0) << s;
  }
  expect_balance(r, 1e-3);  // stress of the castings leaves with them; energy itself closes:
  const double scale = h.at("heat_exchanged[J]").back();
  EXPECT_NEAR(h.at("energy_defect[J]").back(), 0, 1e-6 * scale);
}

TEST(Shots, ThePeriodicStateIsFoundWithADeformingDie) {
  const std::string coupled = k_shots + k_supports;
  ASSERT_TRUE(k_here.run("coupled_plain", coupled, periodic("0.2 K", "repetition", k_coupled)).finished);
  ASSERT_TRUE(k_here.run("coupled_anderson", coupled, periodic("0.2 K", "anderson", k_coupled)).finished);
  const Columns plain = shots("coupled_plain"), found = shots("coupled_anderson");
  const std::size_t n = plain.at("shot[1]").size();
  EXPECT_LE(3 * found.at("shot[1]").size(), n);
  // Repetition falls short of its limit, which follows from its last three shots (Aitken's process).
  for (const char* column : {"die_at_end_mean[degC]", "die_at_end_min[degC]", "die_at_end_max[degC]"}) {
    const std::vector<double>& t = plain.at(column);
    const double last = t[n - 1] - t[n - 2], before = t[n - 2] - t[n - 3];
    const double limit = t[n - 1] + last * last / (before - last);
    EXPECT_GT(std::abs(limit - t[n - 1]), 0.2) << column;
    EXPECT_NEAR(found.at(column).back(), limit, 0.5) << column;
  }
  k_here.expect_exact_restart("coupled_search", coupled, 3 * 18 + 7,
                              periodic("0.2 K", "anderson", k_coupled));
}

TEST(Shots, TwoProcessesAgree) {
  // Four shots, of which the search moves the third and the fourth.
  const std::string four = "cycle.shots.repeat=4", search = "cycle.shots.periodic=1 K";
  const CaseRun one = k_here.run("serial", k_shots, {four, search});
  const fs::path folder = k_here.root() / "parallel";
  const std::string command =
      "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
      "OMPI_ALLOW_RUN_AS_ROOT=1 "
      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n 2 --bind-to none "
      "--oversubscribe '" SOLIDUS_BINARY_DIR "/solidus' run '" +
      k_here.write("parallel.toml", k_shots) + "' --set '" + four + "' --set '" + search + "' -o '" +
      folder.string() + "' > '" + folder.string() + ".log' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_text(folder.string() + ".log");
  const Columns two = read_csv(folder / "history.csv");
  ASSERT_EQ(two.at("time[s]").size(), one.history.at("time[s]").size());
  for (const char* column : {"T_die[degC]", "T_max[degC]"})
    for (std::size_t i = 0; i < two.at("time[s]").size(); ++i)
      EXPECT_NEAR(two.at(column)[i], one.history.at(column)[i], 1e-5) << column << " in row " << i;
}

}  // namespace
