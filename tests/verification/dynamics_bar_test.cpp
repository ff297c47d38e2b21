/// A bar that hits a wall: behind the front that runs back from the wall the bar stands still and carries
/// σ = −ρ c v; at t = 2 L/c the front comes back from the free end and the wall is free.
///
///   wall ┃▓▓▓▓▓▓▓▓▓░░░░░░░░░░░░   ← v = 10 m/s      L = 1 m, 100 quads, uniaxial strain, Poisson's ratio 0
///        0        c t         L
#include <gtest/gtest.h>

#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using mechanics::DynamicsOptions;
using mechanics::MassKind;
using mechanics::Motion;
using test::Body;

constexpr double k_young = 2e11, k_density = 7800, k_length = 1, k_height = 0.01, k_speed = 10;
constexpr int k_elements = 100, k_steps_per_element = 2;
const double k_wave = std::sqrt(k_young / k_density);      // [m/s]
const double k_stress = k_density * k_wave * k_speed;      // [Pa]
const double k_passage = k_length / k_wave;                // [s]
constexpr int k_steps = k_elements * k_steps_per_element;  // in one passage of the front

struct Method {
  const char* name;
  Motion motion;
  MassKind mass;
};
const Method k_methods[] = {
    {"backward Euler", Motion::backward_euler(), MassKind::consistent},
    {"Newmark 0.6", Motion::newmark(0.6, 0.3025), MassKind::consistent},
    {"trapezoidal", Motion::trapezoidal(), MassKind::consistent},
    {"generalised-alpha 0.5", Motion::generalised_alpha(0.5), MassKind::consistent},
    {"generalised-alpha 0.5 lumped", Motion::generalised_alpha(0.5), MassKind::lumped}};

/// Over one and a half times the contact.
struct Impact {
  std::vector<double> wall;    ///< pressure at the wall after every step, over ρ c v
  std::vector<double> stress;  ///< along the bar at t = L/2c, element by element, over −ρ c v
  double numerical = 0;        ///< dissipation up to t = L/2c over the kinetic energy at the start
};

Impact impact(const Method& m) {
  Body body({.shape = mesh::Shape::quad4, .cells = {k_elements, 1, 1}, .size = {k_length, k_height, 1}},
            AnalysisKind::plane_strain, test::elastic_material(k_young, 0.0));
  body.hold("left", 0);
  for (const char* side : {"bottom", "top"}) body.hold(side, 1);
  body.options.dynamics = DynamicsOptions{m.mass, m.motion, {{-k_speed, 0, 0}}};
  const auto phase = body.phase();
  mechanics::MechanicalState state = phase->initial_state();
  const double dt = k_passage / k_steps;
  Impact result;
  result.stress.assign(k_elements, 0.0);
  for (int n = 1; n <= 3 * k_steps; ++n) {
    const mechanics::MechanicalState old = state;
    const mechanics::MechanicalReport report = phase->solve(old, state, body.temperature, n * dt, dt);
    double force = 0;
    for (std::size_t i = 0; i < report.reactions.size(); i += 2) force += report.reactions[i];
    result.wall.push_back(parallel::global_sum(force) / k_height / k_stress);
    if (2 * n <= k_steps)
      result.numerical += report.work.numerical / (0.5 * k_density * k_length * k_height * k_speed * k_speed);
    if (2 * n != k_steps) continue;
    const test::ElementFields fields = test::element_fields(phase->mesh(), state).front();
    const mesh::ElementBlock& block = body.mesh.blocks.front();
    for (Index e = 0; e < block.n_counted; ++e)
      result.stress[static_cast<std::size_t>(block.input_element[static_cast<std::size_t>(e)] - 1)] =
          -fields.stress[static_cast<std::size_t>(e)][0] / k_stress;
  }
  for (double& s : result.stress) s = parallel::global_sum(s);
  return result;
}

double mean(const std::vector<double>& values, double from, double to) {
  const auto n = static_cast<double>(values.size());
  const auto first = static_cast<std::size_t>(from * n), last = static_cast<std::size_t>(to * n);
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first);
}

TEST(BarThatHitsAWall, CarriesTheStressOfTheWaveBehindItsFront) {
  auto history = verification::table("dynamics_bar_wall",
                                     "time[L/c],exact,backward_euler,newmark,trapezoidal,generalised_alpha");
  auto profile = verification::table("dynamics_bar_profile",
                                     "x[L],exact,backward_euler,newmark,trapezoidal,generalised_alpha");
  auto summary = verification::table("dynamics_bar", "method,wall,behind_front,ahead,numerical_dissipation");
  std::vector<Impact> impacts;
  for (const Method& m : k_methods) {
    SCOPED_TRACE(m.name);
    const Impact i = impact(m);
    impacts.push_back(i);
    // At the wall between the start, where the first element rings, and the front's return.
    const double wall = mean(i.wall, 0.05, 0.6), behind = mean(i.stress, 0, 0.4),
                 ahead = mean(i.stress, 0.6, 1);
    // Backward Euler widens the front over a tenth of the bar.
    EXPECT_NEAR(wall, 1, 2e-3);
    EXPECT_NEAR(behind, 1, 5e-3);
    EXPECT_NEAR(ahead, 0, 5e-3);
    // Momentum: what has come to rest by t = L/2c is half of the bar.
    EXPECT_NEAR(mean(i.stress, 0, 1), 0.5, 5e-3);
    summary << m.name << "," << wall << "," << behind << "," << ahead << "," << i.numerical << "\n";
  }
  // A shock takes half of the high frequencies' share: small with methods of second order.
  EXPECT_NEAR(impacts[2].numerical, 0, 1e-9);
  EXPECT_GT(impacts[0].numerical, 3 * impacts[3].numerical);
  EXPECT_GT(impacts[3].numerical, 0);
  for (std::size_t n = 0; n < impacts[0].wall.size(); n += 4) {
    const double t = static_cast<double>(n + 1) / k_steps;
    history << t << "," << (t < 2 ? 1 : -1);  // the wall holds on: the bar is pulled where it would leave
    for (std::size_t m = 0; m < 4; ++m) history << "," << impacts[m].wall[n];
    history << "\n";
  }
  for (std::size_t e = 0; e < k_elements; ++e) {
    const double x = (static_cast<double>(e) + 0.5) / k_elements;
    profile << x << "," << (x < 0.5 ? 1 : 0);
    for (std::size_t m = 0; m < 4; ++m) profile << "," << impacts[m].stress[e];
    profile << "\n";
  }
}

TEST(BarThatHitsAWall, IsFreeAgainWhenTheFrontComesBack) {
  for (const Method& m : k_methods) {
    const Impact i = impact(m);
    // Half height of the drop from 1 to −1.
    std::size_t n = static_cast<std::size_t>(k_steps);
    while (n < i.wall.size() && i.wall[n] > 0) ++n;
    EXPECT_NEAR(static_cast<double>(n) / k_steps, 2, 0.02) << m.name;  // elements are 0.01 of the bar
  }
}

}  // namespace
}  // namespace solidus
