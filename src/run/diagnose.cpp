/// Facts of bodies, contacts and heat are compared with thresholds, from what makes equilibrium impossible
/// to what merely makes it hard.
#include "run/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "coupling/contact_states.hpp"
#include "coupling/largest_difference.hpp"
#include "heat/iteration/heat_rejected.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "mechanics/equilibrium_rejected.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "run/body_facts.hpp"
#include "system/processes.hpp"

namespace solidus::run {

namespace {

using coupling::Diagnosis;

/// A body that moves by this share of its size in a try has lost what held it, and a law that finds no state
/// there is not the cause.
constexpr double k_moved_far = 0.01, k_too_far_for_a_law = 0.1;
/// A body that flows in this share of its volume is a mechanism; one that is strained so much has been one.
constexpr double k_mechanism = 0.25, k_strained = 0.2;
/// A contact that keeps less than this share of its closed points comes off.
constexpr double k_kept = 0.5;
/// Conductance times step over heat capacity above which the contact sets the temperature of its surface.
constexpr double k_conducts = 1;

/// The owner of a node that one process at most holds, negative elsewhere; −1 where none does. Collective.
int owner_of(Index node) {
  const processes::Largest found = processes::find_largest(node >= 0 ? 1.0 : 0.0);
  return found.value > 0 ? found.rank : -1;
}

/// Place and state of a node at the last step. Collective.
void describe_node(const setup::Assembly& a, const coupling::State& last, Index node, Diagnosis& d) {
  // Every process takes part in what is collective; the owner of the node then fills in its
  // numbers.
  const std::vector<double> coherency = coupling::coherency_of(a.phases, last.heat);
  const std::vector<double> solid =
      a.heat ? a.heat->states().solid_fraction(last.heat) : std::vector<double>(a.mesh.x.size(), 1.0);
  const std::vector<double>& temperature = a.heat ? last.heat.temperature : a.phases.temperature;
  const int owner = owner_of(node);
  if (owner < 0) return;
  std::vector<double> numbers(6, 0.0);
  if (owner == processes::rank()) {
    const mesh::Point& x = a.mesh.x[as_size(node)];
    const bool melt = !coherency.empty() && coherency[as_size(node)] < 1;
    numbers = {x[0],
               x[1],
               x[2],
               as_size(node) < temperature.size() ? temperature[as_size(node)] : 0.0,
               solid[as_size(node)],
               melt ? 1.0 : 0.0};
  }
  processes::broadcast(numbers, owner);
  d.place = {numbers[0], numbers[1], numbers[2]};
  d.temperature = numbers[3];
  d.solid_fraction = numbers[4];
  d.molten = numbers[5] > 0;
}

/// The name of the first body that has a node, on the process that owns it.
std::string body_of(const mesh::Mesh& mesh, Index node) {
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (std::ranges::find(block.nodes, node) != block.nodes.end())
      return mesh.bodies[as_size(block.body)].name;
  return {};
}

void describe_body(const setup::Assembly& a, const coupling::State& last, std::size_t body,
                   const BodyFacts& facts, Diagnosis& d) {
  d.body = a.mesh.bodies[body].name;
  d.size = facts.size;
  d.weight = facts.weight;
  d.supported = facts.supported;
  d.rubs = facts.rubs;
  d.contact = facts.contact;
  d.elongation = facts.elongation;
  d.moved = facts.moved;
  d.yielding = facts.yielding;
  describe_node(a, last, facts.farthest, d);
}

/// The body that is not carried, or else the one that goes farthest in its size; nothing without mechanics.
std::optional<std::size_t> concerned(const std::vector<BodyFacts>& facts) {
  std::optional<std::size_t> found;
  const auto before = [&](const BodyFacts& one, const BodyFacts& other) {
    if (one.carried != other.carried) return other.carried;
    return one.moved / one.size > other.moved / other.size;
  };
  for (std::size_t b = 0; b < facts.size(); ++b)
    if (facts[b].moves && facts[b].size > 0 && (!found || before(facts[b], facts[*found]))) found = b;
  return found;
}

/// Whether most points that were closed at the last step are open in the failing try.
bool comes_off(const coupling::ContactPoints& c) {
  return c.before > 0 && static_cast<double>(c.now) < k_kept * static_cast<double>(c.before);
}

/// Returns the physics behind the failed equilibrium of a body.
coupling::Physics physics_of(const BodyFacts& body, const Diagnosis& d, Failure failure, bool inertia) {
  // From what makes equilibrium impossible to what makes it hard: the first that fits is told.
  const double share = body.moved / body.size;
  const bool far = d.in_try && !(share <= k_moved_far), law_failed = failure == Failure::law;
  if (!inertia && !body.carried && (body.weight > 0 || far || failure == Failure::linear_solver))
    return coupling::Physics::nothing_carries;
  // Plastic flow nearly everywhere is a mechanism: strain then tells whether the load is the limit.
  const bool mechanism = body.plastic && body.yielding > k_mechanism;
  if (mechanism && !d.molten && body.elongation > k_strained) return coupling::Physics::limit_load;
  if (law_failed && share <= k_too_far_for_a_law) return coupling::Physics::law;
  if (d.molten && far) return coupling::Physics::melt_flows;
  // A body that nothing supports may lose its last contact in the failing try.
  if (!body.supported && d.in_try && comes_off(body.contact)) return coupling::Physics::comes_off;
  if (!inertia && !body.supported && failure == Failure::linear_solver) return coupling::Physics::slides;
  if (mechanism) return coupling::Physics::limit_load;
  if (law_failed) return coupling::Physics::law;
  if (body.contact.changed > 0) return coupling::Physics::points_change;
  return coupling::Physics::no_equilibrium;
}

/// The contact through which most heat passes at a node, by conductance times step over heat capacity; the
/// pairs are at the last step. Collective.
void find_contact_heat(const setup::Assembly& a, const coupling::State& last, Index node, double dt,
                       Diagnosis& d) {
  std::vector<double> number(a.phases.contacts.size(), 0.0);
  const double temperature = node >= 0 ? last.heat.temperature[as_size(node)] : 0.0;
  const double capacity = node >= 0 ? a.heat->storage().capacity(node, temperature) : 0.0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const contact::ContactPair& pair = *a.phases.contacts[i];
    if (!pair.parts().forces.active() || !pair.parts().spec.heat || !(capacity > 0)) continue;
    const contact::ContactNodalFields fields = contact::nodal_fields(pair.view(), last.heat.temperature);
    const auto found = std::ranges::find(fields.nodes, node);
    if (found == fields.nodes.end()) continue;
    const auto k = as_size(found - fields.nodes.begin());
    const double passes = fields.conductance[k] * fields.paired_area[k] * dt / capacity;
    if (std::isfinite(passes)) number[i] = passes;
  }
  processes::largest(number);
  const auto largest = std::ranges::max_element(number);
  if (largest == number.end() || !(*largest > 0)) return;
  d.conductance_number = *largest;
  d.contact_name = a.phases.contacts[as_size(largest - number.begin())]->parts().spec.name;
}

/// Whether a temperature is above all that bodies were poured at and that is around them: flow has heated it.
bool heated_by_flow(const setup::Assembly& a, const coupling::State& last, double temperature) {
  constexpr double k_beyond = 100;  // [K]
  double hottest = heat::ambient_range(*a.heat, last.time, false).highest;
  for (const setup::InitialTemperatureRange& body : a.start) hottest = std::max(hottest, body.high);
  return temperature > hottest + k_beyond;
}

/// A body that has flowed far and heats itself by that is beyond its limit load, although the heat fails
/// first.
void look_for_flow(const cases::CaseSpec& spec, const setup::Assembly& a, const coupling::State& last,
                   Diagnosis& d) {
  if (!a.mechanics || !spec.exchanges_heat() || !heated_by_flow(a, last, d.temperature)) return;
  const auto body = std::ranges::find(a.mesh.bodies, d.body, &mesh::Body::name);
  if (body == a.mesh.bodies.end()) return;
  const BodyFacts facts = body_facts(spec, a, last, nullptr)[as_size(body - a.mesh.bodies.begin())];
  if (!facts.plastic || !(facts.elongation > k_strained)) return;
  d.physics = coupling::Physics::limit_load;
  d.elongation = facts.elongation;
  d.supported = facts.supported;
  d.contact = facts.contact;
}

Diagnosis of_heat(const cases::CaseSpec& spec, const setup::Assembly& a, const coupling::State& last,
                  const heat::HeatRejected& rejected, Diagnosis d) {
  describe_node(a, last, rejected.node, d);
  const int owner = owner_of(rejected.node);
  if (owner < 0) return d;
  // The process that owns the node knows its temperature and body and tells the others.
  std::vector<double> tried(1, 0.0);
  if (owner == processes::rank()) {
    tried[0] = rejected.temperature[as_size(rejected.node)];
    d.body = body_of(a.mesh, rejected.node);
  }
  processes::broadcast(tried, owner);
  processes::broadcast(d.body, owner);
  d.tried_temperature = tried[0];
  d.largest_change = coupling::largest_difference(rejected.temperature, last.heat.temperature);
  // Then what explains it: heat that a contact conducts within the step, or a flow of the melt.
  find_contact_heat(a, last, rejected.node, d.step, d);
  d.physics = rejected.failure() == Failure::temperature ? coupling::Physics::cold
              : d.conductance_number > k_conducts        ? coupling::Physics::contact_heat
                                                         : coupling::Physics::heat;
  look_for_flow(spec, a, last, d);
  return d;
}

}  // namespace

