/// The crankshaft of section 7.4 on a mesh of 2 900 tetrahedra in the part: what must hold on any mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "case_run.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::CaseRun;
using solidus::testing::Columns;

fs::path root() {
  return fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "crankshaft";
}

std::string probe(const std::string& name, double x, double y, double z) {
  std::ostringstream text;
  text << "[[probe]]\nname = \"" << name
       << "\"\nfield = \"temperature\"\nbody = \"part\"\nunit = \"degC\"\npoint = [\"" << x << " mm\", \""
       << y << " mm\", \"" << z << " mm\"]\n";
  return text.str();
}

/// The case with large elements and steps, until a little after shake-out, and with more thermocouples.
std::string short_case(const std::string& variant = "case", const std::string& in_sand = "700 s",
                       const std::string& in_air = "300 s") {
  const std::string text = "include = \"" SOLIDUS_SOURCE_DIR "/cases/crankshaft/" + variant +
                           ".toml\"\n"
                           "[mesh]\nfile = \"" SOLIDUS_SOURCE_DIR
                           "/cases/crankshaft/crankshaft.geo\"\n"
                           "[[mesh.constant]]\nname = \"size\"\nvalue = 24\n"
                           "[time]\ntemperature_error = \"10 K\"\nsolid_fraction_change = 0.2\n"
                           "[[stage]]\nname = \"mould\"\nduration = \"" +
                           in_sand +
                           "\"\nmax_step = \"60 s\"\n"
                           "[[stage]]\nname = \"shake_out\"\nduration = \"" +
                           in_air +
                           "\"\nstep = \"5 s\"\nmax_step = \"60 s\"\n"
                           "[output]\ntimes = [\"" +
                           in_sand + "\"]\n" + probe("T_journal_2", -90, 0, 0) +
                           probe("T_journal_4", 90, 0, 0) + probe("T_pin_3", 45, -40, 0) +
                           probe("T_pin_1", -135, 40, 0) + probe("T_web_above", -22, -20, 20) +
                           probe("T_web_below", -22, -20, -20);
  fs::create_directories(root());
  const fs::path path = root() / (variant + "_" + in_sand + ".toml");
  std::ofstream(path) << text;
  return path.string();
}

const CaseRun& whole() {
  static const CaseRun run = solidus::testing::run(short_case(), "crankshaft/whole");
  return run;
}

std::size_t first_row(const Columns& c, const std::string& name, double at_least) {
  const std::vector<double>& y = c.at(name);
  return static_cast<std::size_t>(std::find_if(y.begin(), y.end(), [&](double v) { return v >= at_least; }) -
                                  y.begin());
}

TEST(Crankshaft, FreezesIsShakenOutAndCools) {
  const CaseRun& r = whole();
  ASSERT_TRUE(r.finished) << r.reason;
  for (const auto& [name, column] : r.history)
    for (const double value : column) ASSERT_TRUE(std::isfinite(value)) << name;
  EXPECT_EQ(r.history.at("solid_fraction[1]").front(), 0);
  EXPECT_NEAR(r.history.at("solid_fraction[1]").back(), 1, 1e-12);
  // In the sand, then in air: the part is hotter than 500 degC at shake-out and cools faster afterwards.
  const auto rate = [&](double from, double to) {
    return (solidus::testing::at(r.history, "T_flange[degC]", from) -
            solidus::testing::at(r.history, "T_flange[degC]", to)) /
           (to - from);
  };
  EXPECT_GT(rate(700, 800), rate(600, 700));
  // It is free then, and shrinks with its mean temperature.
  EXPECT_LT(r.history.at("length_change[mm]").back(),
            solidus::testing::at(r.history, "length_change[mm]", 700));
}

TEST(Crankshaft, EnergyIsClosed) {
  const CaseRun& r = whole();
  for (std::size_t i = 1; i < r.history.at("time[s]").size(); ++i)
    EXPECT_LT(std::abs(r.history.at("energy_defect[J]")[i]), 1e-10 * r.history.at("heat_exchanged[J]")[i])
        << i;
}

