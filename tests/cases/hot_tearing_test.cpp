/// Criteria of hot tearing rank an alloy that hardly tears below one that does, on two meshes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "case_folder.hpp"

namespace solidus {
namespace {

using testing::CaseFolder;
using testing::CaseRun;

const CaseFolder k_here("hot_tearing");

std::string film(const std::string& group) {
  return "[[thermal_condition]]\nname = \"sand_" + group + "\"\ngroup = \"" + group +
         "\"\nkind = \"film\"\ncoefficient = \"150 W/m2/K\"\nambient = \"200 degC\"\n";
}

/// A bar of 200 × 20 mm that freezes from its long sides and its ends, by heat alone.
std::string bar(const std::string& alloy, int across) {
  const std::string along = std::to_string(10 * across), through = std::to_string(across);
  return "title = \"A bar\"\n[analysis]\nkind = \"plane_strain\"\nphysics = \"heat\"\n[mesh]\nshape = "
         "\"block\"\n"
         "element = \"quad4\"\n[mesh.block]\nsize = [\"200 mm\", \"20 mm\"]\ndivisions = [" +
         along + ", " + through +
         "]\n[time]\nuntil = \"solid\"\nend = \"1000 s\"\nstep = \"0.5 s\"\nadaptive = true\n[[body]]\nname "
         "= "
         "\"block\"\nrole = \"casting\"\nmaterial = \"" +
         alloy + "\"\ninitial_temperature = \"700 degC\"\n" + film("x_min") + film("x_max") + film("y_min") +
         film("y_max");
}

double probe_at_end(const CaseRun& run, const std::string& name) {
  return run.history.at(name).back();
}

// At the centre of the bar, where the gradient is zero, the estimate has a limit: it does not grow as
// elements get smaller.
TEST(HotTearing, HasALimitAtAThermalCentre) {
  std::vector<double> largest;
  for (const int across : {6, 10, 20}) {
    const std::string text = bar("aluminium_alsi7mg", across) +
                             "[[probe]]\nname = \"maximum\"\nfield = \"tearing_tendency\"\nkind = "
                             "\"maximum\"\ngroup = \"block\"\nunit = \"1\"\n";
    const CaseRun run = k_here.run("centre" + std::to_string(across), text, {});
    ASSERT_TRUE(run.finished) << run.reason;
    largest.push_back(probe_at_end(run, "maximum[1]"));
  }
  EXPECT_NEAR(largest[0], largest[2], 0.1 * largest[2]);
  EXPECT_NEAR(largest[1], largest[2], 0.1 * largest[2]);
}

TEST(HotTearing, RanksAlloysAsFoundriesDo) {
  for (const int across : {6, 10}) {
    for (const char* alloy : {"aluminium_alsi7mg", "aluminium_alcu4mgti"}) {
      std::string text = bar(alloy, across);
      for (const char* kind : {"minimum", "maximum"})
        text += std::string("[[probe]]\nname = \"") + kind + "\"\nfield = \"tearing_tendency\"\nkind = \"" +
                kind + "\"\ngroup = \"block\"\nunit = \"1\"\n";
      const CaseRun run = k_here.run(alloy + std::to_string(across), text, {});
      ASSERT_TRUE(run.finished) << run.reason;
      if (std::string(alloy) == "aluminium_alsi7mg")
        EXPECT_LT(probe_at_end(run, "maximum[1]"), 0.5) << across;
      else
        EXPECT_GT(probe_at_end(run, "minimum[1]"), 1) << across;
    }
  }
}

const std::string k_linear_alloy = R"(title = "An alloy that freezes evenly over its range"
[density]
value = "2500 kg/m3"
source = "made"
[conductivity]
value = "1000 W/m/K"
source = "made"
[specific_heat]
value = "1000 J/kg/K"
source = "made"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "400 kJ/kg"
volume_change = -0.05
source = "made"
[phase_change.fraction]
kind = "table"
temperatures = ["600 degC", "500 degC"]
fractions = [0, 1]
)";

// A small block that loses heat at an even rate has an enthalpy, and with these data a solid fraction, that
// is linear in time: 0.09 of the time of freezing over 0.5 of it.
TEST(HotTearing, ClyneAndDaviesOfAnEvenFreezing) {
  k_here.write("linear.toml", k_linear_alloy);
  std::string text =
      "title = \"A drop\"\n[analysis]\nkind = \"plane_strain\"\nphysics = \"heat\"\n[mesh]\nshape = "
      "\"block\"\nelement "
      "= \"quad4\"\n[mesh.block]\nsize = [\"1 mm\", \"1 mm\"]\ndivisions = [1, 1]\n[time]\nend = \"15 "
      "s\"\nstep = "
      "\"0.1 s\"\n[[body]]\nname = \"block\"\nmaterial = \"linear.toml\"\ninitial_temperature = \"620 "
      "degC\"\n[[probe]]\nname = \"share\"\nfield = \"vulnerable_share\"\nkind = \"mean\"\ngroup = "
      "\"block\"\nunit = \"1\"\n";
  for (const char* side : {"x_min", "x_max", "y_min", "y_max"})
    text += std::string("[[thermal_condition]]\nname = \"") + side + "\"\ngroup = \"" + side +
            "\"\nkind = \"flux\"\nflux = \"-25000 W/m2\"\n";
  const CaseRun run = k_here.run("drop", text, {});
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_NEAR(run.history.at("share[1]").back(), 0.09 / 0.5, 1e-3);
}

/// A number of the criteria in summary.json.
double finding(const std::filesystem::path& folder, const std::string& name) {
  const std::string summary = testing::read_text(folder / "summary.json");
  const std::string key = "\"" + name + "\": ";
  const std::size_t at = summary.find(key);
  EXPECT_NE(at, std::string::npos) << name;
  return at == std::string::npos ? -1 : std::stod(summary.substr(at + key.size()));
}

// The strain that the mush of a bar takes between its flanges, by the coupled run, with two meshes.
TEST(HotTearBar, TearsOfTheAlloyThatFoundriesKnowForIt) {
  const auto share = [](const std::string& file, const std::string& name, const std::string& size) {
    const CaseRun run = testing::run("cases/hot_tear_bar/" + file, "hot_tearing/" + name,
                                     {"mesh.constant=[{name=\"size\",value=" + size + "}]"});
    EXPECT_TRUE(run.finished) << run.reason;
    return finding(k_here.root() / name, "strained_tendency_beyond");
  };
  const double coarse = share("case.toml", "bar_coarse", "4"), fine = share("case.toml", "bar_fine", "2.5");
  EXPECT_GT(fine, 0.8);
  EXPECT_NEAR(coarse, fine, 0.03);
  EXPECT_LT(share("alsi7mg.toml", "bar_alsi7mg", "2.5"), 0.005);
}

}  // namespace
}  // namespace solidus
