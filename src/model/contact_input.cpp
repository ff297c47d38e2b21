#include "model/contact_input.hpp"

#include "model/friction_input.hpp"
#include "model/rigid_surface_input.hpp"

namespace solidus::model {

namespace {

contact::NormalKind normal_kind(ContactSpec::Normal normal, bool dynamic) {
  using Normal = ContactSpec::Normal;
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

void add_friction(const ContactSpec& c, Physics physics, contact::ContactSpec& pair) {
  if (c.friction && physics == Physics::heat)
    throw InputError(c.friction->where, "friction in an analysis of heat alone",
                     "physics = \"thermomechanical\" or \"mechanics\", or no [contact.friction]");
  if (c.wear && !c.friction)
    throw InputError(c.wear->where, "wear without friction: nothing slides against a resistance",
                     "a section [contact.friction] beside [contact.wear]");
  if (c.wear && c.wear->master_share > 0 && !c.surfaces.empty())
    throw InputError(c.wear->where, "'master_share' where the program chooses which surface is the master",
                     "'slave' and 'master' in place of 'surfaces'");
  if (c.friction) pair.friction = friction_spec(*c.friction);
  if (c.wear) pair.wear = wear_spec(*c.wear);
  pair.interface_heat_capacity = c.interface.heat_capacity;
}

}  // namespace

std::vector<contact::ContactSpec> contact_specs(const CaseSpec& spec) {
  std::vector<contact::ContactSpec> result;
  for (const ContactSpec& c : spec.contacts) {
    contact::ContactSpec pair;
    pair.name = c.name;
    pair.slave = c.sides()[0];
    pair.master = c.sides()[1];
    if (const RigidSurfaceSpec* master = spec.rigid_surface(c.master))
      pair.rigid_master = rigid_surface(*master, spec.analysis.kind);
    pair.choose_roles = !c.surfaces.empty();
    pair.formulation = c.formulation;
    pair.smoothing = c.smoothing;
    pair.normal = normal_kind(c.normal, spec.dynamics.has_value());
    pair.penetration_tolerance = c.penetration_tolerance;
    pair.penalty_is_factor = !c.penalty;
    pair.penalty = c.penalty.value_or(c.penalty_factor);
    pair.stabilisation = c.stabilisation;
    pair.integration = c.integration;
    pair.gauss_degree = c.gauss_degree;
    pair.search_distance = c.search_distance;
    pair.touching = c.touching;
    pair.heat = c.heat;
    add_friction(c, spec.analysis.physics, pair);
    pair.nodal_heat = spec.heat.integration == heat::Integration::closed;
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

}  // namespace solidus::model
