/// From keys to parameters of contact: friction, moduli, penalties and gaps that follow from the bodies
/// where the user has not said them.
#include "setup/contact_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/laws/contact_law.hpp"
#include "contact/points/penalty.hpp"
#include "material/elasticity.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "setup/friction_input.hpp"
#include "setup/rigid_surface_input.hpp"

namespace solidus::setup {

namespace {

/// ε_N over the stiffness of the elements behind a surface. Points of segments are more than faces that do
/// not match can follow: with 100 the pressure of a cylinder on quads varies from node to node by a quarter
/// of its largest one. Means around nodes do not mind (docs/decisions/0029-contact-at-means-around-nodes.md).
constexpr double k_penalty_factor = 10, k_penalty_factor_of_means = 100;
/// ContactSpec::pressure_tolerance of solid bodies: with the factor of segments it leaves 1e-4 of a pressure
/// that follows from prescribed displacements. Where points slide their pressures change in every step, and
/// augmentations for each change would double the cost: there it leaves 1e-3.
constexpr double k_pressure_tolerance = 0.01, k_pressure_tolerance_of_slides = 0.05;
/// Displacement by the atmosphere of a liquid skin that it holds on its wall, over the gap that counts as
/// leaving it.
constexpr double k_wet_share = 0.1;

contact::NormalKind normal_kind(cases::ContactSpec::Normal normal, bool dynamic) {
  using Normal = cases::ContactSpec::Normal;
  switch (normal) {
    case Normal::penalty:
      return contact::NormalKind::penalty;
    case Normal::augmented_lagrangian:
      return contact::NormalKind::augmented_lagrangian;
    case Normal::energy_conserving:
      return contact::NormalKind::energy_conserving;
    case Normal::automatic:
      break;
  }
  return dynamic ? contact::NormalKind::energy_conserving : contact::NormalKind::penalty;
}

void add_friction(const cases::ContactSpec& c, cases::Physics physics, contact::ContactParameters& pair) {
  if (c.friction && physics == cases::Physics::heat)
    throw InputError(c.friction->where, "friction in an analysis of heat alone",
                     "physics = \"thermomechanical\" or \"mechanics\", or no [contact.friction]");
  if (c.wear && !c.friction)
    throw InputError(c.wear->where, "wear without friction: nothing slides against a resistance",
                     "a section [contact.friction] along with [contact.wear]");
  if (c.wear && c.wear->master_share > 0 && !c.surfaces.empty())
    throw InputError(c.wear->where, "'master_share' where the program chooses which surface is the master",
                     "'slave' and 'master' in place of 'surfaces'");
  if (c.friction) pair.friction = friction_spec(*c.friction);
  if (c.wear) pair.wear = wear_spec(*c.wear);
  pair.interface_heat_capacity = c.interface.heat_capacity;
}

/// Whether a body has nodes on a surface of the pair. Collective.
bool meets(const mesh::Mesh& mesh, int body, const contact::ContactParameters& pair) {
  std::vector<char> on(mesh.x.size(), 0);
  for (const std::string& name : {pair.slave, pair.master})
    if (const auto found = mesh.surfaces.find(name); found != mesh.surfaces.end())
      for (const Index node : found->second.nodes) on[as_size(node)] = 1;
  const bool here = std::any_of(mesh.blocks.begin(), mesh.blocks.end(), [&](const mesh::ElementBlock& block) {
    return block.body == body && std::any_of(block.nodes.begin(), block.nodes.end(),
                                             [&](Index node) { return on[as_size(node)] != 0; });
  });
  return parallel::any_process(here);
}

/// The body that has most nodes on a surface; -1: none. Collective.
int body_on(const mesh::Mesh& mesh, const std::string& surface) {
  const auto found = mesh.surfaces.find(surface);
  // Nodes of the surface, and for each body how many of them it has.
  std::vector<char> on(mesh.x.size(), 0);
  if (found != mesh.surfaces.end())
    for (const Index node : found->second.nodes) on[as_size(node)] = 1;
  int most = -1;
  double largest = 0;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    std::vector<char> of_body(mesh.x.size(), 0);
    for (const mesh::ElementBlock& block : mesh.blocks)
      if (block.body == static_cast<int>(b))
        for (const Index node : block.nodes) of_body[as_size(node)] = 1;
    double count = 0;
    for (std::size_t i = 0; i < as_size(mesh.n_owned_nodes); ++i) count += on[i] * of_body[i];
    count = parallel::global_sum(count);
    if (count > largest) largest = count, most = static_cast<int>(b);
  }
  return most;
}

/// 2 k_1 k_2/(k_1 + k_2) at the points of both tables and between them.
Table harmonic_mean(const Table& one, const Table& two) {
  // The mean of two tables that are linear is not: between their points it is sampled.
  constexpr int k_parts = 16;  // of an interval of both tables
  std::vector<double> x(one.x().begin(), one.x().end()), at, mean;
  // The points of both, each once.
  x.insert(x.end(), two.x().begin(), two.x().end());
  std::ranges::sort(x);
  x.erase(std::unique(x.begin(), x.end()), x.end());
  const auto value = [&](double t) {
    const double a = one.value(t), b = two.value(t);
    return 2 * a * b / (a + b);
  };
  if (one.constant() && two.constant()) return {value(0)};
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int part = 0; part < (i + 1 < x.size() ? k_parts : 1); ++part) {
      at.push_back(part == 0 ? x[i] : x[i] + part * (x[i + 1] - x[i]) / k_parts);
      mean.push_back(value(at.back()));
    }
  return {std::move(at), std::move(mean)};
}

}  // namespace

