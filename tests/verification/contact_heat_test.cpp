/// Two bars in thermal contact, against closed forms.
///
///   Θ_hot ├─── lower, k_1, L_1 ───┤ h ├─── upper, k_2, L_2 ───┤ Θ_cold
///
/// Steady flux q = (Θ_hot − Θ_cold)/(L_1/k_1 + 1/h + L_2/k_2), linear temperatures in both bars.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/tabulated.hpp"
#include "contact_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using HeatLaw = contact::HeatTransferSpec;

constexpr double k_hot = 900, k_cold = 300;  // [K]
constexpr double k_l1 = 0.1, k_l2 = 0.2;     // [m]
constexpr double k_k1 = 200, k_k2 = 40;      // [W/(m K)]

heat::ThermalConditions ends(const mesh::Mesh& mesh) {
  const std::string last = mesh.dimension == 2 ? "y" : "z";
  heat::ThermalConditions c;
  c.temperatures.push_back({"hot", "lower_" + last + "_min", k_hot});
  c.temperatures.push_back({"cold", "upper_" + last + "_max", k_cold});
  return c;
}

std::vector<material::Material> bars(double expansion = 0) {
  return {test::elastic(70e9, 0.33, expansion, k_k1), test::elastic(210e9, 0.3, expansion, k_k2)};
}

struct Steady {
  heat::ThermalState state;
  heat::HeatBalance balance;
};
Steady steady(const mesh::Mesh& mesh, AnalysisKind kind, contact::ContactPair& pair,
              heat::HeatIntegration integration = heat::HeatIntegration::closed) {
  heat::HeatOptions options;
  options.integration = integration;
  options.tolerance = 1e-12;
  options.solver = linear::SolverKind::direct;
  heat::ThermalPhase phase(mesh, kind, bars(), ends(mesh), options, {pair.parts().heat.term()});
  Steady result{phase.states().initial(std::vector<double>{600, 600}), {}};
  const heat::ThermalState start = result.state;
  result.balance = phase.solve_steady(start, result.state, 1).balance;
  return result;
}

// Largest deviation of the interface's nodes from the two interface temperatures.
double deviation(const mesh::Mesh& mesh, const heat::ThermalState& state, double lower, double upper) {
  double worst = 0;
  const auto scan = [&](const char* surface, double expected) {
    for (Index n : mesh.surfaces.at(surface).nodes)
      if (n < mesh.n_owned_nodes)
        worst = std::max(worst, std::abs(state.temperature[static_cast<std::size_t>(n)] - expected));
  };
  scan("lower_top", lower);
  scan("upper_bottom", upper);
  return parallel::global_max(worst);
}

contact::ContactParameters conducting(double h) {
  contact::ContactParameters s = test::interface();
  s.heat = HeatLaw{};
  s.heat->contact_law = contact::contact_law(contact::PowerContact{h});
  return s;
}

TEST(TwoBars, InThermalContactHaveTheInterfaceTemperaturesOfTheClosedForm) {
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::quad8, Shape::tet4, Shape::hex8, Shape::hex20})
    for (auto integration : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
      for (auto rule : {contact::IntegrationRule::segments, contact::IntegrationRule::nodal}) {
        // On meshes that do not match, only segments integrate the master's side exactly; the nodal rule is
        // recorded, not required.
        if (rule == contact::IntegrationRule::nodal && integration == heat::HeatIntegration::open) continue;
        const mesh::Mesh mesh = test::two_blocks(shape);
        const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
        contact::ContactParameters spec = conducting(2300);
        spec.integration = rule;
        spec.nodal_heat = integration == heat::HeatIntegration::closed;
        contact::ContactPair pair(mesh, kind, spec, std::vector<double>{70e9, 210e9});
        const Steady found = steady(mesh, kind, pair, integration);
        const double q = (k_hot - k_cold) / (k_l1 / k_k1 + 1 / 2300.0 + k_l2 / k_k2);
        const double worst = deviation(mesh, found.state, k_hot - q * k_l1 / k_k1, k_cold + q * k_l2 / k_k2);
        const std::string name = std::string(mesh::name(shape)) +
                                 (integration == heat::HeatIntegration::closed ? "_closed" : "_open") +
                                 (rule == contact::IntegrationRule::segments ? "_segments" : "_nodal");
        RecordProperty(name, fmt::format("{:.1e}", worst));
        if (rule == contact::IntegrationRule::segments) {
          EXPECT_LT(worst, 1e-6 * k_hot) << name;
          const double area = mesh.dimension == 2 ? 0.3 : 0.06;
          EXPECT_NEAR(contact::sums(pair.view(), found.state.temperature).heat, q * area, 1e-9 * q * area)
              << name;
        }
      }
}

