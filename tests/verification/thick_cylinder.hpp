/// The thick-walled cylinder of monograph 7.1, quasi-static, and the values of the program of its own
/// (reference/README.md) that it is compared with.
///
///        p → ┊ 100 mm ──── steel, 593 K ──── 200 mm ┊    u_z = 0, 50 quads
///   film 1160 W/(m² K), 293 K           film 10 W/(m² K), 293 K
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "coupling_bodies.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::verification {

/// Tables 7.1 and 7.2.
inline material::Material steel(double expansion_factor, bool plastic) {
  constexpr auto k_on = Extrapolation::linear;
  material::Material m;
  m.name = "steel";
  m.density = 7800;
  m.conductivity = Table({273, 673}, {45.29, 39.42}, k_on);
  m.specific_heat = Table({273, 673}, {340, 390}, k_on);
  m.specific_heat_at = material::SpecificHeatAt::constant_strain;  // 2.49c
  m.young_modulus = Table({273, 673}, {221.9e9, 183.9e9}, k_on);
  m.poisson_ratio = 0.3;
  m.expansion = Table({273, 673}, {expansion_factor * 1.19e-5, expansion_factor * 1.39e-5}, k_on);
  m.expansion_reference = 293;
  m.liquid_viscosity = 1.0;
  if (plastic) {
    m.flow.emplace();
    m.flow->flow_stress = 3.2e8;
    m.flow->rate[material::Perzyna::viscosity] = 0.0;
  }
  return m;
}

/// From a to b as sin² from time zero to `end`, in 400 pieces.
inline Table smooth(double a, double b, double end) {
  std::vector<double> x, y;
  for (int i = 0; i <= 400; ++i) {
    const double s = std::sin(0.5 * std::numbers::pi * i / 400);
    x.push_back(end * i / 400);
    y.push_back(a + (b - a) * s * s);
  }
  return {x, y};
}

struct Variant {
  bool plastic = false;
  int expansion_factor = 1;
  mechanics::Mapping mapping = mechanics::Mapping::isentropic;
  mechanics::StructuralForm form = mechanics::StructuralForm::energy;
  heat::SensibleForm sensible = heat::SensibleForm::enthalpy;
  coupling::ThermalFlow flow = coupling::ThermalFlow::kept;
};

inline Coupled cylinder(const Variant& v, int quads = 50) {
  Coupled c;
  c.mesh = test::make_mesh({.shape = mesh::Shape::quad4,
                            .cells = {quads, 1, 1},
                            .size = {0.1, 0.002, 1},
                            .map = [](const mesh::Point& x) {
                              return mesh::Point{x[0] + 0.1, x[1], 0};
                            }});
  c.kind = AnalysisKind::axisymmetric;
  c.materials = {steel(v.expansion_factor, v.plastic)};
  c.start = {593};
  c.hold("bottom", 1);
  c.hold("top", 1);
  c.mechanical.pressures.push_back({"left", 2e8});
  c.thermal.films.push_back({"inner", "left", {1160.0}, 293.0});
  c.thermal.films.push_back({"outer", "right", {10.0}, 293.0});
  c.mapping = v.mapping;
  c.form = v.form;
  c.sensible = v.sensible;
  c.thermal_flow = v.flow;
  c.ambient = 293;
  return c;
}

/// At the inner and the outer surface.
struct Surfaces {
  double u[2], temperature[2];  ///< [mm], [K]
};
inline Surfaces surfaces(const mesh::Mesh& mesh, const coupling::State& state) {
  Surfaces s{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double r = i == 0 ? 0.1 : 0.2;
    double u = -1e300, t = -1e300;
    for (Index node = 0; node < mesh.n_owned_nodes; ++node) {
      const auto n = static_cast<std::size_t>(node);
      if (std::abs(mesh.x[n][0] - r) > 1e-9) continue;
      u = state.mechanics.displacement[2 * n] * 1e3;
      t = state.heat.temperature[n];
    }
    s.u[i] = parallel::global_max(u);
    s.temperature[i] = parallel::global_max(t);
  }
  return s;
}

/// 𝓛 since the start and its increments per phase in a step, of the ring 1 mm high [J].
struct Functional {
  double sum = 0, mechanical = 0, thermal = 0;
  /// Goes on by a step of cylinder(), which is 2 mm high.
  void add(const coupling::StabilityAudit& step) {
    mechanical = step.mechanical / 2;
    thermal = step.thermal / 2;
    sum += mechanical + thermal;
  }
};

/// Values of the reference's histories at a time.
struct ReferenceRow {
  Surfaces surfaces;
  Functional functional;
};
inline ReferenceRow reference_row(const Variant& v, const std::string& scheme, int time) {
  std::ifstream file(SOLIDUS_SOURCE_DIR "/tests/verification/reference/histories.csv");
  const std::string start = std::string(v.plastic ? "tp," : "te,") + std::to_string(v.expansion_factor) +
                            ",closed," + scheme + "," + std::to_string(time) + ",";
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(start, 0) != 0) continue;
    std::istringstream rest(line.substr(start.size()));
    Surfaces s{};
    Functional f;
    char comma = 0;
    rest >> s.u[0] >> comma >> s.u[1] >> comma >> s.temperature[0] >> comma >> s.temperature[1] >> comma >>
        f.sum >> comma >> f.mechanical >> comma >> f.thermal;
    return {s, f};
  }
  ADD_FAILURE() << "no line " << start;
  return {};
}
inline Surfaces reference(const Variant& v, const std::string& scheme, int time) {
  return reference_row(v, scheme, time).surfaces;
}

}  // namespace solidus::verification