Diagnosis diagnose(const cases::CaseSpec& spec, setup::Assembly& a, const std::string& ran_out,
                   const coupling::State& last, const StepRejected& rejected, double dt) {
  // The state of the last step is restored, so that what is found is not that of a failed try.
  coupling::restore_contacts(a.phases, last);
  Diagnosis d;
  d.step = dt;
  // Failures of heat explain themselves; melt that has run out explains everything else.
  const auto* heat = dynamic_cast<const heat::HeatRejected*>(&rejected);
  if (heat != nullptr) {
    const Diagnosis found = of_heat(spec, a, last, *heat, d);
    if (ran_out.empty() || found.physics == coupling::Physics::limit_load) return found;
  }
  if (!ran_out.empty()) {
    d.physics = coupling::Physics::runs_out;
    d.detail = ran_out;
    return d;
  }
  if (!a.mechanics) return d;
  // In mechanics the last iterate of the failed try tells which body it was and how it moved.
  const auto* equilibrium = dynamic_cast<const mechanics::EquilibriumRejected*>(&rejected);
  const mechanics::LastIterate* iterate = equilibrium != nullptr ? &equilibrium->iterate : nullptr;
  const std::vector<BodyFacts> facts = body_facts(spec, a, last, iterate);
  const std::optional<std::size_t> body = concerned(facts);
  if (!body) return d;
  d.in_try = iterate != nullptr;
  describe_body(a, last, *body, facts[*body], d);
  // Then the kind of the failure is named from what is certain (nothing carries the body) to what is left.
  const Failure failure = rejected.failure();
  if (!facts[*body].carried && d.weight > 0 && a.mechanics->bodies().inertia == nullptr) {
    d.physics = coupling::Physics::nothing_carries;
  } else if (failure == Failure::multipliers) {
    d.physics = coupling::Physics::multipliers;
  } else if (failure == Failure::coupling || failure == Failure::divergence ||
             failure == Failure::another_solution) {
    d.physics = coupling::Physics::phases;
  } else if (equilibrium != nullptr) {
    d.physics = physics_of(facts[*body], d, failure, a.mechanics->bodies().inertia != nullptr);
  }
  // A law that fails at a temperature below zero is one of heat.
  if (d.physics == coupling::Physics::law) {
    d.detail = rejected.where();
    d.tried_temperature = iterate->law_temperature;
    if (!(d.tried_temperature > 0)) d.physics = coupling::Physics::cold_law;
  }
  if (d.physics == coupling::Physics::multipliers) {
    d.detail = rejected.reason();
    if (a.heat) d.solid_fraction = a.heat->states().mean_solid_fraction(last.heat, static_cast<int>(*body));
  }
  return d;
}

}  // namespace solidus::run
