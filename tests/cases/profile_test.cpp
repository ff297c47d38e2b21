/// The profile of a run: where summary.json says that the wall time went.
#include <gtest/gtest.h>

#include <chrono>

#include "case_run.hpp"
#include "system/profile.hpp"

namespace solidus::testing {
namespace {

/// The members of "profile[s]" of a run's summary.json.
std::map<std::string, double> profile_of(const std::string& name) {
  std::ifstream in(std::filesystem::path(SOLIDUS_BINARY_DIR) / "case_runs" / name / "summary.json");
  std::map<std::string, double> parts;
  std::string line;
  while (std::getline(in, line) && line.find("\"profile[s]\"") == std::string::npos) continue;
  while (std::getline(in, line) && line.find('}') == std::string::npos) {
    const std::size_t begin = line.find('"') + 1, end = line.find("\":", begin);
    parts[line.substr(begin, end - begin)] = std::strtod(line.c_str() + end + 2, nullptr);
  }
  return parts;
}

TEST(Profile, ThePartsOfARunAddUpToItsWallTimeAndNameNearlyAllOfIt) {
  const auto start = std::chrono::steady_clock::now();
  profile::begin();
  ASSERT_TRUE(
      run("bench/cooling_block", "profile", {"mesh.block.divisions=[10,10,10]", "time.end=4 s"}).finished);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::map<std::string, double> parts = profile_of("profile");
  const double total = parts.at("total");
  parts.erase("total");
  double sum = 0;
  for (const auto& [name, seconds] : parts) {
    EXPECT_GE(seconds, 0) << name;
    sum += seconds;
  }
  EXPECT_NEAR(sum, total, 1e-3 * total);  // milliseconds pass between the two
  EXPECT_LE(total, wall);
  EXPECT_GE(total, 0.8 * wall);  // reading the tables back comes after it
  // On a quiet machine a per cent; reading the case file belongs to it, and everything here is short.
  EXPECT_LE(parts.at("other"), 0.1 * total);
  for (const char* part : {"partition", "set-up", "heat: solve", "mechanics: law and forces",
                           "mechanics: assembly", "mechanics: solver set-up", "mechanics: solve", "output"})
    EXPECT_EQ(parts.count(part), 1U) << part;
}

}  // namespace
}  // namespace solidus::testing