std::vector<contact::ContactParameters> contact_specs(const cases::CaseSpec& spec) {
  // The keys of each [[contact]] become the parameters of a pair. What the case leaves open is chosen here
  // or, where it depends on the mesh, when the pair is made.
  std::vector<contact::ContactParameters> result;
  for (const cases::ContactSpec& c : spec.contacts) {
    // Names, sides and geometry come first, then the settings of the computation, at last heat and friction.
    contact::ContactParameters pair;
    pair.name = c.name;
    pair.slave = c.sides()[0];
    pair.master = c.sides()[1];
    if (const cases::RigidSurfaceSpec* master = spec.rigid_surface(c.master))
      pair.rigid_master = rigid_surface(*master, spec.analysis.kind);
    pair.choose_roles = !c.surfaces.empty();
    pair.formulation = c.formulation;
    pair.smoothing = c.smoothing;
    pair.normal = normal_kind(c.normal, spec.dynamics.has_value());
    pair.penetration_tolerance = c.penetration_tolerance;
    pair.penalty_is_factor = !c.penalty;
    // With means around nodes the default penalty is stiffer than with points of faces.
    const double factor =
        c.integration == contact::IntegrationRule::mortar ? k_penalty_factor_of_means : k_penalty_factor;
    // The penalty is that of the case, or a factor on the stiffness of the bodies in contact.
    pair.penalty = c.penalty.value_or(c.penalty_factor.value_or(factor));
    pair.stabilisation = c.stabilisation;
    pair.integration = c.integration;
    pair.gauss_degree = c.gauss_degree;
    pair.search_distance = c.search_distance;
    pair.touching = c.touching;
    // The pressure of the air acts on wet sides alone.
    pair.atmosphere = c.wet ? c.atmosphere : 0.0;
    pair.heat = c.heat;
    add_friction(c, spec.analysis.physics, pair);
    pair.nodal_heat = spec.heat.integration == heat::HeatIntegration::closed;
    pair.where = c.where;
    result.push_back(std::move(pair));
  }
  return result;
}

std::vector<double> contact_moduli(const std::vector<material::Material>& materials) {
  constexpr double k_room_temperature = 293.15, k_any = 1e9;
  std::vector<double> moduli;
  for (const auto& m : materials)
    moduli.push_back(m.mechanical() ? m.young_modulus.value(k_room_temperature) : k_any);
  return moduli;
}

