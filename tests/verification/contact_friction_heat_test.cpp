/// Heat of friction between two bodies that slide, with the temperature Θ_c of their interface.
///
///              ───► v, pressed by δ
///   ┌──────────────────────────┐
///   │ upper, e_2               │    All nodes of the upper body move with v, those of the lower one stand
///   ├──────────────────────────┤    still; along y both are free but for their ends, so pressure and
///   │ lower, e_1               │    friction are uniform and heat flows in one dimension.
///   └──────────────────────────┘
///
/// Two half spaces that rub with the power q and share one temperature at the interface: it rises by
/// 2 q √(t/π)/(e_1 + e_2), and they take the heat in the ratio of their effusivities e = √(k ρ c) (Carslaw
/// and Jaeger 1959, 2.9; Jaeger 1942).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/laws/power_contact.hpp"
#include "contact_bodies.hpp"
#include "coupling_bodies.hpp"
#include "csv.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;

constexpr double k_width = 0.01, k_length = 0.05;  // [m]
constexpr double k_speed = 0.1;                    // [m/s]
constexpr double k_capacity = 7800.0 * 500.0;      // of test::elastic [J/(m³ K)]

contact::ContactParameters rubbing(double conductance) {
  contact::ContactParameters s = test::interface();
  s.heat = contact::HeatTransferSpec{};
  s.heat->contact_law = contact::contact_law(contact::PowerContact{conductance});
  s.friction = contact::FrictionParameters{};
  s.friction->coefficient.terms = {Table(0.3)};
  return s;
}

Coupled sliding(int elements, double k1, double k2, double start, double end) {
  Coupled c;
  c.mesh = test::distribute_blocks(test::raw_blocks(
      {{k_width, k_length}, {k_width, k_length}, {2, elements}, {2, elements}, 0.0}, mesh::Shape::quad4));
  c.materials = {test::elastic(2e11, 0.0, 0, k1), test::elastic(2e11, 0.0, 0, k2)};
  c.start = {start, start};
  c.hold("lower", 0);
  c.hold("upper", 0, Table({0, end}, {0, k_speed * end}));
  c.hold("lower_y_min", 1);
  c.hold("upper_y_max", 1, -2e-5);
  return c;
}

// Heat content over the start of one body, by its nodes [J/m].
double warmed(const Coupled& c, const char* body, const std::vector<double>& temperature, double start) {
  double sum = 0;
  std::vector<char> inside(c.mesh.x.size(), 0);
  for (const Index n : c.mesh.node_sets.at(body)) inside[static_cast<std::size_t>(n)] = 1;
  for (const mesh::ElementBlock& block : c.mesh.blocks)
    for (Index e = 0; e < block.n_counted; ++e) {
      const Index* nodes = block.element(e);
      if (inside[static_cast<std::size_t>(nodes[0])] == 0) continue;
      const auto& a = c.mesh.x[static_cast<std::size_t>(nodes[0])];
      const auto& b = c.mesh.x[static_cast<std::size_t>(nodes[2])];
      double mean = 0;
      for (int i = 0; i < 4; ++i) mean += 0.25 * temperature[static_cast<std::size_t>(nodes[i])];
      sum += std::abs((b[0] - a[0]) * (b[1] - a[1])) * k_capacity * (mean - start);
    }
  return parallel::global_sum(sum);
}

double surface(const mesh::Mesh& mesh, const char* name, const std::vector<double>& temperature) {
  double sum = 0, n = 0;
  for (const Index node : mesh.surfaces.at(name).nodes)
    if (node < mesh.n_owned_nodes) {
      sum += temperature[static_cast<std::size_t>(node)];
      n += 1;
    }
  return parallel::global_sum(sum) / parallel::global_sum(n);
}

// A scheme of the run: a split, both fields at once in one stage or two, or the double pass.
struct Scheme {
  const char* name;
  Mapping mapping = Mapping::isothermal;
  bool two_stages = false, double_pass = false;
  coupling::PhaseOrder order = coupling::PhaseOrder::mechanics_first;

  void set(Coupled& c) const {
    c.mapping = mapping;
    c.double_pass = double_pass;
    c.order = order;
    if (mapping != Mapping::isothermal) c.form = StructuralForm::energy;
    if (two_stages) c.simultaneous.integration = coupling::SimultaneousOptions::Integration::sdirk2;
  }
};
constexpr Scheme k_split{""}, k_together{"_together", Mapping::simultaneous},
    k_two_stages{"_two_stages", Mapping::simultaneous, true},
    k_double_pass{"_double_pass", Mapping::isentropic, false, true},
    k_heat_first{"_heat_first", Mapping::isentropic, false, false, coupling::PhaseOrder::heat_first};

