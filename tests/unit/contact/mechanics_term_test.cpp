/// Contact forces with friction as a term of the mechanical phase, of both formulations.
#include "contact/forces/mechanics_term.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bodies.hpp"
#include "contact/pair.hpp"
#include "friction_laws.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

struct Formulated {
  Formulation formulation;
  Shape shape;
};

ContactParameters spec(Formulation formulation) {
  ContactParameters s;
  s.name = "interface";
  s.slave = "lower_top";
  s.master = "upper_bottom";
  s.penalty = 1e10;
  s.penalty_is_factor = false;
  s.stabilisation = 0;
  s.formulation = formulation;
  s.search_distance = 0.05;
  // Hardens with the work of the normal pressure, so that ∂‖T‖/∂t_N is not just μ.
  s.friction = friction_spec({0.3, 0.02}, 1e3);
  s.friction->tangential_penalty = 5e9;
  return s;
}

AnalysisKind kind_of(const mesh::Mesh& mesh) {
  return mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
}

/// Pressed together by about 1e-4 m everywhere, unevenly; the upper body moves aside by `aside`.
std::vector<double> pressed(const mesh::Mesh& mesh, double aside) {
  const auto last = static_cast<std::size_t>(mesh.dimension - 1);
  return test::nodal_field(mesh, mesh.dimension, [&](const Point& x, bool upper) {
    std::vector<double> u(last + 1);
    u[0] = (upper ? aside : 0.0) + 1e-6 * std::sin(9 * x[0] + 5 * x[1]);
    if (last == 2) u[1] = (upper ? 0.6 * aside : 0.0) + 1e-6 * std::cos(7 * x[0]);
    u[last] = upper ? -1e-4 - 2e-5 * std::sin(8 * x[0] + 4 * x[1]) : 1e-5 * std::cos(8 * x[0] + 3 * x[1]);
    return u;
  });
}

/// The matrix of a term, bound to it.
std::unique_ptr<linear::BlockMatrix> matrix_of(const mesh::Mesh& mesh, linear::Contribution& term) {
  linear::NodeGraph graph(mesh);
  term.add_to_graph(graph);
  auto matrix = std::make_unique<linear::BlockMatrix>(mesh, mesh.dimension, std::move(graph));
  term.bind(*matrix);
  return matrix;
}

/// max |(r(x + h d) − r(x − h d))/2h − K d| / max |K d| over the owned rows.
double tangent_defect(const mesh::Mesh& mesh, linear::Contribution& term, const std::vector<double>& x,
                      double h) {
  const auto matrix = matrix_of(mesh, term);
  std::vector<double> d(x.size()), up = x, down = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Point& p = mesh.x[i / static_cast<std::size_t>(mesh.dimension)];
    d[i] = std::sin(31 * p[0] + 17 * p[1] + 13 * p[2] +
                    static_cast<double>(i % static_cast<std::size_t>(mesh.dimension)));
    up[i] += h * d[i];
    down[i] -= h * d[i];
  }
  const auto n = static_cast<std::size_t>(mesh.n_owned_nodes * mesh.dimension);
  std::vector<double> at(n, 0), r_up(n, 0), r_down(n, 0), product(n, 0);
  term.add_residual(x, at);
  term.add_tangent(x, *matrix);
  term.add_residual(up, r_up);
  term.add_residual(down, r_down);
  matrix->multiply(d, product);
  double defect = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    defect = std::max(defect, std::abs((r_up[i] - r_down[i]) / (2 * h) - product[i]));
    size = std::max(size, std::abs(product[i]));
  }
  return parallel::global_max(defect) / parallel::global_max(size);
}

/// A pair whose points hold tangential tractions, and a second step from there.
std::unique_ptr<ContactPair> rubbed(const mesh::Mesh& mesh, const ContactParameters& s) {
  auto pair = std::make_unique<ContactPair>(mesh, kind_of(mesh), s);
  const std::vector<double> rest(mesh.x.size() * static_cast<std::size_t>(mesh.dimension), 0.0);
  pair->begin({}, {.time = 1, .dt = 1, .displacement = rest});
  const std::vector<double> first = pressed(mesh, 3e-5);
  pair->update(first);
  const ContactState state = pair->state();
  pair->begin(state, {.time = 2, .dt = 1, .displacement = first});
  return pair;
}

class FrictionForces : public testing::TestWithParam<Formulated> {};

