/// Heat through a pair: its tangents, its balance and what it shows at the nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/laws/gas_gap.hpp"
#include "two_block_pair.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;
using namespace pairs;

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
      ContactParameters s = spec();
      s.heat = heat_spec();
      s.nodal_heat = nodal;
      ContactPair pair(mesh, kind_of(mesh), s);
      pair.update(rocking(mesh));
      // Linear in the temperature; differences of 1e5 W lose digits to rounding only.
      EXPECT_LT(tangent_defect(mesh, *pair.parts().heat.term(), 1, warm(mesh), 1.0), 1e-11);
    }
}

// The heat of a temperature field that stays, along a displacement that moves every gap.
double gap_tangent_defect(const mesh::Mesh& mesh, ContactPair& pair, const std::vector<double>& temperature,
                          const std::vector<double>& u, double h) {
  linear::BlockMatrix of_u = make_matrix(mesh, mesh.dimension, pair.parts().forces.term());
  linear::BlockMatrix of_t = make_matrix(mesh, 1, *pair.parts().heat.term());
  pair.parts().forces.term().bind(of_u);
  linear::CoupledMatrix matrix(mesh, of_u, of_t);
  pair.update(u);
  pair.parts().heat.add_coupling(temperature, matrix);
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
    const std::vector<double> heat = pair.parts().heat.nodal(temperature);
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
        ContactParameters s = spec();
        s.heat = law;
        s.nodal_heat = nodal;
        ContactPair pair(mesh, kind_of(mesh), s);
        // Steps of 1e-10 m of gaps of 1e-4 m: 1e-12 by curvature, 1e-10 by rounding.
        EXPECT_LT(gap_tangent_defect(mesh, pair, warm(mesh), rocking(mesh), 1e-5), 1e-7);
      }
}

TEST(InterfaceHeat, ByRadiationHasTheMeanOfBothDerivativesAsItsTangent) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.heat = heat_spec();
  s.heat->slave_emissivity = 0.8;
  s.heat->master_emissivity = 0.6;
  s.heat->contact_law = contact_law(PowerContact{0});
  s.heat->gap_law = gap_law(ConstantGap{});
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  // Where both sides have one temperature the two derivatives, 4σΘ³ and −4σΘ³, are the tangent's.
  const std::vector<double> equal(mesh.x.size(), 800.0);
  EXPECT_LT(tangent_defect(mesh, *pair.parts().heat.term(), 1, equal, 1e-2), 1e-8);
  // And the heat is that of the law, not of its linearisation.
  const auto hot_and_cold = test::nodal_field(
      mesh, 1, [](const Point&, bool upper) { return std::vector{upper ? 400.0 : 1000.0}; });
  const double factor = k_stefan_boltzmann / (1 / 0.8 + 1 / 0.6 - 1);
  const double expected = factor * 0.3 * (std::pow(1000.0, 4) - std::pow(400.0, 4));
  EXPECT_NEAR(contact::sums(pair.view(), hot_and_cold).heat, expected, 1e-12 * expected);
}

// A gap that opens from 40 to 120 µm has 80 in the middle.
TEST(InterfaceHeat, PassesThroughTheGapsThatItIsTold) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.heat = heat_spec();
  s.heat->gap_law = gap_law(GasGap{.conductivity = 0.06, .open_conductance = 2300});
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  const auto lifted = [&](double gap) {
    return test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
      return std::vector<double>{0, upper ? gap : 0};
    });
  };
  const auto temperature = test::nodal_field(
      mesh, 1, [](const Point&, bool upper) { return std::vector{upper ? 400.0 : 1000.0}; });
  const auto heat = [&] { return std::abs(contact::sums(pair.view(), temperature).heat); };
  pair.update(lifted(80e-6));
  const double of_the_middle = heat();
  pair.update(lifted(40e-6));
  const std::vector<HeatGap> start = pair.parts().gaps.now();
  const double of_the_start = heat();
  pair.update(lifted(120e-6));
  const std::vector<HeatGap> mean = middle(start, pair.parts().gaps.now());
  pair.parts().gaps.use(mean);
  EXPECT_NEAR(heat(), of_the_middle, 1e-12 * of_the_middle);
  const GapHeat misplaced = pair.parts().gaps.heat(start, mean, temperature);
  EXPECT_NEAR(misplaced.passed, of_the_start, 1e-12 * of_the_start);
  EXPECT_NEAR(misplaced.misplaced, of_the_start - of_the_middle, 1e-12 * of_the_start);
  EXPECT_EQ(pair.parts().gaps.heat(mean, mean, temperature).misplaced, 0);
}