/// @param off     share by which the surfaces may be warmer or colder than the closed form
/// @param shared  share by which the heats may be divided otherwise
void flash(const Scheme& scheme, double off = 1e-2, double shared = 5e-3) {
  SCOPED_TRACE(scheme.name);
  const double k1 = 160, k2 = 40, start = 300, end = 1;  // diffusion lengths of 6 and 3 mm
  Coupled c = sliding(100, k1, k2, start, end);
  c.contact = rubbing(1e8);
  scheme.set(c);
  const double e1 = std::sqrt(k1 * k_capacity), e2 = std::sqrt(k2 * k_capacity);
  double power = 0, time = 0, worst = 0, dissipated = 0;
  auto file =
      verification::csv(std::string("contact_flash") + scheme.name, "time[s],lower[K],upper[K],exact[K]");
  const auto run = verification::march(c, end, 200, [&](const coupling::State& state, const auto& effort) {
    power = effort.energy.interface.dissipated / (state.time - time) / k_width;
    dissipated += effort.energy.interface.dissipated;
    time = state.time;
    const double exact = start + 2 * power * std::sqrt(time / std::numbers::pi) / (e1 + e2);
    const double lower = surface(c.mesh, "lower_top", state.heat.temperature);
    const double upper = surface(c.mesh, "upper_bottom", state.heat.temperature);
    file << time << ',' << lower << ',' << upper << ',' << exact << '\n';
    if (time > 0.2)
      worst = std::max(
          {worst, std::abs(lower - exact) / (exact - start), std::abs(upper - exact) / (exact - start)});
  });
  const double pressure = 2e11 * 2e-5 / (2 * k_length);
  EXPECT_NEAR(power, 0.3 * pressure * k_speed, 0.1 * power)
      << "mu p v; the penalty takes part of the approach";
  const double lower = warmed(c, "lower", run.end.heat.temperature, start);
  const double upper = warmed(c, "upper", run.end.heat.temperature, start);
  ::testing::Test::RecordProperty(std::string("flash") + scheme.name, fmt::format("{:.2e}", worst));
  ::testing::Test::RecordProperty(std::string("ratio") + scheme.name,
                                  fmt::format("{:.5f}, closed form {:.5f}", lower / upper, e1 / e2));
  // The energy form also has as heat what backward Euler loses of the elastic work in the first step.
  const double stress = power / (0.3 * k_speed);
  const double lost = c.form ? 0.5 * stress * stress / 2e11 * 2 * k_length * k_width : 0;
  EXPECT_NEAR(lower + upper, dissipated + lost, (c.form ? 1e-6 : 1e-9) * dissipated)
      << "all of it reaches the bodies";
  // Backward Euler of 200 steps and elements of 0.5 mm against diffusion lengths of 3 to 6 mm.
  EXPECT_NEAR(lower / upper, e1 / e2, shared * e1 / e2);
  EXPECT_LT(worst, off);
}

TEST(FrictionHeat, IsSharedByHalfSpacesAsTheirEffusivitiesAndFlashesAsTheClosedForm) {
  flash(k_split);
}

TEST(FrictionHeat, DoesSoWithTheOtherSchemes) {
  for (const Scheme& scheme : {k_together, k_two_stages, k_double_pass}) flash(scheme);
}

// The heat of a step lies in the surfaces when it ends: the closed form is left by more than with the other
// order, which is therefore taken where bodies rub and nothing melts.
TEST(FrictionHeat, OfAStepStaysInTheSurfaceWhereHeatComesFirst) {
  flash(k_heat_first, 0.2, 1e-2);
}

TEST(FrictionHeat, GoesHalfAndHalfWhereTheInterfaceResistsMoreThanTheBodies) {
  Coupled c = sliding(20, 160, 40, 300, 0.05);
  c.contact = rubbing(1);
  const auto run = verification::march(c, 0.05, 5);
  const double lower = warmed(c, "lower", run.end.heat.temperature, 300);
  const double upper = warmed(c, "upper", run.end.heat.temperature, 300);
  EXPECT_NEAR(lower, upper, 1e-3 * upper) << "h_1 = h_2";
}

