/// A column of melt under its own weight between smooth walls:
///
///   ▒│≈≈≈≈│▒   p = ρ g (H − y),   u_y = −ρ g/k (H y − y²/2),   nothing else moves
///   ▒│    │▒
///   ▒│    │▒   The only strain is that of the compressed melt, ρ g H/k = 1e-7; a shear strain of the size
///   ▒└────┘▒   of ρ g h Δt/η would be the element's, and there is no bound to it for a thin melt.
#include <gtest/gtest.h>

#include "material/melt.hpp"
#include "material/permeability.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/pores.hpp"
#include "simplex_bodies.hpp"

namespace solidus {
namespace {

using mesh::Point;
using test::Body;
using test::Lattice;
using verification::Element;

constexpr double k_height = 0.2, k_width = 0.1;  // [m]
constexpr double k_density = 2400, k_gravity = 9.81;
constexpr double k_young = 7e10, k_poisson = 0.33;
constexpr double k_bulk = k_young / (3 * (1 - 2 * k_poisson));
constexpr double k_weight = k_density * k_gravity;  // [N/m³]

material::Material melt(double viscosity) {
  material::Material m = test::elastic_material(k_young, k_poisson);
  m.density = k_density;
  m.liquid_viscosity = viscosity;
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(800, 900),
                             .latent_heat = 4e5,
                             .solidification = true});
  return m;
}

struct Errors {
  double pressure;      ///< largest, over that at the bottom
  double displacement;  ///< largest, over the sinking of the surface
  int iterations;       ///< of all steps
};

Errors rest(const Element& element, AnalysisKind kind, double viscosity, mechanics::Mapping mapping) {
  const bool solid = kind == AnalysisKind::solid;
  const int n = solid ? 4 : 6;
  Lattice lattice{.shape = element.shape,
                  .cells = {n, 2 * n, n},
                  .size = {k_width, k_height, k_width},
                  .distortion = 0.15};
  Body body(lattice, kind, melt(viscosity));
  body.initial_temperature.assign(body.mesh.x.size(), 950.0);
  body.temperature = body.initial_temperature;
  element.choose(body.options);
  body.options.mapping = mapping;
  for (const char* wall : {"left", "right"}) body.hold(wall, 0);
  body.hold("bottom", 1);
  if (solid)
    for (const char* wall : {"back", "front"}) body.hold(wall, 2);
  body.conditions.gravity = {0, -k_gravity, 0};

  test::Solved solved(body);
  Errors errors{0, 0, solved.report.newton.iterations};
  for (int step = 2; step <= 5; ++step) {
    solved.step(body, step, 1.0);
    errors.iterations += solved.report.newton.iterations;
  }
  const verification::Cells cells(body.mesh, body.mesh.blocks[0], kind);
  const std::vector<double> pressure = test::element_fields(solved)[0].pressure;
  for (std::size_t e = 0; e < pressure.size(); ++e)
    errors.pressure = std::max(errors.pressure,
                               std::abs(pressure[e] / k_weight - (k_height - cells.centre[e][1])) / k_height);
  const double sinking = k_weight / k_bulk * k_height * k_height / 2;
  const auto components = static_cast<std::size_t>(displacement_components(kind));
  for (std::size_t node = 0; node < body.mesh.x.size(); ++node)
    for (std::size_t i = 0; i < components; ++i) {
      const double y = body.mesh.x[node][1];
      const double exact = i == 1 ? -k_weight / k_bulk * (k_height * y - y * y / 2) : 0;
      errors.displacement = std::max(
          errors.displacement, std::abs(solved.state.displacement[node * components + i] - exact) / sinking);
    }
  return errors;
}

struct Choice {
  Element element;
  AnalysisKind kind;
};

TEST(MeltColumn, OfStabilisedSimplicesCarriesTheHydrostaticPressureAndStaysAtRest) {
  const std::vector<Choice> choices{{verification::k_tri3, AnalysisKind::plane_strain},
                                    {verification::k_tri3, AnalysisKind::axisymmetric},
                                    {verification::k_tri3_algebraic, AnalysisKind::plane_strain},
                                    {verification::k_tri3_algebraic, AnalysisKind::axisymmetric},
                                    {verification::k_tet4, AnalysisKind::solid},
                                    {verification::k_tet4_algebraic, AnalysisKind::solid}};
  for (const mechanics::Mapping mapping : {mechanics::Mapping::isothermal, mechanics::Mapping::isentropic})
    for (const double viscosity : {1.0, 1e3, 1e6, 1e9})
      for (const Choice& c : choices) {
        const Errors e = rest(c.element, c.kind, viscosity, mapping);
        printf("%-10s eta %.0e Pa s, %-16s %-12s pressure %.1e, displacement %.1e, %d iterations\n",
               mapping == mechanics::Mapping::isothermal ? "isothermal" : "isentropic", viscosity,
               c.element.name, c.kind == AnalysisKind::axisymmetric ? "axisymmetric" : "", e.pressure,
               e.displacement, e.iterations);
        // Bound by Newton's criterion. The nodes of a linear element cannot sink along a parabola.
        EXPECT_LT(e.pressure, 1e-4) << c.element.name;
        EXPECT_LT(e.displacement, 0.05) << c.element.name;
      }
}

