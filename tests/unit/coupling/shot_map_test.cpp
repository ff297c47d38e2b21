/// The search for the periodic state of a die, on maps of shots that are given.
#include "coupling/shot_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../heat/block.hpp"
#include "heat/storage/nodal_enthalpy.hpp"

namespace solidus {
namespace {

using coupling::ShotHistory;
using coupling::ShotMap;
using coupling::State;

class Periodic : public ::testing::Test {
 protected:
  Periodic()
      : mesh_(test::block_mesh(mesh::Shape::quad4, {0.09, 0.01}, {9, 1})),
        phase_(mesh_, AnalysisKind::plane_strain, {test::metal(40)}, {}) {}

  struct Search {
    int shots = 0;
    State state;
    ShotHistory history;
    double corrected = 0;  ///< sum [J]
  };
  /// Shots until the state is periodic, 500 at most.
  /// @param map  the temperature at the end of a shot from that at its start and the place along the bar [K]
  Search search(const std::function<double(double, double)>& map, bool accelerate) {
    const ShotMap shots(phase_, {1}, {.tolerance = 1e-4, .accelerate = accelerate});
    Search s;
    s.state.heat = phase_.states().initial(std::vector<double>{400.0});
    s.history.lowest = 300;
    s.history.highest = 850;
    while (s.shots < 500) {
      s.corrected += shots.begin(s.state, s.history);
      for (Index i = 0; i < static_cast<Index>(mesh_.x.size()); ++i) {
        double& t = s.state.heat.temperature[static_cast<std::size_t>(i)];
        t = map(t, mesh_.x[static_cast<std::size_t>(i)][0]);
      }
      s.state.heat = phase_.states().initial_at_nodes(s.state.heat.temperature);
      ++s.shots;
      if (shots.end(s.state, s.history).periodic) break;
    }
    return s;
  }

  mesh::Mesh mesh_;
  heat::ThermalPhase phase_;
};

/// Three factors by which deviations fall, along the bar, from the temperature 600 K.
double linear(double t, double x) {
  const double factor = x < 0.03 ? 0.95 : x < 0.06 ? 0.7 : 0.2;
  return 600 + factor * (t - 600);
}

TEST_F(Periodic, ALinearMapOfThreeFactorsIsSolvedInFiveShots) {
  const Search plain = search(linear, false), found = search(linear, true);
  EXPECT_GT(plain.shots, 200);
  EXPECT_EQ(plain.corrected, 0);
  EXPECT_LE(found.shots, 5);  // four changes span the space; the fifth shot shows it
  for (const double t : found.state.heat.temperature) EXPECT_NEAR(t, 600, 1e-3);
  EXPECT_NE(found.corrected, 0);
}

TEST_F(Periodic, AMapThatBendsIsSolvedToo) {
  const auto bent = [](double t, double x) { return linear(t, x) + 30 * std::sin(t / 40); };
  const Search found = search(bent, true);
  EXPECT_LE(found.shots, 40);
  EXPECT_LE(found.history.change, 1e-4);
}

// A combination that would leave the temperatures of the run is taken in part.
TEST_F(Periodic, NoNodeIsMovedBeyondTheHighestTemperatureOfTheRun) {
  const Search s = search([](double t, double) { return std::min(t + 20 - 1e-3 * (t - 400), 845.0); }, true);
  EXPECT_LT(s.shots, 500);
  for (const double t : s.state.heat.temperature) EXPECT_NEAR(t, 845, 1e-6);
}

TEST_F(Periodic, TheHeatOfAMoveIsToldToTheLastDigit) {
  const ShotMap shots(phase_, {1}, {.tolerance = 1e-9});
  State state;
  state.heat = phase_.states().initial(std::vector<double>{400.0});
  ShotHistory history;
  history.lowest = 300;
  history.highest = 850;
  for (int shot = 0; shot < 4; ++shot) {
    const double before = phase_.states().heat_content(state.heat);
    const double corrected = shots.begin(state, history);
    EXPECT_NEAR(phase_.states().heat_content(state.heat) - before, corrected, 1e-12 * before);
    for (std::size_t i = 0; i < mesh_.x.size(); ++i)
      state.heat.temperature[i] = linear(state.heat.temperature[i], mesh_.x[i][0]);
    state.heat = phase_.states().initial_at_nodes(state.heat.temperature);
    shots.end(state, history);
  }
}

}  // namespace
}  // namespace solidus
