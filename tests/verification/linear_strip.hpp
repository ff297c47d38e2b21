/// A strip of a linear thermoelastic solid in uniaxial strain, in units of its own: length and time are such
/// that diffusivity and speed of the elastic wave are one.
///
///   u_y = 0 ┌───┬───┬───┬─ ─ ─┐
///           └───┴───┴───┴─ ─ ─┘ u_y = 0      quads of side h, temperatures from 300 K, raised by 0.1 K
#pragma once

#include <string>
#include <vector>

#include "coupling_bodies.hpp"

namespace solidus::verification {

struct LinearSolid {
  static constexpr double k_start = 300;  ///< Θ_0 [K]
  static constexpr double k_rise = 0.1;   ///< ΔΘ [K]: what is not linear is ΔΘ/Θ_0 = 3e-4 of the answer
  static constexpr double k_stiffness = 1e9;  ///< λ + 2μ [Pa]
  static constexpr double k_capacity = 1e6;   ///< C [J/(m³ K)]
  double coupling;                            ///< δ

  /// 3αK of δ = β² Θ_0/(C (λ+2μ)) [Pa/K]; without coupling the strip expands, but does not feel it.
  double beta() const {
    const double delta = coupling > 0 ? coupling : 1;
    return std::sqrt(delta * k_capacity * k_stiffness / k_start);
  }
  material::Material material() const {
    constexpr double poisson = 0.25;
    constexpr double young = k_stiffness * (1 + poisson) * (1 - 2 * poisson) / (1 - poisson);
    constexpr double bulk = young / (3 * (1 - 2 * poisson));
    material::Material m;
    m.name = "linear";
    m.density = k_stiffness;  // c = 1 m/s
    m.specific_heat = k_capacity / m.density;
    m.specific_heat_at = material::SpecificHeatAt::constant_strain;
    m.conductivity = k_capacity;  // a = 1 m²/s
    m.young_modulus = young;
    m.poisson_ratio = poisson;
    m.expansion = beta() / (3 * bulk);
    m.expansion_reference = k_start;
    m.liquid_viscosity = 1.0;
    return m;
  }
  double stress() const { return beta() * k_rise; }               ///< of σ = 1 [Pa]
  double displacement() const { return stress() / k_stiffness; }  ///< of u = 1 [m]
};

struct StripScheme {
  std::string name;
  mechanics::Mapping mapping;
  bool double_pass = false;
  bool iterated = false;
  coupling::SimultaneousOptions::Integration integration =
      coupling::SimultaneousOptions::Integration::backward_euler;
};

inline Coupled linear_strip(const LinearSolid& solid, const StripScheme& scheme, double length, int quads) {
  Coupled c;
  c.mesh = test::make_mesh(
      {.shape = mesh::Shape::quad4, .cells = {quads, 1, 1}, .size = {length, length / quads, 1}});
  c.kind = AnalysisKind::plane_strain;
  c.materials = {solid.material()};
  c.start = {LinearSolid::k_start};
  c.hold("bottom", 1);
  c.hold("top", 1);
  c.hold("right", 0);
  if (solid.coupling > 0) c.form = mechanics::StructuralForm::energy;
  c.mapping = scheme.mapping;
  c.double_pass = scheme.double_pass;
  if (scheme.iterated) c.iteration.emplace();
  c.simultaneous.integration = scheme.integration;
  return c;
}

/// Dimensionless fields along the strip: at nodes, the stress of elements.
struct StripFields {
  std::vector<double> temperature, displacement, stress;
};
inline StripFields strip_fields(const Coupled& c, const Assembly& assembly, const coupling::State& state,
                                const LinearSolid& solid) {
  const mesh::ElementBlock& block = c.mesh.blocks.front();
  const auto n = static_cast<std::size_t>(block.n_counted);
  StripFields f{std::vector<double>(n + 1), std::vector<double>(n + 1), std::vector<double>(n)};
  double length = 0;
  for (const mesh::Point& x : c.mesh.x) length = std::max(length, x[0]);
  for (std::size_t node = 0; node < c.mesh.x.size(); ++node) {
    const auto i = static_cast<std::size_t>(std::lround(c.mesh.x[node][0] / length * static_cast<double>(n)));
    f.temperature[i] = (state.heat.temperature[node] - LinearSolid::k_start) / LinearSolid::k_rise;
    f.displacement[i] = state.mechanics.displacement[2 * node] / solid.displacement();
  }
  const test::ElementFields elements =
      test::element_fields(assembly.mechanics().mesh(), state.mechanics).front();
  for (std::size_t e = 0; e < n; ++e)
    f.stress[static_cast<std::size_t>(block.input_element[e] - 1)] = elements.stress[e][0] / solid.stress();
  return f;
}

/// Equal steps; `watch` sees the number of every step and the fields after it.
template <class Watch>
void march_strip(const Coupled& c, const LinearSolid& solid, double dt, int n_steps, const Watch& watch) {
  Assembly assembly(c, n_steps * dt);
  coupling::State state = assembly.start();
  assembly.scheme().synchronise(state);
  for (int n = 1; n <= n_steps; ++n) {
    coupling::State trial;
    assembly.advance(state, trial, n * dt, dt);
    state = std::move(trial);
    watch(n, strip_fields(c, assembly, state, solid));
  }
}

}  // namespace solidus::verification
