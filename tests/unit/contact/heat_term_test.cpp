/// Heat of friction as a term of the thermal phase: where a pair has slid in a step.
#include "contact/heat/heat_term.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bodies.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/tabulated.hpp"
#include "contact/pair.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

constexpr double k_dt = 0.2;

ContactParameters rubbing(bool nodal, double heat_capacity, bool of_temperature) {
  ContactParameters s;
  s.name = "interface";
  s.slave = "lower_top";
  s.master = "upper_bottom";
  s.penalty = 1e11;
  s.penalty_is_factor = false;
  s.nodal_heat = nodal;
  s.heat = HeatTransferSpec{};
  if (of_temperature) {
    s.heat->contact_law = contact_law(TableContact{});
    s.heat->gap_law = gap_law(TableGap{});
    s.heat->families = {{300, Table({0, 1e8}, {500, 2000}), Table({0, 1e-4}, {500, 100})},
                        {900, Table({0, 1e8}, {4000, 9000}), Table({0, 1e-4}, {4000, 200})}};
  } else {
    s.heat->contact_law = contact_law(PowerContact{3000});
  }
  s.friction = FrictionParameters{};
  s.friction->coefficient.terms = {Table(0.2), Table({300, 900}, {0.3, 0.1})};
  s.friction->coefficient.unit = 1e4;
  s.interface_heat_capacity = heat_capacity;
  return s;
}

// The upper block closes the gap on a part of the interface and slides.
std::vector<double> sliding(const mesh::Mesh& mesh) {
  return test::nodal_field(mesh, mesh.dimension, [&](const Point& x, bool upper) {
    std::vector<double> u(static_cast<std::size_t>(mesh.dimension), 0.0);
    if (upper) {
      u[0] = 1e-3;
      u.back() = -1e-4 * std::sin(15 * x[0]);
    }
    return u;
  });
}

std::vector<double> warm(const mesh::Mesh& mesh) {
  return test::nodal_field(mesh, 1, [](const Point& x, bool upper) {
    return std::vector<double>{(upper ? 500.0 : 700.0) + 50 * std::sin(12 * x[0] + 5 * x[1])};
  });
}

void slide(const mesh::Mesh& mesh, ContactPair& pair, std::span<const double> temperature) {
  const std::vector<double> rest(mesh.x.size() * static_cast<std::size_t>(mesh.dimension), 0.0);
  pair.begin({}, {.time = k_dt, .dt = k_dt, .displacement = rest, .temperature = temperature});
  pair.update(sliding(mesh));
}

double tangent_defect(const mesh::Mesh& mesh, linear::Contribution& term, const std::vector<double>& x) {
  linear::NodeGraph graph(mesh);
  term.add_to_graph(graph);
  linear::BlockMatrix matrix(mesh, 1, std::move(graph));
  term.bind(matrix);
  term.add_tangent(x, matrix);
  const double h = 1e-2;
  std::vector<double> d(x.size()), up = x, down = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    d[i] = std::sin(31 * mesh.x[i][0] + 17 * mesh.x[i][1] + 13 * mesh.x[i][2]);
    up[i] += h * d[i];
    down[i] -= h * d[i];
  }
  const auto n = static_cast<std::size_t>(mesh.n_owned_nodes);
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

TEST(FrictionalHeat, HasTheTangentThatFiniteDifferencesShow) {
  for (const Shape shape : {Shape::quad4, Shape::hex8})
    for (const bool nodal : {true, false})
      for (const double capacity : {0.0, 800.0})
        for (const bool of_temperature : {true, false}) {
          const mesh::Mesh mesh = test::two_blocks(shape);
          const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
          ContactPair pair(mesh, kind, rubbing(nodal, capacity, of_temperature));
          slide(mesh, pair, warm(mesh));
          EXPECT_EQ(pair.parts().heat.symmetric(), !of_temperature);
          // Steps of 0.01 K: 1e-8 by curvature, 1e-9 by rounding of what is exchanged.
          EXPECT_LT(tangent_defect(mesh, *pair.parts().heat.term(), warm(mesh)), 1e-7)
              << mesh::name(shape) << nodal << capacity << of_temperature;
        }
}

