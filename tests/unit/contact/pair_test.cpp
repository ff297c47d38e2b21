#include "contact/pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/laws/gas_gap.hpp"
#include "two_block_pair.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;
using namespace pairs;

TEST(ContactForces, HaveTheTangentThatFiniteDifferencesShow) {
  for (Shape shape : {Shape::tri3, Shape::quad8, Shape::tet4, Shape::hex8, Shape::tet10})
    for (auto rule : {IntegrationRule::segments, IntegrationRule::nodal, IntegrationRule::gauss}) {
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::two_blocks(shape);
      ContactPair pair(mesh, kind_of(mesh), spec(rule));
      const std::vector<double> u = rocking(mesh);
      pair.update(u);
      const ContactSums sums = contact::sums(pair.view(), {});
      EXPECT_GT(sums.closed_points, 0);
      EXPECT_LT(sums.closed_points, sums.points);
      // Piecewise linear in u: the difference is exact but for rounding unless a point changes its state.
      EXPECT_LT(tangent_defect(mesh, pair.parts().forces.term(), mesh.dimension, u, 1e-10), 1e-5);
    }
}

TEST(ContactForces, BalanceBetweenTheBodiesInSumAndMoment) {
  for (Shape shape : {Shape::quad4, Shape::hex8, Shape::tet10}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape, 1e-3);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    ContactPair pair(mesh, kind, spec());
    const auto dim = static_cast<std::size_t>(mesh.dimension);
    std::vector<double> r(static_cast<std::size_t>(mesh.n_owned_nodes) * dim, 0);
    pair.parts().forces.term().add_residual(rocking(mesh, -1e-3), r);
    std::array<double, 3> force{}, moment{};
    double size = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(mesh.n_owned_nodes); ++n) {
      Point f{};
      for (std::size_t i = 0; i < dim; ++i) f[i] = r[n * dim + i];
      const Point m = cross(mesh.x[n], f);
      size += norm(f);
      for (std::size_t i = 0; i < 3; ++i) {
        force[i] += f[i];
        moment[i] += m[i];
      }
    }
    size = parallel::global_sum(size);
    EXPECT_GT(size, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(parallel::global_sum(force[i]), 0, 1e-13 * size);
      EXPECT_NEAR(parallel::global_sum(moment[i]), 0, 1e-13 * size);
    }
  }
}

TEST(ContactForces, OfBodiesThatJustTouchAreZeroWithAStiffTangent) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactPair pair(mesh, AnalysisKind::plane_strain, spec());
  EXPECT_EQ(contact::sums(pair.view(), {}).closed_points, contact::sums(pair.view(), {}).points);
  EXPECT_EQ(contact::sums(pair.view(), {}).force, 0);
  auto matrix = make_matrix(mesh, 2, pair.parts().forces.term());
  pair.parts().forces.term().bind(matrix);
  const std::vector<double> u(mesh.x.size() * 2, 0.0);
  pair.parts().forces.term().add_tangent(u, matrix);
  // The work of a rigid approach v is ½ v K v = ½ ε_N A v².
  const auto v = test::nodal_field(mesh, 2, [](const Point&, bool upper) {
    return std::vector<double>{0, upper ? -1.0 : 0.0};
  });
  std::vector<double> product(static_cast<std::size_t>(mesh.n_owned_nodes) * 2, 0);
  matrix.multiply(v, product);
  double work = 0;
  for (std::size_t i = 0; i < product.size(); ++i) work += v[i] * product[i];
  EXPECT_NEAR(parallel::global_sum(work), 1e10 * 0.3, 1e-13 * 3e9);
}

TEST(ContactSums, OfAnInclinedApproachAreTheClosedFormOnAnyNumberOfProcesses) {
  // g = a (x − c): closed for x > c; the segment rule integrates the pieces that lie wholly on one side.
  const double a = 1e-3;
  const mesh::Mesh mesh = test::two_blocks(Shape::hex8);
  ContactPair pair(mesh, AnalysisKind::solid, spec());
  pair.update(test::nodal_field(mesh, 3, [&](const Point& x, bool upper) {
    return std::vector<double>{0, 0, upper ? -a * (x[0] - 0.15) : 0.0};
  }));
  // The master's line x = 0.15 cuts the slave's faces, so no piece changes sign inside.
  const ContactSums sums = contact::sums(pair.view(), {});
  EXPECT_NEAR(sums.closed_area, 0.15 * 0.2, 1e-14);
  EXPECT_NEAR(sums.force, 1e10 * a * 0.5 * 0.15 * 0.15 * 0.2, 1e-12 * sums.force);
  EXPECT_NEAR(sums.energy, 0.5 * 1e10 * a * a * 0.15 * 0.15 * 0.15 / 3 * 0.2, 1e-12 * sums.energy);
}

