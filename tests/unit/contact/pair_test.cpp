#include "contact/pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bodies.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/tabulated.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

ContactSpec spec(IntegrationRule rule = IntegrationRule::segments) {
  ContactSpec s;
  s.name = "interface";
  s.slave = "lower_top";
  s.master = "upper_bottom";
  s.penalty = 1e10;
  s.penalty_is_factor = false;
  s.stabilisation = 0;
  s.integration = rule;
  return s;
}

HeatTransferSpec heat_spec() {
  HeatTransferSpec h;
  h.contact_law = contact_law(PowerContact{2300});
  h.gap_law = gap_law(TableGap{{}, Table({0, 6e-5, 1e-4}, {2300, 350, 300})});
  return h;
}

AnalysisKind kind_of(const mesh::Mesh& mesh) {
  return mesh.dimension == 2 ? AnalysisKind::axisymmetric : AnalysisKind::solid;
}
std::size_t last_axis(const mesh::Mesh& mesh) {
  return static_cast<std::size_t>(mesh.dimension - 1);
}

// A smooth displacement under which the interface is closed on one side and open on the other.
std::vector<double> rocking(const mesh::Mesh& mesh, double lift = 0) {
  return test::nodal_field(mesh, mesh.dimension, [&](const Point& x, bool upper) {
    std::vector<double> u(static_cast<std::size_t>(mesh.dimension));
    u[0] = 1e-4 * std::sin(9 * x[0]);
    u[last_axis(mesh)] = upper ? lift + 2e-4 * (x[0] - 0.14) + 1e-4 * x[1] : 3e-5 * std::cos(8 * x[0]);
    return u;
  });
}

linear::BlockMatrix make_matrix(const mesh::Mesh& mesh, int block, linear::Contribution& term) {
  linear::NodeGraph graph(mesh);
  term.add_to_graph(graph);
  return {mesh, block, std::move(graph)};
}

// max |(r(x + h d) − r(x − h d)) / 2h − K d| / max |K d| over the owned rows, for a smooth d.
double tangent_defect(const mesh::Mesh& mesh, linear::Contribution& term, int block,
                      const std::vector<double>& x, double h) {
  linear::BlockMatrix matrix = make_matrix(mesh, block, term);
  term.bind(matrix);
  term.add_tangent(x, matrix);
  std::vector<double> d(x.size()), up = x, down = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto& p = mesh.x[i / static_cast<std::size_t>(block)];
    d[i] = std::sin(31 * p[0] + 17 * p[1] + 13 * p[2] +
                    static_cast<double>(i % static_cast<std::size_t>(block)));
    up[i] += h * d[i];
    down[i] -= h * d[i];
  }
  const auto n = static_cast<std::size_t>(mesh.n_owned_nodes * block);
  std::vector<double> r_up(n, 0), r_down(n, 0), product(n, 0);
  term.add_residual(up, r_up);
  term.add_residual(down, r_down);
  matrix.multiply(d, product);
  double defect = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    defect = std::max(defect, std::abs((r_up[i] - r_down[i]) / (2 * h) - product[i]));
    size = std::max(size, std::abs(product[i]));
  }
  return parallel::global_max(defect) / parallel::global_max(size);
}

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
      EXPECT_LT(tangent_defect(mesh, pair.mechanics(), mesh.dimension, u, 1e-10), 1e-5);
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
    pair.mechanics().add_residual(rocking(mesh, -1e-3), r);
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
  auto matrix = make_matrix(mesh, 2, pair.mechanics());
  pair.mechanics().bind(matrix);
  const std::vector<double> u(mesh.x.size() * 2, 0.0);
  pair.mechanics().add_tangent(u, matrix);
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
    ContactSpec s = spec();
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

std::vector<double> warm(const mesh::Mesh& mesh) {
  return test::nodal_field(mesh, 1, [](const Point& x, bool upper) {
    return std::vector<double>{(upper ? 500.0 : 900.0) + 50 * std::sin(12 * x[0] + 5 * x[1])};
  });
}

