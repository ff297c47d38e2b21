/// Newton's iteration on contact: quadratic once no point changes its status any more, and it ends.
///
/// Without line search and chord steps, so that every residual belongs to an iterate.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "contact_hertz.hpp"

namespace solidus {
namespace {

using contact::Formulation;
using test::Hertz;
using test::Iteration;

mechanics::MechanicsOptions plain_newton() {
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.newton.line_search = false;
  options.newton.chords = false;
  return options;
}

constexpr double k_rounding = 1e-9;  ///< of residuals with stiff penalties; the linear case ends there

/// r_{k+1} <= r_k² relative to the forces, from the last change on. Returns how many pairs were above
/// rounding.
int expect_quadratic(const Iteration& i) {
  int n = 0;
  for (std::size_t k = i.settled(); k + 1 < i.residuals.size(); ++k) {
    const double r = i.residuals[k], next = i.residuals[k + 1];
    EXPECT_LE(next, std::max(r * r, k_rounding)) << "iteration " << k + 1;
    if (r < 0.5 && r * r > k_rounding) ++n;
  }
  return n;
}

void write(const Iteration& i, std::ofstream table) {
  for (std::size_t k = 0; k < i.residuals.size(); ++k)
    table << k << "," << i.residuals[k] << "," << i.changes[k] << "\n";
}

/// A round foot, pressed on a block and dragged along it with friction, over many faces.
struct Foot {
  mesh::Mesh mesh;
  std::unique_ptr<test::ContactSteps> run;

  Foot(mesh::Shape shape, const mechanics::MechanicsOptions& options) : mesh(make_mesh(shape)) {
    const bool flat = mesh.dimension == 2;
    contact::ContactParameters spec = test::interface();
    std::swap(spec.slave, spec.master);
    spec.formulation = Formulation::large_sliding;
    spec.integration = contact::IntegrationRule::gauss;
    spec.friction.emplace();
    spec.friction->coefficient.terms = {Table(0.3)};
    const std::string last = flat ? "y" : "z";
    const int up = mesh.dimension - 1;
    mechanics::MechanicalConditions c;
    for (int i = 0; i <= up; ++i) c.displacements.push_back({"lower_" + last + "_min", i, 0.0});
    c.displacements.push_back({"upper_" + last + "_max", up, Table({0, 1}, {0, -2e-4})});
    c.displacements.push_back({"upper_" + last + "_max", 0, Table({0, 1, 2}, {0, 0, 0.1})});
    if (!flat) c.displacements.push_back({"upper_" + last + "_max", 1, Table({0, 1, 2}, {0, 0, 0.03})});
    run = std::make_unique<test::ContactSteps>(
        mesh, flat ? AnalysisKind::plane_strain : AnalysisKind::solid,
        std::vector{test::elastic(70e9, 0.33), test::elastic(210e9, 0.3)}, spec, c, options);
  }

