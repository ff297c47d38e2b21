/// A hot block that slides over a cooler base, far: its points change their faces again and again.
///
///      p ↓ ↓ ↓ ↓   → v                Heat across the interface by a conductance, heat of friction half and
///      ┌────────┐                     half besides; nothing is exchanged with the surroundings.
///   ┌──┴─┬────┬─┴──┬────┬────┬────┐
///   └────┴────┴────┴────┴────┴────┘
///
/// Rigid, the pressure is uniform and the heat is that of a two-dimensional program by finite differences,
/// whose block moves on by a cell a step. Elastic, with friction and expansion, the isentropic split in the
/// energy form closes the first law.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/laws/power_contact.hpp"
#include "contact_rubbing.hpp"
#include "coupling_bodies.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;

constexpr double k_base = 0.16, k_depth = 0.006;    // [m]
constexpr double k_block = 0.03, k_height = 0.006;  // [m]
constexpr double k_from = 0.02;                     // where the block's left end starts [m]
constexpr double k_speed = 0.1, k_end = 1;          // [m/s], [s]
constexpr double k_hot = 700, k_cold = 300;         // [K]
constexpr double k_conductance = 1e4, k_friction = 0.3, k_pressure = 20e6;
constexpr double k_face = k_base / 40;              // of the base [m]
constexpr double k_young = 2e11, k_penalty = 1e13;  // [Pa], [Pa/m]
constexpr double k_conductivity = 20, k_capacity = 7800.0 * 500.0;

/// Layers of both bodies get thinner towards the interface.
mesh::Mesh bodies() {
  mesh::RawMesh raw =
      test::raw_blocks({{k_base, k_depth}, {k_block, k_height}, {40, 12}, {11, 12}, 0}, mesh::Shape::quad4);
  const auto graded = [](double depth, double whole) { return depth * (0.25 + 0.75 * depth / whole); };
  test::map_body(raw, "lower", [&](mesh::Point x) {
    x[1] = k_depth - graded(k_depth - x[1], k_depth);
    return x;
  });
  test::map_body(raw, "upper", [&](mesh::Point x) {
    x[0] += k_from;
    x[1] = k_depth + graded(x[1] - k_depth, k_height);
    return x;
  });
  return test::distribute_blocks(raw);
}

contact::ContactParameters sliding() {
  contact::ContactParameters s = test::rubbing(test::coulomb(k_friction), k_penalty);
  s.heat = contact::HeatTransferSpec{};
  s.heat->contact_law = contact::contact_law(contact::PowerContact{k_conductance});
  s.search_distance = 1e-3;
  return s;
}

Coupled hot_block(bool rigid) {
  Coupled c;
  c.mesh = bodies();
  const double poisson = rigid ? 0 : 0.3, expansion = rigid ? 0 : 1.2e-5;
  c.materials = {test::elastic(k_young, poisson, expansion, k_conductivity),
                 test::elastic(k_young, poisson, expansion, k_conductivity)};
  for (material::Material& m : c.materials) m.specific_heat_at = material::SpecificHeatAt::constant_strain;
  c.start = {k_cold, k_hot};
  for (int i = 0; i < 2; ++i) c.hold(rigid ? "lower" : "lower_y_min", i);
  c.hold(rigid ? "upper" : "upper_y_max", 0, Table({0, k_end}, {0, k_speed * k_end}));
  c.mechanical.plane_faces = {{"upper_y_max"}};
  c.mechanical.pressures.push_back({"upper_y_max", k_pressure});
  c.contact = sliding();
  c.form = StructuralForm::energy;
  c.mapping = Mapping::isentropic;
  return c;
}

// Enthalpy over the start of one body [J/m], with the capacity lumped to the nodes.
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

/// Square cells; an explicit step moves the block on by one cell.
class Differences {
 public:
  explicit Differences(double cell)
      : cell_(cell),
        dt_(cell / k_speed),
        base_{count(k_base), count(k_depth), k_cold},
        block_{count(k_block), count(k_height), k_hot} {}

