/// The norm by which displacements and temperatures of bodies are measured, and the errors of displacement
/// that bound a step: rigid motions and melt have no say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "../mechanics/lattice.hpp"
#include "coupling/coherency.hpp"
#include "coupling/error_estimate.hpp"
#include "coupling/phases.hpp"

namespace solidus {
namespace {

using coupling::State;

TEST(BodyNorm, OfAUniformFieldIsItsSizeWhateverTheMesh) {
  for (const auto kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric})
    for (const auto shape : {mesh::Shape::quad4, mesh::Shape::tri6}) {
      const mesh::Mesh mesh =
          test::make_mesh({.shape = shape, .cells = {4, 3, 1}, .size = {2, 1, 1}, .distortion = 0.1});
      const coupling::BodyNorm norm(mesh, kind);
      EXPECT_NEAR(norm(std::vector<double>(mesh.x.size(), 3.0)), 3.0, 1e-14);
      EXPECT_NEAR(norm(std::vector<double>(mesh.x.size() * 2, 3.0)), 3.0 * std::sqrt(2.0), 1e-14);
      EXPECT_EQ(norm({}), 0.0);
    }
}

TEST(BodyNorm, IsTheRootMeanSquareOverTheVolume) {
  // x on (0, 2): mean square 4/3, which the nodal rule misses by h²/6 at h = 2/64.
  const mesh::Mesh mesh =
      test::make_mesh({.shape = mesh::Shape::quad4, .cells = {64, 2, 1}, .size = {2, 1, 1}});
  std::vector<double> x;
  for (const mesh::Point& p : mesh.x) x.push_back(p[0]);
  const coupling::BodyNorm norm(mesh, AnalysisKind::plane_strain);
  EXPECT_NEAR(norm(x), std::sqrt(4.0 / 3), 1e-4);
}

TEST(BodyNorm, OfADistortionTakesRigidMotionsAway) {
  using Field = std::function<mesh::Point(const mesh::Point&)>;
  const auto field = [](const mesh::Mesh& mesh, AnalysisKind kind, const Field& f) {
    std::vector<double> u;
    for (const mesh::Point& x : mesh.x)
      for (int i = 0; i < displacement_components(kind); ++i) u.push_back(f(x)[static_cast<std::size_t>(i)]);
    return u;
  };
  const mesh::Mesh flat = test::make_mesh(
      {.shape = mesh::Shape::quad4, .cells = {6, 3, 1}, .size = {2, 1, 1}, .distortion = 0.1});
  const mesh::Mesh block = test::make_mesh(
      {.shape = mesh::Shape::tet4, .cells = {16, 3, 2}, .size = {2, 1, 1}, .distortion = 0.1});
  const Field rigid = [](const mesh::Point& x) -> mesh::Point {
    return {3 - 2 * x[1] + 5 * x[2], -1 + 2 * x[0] - 4 * x[2], 7 - 5 * x[0] + 4 * x[1]};
  };
  const Field flat_rigid = [](const mesh::Point& x) -> mesh::Point {
    return {3 - 2 * x[1], -1 + 2 * x[0], 0};
  };
  const Field bend = [](const mesh::Point& x) -> mesh::Point { return {0, x[0] * x[0], 0}; };
  const coupling::BodyNorm in_plane(flat, AnalysisKind::plane_strain), in_space(block, AnalysisKind::solid),
      round(flat, AnalysisKind::axisymmetric);
  EXPECT_LT(in_plane.of_distortion(field(flat, AnalysisKind::plane_strain, flat_rigid), {}), 1e-6);
  EXPECT_LT(in_space.of_distortion(field(block, AnalysisKind::solid, rigid), {}), 1e-6);
  // The distortion does not depend on the rigid motion that comes with it, and none makes it smaller.
  const auto bent = [&](const mesh::Point& x) -> mesh::Point {
    const mesh::Point a = rigid(x), b = bend(x);
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  };
  const double alone = in_space.of_distortion(field(block, AnalysisKind::solid, bend), {});
  EXPECT_NEAR(in_space.of_distortion(field(block, AnalysisKind::solid, bent), {}), alone, 1e-6);
  // By the nodal rule, which is of second order: u_y = x² on (0, 2) × (0, 1) has the variance 64/45, of which
  // a rotation about z explains (2/3)² / (1/3 + 1/12).
  EXPECT_NEAR(alone, std::sqrt(64.0 / 45 - 16.0 / 15), 0.05);
  EXPECT_LT(alone, in_space(field(block, AnalysisKind::solid, bend)));
  // A ring moves along its axis; that it widens is distortion.
  const Field axial = [](const mesh::Point&) -> mesh::Point { return {0, 2, 0}; };
  const Field wider = [](const mesh::Point&) -> mesh::Point { return {2, 0, 0}; };
  EXPECT_LT(round.of_distortion(field(flat, AnalysisKind::axisymmetric, axial), {}), 1e-6);
  EXPECT_NEAR(round.of_distortion(field(flat, AnalysisKind::axisymmetric, wider), {}), 2, 1e-12);
  // Fitted to the nodes that count: one half rests, the other one moves as a rigid body.
  std::vector<double> half = field(flat, AnalysisKind::plane_strain, flat_rigid);
  std::vector<char> counts(flat.x.size(), 1);
  for (std::size_t i = 0; i < flat.x.size(); ++i)
    if (flat.x[i][0] > 1) counts[i] = 0, half[2 * i] = half[2 * i + 1] = 99;
  EXPECT_LT(in_plane.of_distortion(half, counts), 1e-6);
  // The first node that freezes moves and does not distort: what its inertia leaves is rounding.
  const std::vector<double> plane = field(flat, AnalysisKind::plane_strain, flat_rigid),
                            space = field(block, AnalysisKind::solid, bent);
  const auto alone_counts = [](const mesh::Mesh& mesh, GlobalIndex node) {
    std::vector<char> one;
    for (const GlobalIndex of_all : mesh.global_node) one.push_back(of_all == node ? 1 : 0);
    return one;
  };
  for (GlobalIndex i = 0; i < flat.n_global_nodes; ++i)
    EXPECT_LT(in_plane.of_distortion(plane, alone_counts(flat, i)), 1e-6) << i;
  for (GlobalIndex i = 0; i < block.n_global_nodes; ++i)
    EXPECT_LT(in_space.of_distortion(space, alone_counts(block, i)), 1e-6) << i;
}

TEST(BodyNorm, TheFarthestDistortionIsThatOfOneNode) {
  // A bar moves as a rigid body, but for one node.
  const mesh::Mesh block = test::make_mesh(
      {.shape = mesh::Shape::tet4, .cells = {16, 3, 2}, .size = {2, 1, 1}, .distortion = 0.1});
  const coupling::BodyNorm norm(block, AnalysisKind::solid);
  std::vector<double> u;
  std::vector<char> counts;
  for (std::size_t i = 0; i < block.x.size(); ++i) {
    const mesh::Point& x = block.x[i];
    const double more = block.global_node[i] == 7 ? 0.01 : 0;
    u.insert(u.end(), {3 - 2 * x[1] + 5 * x[2] + more, -1 + 2 * x[0] - 4 * x[2], 7 - 5 * x[0] + 4 * x[1]});
    counts.push_back(more > 0 ? 0 : 1);
  }
  EXPECT_NEAR(norm.farthest_distortion(u, {}), 0.01, 5e-4);
  EXPECT_LT(norm.of_distortion(u, {}), 2e-3);
  EXPECT_LT(norm.farthest_distortion(u, counts), 1e-12);
}

TEST(SkinOpening, IsTheWidestGapOfAPointThatLetsGoOfItsWallInTheStep) {
  const mesh::Mesh mesh = test::make_mesh({.shape = mesh::Shape::quad4, .cells = {1, 1, 1}});
  const coupling::ErrorEstimate estimate(coupling::BodyNorm(mesh, AnalysisKind::plane_strain));
  // Points whose gaps open by 7, 30 and 50 µm: wet before and dry behind the step, dry, and wet throughout.
  const auto point = [](double gap, double suction) {
    contact::ContactPointState p;
    p.penetration = -gap;
    p.suction = suction;
    return p;
  };
  State old, now;
  old.contacts = {{{point(1e-6, 1e5), point(0, 0), point(0, 1e5)}, {}}};
  now.contacts = {{{point(8e-6, 0), point(30e-6, 0), point(50e-6, 1e5)}, {}}};
  EXPECT_NEAR(estimate.skin_opening(old, now), 7e-6, 1e-18);
  EXPECT_EQ(estimate.skin_opening(now, now), 0);
  EXPECT_EQ(estimate.skin_opening(State{}, now), 0);  // bodies that have not moved yet
}

/// A body on (0, 2) × (0, 1) without a thermal phase that is melt where x > 1.
struct HalfMolten {
  mesh::Mesh mesh = test::make_mesh({.shape = mesh::Shape::quad4, .cells = {8, 2, 1}, .size = {2, 1, 1}});
  std::vector<material::Material> materials = {freezes()};
  coupling::Coherency coherency{mesh, materials, linear::ActiveSet(mesh, {})};
  coupling::Phases phases;

