// Liquid metal on its wall: held by the atmosphere until it is coherent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bodies.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/pair.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

constexpr double k_atmosphere = 1e5, k_penalty = 1e10, k_reach = k_atmosphere / k_penalty;

ContactParameters spec(Formulation formulation = Formulation::small_sliding) {
  ContactParameters s;
  s.name = "wall";
  s.slave = "lower_top";
  s.master = "upper_bottom";
  s.penalty = k_penalty;
  s.penalty_is_factor = false;
  s.stabilisation = 0;
  s.formulation = formulation;
  s.atmosphere = k_atmosphere;
  s.gauss_degree = 3;  // no point of a slave's face lies opposite an edge of the master
  return s;
}
AnalysisKind kind_of(const mesh::Mesh& mesh) {
  return mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
}
/// The lower body at f_S/f_c = `lower`, the upper one at `upper`.
std::vector<double> coherency(const mesh::Mesh& mesh, double lower, double upper) {
  return test::nodal_field(mesh, 1, [&](const Point&, bool up) { return std::vector{up ? upper : lower}; });
}
/// The upper body lifted, and tilted by so much over the width.
std::vector<double> lifted(const mesh::Mesh& mesh, double lift, double tilt = 0) {
  const auto last = static_cast<std::size_t>(mesh.dimension - 1);
  return test::nodal_field(mesh, mesh.dimension, [&](const Point& x, bool up) {
    std::vector<double> u(static_cast<std::size_t>(mesh.dimension), 0.0);
    if (up) u[last] = lift + tilt * x[0] / 0.3;
    return u;
  });
}
double area(const mesh::Mesh& mesh) {
  return mesh.dimension == 2 ? 0.3 : 0.3 * 0.2;
}

struct OneStep {
  const mesh::Mesh& mesh;
  ContactPair pair;
  ContactState state;

  OneStep(const mesh::Mesh& m, ContactParameters s) : mesh(m), pair(m, kind_of(m), std::move(s)) {
    state = pair.parts().history.initial();
  }
  /// A step from the state so far to a displacement.
  ContactSums step(const std::vector<double>& displacement, const std::vector<double>& coherent) {
    pair.begin(state, {.time = 1, .dt = 1, .displacement = displacement, .solidity = {coherent}});
    pair.update(displacement);
    state = pair.state();
    return contact::sums(pair.view(), {});
  }
};

struct Melt {
  Shape shape;
  Formulation formulation;
  bool slave;  ///< melts, else the master does
};

class Wet : public ::testing::TestWithParam<Melt> {
 protected:
  const mesh::Mesh mesh_ = test::two_blocks(GetParam().shape);
  std::vector<double> liquid(double at = 0.5) const {
    return GetParam().slave ? coherency(mesh_, at, 1) : coherency(mesh_, 1, at);
  }
};

TEST_P(Wet, HoldsTheWallUntilTheAtmosphereGivesInAndOpensWhenItIsCoherent) {
  OneStep run(mesh_, spec(GetParam().formulation));
  const double a = area(mesh_), whole = k_atmosphere * a;
  ContactSums sums = run.step(lifted(mesh_, 0.4 * k_reach), liquid());
  EXPECT_NEAR(sums.force, -0.4 * whole, 2e-2 * whole);  // what points at fixed places integrate
  EXPECT_EQ(sums.closed_points, sums.points);
  EXPECT_NEAR(sums.wet_area, a, 1e-9 * a);
  sums = run.step(lifted(mesh_, 50 * k_reach), liquid());
  EXPECT_NEAR(sums.force, -whole, 1e-9 * whole);  // no more than the atmosphere
  EXPECT_EQ(sums.closed_points, 0);
  sums = run.step(lifted(mesh_, 0.4 * k_reach), liquid());  // wet all the while: it did not draw air
  EXPECT_NEAR(sums.force, -0.4 * whole, 2e-2 * whole);
  sums = run.step(lifted(mesh_, 0.4 * k_reach), liquid(1.2));
  EXPECT_EQ(sums.force, 0);
  EXPECT_EQ(sums.wet_area, 0);
  sums = run.step(lifted(mesh_, 0.4 * k_reach), liquid());  // melts again behind its gap of air
  EXPECT_EQ(sums.force, 0);
  sums = run.step(lifted(mesh_, -0.1 * k_reach), liquid());  // touches
  EXPECT_GT(sums.force, 0);
  sums = run.step(lifted(mesh_, 0.4 * k_reach), liquid());
  EXPECT_NEAR(sums.force, -0.4 * whole, 2e-2 * whole);
}