  void run() {
    // Within a step the block passes from one place to the next: half of the parts each.
    const int first = count(k_from);
    for (int i = 0; i < count(k_speed * k_end); ++i)
      for (int part = 0; part < k_parts; ++part) advance(first + i + (part < k_parts / 2 ? 0 : 1));
  }
  double base_heat() const { return heat(base_, k_cold); }
  double block_heat() const { return heat(block_, k_hot); }
  double base_surface(double x) const {
    return base_.at(std::min(static_cast<int>(x / cell_), base_.nx - 1), 0);
  }

 private:
  struct Grid {
    int nx, ny;
    std::vector<double> t;  // [row from the interface][cell along it]
    Grid(int nx_, int ny_, double start)
        : nx(nx_), ny(ny_), t(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), start) {}
    double& at(int x, int y) { return t[static_cast<std::size_t>(y * nx + x)]; }
    double at(int x, int y) const { return t[static_cast<std::size_t>(y * nx + x)]; }
  };
  int count(double length) const { return static_cast<int>(std::lround(length / cell_)); }
  /// All fluxes from the temperatures at the start; the block's left end at a cell of the base.
  void advance(int left) {
    const Grid base = base_, block = block_;
    conduct(base, base_);
    conduct(block, block_);
    const double warms = dt_ / k_parts / (k_capacity * cell_);
    const double rubbed = 0.5 * k_friction * k_pressure * k_speed;
    for (int x = 0; x < block.nx; ++x) {
      const double q = (block.at(x, 0) - base.at(left + x, 0)) / (1 / k_conductance + cell_ / k_conductivity);
      base_.at(left + x, 0) += warms * (rubbed + q);
      block_.at(x, 0) += warms * (rubbed - q);
    }
  }
  void conduct(const Grid& old, Grid& now) const {
    const double f = k_conductivity * dt_ / k_parts / (k_capacity * cell_ * cell_);
    for (int y = 0; y < old.ny; ++y)
      for (int x = 0; x < old.nx; ++x) {
        const double t = old.at(x, y);
        double sum = 0;
        if (x > 0) sum += old.at(x - 1, y) - t;
        if (x + 1 < old.nx) sum += old.at(x + 1, y) - t;
        if (y > 0) sum += old.at(x, y - 1) - t;
        if (y + 1 < old.ny) sum += old.at(x, y + 1) - t;
        now.at(x, y) = t + f * sum;
      }
  }
  double heat(const Grid& grid, double start) const {
    double sum = 0;
    for (const double t : grid.t) sum += t - start;
    return sum * k_capacity * cell_ * cell_;
  }

  static constexpr int k_parts = 4;  // of a step, for the explicit conduction to be stable
  double cell_, dt_;
  Grid base_, block_;
};

/// The place where the base's surface is hottest, and the largest change ahead of the block.
struct Spot {
  double hottest = 0, at = 0, ahead = 0;
};
Spot spot(const Coupled& c, const coupling::State& state) {
  const double left = k_from + k_speed * state.time;
  Spot s;
  for (const Index node : c.mesh.surfaces.at("lower_top").nodes) {
    if (node >= c.mesh.n_owned_nodes) continue;
    const double x = c.mesh.x[static_cast<std::size_t>(node)][0];
    const double t = state.heat.temperature[static_cast<std::size_t>(node)];
    if (t > s.hottest) s = {t, x, s.ahead};
    if (x > left + k_block + 2 * k_face) s.ahead = std::max(s.ahead, std::abs(t - k_cold));
  }
  const double hottest = parallel::global_max(s.hottest);
  s.at = parallel::global_max(s.hottest == hottest ? s.at : 0.0);
  s.hottest = hottest;
  s.ahead = parallel::global_max(s.ahead);
  return s;
}

/// The largest difference of the base's surface temperatures behind the block [K].
double trail_error(const Coupled& c, const std::vector<double>& temperature, const Differences& exact) {
  double worst = 0;
  for (const Index node : c.mesh.surfaces.at("lower_top").nodes) {
    const double x = c.mesh.x[static_cast<std::size_t>(node)][0];
    if (x < k_from + 2 * k_face || x > k_from + k_speed * k_end - 2 * k_face) continue;
    const double t = temperature[static_cast<std::size_t>(node)];
    worst = std::max(worst, std::abs(t - exact.base_surface(x)));
  }
  return parallel::global_max(worst);
}