// A pressure that is constant within a quad or hex cannot balance a weight that is not: they flow, for ever.
TEST(MeltColumn, OfQuadsAndHexesOnADistortedMeshFlows) {
  for (const Choice& c : {Choice{verification::k_quad4, AnalysisKind::plane_strain},
                          Choice{verification::k_hex8, AnalysisKind::solid}}) {
    const Errors e = rest(c.element, c.kind, 1e6, mechanics::Mapping::isothermal);
    printf("eta 1e6 Pa s, %-6s pressure %.1e, displacement %.1e\n", c.element.name, e.pressure,
           e.displacement);
    EXPECT_GT(e.pressure, 1e-3) << c.element.name;
    EXPECT_GT(e.displacement, 10) << c.element.name;
  }
}

/// A closed box of metal with linear simplices, cooled step by step.
struct ClosedBox {
  Body body;
  test::Solved solved;
  double time = 1;

  /// @param lift  of the lid, by time [m]
  ClosedBox(const Element& element, AnalysisKind kind, double gravity, double first, Table lift = 0.0)
      : body(filled(element, kind, gravity, first, std::move(lift))), solved(body) {}

  static material::Material metal() {
    material::Material m = melt(0);
    m.liquid_viscosity = {};
    m.expansion = k_expansion;
    m.casting.coherency_fraction = 0.75;
    m.phase_changes.front().volume_change = 0;
    return m;
  }
  static Body filled(const Element& element, AnalysisKind kind, double gravity, double temperature,
                     Table lift) {
    const bool solid = kind == AnalysisKind::solid;
    const int n = solid ? 3 : 6;
    Body body(Lattice{.shape = element.shape,
                      .cells = {n, 2 * n, n},
                      .size = {k_width, k_height, k_width},
                      .distortion = 0.15},
              kind, metal());
    body.initial_temperature.assign(body.mesh.x.size(), k_poured);
    body.temperature.assign(body.mesh.x.size(), temperature);
    element.choose(body.options);
    for (const char* wall : {"left", "right"}) body.hold(wall, 0);
    body.hold("bottom", 1);
    body.hold("top", 1, std::move(lift));
    if (solid)
      for (const char* wall : {"back", "front"}) body.hold(wall, 2);
    body.conditions.gravity = {0, -gravity, 0};
    return body;
  }
  void go_to(double temperature) {
    body.temperature.assign(body.mesh.x.size(), temperature);
    solved.step(body, time += 1, 1.0);
  }
  struct Pores {
    double mean = 0, least = 1, most = 0, upper = 0;
  };
  Pores pores() const {
    const verification::Cells cells(body.mesh, body.mesh.blocks[0], body.kind);
    std::vector<double> fraction(cells.centre.size());
    solved.state.elements[0]->get(mechanics::ElementField::pore_fraction, fraction);
    Pores p;
    double volume = 0, upper = 0;
    for (std::size_t e = 0; e < fraction.size(); ++e) {
      p.mean += cells.volume[e] * fraction[e];
      volume += cells.volume[e];
      if (cells.centre[e][1] > k_height / 2) {
        p.upper += cells.volume[e] * fraction[e];
        upper += cells.volume[e];
      }
      p.least = std::min(p.least, fraction[e]);
      p.most = std::max(p.most, fraction[e]);
    }
    p.mean /= volume;
    p.upper /= upper;
    return p;
  }

  static constexpr double k_poured = 950, k_expansion = 1e-4;  // [K], [1/K]
};

const std::vector<Choice> k_boxes{{verification::k_tri3, AnalysisKind::plane_strain},
                                  {verification::k_tri3, AnalysisKind::axisymmetric},
                                  {verification::k_tet4, AnalysisKind::solid},
                                  {verification::k_tet4_algebraic, AnalysisKind::solid}};