/// Concentric cylinders with gas between them, in a plane, about the axis and in space.
///
///   Q/L = 2π (Θ_hot − Θ_cold)/[ln(r_1/r_0)/k_1 + ln(r_2/r_1)/k_gas + ln(r_3/r_2)/k_2]
///
/// r_2/r_1 = 1.2: a gap taken for plane, k_gas/(r_2 − r_1), would let 9 % less through from the inner face
/// and 10 % more from the outer one.
TEST(ConcentricCylinders, ConductThroughAWideGapAsTheClosedForm) {
  constexpr double k_r0 = 0.08, k_r1 = 0.1, k_r2 = 0.12, k_r3 = 0.15, k_gas = 2.0;  // [m], [W/(m K)]
  constexpr double k_width = 1, k_height = 0.05;
  struct Case {
    Shape shape;
    AnalysisKind kind;
    double share;  ///< of the length 1 and the angle 2π
  };
  for (const Case& c : {Case{Shape::quad4, AnalysisKind::plane_strain, 0.25},
                        Case{Shape::quad4, AnalysisKind::axisymmetric, k_height},
                        Case{Shape::hex8, AnalysisKind::solid, 0.25 * k_height}})
    for (const bool from_outside : {true, false}) {
      const bool solid = mesh::dimension(c.shape) == 3;
      const std::size_t last = solid ? 2 : 1;
      mesh::TwoBlocks blocks{{k_width, k_r1 - k_r0}, {k_width, k_r3 - k_r2}, {24, 6}, {24, 6}, k_r2 - k_r1};
      if (solid)
        blocks = {{k_width, k_height, k_r1 - k_r0},
                  {k_width, k_height, k_r3 - k_r2},
                  {24, 1, 6},
                  {24, 1, 6},
                  k_r2 - k_r1};
      mesh::RawMesh raw = test::raw_blocks(blocks, c.shape);
      for (mesh::Point& x : raw.x) {
        const double radius = k_r0 + x[last], angle = 0.5 * std::numbers::pi * (1 - x[0] / k_width);
        if (c.kind == AnalysisKind::axisymmetric)
          x = {radius, -k_height * x[0] / k_width, 0};
        else
          x = {radius * std::cos(angle), radius * std::sin(angle), solid ? -x[1] : 0.0};
      }
      const mesh::Mesh mesh = test::distribute_blocks(raw);
      contact::ContactParameters spec = conducting(1e9);  // at a gap of zero
      spec.slave = from_outside ? "upper_bottom" : "lower_top";
      spec.master = from_outside ? "lower_top" : "upper_bottom";
      spec.search_distance = 0.05;
      spec.heat->gap_law = contact::gap_law(contact::GasGap{.conductivity = k_gas});
      contact::ContactPair pair(mesh, c.kind, spec, std::vector<double>{70e9, 210e9});
      const Steady found = steady(mesh, c.kind, pair);
      const double resistance =
          std::log(k_r1 / k_r0) / k_k1 + std::log(k_r2 / k_r1) / k_gas + std::log(k_r3 / k_r2) / k_k2;
      const double heat = 2 * std::numbers::pi * (k_hot - k_cold) / resistance * c.share;
      const double flows = (from_outside ? -1 : 1) * contact::sums(pair.view(), found.state.temperature).heat;
      const std::string name = std::string(mesh::name(c.shape)) + (from_outside ? " outer" : " inner") +
                               (c.kind == AnalysisKind::axisymmetric ? " axisymmetric" : "");
      RecordProperty(name, fmt::format("{:.1e}", flows / heat - 1));
      EXPECT_NEAR(flows, heat, 2e-3 * heat) << name;
    }
}

