/// Cast iron at 1000 °C in a sand mould at 20 °C, 30 linear elements along the radius (monograph 6.3.1,
/// figure 6.1): the open rule over- and undershoots at the interface, the closed rule never does.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "material/cards/library.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

constexpr double k_hot = 1273.15, k_cold = 293.15;
constexpr double k_part = 0.05, k_outside = 0.20;  // radii [m]: 10 elements in the iron, 20 in the sand

/// One layer of elements; iron and sand share the nodes of the interface.
mesh::Mesh cylinder(mesh::Shape shape) {
  mesh::RawMesh raw = mesh::make_block({{1.0, 0.005}, {}, {30, 1}, "part"}, shape);
  for (mesh::Point& x : raw.x) {
    const double s = 30 * x[0];
    x[0] = s <= 10 ? k_part * s / 10 : k_part + (k_outside - k_part) * (s - 10) / 20;
  }
  mesh::RawGroup& part = raw.groups.at("part");
  mesh::RawGroup mould{part.dimension, {}};
  for (mesh::RawBlock& block : part.blocks) {
    const auto n = static_cast<std::size_t>(mesh::node_count(block.shape));
    mesh::RawBlock iron{block.shape, {}, {}}, sand{block.shape, {}, {}};
    for (std::size_t e = 0; e * n < block.nodes.size(); ++e) {
      double r = 0;
      for (std::size_t a = 0; a < n; ++a) r += raw.x[static_cast<std::size_t>(block.nodes[e * n + a])][0];
      mesh::RawBlock& to = r / static_cast<double>(n) < k_part ? iron : sand;
      to.nodes.insert(to.nodes.end(), block.nodes.begin() + static_cast<std::ptrdiff_t>(e * n),
                      block.nodes.begin() + static_cast<std::ptrdiff_t>((e + 1) * n));
      to.input_element.push_back(block.input_element[e]);
    }
    block = std::move(iron);
    mould.blocks.push_back(std::move(sand));
  }
  raw.groups["mould"] = std::move(mould);
  mesh::validate_and_orient(raw, "cylinder");
  return mesh::distribute(raw, {"part", "mould"}, {});
}

/// How far temperatures leave the range of the start [K], over some steps.
double overshoot(const mesh::Mesh& mesh, heat::HeatIntegration rule, double dt,
                 const std::string& file = {}) {
  const std::string folder = std::string(SOLIDUS_SOURCE_DIR) + "/materials/";
  heat::HeatOptions options;
  options.integration = rule;
  heat::ThermalPhase phase(mesh, AnalysisKind::axisymmetric,
                           {material::load_material(folder + "grey_iron.toml"),
                            material::load_material(folder + "green_sand.toml")},
                           {}, options);
  // The nodes of the interface start as part of the casting.
  std::vector<double> start;
  for (const mesh::Point& x : mesh.x) start.push_back(x[0] <= k_part * (1 + 1e-12) ? k_hot : k_cold);
  heat::ThermalState state = phase.states().initial_at_nodes(start);
  double worst = 0;
  for (int i = 1; i <= 10; ++i) {
    phase.solve(state, state, i * dt, dt);
    for (const double t : state.temperature) worst = std::max({worst, t - k_hot, k_cold - t});
    if (i == 1 && !file.empty()) {
      std::ofstream out = verification::csv(file, "radius[mm],temperature[degC]");
      for (std::size_t n = 0; n < mesh.x.size(); ++n)
        if (mesh.x[n][1] == 0)
          out << 1e3 * mesh.x[n][0] << ',' << state.temperature[n] - k_zero_celsius << '\n';
    }
  }
  return worst;
}

TEST(CastIronInSand, OvershootsWithTheOpenRuleAndNeverWithTheClosedOne) {
  std::ofstream table = verification::csv("closed_open", "dt[s],shape,closed[K],open[K]");
  for (const mesh::Shape shape : {mesh::Shape::quad4, mesh::Shape::tri3}) {
    const mesh::Mesh mesh = cylinder(shape);
    double worst_open = 0;
    for (const double dt : {1e-3, 1e-1, 1.0, 10.0, 1e2, 1e4, 1e6}) {
      const bool shown = shape == mesh::Shape::quad4 && dt == 1.0;
      const double closed =
          overshoot(mesh, heat::HeatIntegration::closed, dt, shown ? "cast_iron_closed" : "");
      const double open = overshoot(mesh, heat::HeatIntegration::open, dt, shown ? "cast_iron_open" : "");
      table << dt << ',' << mesh::name(shape) << ',' << closed << ',' << open << '\n';
      EXPECT_LE(closed, 1e-6) << dt;  // rounding
      worst_open = std::max(worst_open, open);
    }
    EXPECT_GE(worst_open, 10.0);
  }
}

}  // namespace
}  // namespace solidus
