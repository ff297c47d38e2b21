/// Two blocks that press and slide, with an interface that has a heat capacity, friction that hardens and
/// softens with temperature, and a conductance that follows everything: for tests of the simultaneous scheme.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "../contact/bodies.hpp"
#include "../mechanics/body.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "coupled_tangent.hpp"
#include "coupling/simultaneous.hpp"

namespace solidus::test {

using contact::Formulation;
using mesh::Shape;

inline constexpr double k_rubbing_start = 500;  // [K]

struct Rubbing {
  const char* name = "";
  Shape shape = Shape::quad4;
  Formulation formulation = Formulation::small_sliding;
  bool smoothing = false, nodal = true;
  double heat_capacity = 0;
  contact::InternalVariable variable = contact::InternalVariable::normal_work;
  bool mu_of_temperature = true;
  double twist = 0;         ///< of the interface: z += twist x y [1/m]
  bool multiplies = false;  ///< by the augmented Lagrangian
};

inline std::ostream& operator<<(std::ostream& out, const Rubbing& c) {
  return out << c.name;
}

inline contact::ContactParameters interface_of(const Rubbing& c) {
  contact::ContactParameters s;
  s.name = "interface";
  s.slave = "upper_bottom";
  s.master = "lower_top";
  s.penalty = 1e13;
  s.penalty_is_factor = false;
  s.stabilisation = 0;
  if (c.multiplies) s.normal = contact::NormalKind::augmented_lagrangian;
  s.formulation = c.formulation;
  s.integration = c.formulation == Formulation::large_sliding ? contact::IntegrationRule::gauss
                                                              : contact::IntegrationRule::segments;
  s.smoothing = c.smoothing;
  s.nodal_heat = c.nodal;
  s.interface_heat_capacity = c.heat_capacity;
  s.friction = contact::FrictionParameters{};
  s.friction->internal_variable = c.variable;
  const bool slip = c.variable == contact::InternalVariable::slip;
  s.friction->coefficient.unit = slip ? 1e-4 : 1e3;
  if (c.mu_of_temperature)
    s.friction->coefficient.terms = {Table({300, 900}, {0.3, 0.15}), Table({300, 900}, {0.1, 0.02})};
  else
    s.friction->coefficient.terms = {Table(0.25)};
  s.friction->tangential_penalty = 2e12;
  contact::HeatTransferSpec h;
  h.contact_law = contact::contact_law(contact::PowerContact{3e4, 0.95, 1e9});
  h.gap_law = contact::gap_law(contact::GasGap{.conductivity = 0.05, .open_conductance = 2e3});
  s.heat = h;
  return s;
}

inline material::Material metal(bool alone) {
  if (!alone) return elastic_material(2e11, 0.3, 1.2e-5);
  material::Material m = elastic_material(2e11, 0.3);
  m.specific_heat = 1e-3;
  return m;
}

/// Blocks whose interface turns as it goes; linear faces of both fit it exactly.
inline mesh::Mesh twisted(mesh::Mesh mesh, double twist) {
  if (twist != 0)
    for (mesh::Point& x : mesh.x) x[2] += twist * (x[0] - 0.15) * (x[1] - 0.1);
  return mesh;
}

/// Phases of both blocks.
struct RubbingBlocks {
  mesh::Mesh mesh;
  AnalysisKind kind;
  std::vector<material::Material> materials;
  std::unique_ptr<contact::ContactPair> pair;
  std::unique_ptr<mechanics::MechanicalPhase> mechanics;
  std::optional<mechanics::StructuralHeat> structural;
  std::optional<heat::ThermalPhase> heat;
  coupling::Phases phases;
  coupling::State state;