TEST(InterfaceHeat, HasTheTangentThatFiniteDifferencesShow) {
  for (Shape shape : {Shape::tri3, Shape::quad8, Shape::hex8, Shape::tet10})
    for (bool nodal : {true, false}) {
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::two_blocks(shape);
      ContactSpec s = spec();
      s.heat = heat_spec();
      s.nodal_heat = nodal;
      ContactPair pair(mesh, kind_of(mesh), s);
      pair.update(rocking(mesh));
      // Linear in the temperature; differences of 1e5 W lose digits to rounding only.
      EXPECT_LT(tangent_defect(mesh, *pair.heat(), 1, warm(mesh), 1.0), 1e-11);
    }
}

// The heat of a temperature field that stays, along a displacement that moves every gap.
double gap_tangent_defect(const mesh::Mesh& mesh, ContactPair& pair, const std::vector<double>& temperature,
                          const std::vector<double>& u, double h) {
  linear::BlockMatrix of_u = make_matrix(mesh, mesh.dimension, pair.mechanics());
  linear::BlockMatrix of_t = make_matrix(mesh, 1, *pair.heat());
  pair.mechanics().bind(of_u);
  linear::CoupledMatrix matrix(mesh, of_u, of_t);
  pair.update(u);
  pair.add_coupling(temperature, matrix);
  std::vector<double> d(u.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    const Point& p = mesh.x[i / static_cast<std::size_t>(mesh.dimension)];
    d[i] = 1e-5 * std::sin(31 * p[0] + 17 * p[1] + 13 * p[2] + static_cast<double>(i % 2));
  }
  const auto n = static_cast<std::size_t>(mesh.n_owned_nodes);
  std::vector<double> product(n), difference(n, 0.0);
  matrix.multiply_heat(d, product);
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> x = u;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += sign * h * d[i];
    pair.update(x);
    const std::vector<double> heat = pair.nodal_heat(temperature);
    for (std::size_t i = 0; i < n; ++i) difference[i] += sign * heat[i] / (2 * h);
  }
  double defect = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    defect = std::max(defect, std::abs(difference[i] - product[i]));
    size = std::max(size, std::abs(product[i]));
  }
  return parallel::global_max(defect) / parallel::global_max(size);
}

TEST(InterfaceHeat, FollowsTheGapAsFiniteDifferencesShow) {
  HeatTransferSpec pressed = heat_spec();
  pressed.contact_law = contact_law(PowerContact{2300, 0.95, 1e9});
  HeatTransferSpec gas = heat_spec();
  gas.gap_law = gap_law(GasGap{.conductivity = 0.06, .open_conductance = 2300});
  for (const HeatTransferSpec& law : {heat_spec(), pressed, gas})
    for (Shape shape : {Shape::quad4, Shape::hex8})
      for (bool nodal : {true, false}) {
        const mesh::Mesh mesh = test::two_blocks(shape);
        ContactSpec s = spec();
        s.heat = law;
        s.nodal_heat = nodal;
        ContactPair pair(mesh, kind_of(mesh), s);
        // Steps of 1e-10 m of gaps of 1e-4 m: 1e-12 by curvature, 1e-10 by rounding.
        EXPECT_LT(gap_tangent_defect(mesh, pair, warm(mesh), rocking(mesh), 1e-5), 1e-7);
      }
}

TEST(InterfaceHeat, ByRadiationHasTheMeanOfBothDerivativesAsItsTangent) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactSpec s = spec();
  s.heat = heat_spec();
  s.heat->slave_emissivity = 0.8;
  s.heat->master_emissivity = 0.6;
  s.heat->contact_law = contact_law(PowerContact{0});
  s.heat->gap_law = gap_law(ConstantGap{});
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  // Where both sides have one temperature the two derivatives, 4σΘ³ and −4σΘ³, are the tangent's.
  const std::vector<double> equal(mesh.x.size(), 800.0);
  EXPECT_LT(tangent_defect(mesh, *pair.heat(), 1, equal, 1e-2), 1e-8);
  // And the heat is that of the law, not of its linearisation.
  const auto hot_and_cold = test::nodal_field(
      mesh, 1, [](const Point&, bool upper) { return std::vector{upper ? 400.0 : 1000.0}; });
  const double factor = k_stefan_boltzmann / (1 / 0.8 + 1 / 0.6 - 1);
  const double expected = factor * 0.3 * (std::pow(1000.0, 4) - std::pow(400.0, 4));
  EXPECT_NEAR(contact::sums(pair.view(), hot_and_cold).heat, expected, 1e-12 * expected);
}

