/// Measured temperatures of two direct-chill cast billets (docs/validation/dc_billets.md), on coarse meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "case_run.hpp"

namespace solidus {
namespace {

struct Point {
  double z, temperature;  // [mm], [degC]
};

std::map<std::string, std::vector<Point>> measured(const std::string& path) {
  std::ifstream in(std::string(SOLIDUS_SOURCE_DIR) + "/cases/" + path + "/measured.csv");
  std::map<std::string, std::vector<Point>> points;
  std::string line;
  bool headed = false;
  while (std::getline(in, line)) {
    if (line.starts_with('#')) continue;
    if (!headed) {
      EXPECT_EQ(line, "thermocouple,z[mm],temperature[degC]");
      headed = true;
      continue;
    }
    std::istringstream row(line);
    std::string name, z, temperature;
    std::getline(row, name, ',');
    std::getline(row, z, ',');
    std::getline(row, temperature, ',');
    points[name].push_back({std::stod(z), std::stod(temperature)});
  }
  return points;
}

/// Root mean square of computed minus measured temperatures [K].
/// @param start, speed  the thermocouple's z at the start [mm], how fast it sinks [mm/s]
double deviation(const std::vector<Point>& points, const testing::CaseRun& run, const std::string& column,
                 double start, double speed, double shift) {
  double sum = 0;
  for (const Point& p : points) {
    const double time = (start - p.z - shift) / speed;
    sum += std::pow(testing::at(run.history, column, time) - p.temperature, 2);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

TEST(Billets, Aa6060IsMetAsWellAsThePageSays) {
  const auto points = measured("billet_aa6060");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points.at("0 mm").size() + points.at("28 mm").size() + points.at("44 mm").size() +
                points.at("75 mm").size(),
            179U);
  const testing::CaseRun run = testing::run("cases/billet_aa6060", "billet_aa6060",
                                            {"mesh.block.divisions=[16, 160]", "time.step=\"2 s\""});
  ASSERT_TRUE(run.finished) << run.reason;
  const auto rms = [&](const std::string& of, const std::string& radius, double shift) {
    return deviation(points.at(of), run, "T_" + radius + "mm[degC]", 600, 2.583, shift);
  };
  // One shift for all, 14 mm on the mesh of the case. Loads are means over a step, in which the block moves 5
  // mm.
  EXPECT_NEAR(rms("0 mm", "0", 14.5), 13.9, 3);
  EXPECT_NEAR(rms("28 mm", "28", 14.5), 5.7, 3);
  EXPECT_NEAR(rms("44 mm", "44", 14.5), 45.1, 4);
  EXPECT_NEAR(rms("75 mm", "75", 14.5), 49.2, 6);
  // Each with its own.
  EXPECT_NEAR(rms("0 mm", "0", 11.5), 8.7, 3);
  EXPECT_NEAR(rms("28 mm", "28", 13), 4.5, 3);
  EXPECT_NEAR(rms("44 mm", "44", 2.75), 2.7, 3);
  EXPECT_NEAR(rms("75 mm", "75", 17), 39.2, 6);
  // Read at other radii, all with the same shift.
  EXPECT_LT(rms("0 mm", "0", 12), 15);
  EXPECT_LT(rms("28 mm", "28", 12), 15);
  EXPECT_LT(rms("44 mm", "52", 12), 15);
  EXPECT_LT(rms("75 mm", "68", 12), 15);
}

TEST(Billets, Al6CuIsMetAsWellAsThePageSays) {
  const auto points = measured("billet_al6cu");
  ASSERT_EQ(points.size(), 3U);
  const testing::CaseRun run = testing::run("cases/billet_al6cu", "billet_al6cu",
                                            {"mesh.block.divisions=[45, 260]", "time.step=\"4 s\""});
  ASSERT_TRUE(run.finished) << run.reason;
  const auto rms = [&](const std::string& name, double shift) {
    return deviation(points.at(name), run, "T_" + name + "[degC]", 700, 1, shift);
  };
  EXPECT_NEAR(rms("centreline", -6.5), 27, 3);
  EXPECT_NEAR(rms("midradius", -6.5), 9.2, 3);
  EXPECT_NEAR(rms("subsurface", -6.5), 15.9, 3);
  EXPECT_NEAR(rms("centreline", -24.5), 5.6, 2);
}

TEST(Billets, TheCoupledVariantHasTheSameTemperaturesAndAFreeButt) {
  const std::vector<std::string> coarse = {"mesh.block.divisions=[5, 58]", "time.step=\"4 s\"",
                                           "time.end=\"100 s\"", "output.times=[\"100 s\"]"};
  const testing::CaseRun heat = testing::run("cases/billet_aa6060", "billet_heat", coarse),
                         coupled = testing::run("cases/billet_aa6060/coupled.toml", "billet_coupled", coarse);
  ASSERT_TRUE(coupled.finished) << coupled.reason;
  // The specific heat is that at constant pressure in both, and hardly anything is held. Read as one at
  // constant strain the coupled billet is up to 22 K hotter.
  EXPECT_NEAR(coupled.history.at("T_min[degC]").back(), heat.history.at("T_min[degC]").back(), 0.3);
  EXPECT_NEAR(coupled.history.at("solid_fraction[1]").back(), heat.history.at("solid_fraction[1]").back(),
              2e-4);
  // The rim has contracted upward, its centre has not yet: the butt curls.
  EXPECT_GT(coupled.history.at("butt_rim[mm]").back(), coupled.history.at("butt_centre[mm]").back() + 0.1);
}

}  // namespace
}  // namespace solidus