// Without a store the sides get the heat as h_1 : h_2 (3.45), h_1 = h/s and h_2 = h/(1 − s).
TEST(FrictionHeat, IsDividedAsTheOneSidedConductances) {
  Coupled c = sliding(20, 160, 40, 300, 0.05);
  c.contact = rubbing(1);
  c.contact->heat->slave_resistance = 0.2;
  const auto run = verification::march(c, 0.05, 5);
  const double slave =
      warmed(c, c.contact->slave == "lower_top" ? "lower" : "upper", run.end.heat.temperature, 300);
  const double all =
      warmed(c, "lower", run.end.heat.temperature, 300) + warmed(c, "upper", run.end.heat.temperature, 300);
  EXPECT_NEAR(slave / all, 0.8, 1e-3);
}

// A coefficient that hardens, the less the hotter; heat capacity in the interface.
contact::ContactParameters hardening(double heat_capacity) {
  contact::ContactParameters s = rubbing(2e4);
  s.friction->coefficient.terms = {Table(0.05), Table({300, 900}, {0.7, 0.1})};
  s.friction->coefficient.unit = 2e5;  // of the order of the normal work of a run
  s.interface_heat_capacity = heat_capacity;
  return s;
}

Coupled hardening_run(Mapping mapping, bool nodal, double heat_capacity) {
  Coupled c = sliding(10, 40, 20, 600, 0.1);
  c.mapping = mapping;
  c.form = StructuralForm::entropy;
  c.ambient = 300;
  c.integration = nodal ? heat::HeatIntegration::closed : heat::HeatIntegration::open;
  c.contact = hardening(heat_capacity);
  c.contact->nodal_heat = nodal;
  return c;
}

TEST(FrictionHeat, ClosesTheFirstLawAndNeverDissipatesLessThanNothing) {
  for (const bool nodal : {true, false})
    for (const double capacity : {0.0, 500.0})
      for (const Mapping mapping : {Mapping::isothermal, Mapping::isentropic}) {
        const Coupled c = hardening_run(mapping, nodal, capacity);
        double heat = 0;
        const auto run = verification::march(c, 0.1, 20, [&](const coupling::State&, const auto& effort) {
          heat += effort.energy.interface.dissipated;
          EXPECT_GE(effort.energy.interface.dissipated, 0);
          EXPECT_GE(effort.energy.interface.plastic_entropy, 0);
        });
        ASSERT_GT(heat, 0);
        // The first step also puts the pressure on at once, of whose work backward Euler loses half.
        for (std::size_t n = 1; n < run.steps.size(); ++n)
          EXPECT_LT(std::abs(run.steps[n].defect()), 1e-8 * run.steps[n].heat_exchanged)
              << nodal << ' ' << capacity << ", step " << n;
      }
}

TEST(FrictionHeat, ClosesTheFirstLawWithTheOtherSchemes) {
  for (const Scheme& scheme : {k_together, k_two_stages, k_double_pass, k_heat_first})
    for (const double capacity : {0.0, 500.0}) {
      Coupled c = hardening_run(scheme.mapping, true, capacity);
      c.materials = {test::elastic(2e11, 0.3, 1.2e-5, 40), test::elastic(2e11, 0.3, 1.2e-5, 20)};
      scheme.set(c);
      c.ambient.reset();
      double heat = 0, stored = 0;
      const auto run = verification::march(c, 0.1, 20, [&](const coupling::State&, const auto& effort) {
        heat += effort.energy.frictional_heat;
        stored += effort.energy.interface.stored;
        EXPECT_GE(effort.energy.interface.dissipated, 0);
        EXPECT_GE(effort.energy.interface.plastic_entropy, 0);
        EXPECT_NEAR(effort.energy.frictional_heat, effort.energy.friction, 1e-9 * effort.energy.friction);
      });
      ASSERT_GT(heat, 0);
      if (capacity > 0) {
        EXPECT_GT(stored, 0);
      }
      for (std::size_t n = 1; n < run.steps.size(); ++n)
        EXPECT_LT(std::abs(run.steps[n].defect()),
                  1e-8 * std::max(run.steps[n].heat_exchanged, run.steps[n].friction))
            << scheme.name << ' ' << capacity << ", step " << n;
    }
}