TEST_P(FrictionForces, HaveTheTangentThatFiniteDifferencesShowWhereTheyStickAndWhereTheySlip) {
  const mesh::Mesh mesh = test::two_blocks(GetParam().shape);
  for (const double aside : {4e-5, 2e-3}) {
    SCOPED_TRACE(aside);
    const auto pair = rubbed(mesh, spec(GetParam().formulation));
    const std::vector<double> u = pressed(mesh, aside);
    pair->update(u);
    const ContactSums sums = contact::sums(pair->view(), {});
    EXPECT_EQ(sums.sticking_points, aside < 1e-4 ? sums.closed_points : 0);
    EXPECT_GT(sums.closed_points, 0);
    // Steps of 1e-9 m of penetrations of 1e-4 m and slips of 1e-3 m: 1e-9 by curvature and by rounding.
    EXPECT_LT(tangent_defect(mesh, pair->parts().forces.term(), u, 1e-9), 1e-6);
  }
}

TEST_P(FrictionForces, AreTheLawsAndBalanceInSum) {
  const mesh::Mesh mesh = test::two_blocks(GetParam().shape);
  const auto pair = rubbed(mesh, spec(GetParam().formulation));
  const std::vector<double> u = pressed(mesh, 2e-3);
  pair->update(u);
  const auto dim = static_cast<std::size_t>(mesh.dimension);
  std::vector<double> r(static_cast<std::size_t>(mesh.n_owned_nodes) * dim, 0);
  pair->parts().forces.term().add_residual(u, r);
  std::vector<char> is_upper(mesh.x.size(), 0);
  for (Index n : mesh.node_sets.at("upper")) is_upper[static_cast<std::size_t>(n)] = 1;
  Point on_upper{}, all{};
  for (std::size_t i = 0; i < r.size(); ++i) {
    all[i % dim] += r[i];
    if (is_upper[i / dim] != 0) on_upper[i % dim] += r[i];
  }
  const ContactSums sums = contact::sums(pair->view(), {});
  const double mean_mu = sums.friction / sums.force;
  EXPECT_GT(mean_mu, 0.3);
  EXPECT_LT(mean_mu, 0.5);
  for (std::size_t i = 0; i < dim; ++i) {
    EXPECT_NEAR(parallel::global_sum(all[i]), 0, 1e-12 * sums.force);
    // The residual is what a body resists with: minus the force on it.
    EXPECT_NEAR(-parallel::global_sum(on_upper[i]), sums.resultant[i], 1e-12 * sums.force);
  }
  // The upper body is the master and moves in +x: friction holds it back.
  EXPECT_LT(sums.resultant[0], 0);
  EXPECT_GT(sums.resultant[dim - 1], 0);
}

TEST_P(FrictionForces, HaveASymmetricTangentWhenAskedTo) {
  const mesh::Mesh mesh = test::two_blocks(GetParam().shape);
  ContactParameters s = spec(GetParam().formulation);
  for (const bool symmetric : {true, false}) {
    s.friction->symmetric = symmetric;
    const auto pair = rubbed(mesh, s);
    EXPECT_EQ(pair->parts().forces.symmetric(), symmetric);
    const auto matrix = matrix_of(mesh, pair->parts().forces.term());
    const std::vector<double> u = pressed(mesh, 2e-3);
    pair->parts().forces.term().add_tangent(u, *matrix);
    double skew = 0, size = 0;
    const auto at = [](Index i) { return static_cast<std::size_t>(i); };
    for (Index row = 0; row < mesh.n_owned_nodes; ++row)
      for (std::int64_t k = matrix->row_start()[at(row)]; k < matrix->row_start()[at(row) + 1]; ++k) {
        const Index column = matrix->columns()[static_cast<std::size_t>(k)];
        if (column >= mesh.n_owned_nodes) continue;
        const double* a = matrix->block(k);
        const double* b = matrix->block(matrix->slot(column, row));
        for (int i = 0; i < mesh.dimension; ++i)
          for (int j = 0; j < mesh.dimension; ++j) {
            skew = std::max(skew, std::abs(a[i * mesh.dimension + j] - b[j * mesh.dimension + i]));
            size = std::max(size, std::abs(a[i * mesh.dimension + j]));
          }
      }
    skew = parallel::global_max(skew);
    size = parallel::global_max(size);
    if (symmetric)
      EXPECT_LE(skew, 1e-13 * size);
    else
      EXPECT_GT(skew, 1e-2 * size);
  }
}