TEST(LimitedExchange, PassesNoHeatFromColdToHotAndLosesNone) {
  for (const Shape shape : {Shape::quad8, Shape::hex20, Shape::tet10}) {
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    ContactParameters s = rubbing(true, 0, false);
    s.friction.reset();
    s.integration = IntegrationRule::gauss;
    ContactPair pair(mesh, kind, s);
    std::vector<double> temperature = test::nodal_field(
        mesh, 1, [](const Point&, bool upper) { return std::vector<double>{upper ? 500.0 : 700.0}; });
    // One node of the hot body's surface is hotter still, as those are that the consistent form heats.
    double number = -1;
    for (const mesh::ElementBlock& faces : mesh.surfaces.at("lower_top").faces)
      number = std::max(number,
                        static_cast<double>(mesh.global_node[static_cast<std::size_t>(faces.nodes.front())]));
    number = parallel::global_max(number);
    std::vector<char> beyond(mesh.x.size(), 0);
    for (std::size_t i = 0; i < beyond.size(); ++i)
      if (static_cast<double>(mesh.global_node[i]) == number) beyond[i] = 1, temperature[i] = 710;
    slide(mesh, pair, temperature);
    linear::Contribution& term = *pair.parts().heat.term();
    const auto given_off = [&] {
      std::vector<double> r(static_cast<std::size_t>(mesh.n_owned_nodes), 0.0);
      term.add_residual(temperature, r);
      return r;
    };
    const std::vector<double> before = given_off();
    term.limit_exchange(beyond);
    const std::vector<double> after = given_off();
    double sum = 0, size = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (beyond[i]) {
        EXPECT_GT(after[i], 0) << mesh::name(shape) << ": it cools";
      }
      sum += after[i], size += std::abs(after[i]);
    }
    EXPECT_NEAR(parallel::global_sum(sum), 0, 1e-12 * parallel::global_sum(size)) << mesh::name(shape);
    EXPECT_LT(tangent_defect(mesh, term, temperature), 1e-7) << mesh::name(shape);
    term.limit_exchange({});
    EXPECT_EQ(given_off(), before) << mesh::name(shape) << ": as it was";
  }
}

TEST(FrictionalHeat, ReachesTheBodiesButForWhatTheInterfaceStores) {
  for (const bool nodal : {true, false})
    for (const double capacity : {0.0, 800.0})
      for (const Shape shape : {Shape::quad4, Shape::hex8}) {
        const mesh::Mesh mesh = test::two_blocks(shape);
        const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
        ContactPair pair(mesh, kind, rubbing(nodal, capacity, false));
        const std::vector<double> temperature = warm(mesh);
        slide(mesh, pair, temperature);
        double heat = 0, size = 0;
        for (const double q : pair.parts().heat.nodal(temperature)) {
          heat -= q * k_dt;
          size += std::abs(q) * k_dt;
        }
        const InterfaceSums sums = pair.parts().heat.commit(temperature);
        EXPECT_GT(sums.dissipated, 0);
        EXPECT_NE(sums.stored, 0) << "hardening stores entropy";
        EXPECT_NEAR(parallel::global_sum(heat), sums.dissipated - sums.stored,
                    1e-12 * parallel::global_sum(size));
      }
}

TEST(FrictionalHeat, RaisesTheInterfaceAboveBothBodies) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  ContactParameters s = rubbing(true, 0, false);
  s.friction->coefficient.terms = {Table(0.2)};
  ContactPair pair(mesh, AnalysisKind::plane_strain, s);
  const std::vector<double> equal(mesh.x.size(), 400.0);
  slide(mesh, pair, equal);
  pair.parts().heat.commit(equal);
  for (const ContactPointState& point : pair.state().points) {
    // (h_1 + h_2) (Θ_c − Θ) = D with h_1 = h_2 = 2 h.
    if (point.status == PointStatus::open) continue;
    EXPECT_NEAR(point.temperature - 400, point.dissipation / k_dt / (4 * 3000.0), 1e-9 * point.temperature);
  }
}

}  // namespace
}  // namespace solidus::contact
