/// Bodies that take no part in mechanics: those that only conduct heat, and those that leave.
#include <gtest/gtest.h>

#include <array>

#include "../mesh/split_block.hpp"
#include "body.hpp"
#include "mechanics/new_bodies.hpp"
#include "system/processes.hpp"

namespace solidus {
namespace {

constexpr double k_plane = 0.02, k_length = 0.05, k_height = 0.01;  ///< [m]
constexpr double k_young = 2e11, k_soft = 5e10;                     ///< left, right [Pa]

/// Two bars in a row that share nodes, without lateral contraction; the right one is the mould.
test::Body bars(mesh::Shape shape, const std::vector<std::string>& bodies = {"left", "right"}) {
  mesh::RawMesh raw;
  const int rank = processes::rank();
  const bool solid = mesh::dimension(shape) == 3;
  if (rank == 0)
    raw = solid ? test::split_block(shape, {k_length, k_height, k_height}, {5, 2, 2}, k_plane)
                : test::split_block(shape, {k_length, k_height}, {10, 2}, k_plane);
  test::Body body(mesh::distribute(raw, bodies, {}), solid ? AnalysisKind::solid : AnalysisKind::plane_strain,
                  test::elastic_material(k_young, 0.0));
  if (bodies.size() > 1) body.materials.push_back(test::elastic_material(k_soft, 0.0));
  body.hold("y_min", 1);
  if (solid) body.hold("z_min", 2);
  return body;
}

double at_plane(const test::Body& body, const test::Solved& solved) {
  double u = -1e300;
  for (Index i = 0; i < body.mesh.n_owned_nodes; ++i)
    if (std::abs(body.mesh.x[static_cast<std::size_t>(i)][0] - k_plane) < 1e-9)
      u = std::max(u, solved.u(body, i, 0));
  return parallel::global_max(u);
}

double largest_stress(const test::Solved& solved) {
  double s = 0;
  for (const test::ElementFields& fields : test::element_fields(solved))
    for (const auto& stress : fields.stress) s = std::max(s, std::abs(stress[0]));
  return parallel::global_max(s);
}

class Springback : public ::testing::TestWithParam<mesh::Shape> {};

// Pushed by δ against the mould, which is held at its end, the plane goes by δ (L2/E2)/(L1/E1 + L2/E2) under
// σ = −δ/(L1/E1 + L2/E2). Without the mould the part is free: all of it at δ, without stress, in one step.
TEST_P(Springback, OfAPartThatAMouldHeldIsThatOfBarsInARow) {
  test::Body body = bars(GetParam());
  constexpr double push = 1e-5;
  body.hold("x_min", 0, push);
  body.hold("x_max", 0);
  test::Solved solved(body);
  const double part = k_plane / k_young, mould = (k_length - k_plane) / k_soft;
  EXPECT_NEAR(at_plane(body, solved), push * mould / (part + mould), 1e-9 * push);
  EXPECT_NEAR(largest_stress(solved), push / (part + mould), 1e-9 * push / (part + mould));

  mechanics::MechanicalConditions later = body.conditions;
  later.absent_bodies = {"right"};
  const std::vector<double> before = solved.state.displacement;
  const double seconds = solved.phase->system().seconds();
  solved.phase->set_conditions(later, before);
  EXPECT_GE(solved.phase->system().seconds(), seconds) << "the new solver's clock goes on from the old one's";
  solved.step(body, 2.0, 1.0);
  EXPECT_NEAR(at_plane(body, solved), push, 1e-9 * push);
  EXPECT_LT(largest_stress(solved), 1e-9 * push / (part + mould));
  EXPECT_NEAR(solved.report.work.internal_work, 0, 1e-9 * push * push / (part + mould));
  const auto n = static_cast<std::size_t>(solved.phase->bodies().components);
  for (std::size_t i = 0; i < body.mesh.x.size(); ++i) {  // the mould stays where it was
    if (body.mesh.x[i][0] <= k_plane + 1e-9) continue;
    for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(solved.state.displacement[i * n + k], before[i * n + k]);
  }
}

// Fields of elements belong to a state: neither a step that is tried and thrown away nor a body that leaves
// changes those of the state before it.
TEST_P(Springback, FieldsOfAStateStayWhateverIsSolvedAfterIt) {
  test::Body body = bars(GetParam());
  body.hold("x_min", 0, Table({1, 2, 3}, {1e-5, 2e-5, 3e-5}));
  body.hold("x_max", 0);
  test::Solved solved(body);
  const auto fields = [&](const mechanics::MechanicalState& state) {
    return std::array{mechanics::element_field(body.mesh, state, mechanics::ElementField::stress),
                      mechanics::element_field(body.mesh, state, mechanics::ElementField::von_mises)};
  };
  const mechanics::MechanicalState first = solved.state;
  const auto committed = fields(first);
  for (const double time : {2.0, 3.0}) {
    solved.step(body, time, 1.0);
    EXPECT_EQ(fields(first), committed) << time;
  }
  EXPECT_NEAR(largest_stress(solved), 3e-5 / (k_plane / k_young + (k_length - k_plane) / k_soft), 1e2);
  const mechanics::MechanicalState third = solved.state;
  const auto next = fields(third);
  EXPECT_TRUE(parallel::any_process(next != committed));

  mechanics::MechanicalConditions later = body.conditions;
  later.absent_bodies = {"right"};
  solved.phase->set_conditions(later, solved.state.displacement);
  EXPECT_EQ(fields(third), next);
  solved.step(body, 4.0, 1.0);
  EXPECT_EQ(fields(third), next);
  EXPECT_LT(largest_stress(solved), 1e2);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Springback,
                         ::testing::Values(mesh::Shape::quad4, mesh::Shape::tri6, mesh::Shape::hex8,
                                           mesh::Shape::tet10));

TEST(AbsentBodies, LeaveTheOthersAsIfTheyWereAlone) {
  for (const mechanics::Mapping mapping : {mechanics::Mapping::isothermal, mechanics::Mapping::isentropic}) {
    test::Body both = bars(mesh::Shape::quad4), alone = bars(mesh::Shape::quad4, {"left"});
    both.materials[1] = {};  // what only conducts needs no elasticity
    both.conditions.absent_bodies = {"right"};
    for (test::Body* body : {&both, &alone}) {
      body->options.mapping = mapping;
      body->hold("x_min", 0);
      body->conditions.gravity = {3, -5, 0};
      body->conditions.tractions.push_back({"between", {2e6, 1e6, 0.0}});
    }
    const test::Solved here(both), there(alone);
    EXPECT_NEAR(at_plane(both, here), at_plane(alone, there), 1e-10 * std::abs(at_plane(alone, there)));
    EXPECT_NEAR(here.report.work.external_work, there.report.work.external_work,
                1e-9 * there.report.work.external_work);
    test::Body all = bars(mesh::Shape::quad4);
    all.options.mapping = mapping;
    all.hold("x_min", 0);
    all.conditions.gravity = {3, -5, 0};
    const test::Solved everywhere(all);
    const auto bytes = [](const mechanics::MechanicalPhase& phase) {
      return parallel::global_sum(static_cast<double>(phase.bytes()));
    };
    // Half of the elements keep nothing; the rows of their nodes stay in the matrix.
    EXPECT_LT(bytes(*here.phase), 0.9 * bytes(*everywhere.phase));
  }
}

// The face between the two belongs to the first body of the list: when that one leaves, the load presses on
// the other.
TEST(AbsentBodies, APressureActsOnTheBodyThatIsLeft) {
  test::Body body = bars(mesh::Shape::quad4);
  body.hold("x_max", 0);
  body.conditions.absent_bodies = {"left"};
  body.conditions.pressures.push_back({"between", 1e6});
  const test::Solved solved(body);
  EXPECT_NEAR(at_plane(body, solved), 1e6 / k_soft * (k_length - k_plane), 1e-14);
}

// A mould that has left comes back new: without displacement and stress, and with its stiffness.
TEST(AbsentBodies, ComeBackNew) {
  const double part = k_plane / k_young, mould = (k_length - k_plane) / k_soft;
  constexpr double push = 1e-5;
  test::Body body = bars(mesh::Shape::quad4);
  body.hold("x_min", 0, push);
  body.hold("x_max", 0);
  test::Solved solved(body);
  mechanics::MechanicalConditions later = body.conditions;
  later.absent_bodies = {"right"};
  solved.phase->set_conditions(later, solved.state.displacement);
  solved.step(body, 2.0, 1.0);
  EXPECT_LT(largest_stress(solved), 1e-9 * push / (part + mould));

  mechanics::renew_nodes(body.mesh, {0, 1}, solved.state);
  for (std::size_t i = 0; i < body.mesh.x.size(); ++i) {
    const double u =
        solved.state.displacement[i * static_cast<std::size_t>(solved.phase->bodies().components)];
    if (body.mesh.x[i][0] >= k_plane - 1e-9) {
      EXPECT_EQ(u, 0);
    } else if (body.mesh.x[i][0] < 1e-9) {
      EXPECT_NEAR(u, push, 1e-12 * push);
    }
  }
  solved.phase->set_conditions(body.conditions, solved.state.displacement);
  mechanics::renew_history(*solved.phase, {0, 1}, solved.state);
  solved.step(body, 3.0, 1.0);
  EXPECT_NEAR(at_plane(body, solved), push * mould / (part + mould), 1e-9 * push);
  EXPECT_NEAR(largest_stress(solved), push / (part + mould), 1e-9 * push / (part + mould));
}

}  // namespace
}  // namespace solidus