// Melt that shrinks in a closed box: θ = −e^θ but for what the tension of the pores stretches, everywhere
// without gravity, in the mean with it, and more above than below. Warmed again, the pores close.
TEST(ClosedMelt, ShrinksIntoPoresThatTakeUpWhatNothingFeeds) {
  for (const Choice& c : k_boxes)
    for (const double gravity : {0.0, k_gravity}) {
      ClosedBox box(c.element, c.kind, gravity, ClosedBox::k_poured);
      EXPECT_LE(box.pores().most, gravity == 0 ? 0.0 : 1e-4);
      for (const double temperature : {940.0, 920.0, 910.0}) {
        box.go_to(temperature);
        const double shrunk = 3 * ClosedBox::k_expansion * (ClosedBox::k_poured - temperature);
        const auto p = box.pores();
        printf("%-8s g %.2f, shrunk %.4f: pores %.6f in the mean, %.6f in the upper half, %.6f to %.6f\n",
               c.element.name, gravity, shrunk, p.mean, p.upper, p.least, p.most);
        EXPECT_NEAR(p.mean, shrunk, 1e-5);
        if (gravity == 0)
          EXPECT_LT(p.most - p.least, 1e-6);
        else
          EXPECT_GT(p.upper, 1.2 * p.mean);
      }
      box.go_to(ClosedBox::k_poured);
      EXPECT_LT(box.pores().mean, 1e-4) << "pores of a melt close";
    }
}

// A lid that is lifted within one step. By 0.95 of the height the pores are 0.95 in the mean, but the upper
// elements, where the head is least, would be more than empty: they are full, and those below have the rest.
// By 1.2 of it all are full, and the film of metal that is left in them is stretched elastically.
TEST(ClosedMelt, OpensNoMorePoresThanAnElementHasRoomFor) {
  for (const Choice& c : k_boxes) {
    ClosedBox box(c.element, c.kind, k_gravity, ClosedBox::k_poured,
                  Table({1.0, 2.0, 3.0}, {0.0, 0.95 * k_height, 1.2 * k_height}));
    box.go_to(ClosedBox::k_poured);
    const auto p = box.pores();
    printf(
        "%-8s lifted by 0.95: pores %.6f in the mean, %.6f in the upper half, %.6f to %.6f, %d iterations\n",
        c.element.name, p.mean, p.upper, p.least, p.most, box.solved.report.newton.iterations);
    EXPECT_NEAR(p.mean, 0.95, 1e-5);
    EXPECT_EQ(p.most, mechanics::k_most_pores);
    EXPECT_LT(p.least, 0.95);
    EXPECT_LT(box.solved.report.newton.iterations, 40);
    box.go_to(ClosedBox::k_poured);
    EXPECT_EQ(box.pores().least, mechanics::k_most_pores);
    EXPECT_EQ(box.pores().most, mechanics::k_most_pores);
    const std::vector<double> pressures = test::element_fields(box.solved)[0].pressure;
    for (const double pressure : pressures)
      EXPECT_NEAR(-pressure, (1.2 - mechanics::k_most_pores) * k_bulk, 0.01 * k_bulk);
  }
}

// Mush opens where the pressure of its melt has dropped by ΔP_cr, and what has opened stays. The solid
// fraction is 0.75, that of coherency, at 825 K.
TEST(ClosedMush, OpensPoresBeyondItsPressureDropAndKeepsThem) {
  const double drop = ClosedBox::metal().casting.critical_pressure_drop;
  for (const Choice& c : k_boxes) {
    ClosedBox box(c.element, c.kind, 0, ClosedBox::k_poured);
    box.go_to(825.0005);
    const double in_melt = box.pores().mean;
    EXPECT_NEAR(in_melt, 3 * ClosedBox::k_expansion * (ClosedBox::k_poured - 825.0005), 1e-5);
    const double half = 0.5 * drop / k_bulk / (3 * ClosedBox::k_expansion);  // [K]
    box.go_to(825 - half);
    EXPECT_NEAR(box.pores().mean, in_melt, 1e-8) << "half of the drop opens nothing";
    box.go_to(815);
    const double opened = box.pores().mean - in_melt, shrunk = 3 * ClosedBox::k_expansion * 10;
    const double tension = drop * (1 + mechanics::k_pore_drops * opened / (1 - in_melt));
    printf("%-8s pores %.6f in the melt, %.6f opened in the mush, of %.6f; tension %.3g Pa\n", c.element.name,
           in_melt, opened, shrunk, tension);
    EXPECT_NEAR(opened, shrunk - tension / k_bulk, 1e-6);
    box.go_to(820);
    EXPECT_NEAR(box.pores().mean, in_melt + opened, 1e-9) << "pores of mush stay";
  }
}