TEST_P(Wet, PullsOnBothBodiesAlike) {
  OneStep run(mesh_, spec(GetParam().formulation));
  const std::vector<double> u = lifted(mesh_, -0.5 * k_reach, 3 * k_reach);
  run.step(u, liquid());
  const auto dim = static_cast<std::size_t>(mesh_.dimension);
  std::vector<double> r(static_cast<std::size_t>(mesh_.n_owned_nodes) * dim, 0.0);
  run.pair.parts().forces.term().add_residual(u, r);
  double sum = 0, size = 0;
  for (std::size_t i = dim - 1; i < r.size(); i += dim) {
    sum += r[i];
    size += std::abs(r[i]);
  }
  EXPECT_GT(parallel::global_sum(size), 0.1 * k_atmosphere * area(mesh_));
  EXPECT_LT(std::abs(parallel::global_sum(sum)), 1e-12 * parallel::global_sum(size));
}

TEST_P(Wet, HasTheTangentThatFiniteDifferencesShow) {
  OneStep run(mesh_, spec(GetParam().formulation));
  const std::vector<double> u = lifted(mesh_, -0.5 * k_reach, 3.17 * k_reach);  // closed, pulled, void
  run.step(lifted(mesh_, 0), liquid());
  run.pair.begin(run.state, {.time = 2, .dt = 1, .displacement = u, .solidity = {liquid()}});
  linear::NodeGraph graph(mesh_);
  linear::Contribution& term = run.pair.parts().forces.term();
  term.add_to_graph(graph);
  linear::BlockMatrix matrix(mesh_, mesh_.dimension, std::move(graph));
  term.bind(matrix);
  term.add_tangent(u, matrix);
  const double h = 1e-3 * k_reach;
  std::vector<double> d(u.size()), up = u, down = u;
  const auto dim = static_cast<std::size_t>(mesh_.dimension);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const auto& x = mesh_.x[i / dim];
    d[i] = std::sin(31 * x[0] + 17 * x[1] + 13 * x[2] + static_cast<double>(i % dim));
    up[i] += h * d[i];
    down[i] -= h * d[i];
  }
  const auto n = static_cast<std::size_t>(mesh_.n_owned_nodes) * dim;
  std::vector<double> r_up(n, 0.0), r_down(n, 0.0), product(n, 0.0);
  term.add_residual(up, r_up);
  term.add_residual(down, r_down);
  matrix.multiply(d, product);
  double defect = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    defect = std::max(defect, std::abs((r_up[i] - r_down[i]) / (2 * h) - product[i]));
    size = std::max(size, std::abs(product[i]));
  }
  EXPECT_LT(parallel::global_max(defect), 1e-5 * parallel::global_max(size));
}

TEST_P(Wet, ConductsAsClosedContactWhateverGapOpens) {
  ContactParameters s = spec(GetParam().formulation);
  s.heat = HeatTransferSpec{};
  s.heat->contact_law = contact_law(PowerContact{2000});
  s.heat->gap_law = gap_law(GasGap{.conductivity = 0.03});
  OneStep run(mesh_, s);
  const auto temperature =
      test::nodal_field(mesh_, 1, [](const Point&, bool up) { return std::vector{up ? 400.0 : 900.0}; });
  const double closed = 2000 * 500 * area(mesh_);
  run.step(lifted(mesh_, 1e-4), liquid());
  EXPECT_NEAR(contact::sums(run.pair.view(), temperature).heat, closed, 1e-9 * closed);
  const std::vector<double> gap = lifted(mesh_, 1e-4);
  run.pair.restore(run.state, gap, 1);  // as a run that goes on from a checkpoint
  EXPECT_NEAR(contact::sums(run.pair.view(), temperature).heat, closed, 1e-9 * closed);
  run.step(gap, liquid(1.1));
  EXPECT_NEAR(contact::sums(run.pair.view(), temperature).heat, closed * 0.03 / (0.03 + 1e-4 * 2000),
              1e-6 * closed);
}