  /// @param absent     the body that only conducts heat
  /// @param supported  and moved, of metal that expands; else both are free, and neither expansion nor heat
  ///                   capacity is added to what contact does
  RubbingBlocks(const Rubbing& c, bool supported, const std::string& absent = {})
      : RubbingBlocks(two_blocks(c.shape), c, supported, absent) {}
  RubbingBlocks(mesh::Mesh blocks, const Rubbing& c, bool supported, const std::string& absent = {})
      : mesh(twisted(std::move(blocks), c.twist)),
        kind(mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid),
        materials(2, metal(!supported)) {
    pair = std::make_unique<contact::ContactPair>(mesh, kind, interface_of(c));
    mechanics::MechanicsOptions options = strict();
    options.mapping = mechanics::Mapping::simultaneous;
    options.symmetric = false;
    mechanics::MechanicalConditions conditions;
    if (!absent.empty()) conditions.absent_bodies = {absent};
    const int up = mesh.dimension - 1;
    const std::string last = mesh.dimension == 2 ? "y" : "z";
    if (supported) {
      for (int i = 0; i <= up; ++i) conditions.displacements.push_back({"lower_" + last + "_min", i, 0.0});
      const std::string top = "upper_" + last + "_max";
      conditions.displacements.push_back({top, 0, Table({0, 1}, {0, 3e-4})});
      if (up == 2) conditions.displacements.push_back({top, 1, 0.0});
      conditions.displacements.push_back({top, up, Table({0, 1}, {0, -4e-5})});
    }
    const std::vector<double> initial(mesh.x.size(), k_rubbing_start);
    mechanics = std::make_unique<mechanics::MechanicalPhase>(
        mesh, kind, materials, initial, conditions, options,
        std::vector<linear::Contribution*>{&pair->parts().forces.term()});
    structural.emplace(*mechanics, mechanics::StructuralForm::energy, true);
    structural->leave_tangent();
    heat::HeatOptions of_heat;
    of_heat.tolerance = 1e-11;
    of_heat.symmetric = false;
    heat.emplace(mesh, kind, materials, heat::ThermalConditions{}, of_heat,
                 std::vector<linear::Contribution*>{pair->parts().heat.term(), &*structural});
    phases.heat = &*heat;
    phases.mechanics = mechanics.get();
    phases.structural = &*structural;
    phases.contacts = {pair.get()};
    state.heat = heat->states().initial(std::vector<double>{k_rubbing_start, k_rubbing_start});
    state.mechanics = mechanics->initial_state();
    state.contacts = {pair->parts().history.initial()};
  }
};

inline void keep_still(const mesh::Mesh& mesh, const std::string& body, std::vector<double>& u) {
  const auto nc = static_cast<std::size_t>(mesh.dimension);
  for (const Index node : mesh.node_sets.at(body))
    std::fill_n(u.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * nc), nc, 0.0);
}

/// Pressed by 2 µm and less to the right, where it is open; one block slides on the other from nothing on the
/// left, where points stick, to 15 µm.
/// @param still  the body that stays where it is, if one does
inline std::vector<double> rubbed(const mesh::Mesh& mesh, const std::string& still = {}) {
  const auto nc = static_cast<std::size_t>(mesh.dimension);
  const std::vector<double> shake = noise(mesh, mesh.dimension, 1.3, 2e-7);
  std::vector<double> u = nodal_field(mesh, mesh.dimension, [&](const mesh::Point& x, bool upper) {
    std::vector<double> v(nc, 0.0);
    if (upper == (still == "upper")) return v;
    const double sign = upper ? 1 : -1;
    v[0] = sign * 5e-5 * x[0] * (nc == 3 ? 1 + x[1] : 1);
    v.back() = -sign * 2e-6 * (1 - 4 * x[0]);
    return v;
  });
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += shake[i];
  if (!still.empty()) keep_still(mesh, still, u);
  return u;
}

/// The coupled residual off equilibrium, in a first step from rest.
class Iterate {
 public:
  explicit Iterate(RubbingBlocks& blocks, double dt = 1e-3)
      : newton(blocks.phases, linear::CoupledSolverKind::direct), blocks_(blocks) {
    const coupling::State& from = blocks.state;
    pass_.time = pass_.dt = dt;
    pass_.temperature = from.heat.temperature;
    newton.thermal().begin(from.heat, dt, LoadWindow::backward_euler(0, dt));
    pass_.iterate_temperature = newton.thermal().state().temperature;
    blocks.pair->begin(from.contacts[0], {.time = dt,
                                          .dt = dt,
                                          .displacement = from.mechanics.displacement,
                                          .temperature = from.heat.temperature,
                                          .simultaneous = true});
    blocks.mechanics->equations().begin(from.mechanics, pass_);
  }
  /// To this displacement and by some change of temperature.
  void move(std::vector<double> u) {
    u_ = std::move(u);
    const mechanics::MechanicalState& old = blocks_.state.mechanics;
    newton.evaluate(old, pass_, u_);
    newton.assemble(old, u_, 0);
    std::vector<double> warmer = noise(blocks_.mesh, 1, 0.7, 40);
    newton.thermal().equations().set_direction(warmer, {});
    newton.thermal().equations().move(1.0);
    newton.evaluate(old, pass_, u_);
  }
  /// Errors of the tangent here along a direction.
  OfAll<double> tangent_errors(std::span<const double> du, std::vector<double> dt, double h) {
    const mechanics::MechanicalState& old = blocks_.state.mechanics;
    linear::CoupledMatrix& a = newton.assemble(old, u_, 0);
    return test::tangent_errors(newton, a, old, pass_, u_, du, std::move(dt), h);
  }

  coupling::CoupledNewton newton;

 private:
  RubbingBlocks& blocks_;
  mechanics::MechanicalPass pass_;
  std::vector<double> u_;
};

}  // namespace solidus::test