// Seen from 40 µm, a gap that widens to 120 µm will have these, one that closes is closed; points that carry
// a pressure stay closed. The pair itself stays where it was.
TEST(InterfaceHeat, SeesTheGapsOfALaterDisplacement) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.heat = heat_spec();
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  const auto lifted = [&](double gap) {
    return test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
      return std::vector<double>{0, upper ? gap : 0};
    });
  };
  const auto same = [](const std::vector<HeatGap>& a, const std::vector<HeatGap>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t p = 0; p < a.size(); ++p) {
      EXPECT_EQ(a[p].partnered, b[p].partnered) << p;
      EXPECT_NEAR(a[p].penetration, b[p].penetration, 1e-18) << p;
      EXPECT_EQ(a[p].pressure, b[p].pressure) << p;
    }
  };
  pair.update(lifted(120e-6));
  const std::vector<HeatGap> wide = pair.parts().gaps.now();
  pair.update(lifted(40e-6));
  const std::vector<HeatGap> now = pair.parts().gaps.now();
  same(pair.parts().gaps.ahead(lifted(120e-6), 1), wide);
  for (const HeatGap& gap : pair.parts().gaps.ahead(lifted(-10e-6), 1)) {
    EXPECT_EQ(gap.penetration, 0);
    EXPECT_EQ(gap.pressure, 0);
  }
  same(pair.parts().gaps.now(), now);
  pair.update(lifted(-10e-6));
  const std::vector<HeatGap> pressed = pair.parts().gaps.now();
  same(pair.parts().gaps.ahead(lifted(120e-6), 1), pressed);
}

TEST(InterfaceHeat, LeavesOneBodyAndEntersTheOtherWithoutLoss) {
  for (bool nodal : {true, false})
    for (Shape shape : {Shape::tri3, Shape::hex8, Shape::hex20}) {
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::two_blocks(shape);
      ContactParameters s = spec();
      s.heat = heat_spec();
      s.heat->slave_emissivity = s.heat->master_emissivity = 0.5;
      s.nodal_heat = nodal;
      ContactPair pair(mesh, kind_of(mesh), s);
      pair.update(rocking(mesh));
      const std::vector<double> temperature = warm(mesh);
      const std::vector<double> heat = pair.parts().heat.nodal(temperature);
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
    ContactParameters s = spec();
    s.heat = gas;
    ContactPair pair(mesh, kind_of(mesh), s);
    pair.update(rocking(mesh));
    const auto n_owned = static_cast<std::size_t>(mesh.n_owned_nodes);
    for (std::size_t hot = 0; hot < n_owned; ++hot) {
      std::vector<double> temperature(mesh.x.size(), 600.0);
      temperature[hot] = 700;
      const std::vector<double> heat = pair.parts().heat.nodal(temperature);
      double size = 0;
      for (const double q : heat) size = std::max(size, std::abs(q));
      EXPECT_GE(heat[hot], -1e-12 * size) << mesh::name(shape) << ", node " << hot;
    }
  }
}

TEST(NodalFields, ShowTheHeatThatEntersEitherBodyAndWhatOfItIsByFriction) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = spec();
  s.heat = heat_spec();
  s.friction = FrictionParameters{};
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

TEST(InterfaceHeat, InNodalFormKeepsTheMatrixOfNonNegativeTypeForLinearShapes) {
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::tet4, Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    ContactParameters s = spec();
    s.heat = heat_spec();
    ContactPair pair(mesh, kind_of(mesh), s);
    auto matrix = make_matrix(mesh, 1, *pair.parts().heat.term());
    pair.parts().heat.term()->bind(matrix);
    pair.parts().heat.term()->add_tangent(warm(mesh), matrix);
    double largest = 0;
    for (Index p = 0; p < pair.parts().partners.n_points(); ++p)
      for (const Index row : pair.parts().partners.nodes_of(p))
        for (const Index column : pair.parts().partners.nodes_of(p)) {
          if (row != column && row < mesh.n_owned_nodes)
            largest = std::max(largest, *matrix.block(matrix.slot(row, column)));
        }
    EXPECT_LE(largest, 0);
  }
}

}  // namespace
}  // namespace solidus::contact
