/// Mixed triangles and tetrahedra in the simultaneous scheme: displacement, pressure and temperature by one
/// Newton iteration. A column that freezes (freezing_column.hpp) and a block that is chilled and flows: the
/// solution is the one on which the passes of the block-iterative scheme agree, the isentropic split tends to
/// it with the step, two stages are of second order, and the first law closes.
#include <gtest/gtest.h>

#include "freezing_column.hpp"

namespace solidus {
namespace {

using coupling::SimultaneousOptions;
using mechanics::Mapping;
using verification::Coupled;
using verification::CoupledRun;
using verification::Element;

const Element k_elements[] = {verification::k_tri3, verification::k_tri3_algebraic, verification::k_tet4,
                              verification::k_tet4_algebraic};

bool is_solid(const Element& element) {
  return mesh::dimension(element.shape) == 3;
}

/// A bar of steel, 100 × 50 × 50 mm, between two walls, that is quenched from the top: it flows plastically.
Coupled quenched(const Element& element) {
  Coupled c;
  const bool solid = is_solid(element);
  c.mesh = test::make_mesh({.shape = element.shape,
                            .cells = {solid ? 4 : 6, solid ? 3 : 4, 2},
                            .size = {0.1, 0.05, 0.05},
                            .distortion = 0.1});
  c.kind = solid ? AnalysisKind::solid : AnalysisKind::plane_strain;
  material::Material m = verification::plastic_material(2e11, 0.3, Table({300, 900}, {250e6, 60e6}), 1.3e-5);
  m.density = 7800;
  m.conductivity = 40.0;
  m.specific_heat = 600.0;
  m.young_modulus = Table({300, 900}, {2e11, 1.2e11});
  c.materials = {m};
  c.start = {900};
  c.form = mechanics::StructuralForm::energy;
  c.mechanics_tolerance = 1e-9;
  c.simplices = element.simplices;
  c.stabilisation = element.stabilisation;
  for (const char* wall : {"left", "right"}) c.hold(wall, 0);
  c.hold("bottom", 1);
  if (solid) c.hold("back", 2);
  c.thermal.films.push_back({"quench", "top", {3000.0}, 300.0});
  return c;
}

/// The largest differences of two states, in parts of the largest change from `start` [K] and displacement.
struct Difference {
  double temperature = 0, displacement = 0, pressure = 0;
};
Difference difference(const coupling::State& a, const coupling::State& b, double start) {
  const auto compare = [](const std::vector<double>& x, const std::vector<double>& y, double zero) {
    double size = 0, left = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      size = std::max(size, std::abs(y[i] - zero));
      left = std::max(left, std::abs(x[i] - y[i]));
    }
    return left / size;
  };
  return {compare(a.heat.temperature, b.heat.temperature, start),
          compare(a.mechanics.displacement, b.mechanics.displacement, 0),
          compare(a.mechanics.pressure, b.mechanics.pressure, 0)};
}

Coupled simultaneous(Coupled c, SimultaneousOptions options = {}) {
  c.mapping = Mapping::simultaneous;
  c.simultaneous = options;
  return c;
}

TEST(SimplexSimultaneous, FreezesAColumnAsThePassesOfTheBlockIterativeSchemeAgree) {
  for (const Element& element : k_elements) {
    SCOPED_TRACE(element.name);
    constexpr int n_steps = 12;
    constexpr double end = 60;
    Coupled passes = verification::freezing_column(
        element, Mapping::isentropic, is_solid(element) ? std::array{2, 5, 2} : std::array{3, 8, 1});
    passes.mechanics_tolerance = 1e-9;
    const CoupledRun at_once = verification::march(simultaneous(passes), end, n_steps);
    passes.iteration.emplace();
    const CoupledRun in_turn = verification::march(passes, end, n_steps);
    const Difference d = difference(at_once.end, in_turn.end, verification::k_poured_at);
    printf("column, %-16s: temperature %.1e, displacement %.1e, pressure %.1e; first law %.1e\n",
           element.name, d.temperature, d.displacement, d.pressure,
           at_once.worst_defect() / at_once.exchanged());
    EXPECT_LT(d.temperature, 1e-6);
    EXPECT_LT(d.displacement, 1e-6);
    EXPECT_LT(d.pressure, 1e-4);  // of what the shell's thermal stress leaves
    EXPECT_LT(at_once.worst_defect(), 1e-8 * at_once.exchanged());
  }
}

TEST(SimplexSimultaneous, IsWhatTheIsentropicSplitTendsTo) {
  for (const Element& element : k_elements) {
    SCOPED_TRACE(element.name);
    std::vector<double> left;
    for (const int n_steps : {8, 16}) {
      Coupled split = quenched(element);
      split.mapping = Mapping::isentropic;
      const CoupledRun at_once = verification::march(simultaneous(split), 16, n_steps);
      const CoupledRun in_turn = verification::march(split, 16, n_steps);
      left.push_back(difference(at_once.end, in_turn.end, 900).displacement);
      double plastic = 0;
      for (const auto& step : at_once.steps) plastic += step.plastic_work;
      EXPECT_GT(plastic, 0);
      EXPECT_LT(at_once.worst_defect(), 1e-8 * at_once.exchanged());
    }
    printf("block, %-16s: displacement of the split off by %.1e, with half the step %.1e\n", element.name,
           left[0], left[1]);
    EXPECT_LT(left[1], 0.7 * left[0]);
    EXPECT_LT(left[1], 0.06);
  }
}

TEST(SimplexSimultaneous, ClosesTheFirstLawInTwoStages) {
  for (const Element& element : k_elements) {
    SCOPED_TRACE(element.name);
    const CoupledRun run = verification::march(
        simultaneous(quenched(element), {.integration = SimultaneousOptions::Integration::sdirk2}), 16, 6);
    EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged());
  }
}

}  // namespace
}  // namespace solidus