TEST(HotBlock, GivesTheBaseTheHeatOfATwoDimensionalProgram) {
  Differences fine(1.25e-4), coarse(2.5e-4);
  fine.run();
  coarse.run();
  EXPECT_NEAR(coarse.base_heat(), fine.base_heat(), 2e-3 * fine.base_heat()) << "the program's own error";
  const Coupled c = hot_block(true);
  double dissipated = 0;
  const auto run = verification::march(c, k_end, 50, [&](const coupling::State&, const auto& effort) {
    dissipated += effort.energy.interface.dissipated;
  });
  const double base = warmed(c, "lower", run.end.heat.temperature, k_cold);
  const double block = warmed(c, "upper", run.end.heat.temperature, k_hot);
  const double trail = trail_error(c, run.end.heat.temperature, fine);
  RecordProperty(
      "base", fmt::format("{:.6g} J/m ({:.6g}, coarser {:.6g})", base, fine.base_heat(), coarse.base_heat()));
  RecordProperty("block", fmt::format("{:.6g} J/m ({:.6g})", block, fine.block_heat()));
  RecordProperty("trail", fmt::format("{:.3g} K", trail));
  // Slip is the way less what the tangential spring gives. All its work is in the bodies, and what pressing
  // in one step of backward Euler loses of p²/E (the energy form makes heat of it).
  const double traction = k_friction * k_pressure;
  const double slip = k_speed * k_end - traction / k_penalty;
  const double pressing = 0.5 * k_pressure * k_pressure / k_young * k_block * k_height;
  EXPECT_NEAR(dissipated, traction * slip * k_block, 1e-9 * dissipated);
  EXPECT_NEAR(base + block, dissipated + pressing, 1e-9 * base) << "what leaves the block is in the base";
  // Steps of half a face and 12 layers, the thinnest of 0.16 mm: errors of both have opposite signs here.
  EXPECT_NEAR(base, fine.base_heat(), 5e-3 * base);
  EXPECT_NEAR(block, fine.block_heat(), 5e-3 * std::abs(block));
  EXPECT_LT(trail, 0.01 * (k_hot - k_cold));
}

TEST(HotBlock, ClosesTheFirstLawAndWarmsTheBaseWhereItIs) {
  const Coupled c = hot_block(false);
  constexpr int k_steps = 50;
  double worst = 0, ahead = 0, heat = 0;
  int n = 0;
  const auto run = verification::march(
      c, k_end, k_steps, [&](const coupling::State& state, const coupling::StepEffort& effort) {
        ++n;
        const Spot s = spot(c, state);
        const double left = k_from + k_speed * state.time;
        heat += effort.contacts[0].heat * k_end / k_steps;
        ahead = std::max(ahead, s.ahead);
        if (n > 1) worst = std::max(worst, std::abs(effort.energy.defect()) / effort.energy.heat_exchanged);
        EXPECT_GT(effort.contacts[0].heat, 0) << "from the block to the base, step " << n;
        EXPECT_GE(effort.energy.friction, 0) << "step " << n;
        EXPECT_GT(s.at, left - k_face) << "the hottest spot is under the block, step " << n;
        EXPECT_LT(s.at, left + k_block + k_face) << "step " << n;
      });
  double hottest = 0;
  for (const double t : run.end.heat.temperature) hottest = std::max(hottest, t);
  hottest = parallel::global_max(hottest);
  RecordProperty("first_law", fmt::format("{:.1e}", worst));
  RecordProperty("heat", fmt::format("{:.12g} J/m, hottest {:.12g} K", heat, hottest));
  RecordProperty("ahead", fmt::format("{:.2e} K", ahead));
  EXPECT_LT(worst, 1e-8) << "from the second step on";
  // The elastic bodies change their temperature where they are pressed, by α Θ σ/(ρ c) = 0.02 K.
  EXPECT_LT(ahead, 0.02);
  // Found on one process; on two they differ by the order of summation.
  EXPECT_NEAR(heat, 53365.139846, 1e-8 * heat);
  EXPECT_NEAR(hottest, 689.099332735, 1e-8 * hottest);
}

}  // namespace
}  // namespace solidus