TEST_P(Wet, IsSwitchedOffWithTheAtmosphere) {
  ContactParameters s = spec(GetParam().formulation);
  s.atmosphere = 0;
  OneStep run(mesh_, s);
  EXPECT_EQ(run.step(lifted(mesh_, 0.4 * k_reach), liquid()).force, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Wet,
                         ::testing::Values(Melt{Shape::quad4, Formulation::small_sliding, true},
                                           Melt{Shape::tri3, Formulation::small_sliding, false},
                                           Melt{Shape::quad4, Formulation::large_sliding, true},
                                           Melt{Shape::quad8, Formulation::large_sliding, false},
                                           Melt{Shape::tet4, Formulation::small_sliding, true},
                                           Melt{Shape::hex8, Formulation::large_sliding, false}),
                         [](const auto& of) {
                           return std::string(mesh::name(of.param.shape)) +
                                  (of.param.formulation == Formulation::large_sliding ? "Sliding" : "Fixed") +
                                  (of.param.slave ? "Slave" : "Master");
                         });

TEST(WetContact, AGapThatWasThereHoldsAirUntilItCloses) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-3);
  ContactParameters s = spec();
  s.search_distance = 0.05;
  OneStep run(mesh, s);
  const std::vector<double> melt = coherency(mesh, 0.2, 1);
  EXPECT_EQ(run.step(lifted(mesh, 0), melt).wet_area, 0);
  EXPECT_EQ(run.step(lifted(mesh, -1e-3 - 1e-6), melt).wet_area, 0);  // it touches in this step
  EXPECT_NEAR(run.step(lifted(mesh, -1e-3 + 0.1 * k_reach), melt).wet_area, 0.3, 1e-12);
}

TEST(WetContact, WhatLeavesTheWallWhileLiquidIsCounted) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.leaving_gap = 1e-4;
  OneStep run(mesh, s);
  const std::vector<double> melt = coherency(mesh, 0.2, 1);
  EXPECT_EQ(run.step(lifted(mesh, 0.9e-4), melt).left_area, 0);
  const ContactSums left = run.step(lifted(mesh, 0, 2e-4), melt);  // half of the width is beyond
  EXPECT_NEAR(left.left_area, 0.15, 0.04);
  EXPECT_GT(left.left_gap, 1.8e-4);
  EXPECT_LT(left.left_gap, 2e-4);
  EXPECT_EQ(run.step(lifted(mesh, 0, 2e-4), coherency(mesh, 1.1, 1)).left_area, 0);
}

// The kinematics of small sliding keep the normals of the faces that points began on: along a wall that bends
// away they say that melt which slides has left it.
TEST(WetContact, MeltThatSlidesAlongACurvedWallHasNotLeftIt) {
  constexpr double k_bend = -0.2, k_width = 0.3, k_way = 0.08;  // y = bend x² [1/m], [m], [m]
  mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  for (Point& x : mesh.x) x[1] += k_bend * x[0] * x[0];
  ContactParameters s = spec();
  s.touching = 5e-3;  // faces of the two sides are chords of different lengths
  s.leaving_gap = 1.2e-3;
  OneStep run(mesh, s);
  const std::vector<double> melt = coherency(mesh, 0.2, 1);
  run.step(lifted(mesh, 0), melt);
  const std::vector<double> u = test::nodal_field(mesh, 2, [&](const Point& x, bool up) {
    const double way = up ? 0.0 : k_way * std::sin(3.14159265358979 * x[0] / k_width);
    return std::vector{way, k_bend * (2 * x[0] + way) * way};
  });
  const ContactSums sums = run.step(u, melt);
  EXPECT_GT(sums.wet_area, 0.25);
  EXPECT_EQ(sums.left_area, 0);
  const auto& points = run.pair.state().points;
  EXPECT_TRUE(parallel::any_process(std::ranges::any_of(
      points, [&](const ContactPointState& p) { return -p.penetration > s.leaving_gap; })));
}