// Open contact without friction: its tangent is the stabilisation alone. Collective.
TEST(MechanicsTerm, HoldsLessOfAMeltWhoseIterationDoesNotEnd) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec(Formulation::small_sliding);
  s.friction.reset();
  s.stabilisation = 1e-8;
  ContactPair pair(mesh, kind_of(mesh), s);
  const std::vector<double> rest(mesh.x.size() * 2, 0.0);
  pair.begin({}, {.time = 1, .dt = 1, .displacement = rest});
  const std::vector<double> apart = test::nodal_field(mesh, 2, [](const Point&, bool upper) {
    return std::vector<double>{0.0, upper ? 1e-3 : 0.0};
  });
  const auto held = [&] {
    const auto matrix = matrix_of(mesh, pair.parts().forces.term());
    std::vector<double> product(static_cast<std::size_t>(mesh.n_owned_nodes) * 2, 0.0);
    pair.parts().forces.term().add_tangent(apart, *matrix);
    matrix->multiply(apart, product);
    double sum = 0;
    for (const double f : product) sum += std::abs(f);
    return parallel::global_sum(sum);
  };
  const double first = held();
  EXPECT_GT(first, 0);
  for (int k = 2; k <= 8; ++k) EXPECT_DOUBLE_EQ(held(), first) << k;
  EXPECT_NEAR(held() / first, 0.1, 1e-9);
  for (int k = 10; k <= 12; ++k) held();
  EXPECT_NEAR(held() / first, 1e-4, 1e-12);
  pair.begin({}, {.time = 1, .dt = 1, .displacement = rest});
  EXPECT_DOUBLE_EQ(held(), first);
}

INSTANTIATE_TEST_SUITE_P(Of, FrictionForces,
                         testing::Values(Formulated{Formulation::small_sliding, Shape::tri3},
                                         Formulated{Formulation::small_sliding, Shape::quad8},
                                         Formulated{Formulation::small_sliding, Shape::hex8},
                                         Formulated{Formulation::small_sliding, Shape::tet10},
                                         Formulated{Formulation::large_sliding, Shape::quad4},
                                         Formulated{Formulation::large_sliding, Shape::quad8},
                                         Formulated{Formulation::large_sliding, Shape::tet4},
                                         Formulated{Formulation::large_sliding, Shape::hex8}),
                         [](const auto& of) {
                           return std::string(mesh::name(of.param.shape)) +
                                  (of.param.formulation == Formulation::large_sliding ? "Sliding" : "Fixed");
                         });

TEST(NormalLaw, QuotientDoesExactlyTheWorkThatTheSpringGains) {
  const NormalLaw law{NormalKind::energy_conserving, 3e9};
  for (const double g0 : {-2e-6, 0.0, 1e-6, 4e-6})
    for (const double g1 : {-3e-6, -1e-6, 0.0, 1e-6, 5e-6}) {
      const NormalHistory old{true, g0, law.penalty * std::max(g0, 0.0), 0};
      for (const double share : {0.5, 0.7, 1.0}) {
        const NormalLaw::Response r = law.update(g1, old, share);
        const double gain = law.energy(g1) - law.energy(g0);
        EXPECT_NEAR(r.pressure * (g1 - g0), gain, 1e-15 * law.penalty * 1e-11);
        EXPECT_NEAR(share * r.balance_pressure + (1 - share) * old.balance_pressure, r.pressure,
                    1e-12 * law.penalty * 1e-6);
        if (g1 == 0 || g0 == 0) continue;  // bends
        const double h = 1e-10;
        const double slope =
            (law.update(g1 + h, old, share).pressure - law.update(g1 - h, old, share).pressure) / (2 * h);
        EXPECT_NEAR(r.tangent, slope, 1e-5 * law.penalty);
      }
    }
}

TEST(NormalLaw, OfMultipliersHoldsAPressureWithoutPenetration) {
  const NormalLaw law{NormalKind::augmented_lagrangian, 1e9};
  const NormalHistory old{true, 0, 0, 5e6};
  EXPECT_EQ(law.update(0, old, 1).pressure, 5e6);
  EXPECT_DOUBLE_EQ(law.update(-4e-3, old, 1).pressure, 1e6);
  EXPECT_TRUE(law.update(-4.9e-3, old, 1).closed);
  EXPECT_FALSE(law.update(-5.1e-3, old, 1).closed);
}

}  // namespace
}  // namespace solidus::contact