void set_leaving_gap(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                     const std::vector<material::Material>& materials, std::span<const double> sections,
                     contact::ContactParameters& pair) {
  constexpr double k_leaving_share = 0.01, k_room_temperature = 293.15;
  constexpr double k_sections = 10;  // across a casting
  // A share of the contraction of the casting from its liquidus to the room, over ten sections; the least of
  // the bodies that meet there.
  double least = 0;
  for (std::size_t b = 0; b < materials.size(); ++b) {
    const material::Material& m = materials[b];
    // Only bodies that deform, freeze and lie on one of the two sides.
    if (cases::only_conducts(spec.bodies[b]) || !m.mechanical() || m.solidification() == nullptr) continue;
    if (!meets(mesh, static_cast<int>(b), pair)) continue;
    const double liquidus = m.solidification()->fraction.liquidus();
    const double contraction =
        std::abs(material::properties_at(m, liquidus, k_room_temperature).thermal_strain) / 3;
    const double gap = k_leaving_share * contraction * k_sections * sections[b];
    if (gap > 0 && (least == 0 || gap < least)) least = gap;
  }
  pair.leaving_gap = least;
  // The gap and the penalty go with the pair, for its skin and its force need them both.
  const cases::ContactSpec& c = *std::ranges::find(spec.contacts, pair.name, &cases::ContactSpec::name);
  if (least > 0 && pair.atmosphere > 0 && !c.penalty_factor)
    pair.largest_penalty = pair.atmosphere / (k_wet_share * least);
}

void set_solid_penalty(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                       contact::ContactParameters& pair) {
  // The penalty of melt is bounded by the pressure of the atmosphere; solids get that of the softer of both
  // bodies, if both are solid bodies.
  if (!std::isfinite(pair.largest_penalty) || !pair.penalty_is_factor) return;
  std::vector<std::string> surfaces{pair.slave};
  if (!pair.rigid_master) surfaces.push_back(pair.master);
  for (const std::string& name : surfaces)
    if (!mesh.surfaces.contains(name)) return;  // refused where the pair is made
  const std::vector<double> moduli = contact_moduli(materials);
  for (std::size_t b = 0; b < materials.size(); ++b)
    if (!materials[b].mechanical() && meets(mesh, static_cast<int>(b), pair)) return;
  double softer = std::numeric_limits<double>::infinity();
  for (const std::string& name : surfaces)
    softer = std::min(softer, contact::local_stiffness(mesh, contact::ContactSurface(mesh, name), moduli));
  pair.solid_penalty = pair.penalty * softer;
}

void set_mean_conductivity(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                           contact::ContactParameters& pair) {
  if (!pair.heat || pair.heat->contact_law == nullptr || !pair.heat->contact_law->needs_conductivity())
    return;
  const int slave = body_on(mesh, pair.slave), master = pair.rigid_master ? -1 : body_on(mesh, pair.master);
  if (slave < 0 || master < 0)
    throw InputError(
        pair.heat->where,
        fmt::format("the contact '{}' needs the mean conductivity of its spots, and {}", pair.name,
                    pair.rigid_master ? "a rigid surface has none" : "no body is on its surfaces"),
        "'conductivity' in [contact.heat.asperities]");
  pair.heat->contact_law = pair.heat->contact_law->with_conductivity(
      harmonic_mean(materials[as_size(slave)].conductivity, materials[as_size(master)].conductivity));
}

void choose_normal(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                   contact::ContactParameters& pair) {
  const cases::ContactSpec& c = *std::ranges::find(spec.contacts, pair.name, &cases::ContactSpec::name);
  const bool chosen = c.normal != cases::ContactSpec::Normal::automatic || c.penalty || c.penalty_factor;
  if (chosen || spec.dynamics || spec.analysis.physics == cases::Physics::heat) return;
  for (std::size_t b = 0; b < materials.size(); ++b)
    if (!cases::only_conducts(spec.bodies[b]) && materials[b].solidification() != nullptr) return;
  pair.normal = contact::NormalKind::augmented_lagrangian;
  const bool slides = pair.formulation != contact::Formulation::small_sliding || pair.friction;
  pair.pressure_tolerance = slides ? k_pressure_tolerance_of_slides : k_pressure_tolerance;
}

}  // namespace solidus::setup