// A bed of springs that reaches 0.2 mm at the pressure of the atmosphere: up to there melt draws it along.
TEST(WetContact, AWallThatGivesWayIsDrawnAndNotLeft) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.penalty = k_atmosphere / 2e-4;
  s.leaving_gap = 1e-4;
  OneStep run(mesh, s);
  const std::vector<double> melt = coherency(mesh, 0.2, 1);
  EXPECT_EQ(run.step(lifted(mesh, 1.5e-4), melt).left_area, 0);
  const ContactSums left = run.step(lifted(mesh, 2.5e-4), melt);
  EXPECT_NEAR(left.left_area, 0.3, 1e-12);
  EXPECT_NEAR(left.left_gap, 2.5e-4, 1e-12);
}

TEST(WetContact, WhatAShellTakesAlongHasNotLeftTheWall) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.leaving_gap = 1e-4;
  OneStep run(mesh, s);
  // Every second column of nodes of the lower body is coherent, so every face has a coherent node.
  const double width = 0.3;
  std::vector<double> x;
  test::nodal_field(mesh, 1, [&](const Point& p, bool up) {
    if (!up) x.push_back(p[0]);
    return std::vector{0.0};
  });
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end(), [&](double a, double b) { return b - a < 1e-6 * width; }), x.end());
  const auto column = [&](double at) {
    return std::min_element(x.begin(), x.end(),
                            [&](double a, double b) { return std::abs(a - at) < std::abs(b - at); }) -
           x.begin();
  };
  const std::vector<double> melt = test::nodal_field(
      mesh, 1, [&](const Point& p, bool up) { return std::vector{up || column(p[0]) % 2 == 0 ? 1.0 : 0.2}; });
  run.step(lifted(mesh, 0), melt);
  const ContactSums moved = run.step(lifted(mesh, 2e-4), melt);
  EXPECT_GT(moved.wet_area, 0.2);
  EXPECT_EQ(moved.left_area, 0);
}

TEST(WetContact, TensionMakesNoFriction) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.friction = FrictionParameters{};
  s.friction->coefficient.terms = {Table(0.3)};
  OneStep run(mesh, s);
  const std::vector<double> melt = coherency(mesh, 0.2, 1);
  std::vector<double> u = lifted(mesh, 0.5 * k_reach);
  run.step(lifted(mesh, 0), melt);
  for (std::size_t i = 0; i < u.size(); i += 2) u[i] = u[i + 1] > 0 ? 1e-3 : 0.0;  // the upper body slides
  const ContactSums sums = run.step(u, melt);
  EXPECT_LT(sums.force, 0);
  EXPECT_EQ(sums.friction, 0);
  EXPECT_EQ(sums.dissipation, 0);
}

// Melt has no strength to rub with, whatever presses it on its wall, held there or not; the skin that it
// becomes has.
class RubbingMelt : public ::testing::TestWithParam<double> {};

TEST_P(RubbingMelt, RubsOnlyOnceItIsCoherent) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.atmosphere = GetParam();
  s.friction = FrictionParameters{};
  s.friction->coefficient.terms = {Table(0.3)};
  OneStep run(mesh, s);
  const std::vector<double> melt = coherency(mesh, 0.2, 1), skin = coherency(mesh, 1.2, 1);
  const auto pressed = [&](double slip) {
    std::vector<double> u = lifted(mesh, -0.5 * k_reach);
    for (std::size_t i = 0; i < u.size(); i += 2) u[i] = u[i + 1] < 0 ? slip : 0.0;  // the upper body slides
    return u;
  };
  run.step(pressed(0), melt);
  ContactSums sums = run.step(pressed(1e-3), melt);
  EXPECT_GT(sums.force, 0);
  EXPECT_EQ(sums.friction, 0);
  EXPECT_EQ(sums.dissipation, 0);
  sums = run.step(pressed(2e-3), skin);
  EXPECT_NEAR(std::abs(sums.friction), 0.3 * sums.force, 1e-9 * sums.force);
  EXPECT_GT(sums.dissipation, 0);
}

INSTANTIATE_TEST_SUITE_P(Wet, RubbingMelt, ::testing::Values(k_atmosphere));
INSTANTIATE_TEST_SUITE_P(Dry, RubbingMelt, ::testing::Values(0.0));