TEST(InterfaceHeat, LeavesOneBodyAndEntersTheOtherWithoutLoss) {
  for (bool nodal : {true, false})
    for (Shape shape : {Shape::tri3, Shape::hex8, Shape::hex20}) {
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::two_blocks(shape);
      ContactSpec s = spec();
      s.heat = heat_spec();
      s.heat->slave_emissivity = s.heat->master_emissivity = 0.5;
      s.nodal_heat = nodal;
      ContactPair pair(mesh, kind_of(mesh), s);
      pair.update(rocking(mesh));
      const std::vector<double> temperature = warm(mesh);
      const std::vector<double> heat = pair.nodal_heat(temperature);
      std::vector<char> is_upper(mesh.x.size(), 0);
      for (Index n : mesh.node_sets.at("upper")) is_upper[static_cast<std::size_t>(n)] = 1;
      double out = 0, in = 0;
      for (std::size_t n = 0; n < heat.size(); ++n) (is_upper[n] ? in : out) += heat[n];
      const double sum = contact::sums(pair.view(), temperature).heat;
      EXPECT_GT(sum, 0);
      EXPECT_NEAR(parallel::global_sum(out), sum, 1e-12 * sum);
      EXPECT_NEAR(parallel::global_sum(in), -sum, 1e-12 * sum);
    }
}

TEST(InterfaceHeat, LeavesWhatIsHotterThanAllAroundItWhateverTheShapeAndTheGaps) {
  HeatTransferSpec gas = heat_spec();
  gas.gap_law = gap_law(
      GasGap{.conductivity = 1e-3, .open_conductance = 2300});  // conductances that differ a lot along a face
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::tri6, Shape::quad8, Shape::tet4, Shape::hex8,
                      Shape::tet10, Shape::hex20}) {
    const mesh::Mesh mesh = test::two_blocks(shape);
    ContactSpec s = spec();
    s.heat = gas;
    ContactPair pair(mesh, kind_of(mesh), s);
    pair.update(rocking(mesh));
    const auto n_owned = static_cast<std::size_t>(mesh.n_owned_nodes);
    for (std::size_t hot = 0; hot < n_owned; ++hot) {
      std::vector<double> temperature(mesh.x.size(), 600.0);
      temperature[hot] = 700;
      const std::vector<double> heat = pair.nodal_heat(temperature);
      double size = 0;
      for (const double q : heat) size = std::max(size, std::abs(q));
      EXPECT_GE(heat[hot], -1e-12 * size) << mesh::name(shape) << ", node " << hot;
    }
  }
}

TEST(NodalFields, ShowTheHeatThatEntersEitherBodyAndWhatOfItIsByFriction) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactSpec s = spec();
  s.heat = heat_spec();
  s.friction = FrictionSpec{};
  s.friction->coefficient.terms = {Table(0.25)};
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  const auto temperature =
      test::nodal_field(mesh, 1, [](const Point&, bool upper) { return std::vector{upper ? 450.0 : 500.0}; });
  constexpr double k_approach = 1e-6, k_dt = 0.5, k_slid = 1e-4;
  const auto moved = [&](double slid) {
    return test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
      return std::vector{upper ? slid : 0.0, upper ? -k_approach : 0.0};
    });
  };
  pair.update(moved(0));
  const ContactState start = pair.state();
  pair.begin(start, {.time = k_dt, .dt = k_dt, .displacement = moved(0), .temperature = temperature});
  pair.update(moved(k_slid));
  // Closed: 2300 W/(m² K) over 50 K. Slip: what is left of the way when the spring ε_T = ε_N holds μ p.
  const double across = 2300 * 50.0, pressure = 1e10 * k_approach;
  const double power = 0.25 * pressure * (k_slid - 0.25 * pressure / 1e10) / k_dt;
  const ContactNodalFields fields = contact::nodal_fields(pair.view(), temperature);
  for (std::size_t i = 0; i < fields.nodes.size(); ++i) {
    const bool slave = mesh.x[static_cast<std::size_t>(fields.nodes[i])][1] < 0.1 + 1e-9 &&
                       temperature[static_cast<std::size_t>(fields.nodes[i])] > 475;
    EXPECT_NEAR(fields.frictional_heat_flux[i], 0.5 * power, 1e-9 * power);
    EXPECT_NEAR(fields.heat_flux[i], 0.5 * power + (slave ? -across : across), 1e-9 * across);
  }
  const ContactSums sums = contact::sums(pair.view(), temperature);
  EXPECT_NEAR(sums.heat, 0.3 * across, 1e-9 * across);
  EXPECT_NEAR(sums.heat_to_slave + sums.heat_to_master, 0.3 * power, 1e-9 * power);
  EXPECT_NEAR(sums.heat_to_master, 0.3 * (0.5 * power + across), 1e-9 * across);
}

