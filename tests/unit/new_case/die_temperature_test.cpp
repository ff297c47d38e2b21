/// How warm `solidus new` makes dies.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "material/cards/library.hpp"
#include "new_case/casting_processes.hpp"
#include "new_case/draft_choice.hpp"

namespace solidus::new_case {
namespace {

constexpr double k_celsius = 273.15;
const std::array<std::filesystem::path, 1> k_library{std::filesystem::path(SOLIDUS_SOURCE_DIR) / "materials"};

double die_of(const std::string& process, double liquidus) {
  Draft draft;
  draft.liquidus = liquidus;
  DraftBody body;
  body.role = cases::Role::die;
  describe(draft, process_named(process), body);
  return body.start;
}

TEST(DieTemperature, IsFarBelowTheLiquidusOfEveryAlloy) {
  int alloys = 0;
  for (const std::string& name : material::material_names(k_library)) {
    const material::Material alloy = material::find_material(name, k_library);
    if (alloy.solidification() == nullptr) continue;
    ++alloys;
    const double liquidus = alloy.solidification()->fraction.liquidus() - k_celsius;
    for (const char* process : {"gravity_die", "high_pressure"}) {
      EXPECT_LT(die_of(process, liquidus), liquidus - 100) << name << ", " << process;
      EXPECT_GE(die_of(process, liquidus), 20) << name << ", " << process;
    }
  }
  EXPECT_GT(alloys, 20);
}

TEST(DieTemperature, IsThatOfTheProcessForAluminium) {
  EXPECT_EQ(die_of("gravity_die", 614), 250);
  EXPECT_EQ(die_of("high_pressure", 614), 200);
}

}  // namespace
}  // namespace solidus::new_case