  static mesh::Mesh make_mesh(mesh::Shape shape) {
    const bool flat = mesh::dimension(shape) == 2;
    mesh::TwoBlocks blocks{{0.5, 0.1}, {0.15, 0.1}, {21, 4}, {8, 4}, 0};
    if (!flat) blocks = {{0.5, 0.2, 0.1}, {0.15, 0.1, 0.1}, {9, 4, 2}, {4, 3, 2}, 0};
    mesh::Mesh mesh = test::distribute_blocks(test::raw_blocks(blocks, shape));
    const auto up = static_cast<std::size_t>(mesh.dimension - 1);
    for (Index node : mesh.node_sets.at("upper")) {
      mesh::Point& x = mesh.x[static_cast<std::size_t>(node)];
      const double from_middle = x[0] - 0.075, height = x[up] - 0.1;
      x[up] += from_middle * from_middle * (1 - height / 0.1);
      x[0] += 0.1;
      if (!flat) x[1] += 0.03;
    }
    return mesh;
  }
};

TEST(NewtonOnContact, IsQuadraticInHertzsContactOnceTheActiveSetSettles) {
  const std::string header = "iteration,residual,changes";
  for (auto kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric}) {
    // Fixed partners: linear between changes, one solve with the exact tangent ends it; a stabilisation of
    // 1e-8 leaves a residual of its size.
    Hertz small({.kind = kind, .formulation = Formulation::small_sliding, .n = 32, .stabilisation = 0},
                plain_newton());
    small.run->step(1);
    const Iteration& linear = small.run->turns.front();
    EXPECT_LT(linear.residuals[linear.settled() + 1], k_rounding);

    Hertz large({.kind = kind, .formulation = Formulation::large_sliding, .n = 32}, plain_newton());
    // In two halves: without line search the way from touching to full load in one step is left to luck.
    large.run->step(0.5);
    large.run->step(0.5);
    EXPECT_GE(expect_quadratic(large.run->turns.front()), 1);
    if (kind == AnalysisKind::plane_strain)
      write(large.run->turns.front(), verification::table("contact_newton_hertz", header));
  }
}

TEST(NewtonOnContact, IsQuadraticWhileABodySlidesOverManyFacesWithFriction) {
  for (const auto shape : {mesh::Shape::quad4, mesh::Shape::quad8, mesh::Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    Foot foot(shape, plain_newton());
    foot.run->step(1);
    expect_quadratic(foot.run->turns.front());
    int pairs = 0;
    std::size_t most = 0;
    for (int i = 0; i < 10; ++i) {
      foot.run->step(0.1);  // 10 mm along faces of 24 to 56 mm
      pairs += expect_quadratic(foot.run->turns.front());
      most = std::max(most, foot.run->turns.front().residuals.size() - 1);
    }
    RecordProperty(std::string(mesh::name(shape)), fmt::format("pairs {} iterations {}", pairs, most));
    EXPECT_GE(pairs, 8);
    EXPECT_LE(most, 10u);
    const contact::ContactSums sums = contact::sums(foot.run->pair.view(), {});
    EXPECT_EQ(sums.sticking_points, 0);
    EXPECT_NEAR(sums.friction, 0.3 * sums.force, 1e-9 * sums.force);
    if (shape == mesh::Shape::quad4)
      write(foot.run->turns.front(),
            verification::table("contact_newton_sliding", "iteration,residual,changes"));
  }
}

TEST(NewtonOnContact, EndsWithLineSearchFromTouchingToFullLoadInOneStep) {
  using Bodies = test::HertzCase::Bodies;
  std::string iterations;
  for (auto kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric})
    for (auto bodies : {Bodies::round_on_block, Bodies::round_on_rigid, Bodies::rigid_in_block})
      for (int n : {16, 32}) {
        Hertz hertz({.bodies = bodies, .kind = kind, .n = n});
        hertz.run->step(1);
        iterations += fmt::format(" {}", hertz.run->iterations());
        EXPECT_LE(hertz.run->iterations(), 15);
      }
  RecordProperty("iterations", iterations);
}

/// As the time control does it: a step that is rejected is halved.
int advance(test::ContactSteps& run, double dt, int depth = 0) {
  try {
    run.step(dt);
    return 1;
  } catch (const StepRejected&) {
    if (depth == 4) throw;
    const int first = advance(run, 0.5 * dt, depth + 1);
    return first + advance(run, 0.5 * dt, depth + 1);
  }
}

TEST(NewtonOnContact, ReachesFullLoadOnStiffPenaltiesIfStepsThatJamAreHalved) {
  // 12 and 120 times the stiffness of the smallest elements, 25 of them under half the contact.
  for (const double stiffness : {4.6875, 50.0}) {
    mechanics::MechanicsOptions options = test::strict_mechanics();
    options.newton.max_iterations = 25;  // the default
    Hertz hertz({.n = 64, .stiffness = stiffness}, options);
    const int steps = advance(*hertz.run, 1);
    RecordProperty(fmt::format("stiffness_{:.0f}", stiffness),
                   fmt::format("{} steps, {} iterations in the last", steps, hertz.run->iterations()));
    EXPECT_NEAR(hertz.measure().pressure, hertz.exact_pressure(), 0.05 * hertz.exact_pressure());
  }
}

}  // namespace
}  // namespace solidus