TEST(FrictionHeat, OfTemperatureDependentHardeningKeepsTheEstimateWithIsentropicPhasesOnly) {
  auto file = verification::csv("contact_lyapunov",
                                "step,isothermal_mechanical[J/m],isothermal_thermal[J/"
                                "m],isentropic_mechanical[J/m],isentropic_thermal[J/m]");
  const auto isothermal = verification::march(hardening_run(Mapping::isothermal, true, 500), 0.1, 20);
  const auto isentropic = verification::march(hardening_run(Mapping::isentropic, true, 500), 0.1, 20);
  int grows = 0;
  for (std::size_t n = 0; n < isothermal.stability.size(); ++n) {
    const auto &a = isothermal.stability[n], &b = isentropic.stability[n];
    file << n + 1 << ',' << a.mechanical << ',' << a.thermal << ',' << b.mechanical << ',' << b.thermal
         << '\n';
    if (a.mechanical > 10 * a.tolerance) ++grows;
    EXPECT_LE(b.mechanical, b.tolerance) << "5.9a, step " << n;
    EXPECT_LE(b.increment(), b.tolerance) << "of both phases, step " << n;
    // The thermal phase gives back at most the share 1 − Θ_a/Θ_c of the dissipation.
    EXPECT_LE(b.thermal, isentropic.steps[n].interface.dissipated) << "step " << n;
  }
  RecordProperty("steps_that_grow", grows);
  EXPECT_GE(grows, 5) << "5.13a";
}

/// μ falls with the temperature of the interface and hardens, the less the hotter; metal that expands.
Coupled softening_run(Mapping mapping, double heat_capacity) {
  Coupled c = hardening_run(mapping, true, heat_capacity);
  c.materials = {test::elastic(2e11, 0.3, 1.2e-5, 40), test::elastic(2e11, 0.3, 1.2e-5, 20)};
  for (material::Material& m : c.materials) m.expansion_reference = 600;
  c.contact->friction->coefficient.terms = {Table({300, 900}, {0.45, 0.05}), Table({300, 900}, {0.2, 0.1})};
  c.form = StructuralForm::energy;
  c.ambient.reset();
  return c;
}

struct Interface {
  double temperature = 0, work = 0, traction = 0;  ///< means over the points: Θ_c, ζ_c, ‖T‖
};
Interface interface_of(const coupling::State& state) {
  Interface mean;
  const auto& points = state.contacts.at(0).points;
  for (const contact::ContactPointState& point : points) {
    const double share = 1.0 / static_cast<double>(points.size());
    mean.temperature += share * point.temperature;
    mean.work += share * point.internal_variable;
    mean.traction += share * contact::norm(point.traction);
  }
  return mean;
}

// What the passes agree on is the pair of equations 5.40 with the momentum and the heat of t_{n+1}.
TEST(FrictionHeat, OfBlockIterativePassesIsThatOfTheSimultaneousSolution) {
  for (const double capacity : {0.0, 500.0}) {
    Coupled at_once = softening_run(Mapping::simultaneous, capacity);
    const auto expected = verification::march(at_once, 0.1, 10);
    const Interface right = interface_of(expected.end);
    const Interface start =
        interface_of(verification::march(softening_run(Mapping::simultaneous, capacity), 0.01, 1).end);
    ASSERT_GT(std::abs(right.temperature - start.temperature), 5) << "the coefficient follows";
    for (const Mapping passes : {Mapping::isothermal, Mapping::isentropic})
      for (const auto sweep :
           {coupling::IterationOptions::Sweep::gauss_seidel, coupling::IterationOptions::Sweep::jacobi}) {
        Coupled c = softening_run(passes, capacity);
        c.iteration.emplace();
        c.iteration->sweep = sweep;
        c.iteration->tolerance = 1e-10;
        double most = 0;
        const auto run = verification::march(c, 0.1, 10, [&](const coupling::State&, const auto& effort) {
          most = std::max<double>(most, effort.coupling_iterations);
        });
        const Interface found = interface_of(run.end);
        const std::string name = fmt::format(
            "{}, {} passes, {}", capacity, passes == Mapping::isothermal ? "isothermal" : "isentropic",
            sweep == coupling::IterationOptions::Sweep::jacobi ? "Jacobi" : "Gauss-Seidel");
        RecordProperty(name, fmt::format("{:.1e} K, {:.1e} of the traction, {} iterations",
                                         std::abs(found.temperature - right.temperature),
                                         std::abs(found.traction / right.traction - 1), most));
        EXPECT_NEAR(found.temperature, right.temperature, 1e-7 * right.temperature) << name;
        EXPECT_NEAR(found.traction, right.traction, 1e-7 * right.traction) << name;
        EXPECT_NEAR(found.work, right.work, 1e-7 * right.work) << name;
        for (std::size_t i = 0; i < expected.end.heat.temperature.size(); ++i)
          EXPECT_NEAR(run.end.heat.temperature[i], expected.end.heat.temperature[i], 1e-4) << name;
        for (std::size_t n = 1; n < run.steps.size(); ++n)
          EXPECT_LT(std::abs(run.steps[n].defect()), 1e-8 * run.steps[n].heat_exchanged) << name << n;
      }
  }
}