  static material::Material freezes() {
    material::Material m;
    m.young_modulus = Table(70e9);
    m.poisson_ratio = Table(0.3);
    m.phase_changes = {{"solidification", material::PhaseFraction::linear(880, 930), 4e5, 0, true}};
    return m;
  }
  HalfMolten() {
    for (const mesh::Point& x : mesh.x) phases.temperature.push_back(x[0] > 1.01 ? 950 : 800);
    phases.coherency = &coherency;
  }
  coupling::ErrorEstimate estimate() const {
    return coupling::ErrorEstimate(coupling::BodyNorm(mesh, AnalysisKind::plane_strain), &phases);
  }
  /// Moved up, the melt and the casting.
  State moved(double melt, double casting) const {
    State state;
    for (const mesh::Point& x : mesh.x) {
      state.mechanics.displacement.push_back(0);
      state.mechanics.displacement.push_back(x[0] > 1.01 ? melt : casting);
    }
    return state;
  }
};

TEST(DisplacementError, MeltThatFlowsCostsNoStep) {
  const HalfMolten body;
  const coupling::ErrorEstimate estimate = body.estimate();
  const State rest = body.moved(0, 0);
  coupling::Rates rates = estimate.rates_of(rest, rest, 1, {});
  EXPECT_EQ(estimate.displacement_predictor(rest, body.moved(5, 0), 1, rates), 0);
  EXPECT_EQ(estimate.doubling(rest, rest, body.moved(5, 0), {}, 1, {}).displacement, 0);
  // Nodes that have no melt next to them count with their share of the body's volume: four of nine columns.
  const double half = std::sqrt(0.5 - 1.0 / 16);
  EXPECT_NEAR(estimate.doubling(rest, rest, body.moved(5, 3), {}, 1, {}).displacement, 3 * half, 1e-12);
  EXPECT_NEAR(estimate.displacement_predictor(rest, body.moved(5, 3), 1, rates), 1.5 * half, 1e-12);
}

TEST(DisplacementError, ARateOfMeltPredictsNothingOfWhatFroze) {
  HalfMolten body;
  const coupling::ErrorEstimate estimate = body.estimate();
  const coupling::Rates rates = estimate.rates_of(body.moved(0, 0), body.moved(7, 0), 1, {});
  body.phases.temperature.assign(body.mesh.x.size(), 800);  // all is casting now
  EXPECT_EQ(estimate.displacement_predictor(body.moved(7, 0), body.moved(7, 0), 1, rates), 0);
  const coupling::Rates next = estimate.rates_of(body.moved(7, 0), body.moved(7, 0), 1, {});
  EXPECT_GT(estimate.displacement_predictor(body.moved(7, 0), body.moved(8, 0), 1, next), 0.3);
}

}  // namespace
}  // namespace solidus
