/// Criteria of hot tearing rank an alloy that hardly tears below one that does, on two meshes.
#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace solidus
