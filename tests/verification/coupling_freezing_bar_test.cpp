/// A bar that freezes from one end and shrinks while it is held in length: how far every scheme lags, and
/// which order in time is left while metal freezes.
///
///   u_x = 0 ┌───┬───┬───┬─ ─ ─┐ u_x = 0     40 mm, 12 quads, free on top; 940 K, melts from 900 to 932 K
///    film → │   │   │   │     │             4 kW/(m² K) of 300 K on the left
///           └───┴───┴───┴─ ─ ─┘ u_y = 0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "casting_bodies.hpp"

namespace solidus {
namespace {

using coupling::PhaseOrder;
using coupling::SimultaneousOptions;
using mechanics::Mapping;
using verification::Coupled;

constexpr double k_end = 16;  // [s], when a third is solid and a third half so

Coupled freezing_bar() {
  Coupled c;
  c.mesh = test::make_mesh({.shape = mesh::Shape::quad4, .cells = {12, 1, 1}, .size = {0.04, 0.01, 1}});
  material::Material melt = verification::casting(0).materials[1];
  melt.liquid_viscosity = 1e7;
  melt.phase_changes[0].volume_change = -0.04;
  c.materials = {melt};
  c.start = {940};
  for (const char* end : {"left", "right"}) c.hold(end, 0);
  c.hold("bottom", 1);
  c.thermal.films.push_back({"chill", "left", {4000.0}, 300.0});
  c.form = mechanics::StructuralForm::energy;
  c.ambient = 300;
  return c;
}

struct Scheme {
  const char* name;
  Mapping mapping = Mapping::isentropic;
  PhaseOrder order = PhaseOrder::heat_first;
  bool double_pass = false, iterates = false, two_stages = false;
  std::optional<heat::ThermalStepping> stepping{};
};
const Scheme k_schemes[] = {
    {.name = "mechanics first", .order = PhaseOrder::mechanics_first},
    {.name = "heat first"},
    {.name = "heat first, sdirk2", .stepping = heat::ThermalStepping::sdirk2},
    {.name = "block-iterative", .iterates = true},
    {.name = "simultaneous", .mapping = Mapping::simultaneous},
    {.name = "simultaneous, sdirk2", .mapping = Mapping::simultaneous, .two_stages = true},
    {.name = "double pass", .double_pass = true}};

coupling::State end_of(const Scheme& s, int n_steps) {
  Coupled c = freezing_bar();
  c.mapping = s.mapping;
  c.order = s.order;
  c.double_pass = s.double_pass;
  c.stepping = s.stepping;
  if (s.iterates) c.iteration.emplace();
  if (s.two_stages) c.simultaneous.integration = SimultaneousOptions::Integration::sdirk2;
  return verification::march(c, k_end, n_steps).end;
}

double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

struct Errors {
  std::vector<double> temperature, displacement;  ///< root of the mean square over the nodes [K], [m]
};

TEST(FreezingBar, LagOfEveryScheme) {
  const std::vector<int> n_steps{16, 32, 64, 128};
  const coupling::State exact = end_of(k_schemes[6], 1024);
  auto out = verification::table("coupling_freezing_bar", "scheme,dt[s],T[K],u[m]");
  std::map<std::string, Errors> errors;
  for (const Scheme& scheme : k_schemes)
    for (const int n : n_steps) {
      const coupling::State end = end_of(scheme, n);
      Errors& e = errors[scheme.name];
      e.temperature.push_back(mean_difference(end.heat.temperature, exact.heat.temperature));
      e.displacement.push_back(mean_difference(end.mechanics.displacement, exact.mechanics.displacement));
      out << scheme.name << "," << k_end / n << "," << e.temperature.back() << "," << e.displacement.back()
          << "\n";
    }
  const auto order = [](const std::vector<double>& e) { return std::log2(e.front() / e.back()) / 3; };
  for (const Scheme& scheme : k_schemes) {
    SCOPED_TRACE(scheme.name);
    const Errors& e = errors[scheme.name];
    // The strain of metal that freezes within a step goes with the mean stiffness of the step: first order,
    // with hardly any error left where the heat is of second order. Heat of two stages passes one kink a
    // node.
    if (scheme.stepping || scheme.double_pass)
      EXPECT_LT(*std::ranges::max_element(e.displacement), 1.2e-6);
    else if (scheme.two_stages)  // with the fractions of the stages' own time
      EXPECT_LT(*std::ranges::max_element(e.displacement), 1.4e-6);
    else
      EXPECT_NEAR(order(e.displacement), 1.1, 0.2);
    if (scheme.stepping || scheme.two_stages || scheme.double_pass)
      EXPECT_GT(order(e.temperature), 1.3);
    else
      EXPECT_NEAR(order(e.temperature), 1, 0.1);
  }
  for (std::size_t i = 0; i < n_steps.size(); ++i) {
    const auto error = [&](const char* name) { return errors[name].displacement[i]; };
    EXPECT_NEAR(error("block-iterative"), error("simultaneous"), 1e-6 * error("simultaneous"));
    // The printed order lags a step; with heat first and in the monolithic schemes what is left is the strain
    // of the step that freezes.
    EXPECT_LT(error("simultaneous"), 0.45 * error("mechanics first"));
    EXPECT_NEAR(error("heat first"), error("simultaneous"), 0.02 * error("simultaneous"));
    EXPECT_LT(error("double pass"), 0.65 * error("simultaneous"));
    EXPECT_LT(errors["double pass"].temperature[i], 0.1 * errors["simultaneous"].temperature[i]);
  }
}

}  // namespace
}  // namespace solidus