TEST(TwoBars, WithRadiationBesideConductionBalanceTheFourthPowers) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-3);
  contact::ContactParameters spec = conducting(20);
  spec.heat->slave_emissivity = 0.9;
  spec.heat->master_emissivity = 0.7;
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, spec, std::vector<double>{70e9, 210e9});
  const Steady found = steady(mesh, AnalysisKind::plane_strain, pair);
  // Newton for the scalar balance q = h (a − b) + f (a⁴ − b⁴), a = hot − q L_1/k_1, b = cold + q L_2/k_2.
  const double f = k_stefan_boltzmann / (1 / 0.9 + 1 / 0.7 - 1);
  double q = 1e4;
  for (int i = 0; i < 50; ++i) {
    const double a = k_hot - q * k_l1 / k_k1, b = k_cold + q * k_l2 / k_k2;
    const double r = 20 * (a - b) + f * (std::pow(a, 4) - std::pow(b, 4)) - q;
    const double slope = -(20 + 4 * f * a * a * a) * k_l1 / k_k1 - (20 + 4 * f * b * b * b) * k_l2 / k_k2 - 1;
    q -= r / slope;
  }
  const double worst = deviation(mesh, found.state, k_hot - q * k_l1 / k_k1, k_cold + q * k_l2 / k_k2);
  RecordProperty("worst", fmt::format("{:.1e}", worst));
  EXPECT_LT(worst, 1e-6 * k_hot);
}

TEST(TwoBars, WithTablesOfTheTemperatureConductAtItsMeanAcrossTheInterface) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  contact::ContactParameters spec = test::interface();
  spec.heat = HeatLaw{};
  spec.heat->contact_law = contact::contact_law(contact::TableContact{});
  spec.heat->gap_law = contact::gap_law(contact::TableGap{});
  spec.heat->families = {{300, Table(500.0), Table({0, 1e-4}, {500, 100})},
                         {900, Table(4000.0), Table({0, 1e-4}, {4000, 200})}};
  for (const bool nodal : {true, false}) {
    spec.nodal_heat = nodal;
    contact::ContactPair pair(mesh, AnalysisKind::plane_strain, spec, std::vector<double>{70e9, 210e9});
    heat::HeatOptions options;
    options.tolerance = 1e-12;
    options.symmetric = false;
    options.integration = nodal ? heat::HeatIntegration::closed : heat::HeatIntegration::open;
    heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, bars(), ends(mesh), options,
                             {pair.parts().heat.term()});
    heat::ThermalState state = phase.states().initial(std::vector<double>{600, 600});
    const heat::ThermalReport report = phase.solve_steady(heat::ThermalState(state), state, 1);
    EXPECT_LE(report.newton.iterations, 6) << "quadratic, with the exact tangent";
    // q (R_1 + R_2 + 1/h) = ΔΘ with h of the mean of the two interface temperatures, by bisection.
    double low = 0, high = (k_hot - k_cold) / (k_l1 / k_k1 + k_l2 / k_k2);
    for (int i = 0; i < 200; ++i) {
      const double q = 0.5 * (low + high);
      const double a = k_hot - q * k_l1 / k_k1, b = k_cold + q * k_l2 / k_k2;
      const double h = 500 + 3500 * (0.5 * (a + b) - 300) / 600;
      (h * (a - b) < q ? high : low) = q;
    }
    EXPECT_LT(deviation(mesh, state, k_hot - low * k_l1 / k_k1, k_cold + low * k_l2 / k_k2), 1e-6 * k_hot);
    EXPECT_NEAR(contact::sums(pair.view(), state.temperature).heat, low * 0.3, 1e-8 * low * 0.3);
  }
}

// Two bars that expand and close the gap between them. Both stand on rigid ends; sideways they are held, so
// the problem is one-dimensional with the strain ε_y = (1+ν)/(1−ν) α (Θ − Θ_ref) + σ/M, M the oedometer
// modulus. Unknowns q and the pressure p (or the opening g), with h = h_o(g) or h_o(0) + h_co (p/H)^ε.
struct ClosedForm {
  double alpha, gap0, penalty;
  contact::HeatTransferLaw law;
  double q = 0, opening = 0, pressure = 0;