TEST(NodalFields, OfAUniformApproachAreUniformOnBothSides) {
  for (Shape shape : {Shape::tri3, Shape::hex20}) {
    const mesh::Mesh mesh = test::two_blocks(shape);
    ContactParameters s = spec();
    s.heat = heat_spec();
    ContactPair pair(mesh, kind_of(mesh), s);
    for (double approach : {1e-5, -3e-5}) {
      pair.update(test::nodal_field(mesh, mesh.dimension, [&](const Point&, bool upper) {
        std::vector<double> u(static_cast<std::size_t>(mesh.dimension), 0.0);
        u[last_axis(mesh)] = upper ? -approach : 0;
        return u;
      }));
      const ContactNodalFields fields = contact::nodal_fields(pair.view(), {});
      for (std::size_t i = 0; i < fields.nodes.size(); ++i) {
        EXPECT_NEAR(fields.opening[i], -approach, 1e-16);
        EXPECT_NEAR(fields.pressure[i], approach > 0 ? 1e10 * approach : 0, 1e-4);
        EXPECT_NEAR(fields.conductance[i], approach > 0 ? 2300 : 0.5 * (2300 + 350), 1e-7);
      }
    }
  }
}

// An iterative scheme begins the same step again and again, from wherever the last iterate has left the pair.
TEST(Pair, BeginsFromTheStateAtTheStartWhereverItStands) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 0.01);
  ContactParameters s = spec();
  s.formulation = Formulation::large_sliding;
  s.search_distance = 1e-3;
  s.heat = heat_spec();
  s.interface_heat_capacity = 100;
  s.friction = FrictionParameters{};
  s.friction->coefficient.terms = {Table(0.25)};
  const auto temperature =
      test::nodal_field(mesh, 1, [](const Point&, bool upper) { return std::vector{upper ? 450.0 : 500.0}; });
  const auto lowered = [&](double by) {
    return test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
      return std::vector{0.0, upper ? -by : 0.0};
    });
  };
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  const std::vector<double> rest = lowered(0);
  const ContactPass pass{.time = 1, .dt = 1, .displacement = rest, .temperature = temperature};
  const ContactState start = pair.parts().history.initial();
  pair.begin(start, pass);
  pair.update(lowered(0.0101));  // from out of reach into contact
  const ContactState once = pair.state();
  pair.begin(start, pass);
  pair.update(lowered(0.0101));
  ASSERT_FALSE(once.points.empty());
  for (std::size_t p = 0; p < once.points.size(); ++p) {
    EXPECT_GT(once.points[p].pressure, 0);
    EXPECT_EQ(once.points[p].temperature, 0);
    EXPECT_EQ(pair.state().points[p].temperature, once.points[p].temperature);
  }
}

TEST(Pair, TakesTheWorkOnARigidMasterFromItsPlaceAtTheStartOfTheStep) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 0.1);
  ContactParameters s = spec();
  s.formulation = Formulation::large_sliding;
  s.search_distance = 0.05;
  s.master = "plane";
  s.rigid_master.emplace();
  s.rigid_master->point = s.rigid_master->motion.centre = {0.15, 0.099, 0};
  s.rigid_master->direction = {0, -1, 0};
  s.rigid_master->motion.angle = Table({0, 2}, {0, 0.1});
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  const std::vector<double> rest(mesh.x.size() * 2, 0.0);
  const auto moved = test::nodal_field(mesh, 2, [](const Point&, bool) { return std::vector{1e-3, 0.0}; });
  pair.begin({}, {.time = 1, .dt = 1, .displacement = rest});
  pair.update(rest);
  const ContactState start = pair.state();
  double work[2], of_master[2];
  for (std::size_t i = 0; i < 2; ++i) {  // the second time from where the first has ended
    pair.begin(start, {.time = 2, .dt = 1, .displacement = rest});
    pair.update(moved);
    work[i] = contact::work(pair.view(), 0.5);
    of_master[i] = contact::rigid_work(pair.view(), 0.5);
  }
  EXPECT_GT(std::abs(work[0]), 1);
  EXPECT_EQ(work[1], work[0]);
  EXPECT_EQ(of_master[1], of_master[0]);
}

