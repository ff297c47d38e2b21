/// The directions of plastic flow that Newton's method finds along with the displacement.
#include "mechanics/elements/flow_directions.hpp"

#include <gtest/gtest.h>

#include <random>

#include "material/viscoplastic.hpp"
#include "plastic_material.hpp"

namespace solidus {
namespace {

Sym<Lane> random_deviator(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Sym<Lane> a;
  for (int i = 0; i < 6; ++i)
    for (int lane = 0; lane < k_lanes; ++lane) a[i].set(lane, normal(random));
  return dev(a);
}

Sym<Lane> nothing() {
  return {};
}

void expect_equal(const Sym<Lane>& a, const Sym<Lane>& b, double tolerance) {
  for (int i = 0; i < 6; ++i)
    for (int lane = 0; lane < k_lanes; ++lane) EXPECT_NEAR(a[i][lane], b[i][lane], tolerance);
}

const LaneMask k_all = Lane(1.0) > Lane(0.0);

TEST(FlowDirections, BeginWithTheLoadingAtTheStart) {
  std::mt19937 random(1);
  mechanics::FlowDirections directions;
  const Sym<Lane> first = Lane(0.1) * random_deviator(random), relative = random_deviator(random);
  expect_equal(directions.at(0, 1, relative, k_all, [&] { return first; }), first, 1e-6);
}

TEST(FlowDirections, AreThoseOfTheStressOnceTheIterateStays) {
  std::mt19937 random(2);
  mechanics::FlowDirections directions;
  const Sym<Lane> relative = Lane(1e7) * random_deviator(random);
  directions.at(0, 1, relative, k_all, nothing);
  const Sym<Lane> m = directions.at(0, 1, relative, k_all, nothing);
  expect_equal(m, Lane(1.0) / norm(relative) * relative, 1e-6);
}

TEST(FlowDirections, HaveTheErrorOfTheIteratesSquared) {
  std::mt19937 random(3);
  const Sym<Lane> goal = random_deviator(random), away = random_deviator(random);
  const Sym<Lane> n = Lane(1.0) / norm(goal) * goal;
  const auto error = [&](double size) {
    mechanics::FlowDirections directions;
    const Sym<Lane> start = Lane(1.0) / norm(goal + Lane(size) * away) * (goal + Lane(size) * away);
    directions.at(0, 1, goal + Lane(size) * away, k_all, [&] { return start; });
    const Sym<Lane> off = directions.at(0, 1, goal, k_all, nothing) - n;
    return norm(off)[0];
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 2, 0.1);
}

TEST(FlowDirections, AreNeverLongerThanOneAndStayWhereNothingFlows) {
  std::mt19937 random(4);
  mechanics::FlowDirections directions;
  Sym<Lane> before{};
  for (int k = 0; k < 100; ++k) {
    const Sym<Lane> relative = random_deviator(random);
    const LaneMask flows = relative[0] > Lane(0.0);
    const Sym<Lane> m = directions.at(2, 3, relative, flows, [&] { return random_deviator(random); });
    for (int lane = 0; lane < k_lanes; ++lane) {
      EXPECT_LE(norm(m)[lane], 1 + 1e-6);
      if (flows[lane]) continue;
      for (int i = 0; i < 6; ++i) EXPECT_NEAR(m[i][lane], before[i][lane], 1e-7);
    }
    before = m;
    for (int i = 0; i < 6; ++i)
      before[i] =
          for_each_lane(before[i], [](double x) { return static_cast<double>(static_cast<float>(x)); });
  }
}

TEST(FlowDirections, AreForgottenWhenASolveBegins) {
  std::mt19937 random(5);
  mechanics::FlowDirections directions;
  const Sym<Lane> relative = random_deviator(random);
  directions.at(0, 1, relative, k_all, nothing);
  directions.begin();
  expect_equal(directions.at(0, 1, relative, k_all, nothing), {}, 0);
}

TEST(Loading, IsTheShareOfTheYieldRadiusThatAStateTakes) {
  const material::Material m = test::perfectly_plastic(40e6);
  const material::Viscoplastic law(m);
  const auto p = law.properties_at(300.0, 300.0);
  const material::Viscoplastic::State<double> state{};
  const double yield_strain = 40e6 / (2 * p.elastic.shear) / std::sqrt(3.0);  // in pure shear
  const auto at = [&](double share) {
    Sym<double> strain;
    strain[0] = strain[1] = strain[2] = 1e-3;
    strain[3] = share * yield_strain;
    return law.loading(p, state, strain, 1.0);
  };
  EXPECT_NEAR(norm(at(0.25)), 0.25, 1e-12);
  EXPECT_NEAR(norm(at(1)), 1, 1e-12);
  EXPECT_NEAR(norm(at(30)), 1, 1e-12);
  EXPECT_NEAR(trace(at(0.5)), 0, 1e-15);
}

}  // namespace
}  // namespace solidus
