#include "mechanics/solver/balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/making/parametric_meshes.hpp"
#include "parallel/parallel.hpp"

namespace {

using namespace solidus;

mesh::Mesh two_bodies() {
  return mesh::distribute(mesh::make_two_blocks({{1, 1}, {1, 1}, {3, 3}, {2, 2}, 0.1}, mesh::Shape::quad4),
                          {"lower", "upper"}, {});
}

// Owned entries of the nodes above (or below) the gap.
std::vector<double> vertical_force(const mesh::Mesh& mesh, bool upper, double value) {
  std::vector<double> f(static_cast<std::size_t>(2 * mesh.n_owned_nodes), 0.0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.n_owned_nodes); ++i)
    if ((mesh.x[i][1] > 1.05) == upper) f[2 * i + 1] = value;
  return f;
}

double norm(const std::vector<double>& a) {
  double s = 0;
  for (const double v : a) s += v * v;
  return std::sqrt(parallel::global_sum(s));
}

TEST(BodyBalance, ALightBodyIsNotMeasuredAgainstAHeavilyLoadedOne) {
  const mesh::Mesh mesh = two_bodies();
  mechanics::BodyBalance balance(mesh, linear::ActiveSet(mesh), 2);
  const std::vector<double> heavy = vertical_force(mesh, false, 1e6),
                            weight = vertical_force(mesh, true, 1.0);
  std::vector<double> floating = vertical_force(mesh, true, -1.0);  // nothing carries the weight
  const std::vector<char> none(floating.size(), 0);
  balance.begin();
  balance.add_exchanged(heavy);
  balance.add_exchanged(weight);
  balance.add_residual(floating, none, none);
  EXPECT_NEAR(norm(floating) / balance.reference(), 1.0, 1e-12);
}

TEST(BodyBalance, SupportForcesAreExchangedAndTheAxisIsNot) {
  const mesh::Mesh mesh = two_bodies();
  mechanics::BodyBalance balance(mesh, linear::ActiveSet(mesh), 2);
  const std::vector<double> r = vertical_force(mesh, true, 2.0);
  const std::vector<char> all(r.size(), 1), none(r.size(), 0);
  balance.begin();
  balance.add_residual(r, all, all);
  EXPECT_NEAR(balance.reference(), norm(r), 1e-12 * norm(r));
  balance.begin();
  balance.add_residual(r, all, none);
  EXPECT_EQ(balance.reference(), 0.0);
}

TEST(BodyBalance, AStepIsMeasuredByTheIncrementOfItsOwnBody) {
  const mesh::Mesh mesh = two_bodies();
  const mechanics::BodyBalance balance(mesh, linear::ActiveSet(mesh), 2);
  std::vector<double> increment = vertical_force(mesh, false, 1e-3);
  const std::vector<double> upper = vertical_force(mesh, true, 1e-6), step = vertical_force(mesh, true, 1e-7);
  for (std::size_t i = 0; i < increment.size(); ++i) increment[i] += upper[i];
  EXPECT_NEAR(balance.relative_step(step, increment), 0.1, 1e-12);
  EXPECT_EQ(balance.relative_step(std::vector<double>(step.size(), 0.0), increment), 0.0);
  // A body at rest is measured by 1e-8 of its extent, which is √2 here.
  const std::vector<double> nothing(step.size(), 0.0);
  EXPECT_NEAR(balance.relative_step(step, nothing), 1e-7 / (1e-8 * std::sqrt(2.0)), 1e-9);
}

TEST(BodyBalance, WithoutExchangeASmallShareOfTheInternalForcesIsTheReference) {
  const mesh::Mesh mesh = two_bodies();
  mechanics::BodyBalance balance(mesh, linear::ActiveSet(mesh), 2);
  const std::vector<double> r = vertical_force(mesh, true, 1e-3);
  const std::vector<char> none(r.size(), 0);
  balance.begin();
  balance.add_internal(1, 1e6 / parallel::global_sum(1));  // squares: forces of 1e3 N in all
  balance.add_residual(r, none, none);
  EXPECT_NEAR(norm(r) / balance.reference(), norm(r) / 1e-3, 1e-9);
}

// Newton's iteration asks again where the residual is known already.
TEST(BodyBalance, TheReferenceIsTheSameWhenAskedTwice) {
  const mesh::Mesh mesh = two_bodies();
  mechanics::BodyBalance balance(mesh, linear::ActiveSet(mesh), 2);
  const std::vector<double> load = vertical_force(mesh, true, 3.0), r = vertical_force(mesh, true, 1e-3);
  const std::vector<char> none(r.size(), 0);
  balance.begin();
  balance.add_exchanged(load);
  balance.add_residual(r, none, none);
  const double once = balance.reference();
  EXPECT_NEAR(once, norm(load), 1e-12 * norm(load));
  EXPECT_EQ(balance.reference(), once);
}

}  // namespace