TEST(PenaltyFactor, IsTimesTheMeanStiffnessOfTheElementsAtTheStifferSurface) {
  // Heights: lower 0.1/2, upper 0.2/2; moduli 70 and 210 GPa.
  const std::vector<double> modulus{70e9, 210e9};
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::quad8, Shape::hex8, Shape::hex20}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    ContactParameters s = spec();
    s.penalty = 20;
    s.penalty_is_factor = true;
    const ContactPair pair(mesh, kind_of(mesh), s, modulus);
    EXPECT_NEAR(pair.parts().forces.law().normal.penalty, 20 * 210e9 / 0.1,
                1e-9 * pair.parts().forces.law().normal.penalty);
  }
}

TEST(ContactPair, RefusesSurfacesThatDoNotMeet) {
  const mesh::Mesh far = test::two_blocks(Shape::quad4, 0.5);
  EXPECT_THROW(ContactPair(far, AnalysisKind::plane_strain, spec()), InputError);
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.master = s.slave;
  EXPECT_THROW(ContactPair(mesh, AnalysisKind::plane_strain, s), InputError);
  s.master = "nowhere";
  EXPECT_THROW(ContactPair(mesh, AnalysisKind::plane_strain, s), InputError);
  s = spec();
  s.penalty_is_factor = true;
  EXPECT_THROW(ContactPair(mesh, AnalysisKind::plane_strain, s), InputError) << "no stiffness known";
}

TEST(ContactPair, MakesTheFinerSurfaceTheSlaveAndOfTwoAlikeTheSofterOne) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);  // 5 faces below, 3 above
  ContactParameters s = spec();
  s.choose_roles = true;
  for (const bool reversed : {false, true}) {
    s.slave = reversed ? "upper_bottom" : "lower_top";
    s.master = reversed ? "lower_top" : "upper_bottom";
    EXPECT_EQ(ContactPair(mesh, AnalysisKind::plane_strain, s).parts().spec.slave, "lower_top");
  }
  const mesh::Mesh alike =
      test::distribute_blocks(test::raw_blocks({{0.3, 0.1}, {0.3, 0.1}, {4, 2}, {4, 2}, 0}, Shape::quad4));
  EXPECT_EQ(ContactPair(alike, AnalysisKind::plane_strain, s, std::vector{70e9, 210e9}).parts().spec.slave,
            "lower_top");
  EXPECT_EQ(ContactPair(alike, AnalysisKind::plane_strain, s, std::vector{210e9, 70e9}).parts().spec.slave,
            "upper_bottom");
}

TEST(ContactPair, TakesSmallInitialGapsAsTouchingWhenToldTo) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-5);
  ContactParameters s = spec();
  EXPECT_EQ(sums(ContactPair(mesh, AnalysisKind::plane_strain, s).view(), {}).closed_points, 0);
  s.touching = 2e-5;
  const ContactSums sums = contact::sums(ContactPair(mesh, AnalysisKind::plane_strain, s).view(), {});
  EXPECT_EQ(sums.closed_points, sums.points);
}

TEST(ContactPair, RefusesASurfaceInContactWithItself) {
  const mesh::Mesh mesh =
      mesh::distribute(test::raw_blocks(test::standard_blocks(Shape::quad4), Shape::quad4),
                       {"lower", "upper"}, {"lower_top", "lower_x_min", "upper_bottom"});
  const auto refusal = [&](const std::string& master) -> std::string {
    ContactParameters s = spec();
    s.master = master;
    try {
      const ContactPair pair(mesh, AnalysisKind::plane_strain, s);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(refusal("lower_top").find("slave and master are the same surface 'lower_top'"),
            std::string::npos);
  const std::string corner = refusal("lower_x_min");
  EXPECT_NE(corner.find("the surfaces 'lower_top' and 'lower_x_min' share 1 node"), std::string::npos)
      << corner;
  EXPECT_NE(corner.find("contact of a surface with itself is not computed"), std::string::npos);
  EXPECT_EQ(refusal("upper_bottom"), "");
}

}  // namespace
}  // namespace solidus::contact
