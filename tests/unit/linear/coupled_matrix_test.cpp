/// The tangent of two fields: its rectangles, what is prescribed and tied, and both solvers.
#include "linear/coupled_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "grid.hpp"
#include "parallel/parallel.hpp"

namespace solidus::linear {
namespace {

using test::Grid;

/// An entry that depends on global numbers only.
double entry(GlobalIndex row, GlobalIndex column, double seed) {
  return 0.2 * std::sin(seed * static_cast<double>(3 * row + 5 * column) + seed);
}

/// Two diagonally strong matrices and their coupling, on the quads of a grid; `fields` numbers a node stand
/// where the temperature does.
struct System {
  Grid grid{6, 5};
  std::size_t fields;
  BlockMatrix u, t;
  std::unique_ptr<CoupledMatrix> coupled;

  explicit System(int n_fields)
      : fields(static_cast<std::size_t>(n_fields)), u(matrix(2)), t(matrix(n_fields)) {
    const auto n = grid.mesh.x.size();
    std::vector<char> fixed_u(2 * n, 0), fixed_t(fields * n, 0);
    std::vector<Index> tied;
    for (std::size_t i = 0; i < n; ++i) {
      const GlobalIndex g = grid.mesh.global_node[i];
      if (g % 6 == 0) fixed_u[2 * i] = 1;
      if (g % 6 == 5) tied.push_back(static_cast<Index>(2 * i));
      if (g / 6 == 0) fixed_t[fields * i] = 1;
    }
    u.set_fixed(fixed_u);
    u.constrain({tied});
    t.set_fixed(fixed_t);
    coupled = std::make_unique<CoupledMatrix>(grid.mesh, u, t);
    fill();
  }
  BlockMatrix matrix(int block) const {
    NodeGraph graph(grid.mesh);
    graph.add_cliques(grid.quads, 4);
    return {grid.mesh, block, std::move(graph)};
  }
  void fill() {
    const auto of_u = u.clique_slots(grid.quads, 4), of_t = t.clique_slots(grid.quads, 4);
    for (std::size_t e = 0; e < grid.quads.size() / 4; ++e)
      for (std::size_t p = 0; p < 4; ++p)
        for (std::size_t q = 0; q < 4; ++q) {
          const GlobalIndex row = grid.global(grid.quads[4 * e + p]),
                            column = grid.global(grid.quads[4 * e + q]);
          const std::size_t pair = (4 * e + p) * 4 + q;
          for (int a = 0; a < 2; ++a) {
            for (int b = 0; b < 2; ++b)
              u.block(of_u[pair])[2 * a + b] +=
                  entry(2 * row + a, 2 * column + b, 1.0) + (row == column && a == b ? 4 : 0);
            for (std::size_t f = 0; f < fields; ++f) {
              const auto seed = static_cast<double>(f);
              coupled->force_by_temperature(of_u[pair])[static_cast<std::size_t>(a) * fields + f] +=
                  entry(2 * row + a, column, 2.0 + seed);
              coupled->heat_by_displacement(of_u[pair])[f * 2 + static_cast<std::size_t>(a)] +=
                  entry(row, 2 * column + a, 3.0 + seed);
            }
          }
          for (std::size_t f = 0; f < fields; ++f)
            for (std::size_t g = 0; g < fields; ++g)
              t.block(of_t[pair])[f * fields + g] +=
                  entry(row, column, 4.0 + static_cast<double>(f + 2 * g)) +
                  (row == column && f == g ? 4 : 0);
        }
  }
  /// Residual of the right-hand side, by the products of the blocks.
  double defect(const std::vector<double>& force, const std::vector<double>& heat, std::vector<double> du,
                std::vector<double> dt) {
    const parallel::GhostExchange ghosts(grid.mesh);
    const auto n = static_cast<std::size_t>(grid.mesh.n_owned_nodes);
    u.constraints().share(std::span(du).first(2 * n));
    for (std::size_t i = 0; i < 2 * n; ++i)
      if (u.fixed()[i]) du[i] = 0;
    for (std::size_t i = 0; i < fields * n; ++i)
      if (t.fixed()[i]) dt[i] = 0;
    ghosts.update(du, 2);
    ghosts.update(dt, static_cast<int>(fields));
    std::vector<double> ru(2 * n), rt(fields * n), part(2 * n);
    u.multiply(du, ru);
    coupled->multiply_force(dt, part);
    for (std::size_t i = 0; i < 2 * n; ++i) ru[i] += part[i];
    t.multiply(dt, rt);
    coupled->multiply_heat(du, part);
    for (std::size_t i = 0; i < fields * n; ++i) rt[i] += part[i] - heat[i];
    for (std::size_t i = 0; i < 2 * n; ++i)
      if (u.fixed()[i]) ru[i] = 0;
    u.constraints().sum(ru);
    double worst = 0;
    for (std::size_t i = 0; i < 2 * n; ++i)
      if (!u.fixed()[i]) worst = std::max(worst, std::abs(ru[i] - force[i]));
    for (std::size_t i = 0; i < fields * n; ++i)
      if (!t.fixed()[i]) worst = std::max(worst, std::abs(rt[i]));
    return parallel::global_max(worst);
  }
};

TEST(CoupledSolver, SolvesBothFieldsWithWhatIsPrescribedAndTied) {
  struct Case {
    CoupledSolverKind kind;
    int fields;
  };
  for (const Case c : {Case{CoupledSolverKind::direct, 1}, Case{CoupledSolverKind::field_split, 1},
                       Case{CoupledSolverKind::direct, 2}}) {
    System s(c.fields);
    const auto n = static_cast<std::size_t>(s.grid.mesh.n_owned_nodes);
    std::vector<double> force(2 * n), heat(s.fields * n), du(2 * s.grid.mesh.x.size()),
        dt(s.fields * s.grid.mesh.x.size());
    for (std::size_t i = 0; i < 2 * n; ++i)
      force[i] = s.u.fixed()[i]
                     ? 0.0
                     : std::sin(static_cast<double>(2 * s.grid.mesh.global_node[i / 2] + (i % 2 ? 1 : 0)));
    s.u.constraints().sum(force);
    for (std::size_t i = 0; i < heat.size(); ++i)
      heat[i] =
          s.t.fixed()[i]
              ? 0.0
              : std::cos(static_cast<double>(s.grid.mesh.global_node[i / s.fields]) + (i % s.fields ? 1 : 0));
    CoupledSolver solver(s.grid.mesh, 2, c.kind, 1e-13);
    for (int pass = 0; pass < 3; ++pass) {  // the second and third reuse pattern, analysis, hierarchy
      const LinearReport report = solver.solve(*s.coupled, force, heat, {1.0 + pass, 0.5},
                                               std::span(du).first(2 * n), std::span(dt).first(s.fields * n));
      ASSERT_TRUE(report.converged) << report.reason;
      EXPECT_LT(s.defect(force, heat, du, dt), 1e-11) << pass;
      if (pass == 1) solver.forget();
    }
  }
}

}  // namespace
}  // namespace solidus::linear