/// The share of its contraction that a column of mush follows in the last of some steps of 1 s. It is held at
/// the sides, so its network contracts in height alone: the mean stress ζ (ε̇ − ψ ė) of compaction, with
/// ψ = (f_S − f_c)/(1 − f_c), and the deviatoric stress of the Maxwell element with the strain ⅔ ε add up to
/// what the melt above presses with, nothing compared with them.
double followed(const material::Material& metal, const std::vector<double>& temperatures,
                double contraction) {
  const material::MushViscosity mush = material::mush_viscosity(metal);
  const double coherency = metal.casting.coherency_fraction, twice_shear = k_young / (1 + k_poisson);
  double strain = 0, viscous = 0, last = 0;
  for (std::size_t k = 1; k < temperatures.size(); ++k) {
    const double f =
        0.5 * (metal.solid_fraction(temperatures[k - 1]) + metal.solid_fraction(temperatures[k]));
    const double eta = mush.of_network(f), fluidity = (1 - f) / eta, shear = 1 / (f / twice_shear + fluidity),
                 share = (f - coherency) / (1 - coherency);
    last = (eta * share * contraction - shear * (2.0 / 3 * strain - viscous)) / (eta + 2.0 / 3 * shear);
    strain += last;
    viscous += fluidity * shear * (2.0 / 3 * strain - viscous);
  }
  return last / contraction;
}

// A closed column of mush whose metal shrinks at the rate ė below melt. What its network does not follow is
// fed: q̇ = (ė − ε̇) y flows down through the height y, and lowers the pressure by (ė − ε̇) y²/(2 K/μ) on its
// way. All pores are those of the melt.
TEST(ClosedMush, IsFedByMeltThatFlowsBetweenItsDendrites) {
  constexpr double k_mush = 810, k_melt = 900, k_from = 0.8 * k_height, k_cooling = 0.1;  // [K], [m], [K/s]
  for (const Choice& c : k_boxes) {
    if (c.kind == AnalysisKind::axisymmetric) continue;
    ClosedBox box(c.element, c.kind, 0, ClosedBox::k_poured);
    const auto cool_to = [&](double mush) {
      for (std::size_t i = 0; i < box.body.mesh.x.size(); ++i)
        box.body.temperature[i] = box.body.mesh.x[i][1] > k_from - 1e-9 ? k_melt : mush;
      box.solved.step(box.body, box.time += 1, 1.0);
    };
    const std::vector<double> cooled{k_mush + 2 * k_cooling, k_mush + k_cooling, k_mush, k_mush - k_cooling};
    for (std::size_t k = 0; k + 1 < cooled.size(); ++k) cool_to(cooled[k]);
    const auto before = box.pores();
    cool_to(cooled.back());
    const verification::Cells cells(box.body.mesh, box.body.mesh.blocks[0], c.kind);
    const std::vector<double> pressure = test::element_fields(box.solved)[0].pressure;
    const material::Material& metal = box.body.materials[0];
    const double contraction = 3 * ClosedBox::k_expansion * k_cooling,
                 share = followed(metal, cooled, contraction), rate = (1 - share) * contraction,
                 mobility = material::Permeability(metal.casting).mobility(metal.solid_fraction(k_mush));
    const double scale = rate * k_from * k_from / (2 * mobility);
    double least = 1e300, largest = -1e300;
    for (std::size_t e = 0; e < pressure.size(); ++e) {
      const double y = cells.centre[e][1];
      if (y > 0.6 * k_height) continue;
      const double constant = (pressure[e] - rate * y * y / (2 * mobility)) / scale;
      least = std::min(least, constant);
      largest = std::max(largest, constant);
    }
    const double opened = box.pores().mean - before.mean, in_upper = box.pores().upper - before.upper;
    printf(
        "%-8s follows %.3f, drop of pressure %.4g Pa, off by %.1f %%; opened %.3e, of the upper half %.3e\n",
        c.element.name, share, scale, 50 * (largest - least), opened, in_upper);
    EXPECT_LT(0.5 * (largest - least), 0.03) << c.element.name;
    EXPECT_GT(opened, 0.0) << c.element.name;
    EXPECT_NEAR(in_upper, 2 * opened, 0.01 * opened) << c.element.name;
  }
}

}  // namespace
}  // namespace solidus