TEST(Crankshaft, FreezesLastInsideTheThickestSection) {
  const Columns& c = whole().history;
  // Nine tenths solid: what is still liquid is on the axis or where journal, web and pin meet.
  const std::size_t i = first_row(c, "solid_fraction[1]", 0.9);
  ASSERT_LT(i, c.at("time[s]").size());
  const double core = std::max(c.at("T_journal[degC]")[i], c.at("T_web[degC]")[i]);
  EXPECT_NEAR(core, c.at("T_max_part[degC]")[i],
              3);  // within the mushy range of 30 K the places differ little
  for (const char* thin : {"T_counterweight[degC]", "T_flange[degC]", "T_nose[degC]"})
    EXPECT_LT(c.at(thin)[i], core - 80) << thin;
}

TEST(Crankshaft, IsAsSymmetricAsItsMesh) {
  const Columns& c = whole().history;
  const std::vector<double>& t = c.at("time[s]");
  // Mirror images of one another but for nose and flange, which are far. The mesh is not symmetric: the last
  // melt of one side freezes some seconds before that of the other, and where it has, temperatures fall by
  // up to a kelvin a second. That is one row: the mean is smaller.
  for (const auto& [one, other] :
       {std::pair{"T_journal_2[degC]", "T_journal_4[degC]"}, std::pair{"T_pin[degC]", "T_pin_3[degC]"},
        std::pair{"T_web_above[degC]", "T_web_below[degC]"}}) {
    double squares = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double apart = c.at(one)[i] - c.at(other)[i];
      EXPECT_NEAR(apart, 0, 13) << one << " at " << t[i] << " s";
      squares += apart * apart;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(t.size())), 4.5) << one;
  }
}

TEST(Crankshaft, BothSplitsAgree) {
  const CaseRun r = solidus::testing::run(short_case("isothermal"), "crankshaft/isothermal");
  ASSERT_TRUE(r.finished) << r.reason;
  // Temperatures of the part and its change of length in every row: both splits choose the same steps.
  const Columns& other = whole().history;
  for (const double time : other.at("time[s]")) {
    for (const char* column : {"T_journal[degC]", "T_web[degC]", "T_pin[degC]", "T_nose[degC]"})
      EXPECT_NEAR(solidus::testing::at(r.history, column, time), solidus::testing::at(other, column, time),
                  0.5)
          << column << " at " << time;
    EXPECT_NEAR(solidus::testing::at(r.history, "length_change[mm]", time),
                solidus::testing::at(other, "length_change[mm]", time), 0.03)
        << time;
  }
}

TEST(Crankshaft, TwoProcessesAgree) {
  const std::string file = short_case("case", "6 s", "6 s");
  // For digits that can be compared; and cold enough to leave the sand at once.
  std::ofstream(file, std::ios::app) << "[heat]\ntolerance = 1e-9\n[[body]]\nname = \"part\"\n"
                                        "initial_temperature = \"1120 degC\"\n";
  const CaseRun one = solidus::testing::run(file, "crankshaft/one");
  ASSERT_TRUE(one.finished) << one.reason;
  const fs::path folder = root() / "two";
  const std::string command =
      "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 "
      "mpirun -n 2 --bind-to none --oversubscribe '" SOLIDUS_BINARY_DIR "/solidus' run '" +
      file + "' -o '" + folder.string() + "' > '" + folder.string() + ".log' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << folder.string() << ".log";
  const Columns two = solidus::testing::read_csv(folder / "history.csv");
  ASSERT_EQ(two.at("time[s]").size(), one.history.at("time[s]").size());
  for (std::size_t i = 0; i < two.at("time[s]").size(); ++i) {
    EXPECT_NEAR(two.at("T_journal[degC]")[i], one.history.at("T_journal[degC]")[i], 1e-6) << i;
    EXPECT_NEAR(two.at("T_web[degC]")[i], one.history.at("T_web[degC]")[i], 1e-6) << i;
    EXPECT_NEAR(two.at("length_change[mm]")[i], one.history.at("length_change[mm]")[i], 1e-6) << i;
  }
}

}  // namespace