// 5.40–5.51 in the thermal phase of a split: the traction at the end of a step is μ(ζ_c, Θ_c) t_N with the
// Θ_c of that end, in one stage and in two; kept slip leaves the μ of the step before.
TEST(FrictionHeat, OfThermalReturnMappingsBelongsToTheTemperatureOfItsStep) {
  const Interface right =
      interface_of(verification::march(softening_run(Mapping::simultaneous, 500), 0.1, 10).end);
  for (const Mapping mapping : {Mapping::isothermal, Mapping::isentropic})
    for (const auto stepping : {heat::ThermalStepping::backward_euler, heat::ThermalStepping::sdirk2}) {
      double off_kept = 0, error_kept = 0;
      for (const bool anew : {false, true}) {
        Coupled c = softening_run(mapping, 500);
        c.stepping = stepping;
        c.contact->friction->thermal_return_mapping = anew;
        double off = 0, lost = 0, heat = 0;
        const contact::FrictionLaw law(*c.contact->friction, 1.0, 500);
        const auto run =
            verification::march(c, 0.1, 10, [&](const coupling::State& state, const auto& effort) {
              for (const contact::ContactPointState& point : state.contacts.at(0).points) {
                if (point.status != contact::PointStatus::slips) continue;
                const double mu = law.coefficient().value(point.internal_variable, point.temperature).value;
                off = std::max(off, std::abs(contact::norm(point.traction) / (mu * point.pressure) - 1));
              }
              lost += effort.energy.friction - effort.energy.frictional_heat;
              heat += effort.energy.frictional_heat;
            });
        const Interface found = interface_of(run.end);
        const double error = std::abs(found.traction / right.traction - 1);
        RecordProperty(fmt::format("{}_{}_{}", mapping == Mapping::isothermal ? "isothermal" : "isentropic",
                                   stepping == heat::ThermalStepping::sdirk2 ? "two_stages" : "one_stage",
                                   anew ? "anew" : "kept"),
                       fmt::format("off the surface {:.1e}, traction off {:.1e}, lost {:.1e} of the heat",
                                   off, error, lost / heat));
        ASSERT_GT(heat, 0);
        if (anew) {
          EXPECT_LT(off, 1e-9);
          EXPECT_GT(off_kept, 1e-3);
          EXPECT_LT(error, 0.5 * error_kept) << "of the simultaneous solution";
          EXPECT_LT(std::abs(lost), 0.05 * heat) << "of first order in the step";
        } else {
          off_kept = off;
          error_kept = error;
          EXPECT_LT(std::abs(lost), 1e-9 * heat);
        }
        // What the nodes and the interface take up is what the thermal phase has dissipated.
        for (std::size_t n = 1; n < run.steps.size(); ++n)
          EXPECT_LT(std::abs(run.steps[n].defect()), 1e-8 * run.steps[n].heat_exchanged) << n;
      }
    }
}

// With heat first the bodies and the interface exchange heat in the first solve, where nothing moves.
TEST(FrictionHeat, ThatAnInterfaceStoresReachesTheBodiesInBothOrders) {
  std::vector<double> temperature;
  for (const auto order : {coupling::PhaseOrder::mechanics_first, coupling::PhaseOrder::heat_first}) {
    Coupled c = softening_run(Mapping::isentropic, 500);
    c.order = order;
    temperature.push_back(interface_of(verification::march(c, 0.1, 80).end).temperature);
  }
  EXPECT_NEAR(temperature[0], temperature[1], 0.1 * (temperature[0] - 600));
}

}  // namespace
}  // namespace solidus