  // Free thermal elongation of both bars for the flux q; their mean temperatures are those at mid length.
  double elongation(double flux) const {
    const double mean1 = k_hot - 0.5 * flux * k_l1 / k_k1, mean2 = k_cold + 0.5 * flux * k_l2 / k_k2;
    return alpha *
           ((1 + 0.33) / (1 - 0.33) * k_l1 * (mean1 - 300) + (1 + 0.3) / (1 - 0.3) * k_l2 * (mean2 - 300));
  }
  void mechanics(double flux) {
    const auto oedometer = [](double e, double nu) { return e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)); };
    const double excess = elongation(flux) - gap0;
    pressure =
        excess > 0 ? excess / (k_l1 / oedometer(70e9, 0.33) + k_l2 / oedometer(210e9, 0.3) + 1 / penalty) : 0;
    opening = excess > 0 ? -pressure / penalty : -excess;
  }
  void solve() {
    // The balance q (R_1 + R_2) + q/h(q) = ΔΘ has one root: bisection.
    double low = 0, high = (k_hot - k_cold) / (k_l1 / k_k1 + k_l2 / k_k2);
    for (int i = 0; i < 200; ++i) {
      q = 0.5 * (low + high);
      mechanics(q);
      const double h = law.at(-opening, pressure, 0.5 * (k_hot + k_cold)).value;
      (q * (k_l1 / k_k1 + k_l2 / k_k2 + 1 / h) > k_hot - k_cold ? high : low) = q;
    }
  }
};

void expand(double gap0, double alpha, bool closes) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, gap0);
  contact::ContactParameters spec = conducting(3000);
  spec.heat->contact_law = contact::contact_law(contact::PowerContact{3000, 0.95, 5e8});
  spec.heat->gap_law = contact::gap_law(contact::GasGap{.conductivity = 0.05, .open_conductance = 1500});
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, spec, std::vector<double>{70e9, 210e9});

  mechanics::MechanicalConditions supports = test::symmetric_supports(2);
  for (const char* side : {"lower_x_max", "upper_x_max"}) supports.displacements.push_back({side, 0, 0.0});
  supports.displacements.push_back({"upper_y_max", 1, 0.0});
  const std::vector<double> cold(mesh.x.size(), 300.0);
  const std::vector<material::Material> materials = bars(alpha);
  mechanics::MechanicalPhase phase(mesh, AnalysisKind::plane_strain, materials, cold, supports,
                                   test::strict_mechanics(), {&pair.parts().forces.term()});
  mechanics::MechanicalState state = phase.initial_state();
  heat::ThermalState thermal;
  double before = 0, flux = 0;
  int passes = 0;
  do {
    thermal = steady(mesh, AnalysisKind::plane_strain, pair).state;
    const mechanics::MechanicalState old = state;
    phase.solve(old, state, thermal.temperature, 1, 1);
    pair.update(state.displacement);
    before = flux;
    flux = contact::sums(pair.view(), thermal.temperature).heat / 0.3;
  } while (std::abs(flux - before) > 1e-11 * std::abs(flux) && ++passes < 200);
  ASSERT_LT(passes, 200);

  ClosedForm exact{alpha, gap0, pair.parts().forces.law().normal.penalty,
                   contact::HeatTransferLaw(*spec.heat)};
  exact.solve();
  EXPECT_EQ(closes, exact.pressure > 0);
  // Opening and pressure are measured against the elongation and the stress that it would take to hold it.
  for (const contact::ContactPointState& point : pair.state().points) {
    EXPECT_NEAR(point.penetration, -exact.opening, 1e-7 * exact.elongation(exact.q));
    EXPECT_NEAR(point.pressure, exact.pressure, 1e-6 * exact.pressure);
  }
  EXPECT_NEAR(flux, exact.q, 1e-6 * exact.q);
  EXPECT_LT(deviation(mesh, thermal, k_hot - exact.q * k_l1 / k_k1, k_cold + exact.q * k_l2 / k_k2),
            1e-6 * k_hot);
  ::testing::Test::RecordProperty("flux", fmt::format("{:.8g} (closed form {:.8g})", flux, exact.q));
  ::testing::Test::RecordProperty("pressure", fmt::format("{:.8g}", exact.pressure));
  ::testing::Test::RecordProperty("opening", fmt::format("{:.8g}", exact.opening));
}

TEST(TwoExpandingBars, ThatStayApartConductThroughTheGasInTheRemainingGap) {
  expand(2.5e-3, 1e-5, false);
}

TEST(TwoExpandingBars, ThatCloseTheirGapPressAndConductAsTheClosedFormSays) {
  expand(2e-4, 1e-5, true);
}

}  // namespace
}  // namespace solidus