// As a melt that moves runs against its wall: it does not rub in the step in which it gets there either.
TEST(WetContact, MeltThatComesToItsWallDoesNotRub) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-3);
  ContactParameters s = spec();
  s.search_distance = 0.05;
  s.friction = FrictionParameters{};
  s.friction->coefficient.terms = {Table(0.3)};
  for (const double atmosphere : {k_atmosphere, 0.0}) {
    s.atmosphere = atmosphere;
    OneStep run(mesh, s);
    std::vector<double> u = lifted(mesh, -1e-3 - 1e-6);
    for (std::size_t i = 0; i < u.size(); i += 2) u[i] = u[i + 1] < 0 ? 1e-3 : 0.0;
    const ContactSums sums = run.step(u, coherency(mesh, 0.2, 1));
    EXPECT_GT(sums.force, 0);
    EXPECT_EQ(sums.friction, 0);
  }
}

// A flat punch of the augmented Lagrangian: pulled with half of the atmosphere it keeps its wall exactly, and
// the multipliers go where the metal is coherent.
TEST(WetContact, MultipliersHoldTensionDownToTheAtmosphere) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.normal = NormalKind::augmented_lagrangian;
  OneStep run(mesh, s);
  const std::vector<double> melt = coherency(mesh, 0.2, 1), u = lifted(mesh, 0.3 * k_reach);
  run.pair.begin(run.state, {.time = 1, .dt = 1, .displacement = u, .solidity = {melt}});
  for (int turn = 1; turn <= 5; ++turn) {
    run.pair.update(u);
    const double expected = -std::min(0.3 * turn, 1.0) * k_atmosphere * 0.3;
    EXPECT_NEAR(contact::sums(run.pair.view(), {}).force, expected, 1e-9 * k_atmosphere) << turn;
    run.pair.parts().augmentations.augment();
  }
  run.state = run.pair.state();
  const ContactSums dry = run.step(u, coherency(mesh, 1.1, 1));
  EXPECT_EQ(dry.force, 0);
  EXPECT_EQ(dry.closed_points, 0);
}

TEST(WetNormalLaw, IsMonotoneAndTheDerivativeOfItsEnergy) {
  for (const NormalKind kind : {NormalKind::penalty, NormalKind::augmented_lagrangian}) {
    const NormalLaw law{kind, 1e9};
    const NormalHistory wet{true, 0, 0, 0, 1e5};
    double before = -1e300;
    for (double g = -3e-4; g < 2e-4; g += 0.7e-5) {
      const NormalLaw::Response r = law.update(g, wet, 1);
      EXPECT_GE(r.pressure, before);
      EXPECT_GE(r.pressure, -1e5);
      before = r.pressure;
      const double h = 1e-9;
      EXPECT_NEAR((law.energy(g + h, 1e5) - law.energy(g - h, 1e5)) / (2 * h), r.pressure, 1.0);
      EXPECT_EQ(r.closed, r.pressure > -1e5);
    }
  }
}

TEST(WetNormalLaw, QuotientDoesExactlyTheWorkThatTheEnergyGains) {
  const NormalLaw law{NormalKind::energy_conserving, 3e9};
  constexpr double k_suction = 6e3;  // reach 2e-6
  for (const double g0 : {-5e-6, -2.5e-6, -1e-6, 0.0, 4e-6})
    for (const double g1 : {-7e-6, -3e-6, -1.5e-6, 0.5e-6, 5e-6})
      for (const double share : {0.5, 1.0}) {
        const NormalHistory old{true, g0, 0, 0, k_suction};
        const NormalLaw::Response r = law.update(g1, old, share);
        EXPECT_NEAR(r.pressure * (g1 - g0), law.energy(g1, k_suction) - law.energy(g0, k_suction), 1e-15);
        EXPECT_DOUBLE_EQ(share * r.balance_pressure, r.pressure);
        const double h = 1e-10;
        const double slope =
            (law.update(g1 + h, old, share).pressure - law.update(g1 - h, old, share).pressure) / (2 * h);
        EXPECT_NEAR(r.tangent, slope, 1e-5 * law.penalty);
      }
}

}  // namespace
}  // namespace solidus::contact
