/// The latent heat released is L ρ V whatever the step and the freezing range; how many solves a step takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "material/cards/library.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

struct Result {
  double latent_error = 0;   ///< released over L ρ V, minus one
  double balance_error = 0;  ///< heat out over heat stored, minus one
  int worst = 0;             ///< linear solves of the worst step
  double mean = 0;
};

/// A plate of 60 mm × 1.5 mm cells cools through one side until it is cold.
Result freeze(const material::Material& m, double start, double dt, heat::HeatIntegration rule) {
  const mesh::Mesh mesh = verification::block(mesh::Shape::quad4, {0.06, 0.0015}, {40, 1});
  heat::ThermalConditions conditions;
  conditions.films.push_back({"chill", "x_min", {Table(5000.0), false}, Table(350.0)});
  heat::HeatOptions options;
  options.integration = rule;
  options.tolerance = 1e-12;
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {m}, conditions, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{start});
  Result result;
  double latent = 0, stored = 0, in = 0;
  int steps = 0;
  while (phase.states().mean_solid_fraction(state) < 1.0 && steps < 5000) {
    ++steps;
    const heat::ThermalReport report = phase.solve(state, state, steps * dt, dt);
    latent -= report.balance.latent;
    stored += report.balance.stored;
    in += report.balance.heat_in();
    result.worst = std::max(result.worst, report.newton.iterations);
    result.mean += report.newton.iterations;
  }
  result.mean /= steps;
  double expected = 0;
  for (const material::PhaseChange& change : m.phase_changes)
    expected += m.density * change.latent_heat * 0.06 * 0.0015;
  result.latent_error = std::abs(latent / expected - 1);
  result.balance_error = std::abs(in / stored - 1);
  return result;
}

material::Material metal(double range) {
  material::Material m;
  m.name = "metal";
  m.density = 2500;
  m.conductivity = Table(100.0);
  m.specific_heat = Table(1000.0);  // latent heat: 280 times the sensible heat of a kelvin
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(900 - range, 900), 2.8e5, 0.0, true}};
  return m;
}

TEST(LatentHeat, IsReleasedToRoundingForEveryStepAndFreezingRange) {
  std::ofstream table = verification::csv(
      "latent_heat", "rule,range[K],dt[s],latent_error[1],balance_error[1],worst_solves,mean_solves");
  for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
    for (const double range : {0.0, 1.0, 40.0})
      for (const double dt : {0.05, 0.5, 5.0, 50.0, 1e3, 1e6}) {
        const Result r = freeze(metal(range), 920, dt, rule);
        table << (rule == heat::HeatIntegration::closed ? "closed," : "open,") << range << ',' << dt << ','
              << r.latent_error << ',' << r.balance_error << ',' << r.worst << ',' << r.mean << '\n';
        EXPECT_LE(r.latent_error, 1e-10) << range << " " << dt;
        // Over 1e6 s one rounding error of the surface's temperature, 1e-13 K, is already 2e-9 of the heat.
        EXPECT_LE(r.balance_error, dt > 1e5 ? 1e-8 : 1e-10) << range << " " << dt;
      }
}

TEST(LatentHeat, OfTheLibrarysAluminiumNeedsFewSolves) {
  const material::Material aluminium =
      material::load_material(std::string(SOLIDUS_SOURCE_DIR) + "/materials/aluminium_99_7.toml");
  std::ofstream table = verification::csv("aluminium_solves", "dt[s],worst_solves,mean_solves");
  for (const double dt : {0.1, 1.0, 10.0}) {
    const Result r = freeze(aluminium, 943.15, dt, heat::HeatIntegration::closed);
    table << dt << ',' << r.worst << ',' << r.mean << '\n';
    EXPECT_LE(r.latent_error, 1e-10);
    EXPECT_LE(r.worst, 12);
  }
}

}  // namespace
}  // namespace solidus