// An iterative scheme begins the same step again and again, from wherever the last iterate has left the pair.
TEST(Pair, BeginsFromTheStateAtTheStartWhereverItStands) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 0.01);
  ContactSpec s = spec();
  s.formulation = Formulation::large_sliding;
  s.search_distance = 1e-3;
  s.heat = heat_spec();
  s.interface_heat_capacity = 100;
  s.friction = FrictionSpec{};
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
  const ContactState start = pair.history().initial();
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
  ContactSpec s = spec();
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

TEST(InterfaceHeat, InNodalFormKeepsTheMatrixOfNonNegativeTypeForLinearShapes) {
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::tet4, Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    ContactSpec s = spec();
    s.heat = heat_spec();
    ContactPair pair(mesh, kind_of(mesh), s);
    auto matrix = make_matrix(mesh, 1, *pair.heat());
    pair.heat()->bind(matrix);
    pair.heat()->add_tangent(warm(mesh), matrix);
    double largest = 0;
    for (Index p = 0; p < pair.partners().n_points(); ++p)
      for (const Index row : pair.partners().nodes_of(p))
        for (const Index column : pair.partners().nodes_of(p)) {
          if (row != column && row < mesh.n_owned_nodes)
            largest = std::max(largest, *matrix.block(matrix.slot(row, column)));
        }
    EXPECT_LE(largest, 0);
  }
}

TEST(PenaltyFactor, IsTimesTheMeanStiffnessOfTheElementsAtTheStifferSurface) {
  // Heights: lower 0.1/2, upper 0.2/2; moduli 70 and 210 GPa.
  const std::vector<double> modulus{70e9, 210e9};
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::quad8, Shape::hex8, Shape::hex20}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    ContactSpec s = spec();
    s.penalty = 20;
    s.penalty_is_factor = true;
    const ContactPair pair(mesh, kind_of(mesh), s, modulus);
    EXPECT_NEAR(pair.forces().penalty(), 20 * 210e9 / 0.1, 1e-9 * pair.forces().penalty());
  }
}

TEST(ContactPair, RefusesSurfacesThatDoNotMeet) {
  const mesh::Mesh far = test::two_blocks(Shape::quad4, 0.5);
  EXPECT_THROW(ContactPair(far, AnalysisKind::plane_strain, spec()), InputError);
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactSpec s = spec();
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
  ContactSpec s = spec();
  s.choose_roles = true;
  for (const bool reversed : {false, true}) {
    s.slave = reversed ? "upper_bottom" : "lower_top";
    s.master = reversed ? "lower_top" : "upper_bottom";
    EXPECT_EQ(ContactPair(mesh, AnalysisKind::plane_strain, s).spec().slave, "lower_top");
  }
  const mesh::Mesh alike =
      test::distribute_blocks(test::raw_blocks({{0.3, 0.1}, {0.3, 0.1}, {4, 2}, {4, 2}, 0}, Shape::quad4));
  EXPECT_EQ(ContactPair(alike, AnalysisKind::plane_strain, s, std::vector{70e9, 210e9}).spec().slave,
            "lower_top");
  EXPECT_EQ(ContactPair(alike, AnalysisKind::plane_strain, s, std::vector{210e9, 70e9}).spec().slave,
            "upper_bottom");
}

TEST(ContactPair, TakesSmallInitialGapsAsTouchingWhenToldTo) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-5);
  ContactSpec s = spec();
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
    ContactSpec s = spec();
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
