#include "results/fields/state_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/quantities.hpp"
#include "heat/quantities.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "mechanics/quantities.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "results/fields/heat_flux.hpp"

namespace solidus::results {

namespace {

namespace of_heat = heat::fields;
namespace of_mechanics = mechanics::fields;
namespace of_contact = contact::fields;
using mechanics::ElementField;
using quantities::Quantity;

/// Fields of every contact surface, and those that friction accumulates, which a surface keeps when its
/// partner has been removed.
constexpr std::array k_contact = {&of_contact::k_gap, &of_contact::k_contact_pressure,
                                  &of_contact::k_conductance};
constexpr std::array k_remembered = {&of_contact::k_slip, &of_contact::k_internal_variable,
                                     &of_contact::k_friction_coefficient, &of_contact::k_friction_dissipation,
                                     &of_contact::k_wear_depth};

struct ElementQuantity {
  const Quantity& quantity;
  ElementField which;
};
constexpr ElementQuantity k_elements[] = {
    {of_mechanics::k_stress, ElementField::stress},
    {of_mechanics::k_von_mises, ElementField::von_mises},
    {of_mechanics::k_pressure, ElementField::pressure},
    {of_mechanics::k_viscous_strain, ElementField::viscous_strain},
    {of_mechanics::k_dissipation, ElementField::dissipation},
    {of_mechanics::k_plastic_strain, ElementField::plastic_strain},
    {of_mechanics::k_equivalent_plastic_strain, ElementField::equivalent_plastic_strain},
    {of_mechanics::k_back_stress, ElementField::back_stress},
    {of_mechanics::k_flow_stress, ElementField::flow_stress},
    {of_mechanics::k_pore_fraction, ElementField::pore_fraction},
    {of_mechanics::k_thermal_dissipation, ElementField::thermal_dissipation},
    {of_mechanics::k_inelastic_entropy, ElementField::inelastic_entropy},
    {of_mechanics::k_strain, ElementField::strain},
    {of_mechanics::k_intermediate_temperature, ElementField::intermediate_temperature}};

/// Principal values of the recovered stress, the largest first.
constexpr std::array k_principal = {&of_mechanics::k_principal_stress_1, &of_mechanics::k_principal_stress_2,
                                    &of_mechanics::k_principal_stress_3};

mesh::FieldPlace place_of(const Quantity& quantity) {
  return quantity.place == quantities::Place::element ? mesh::FieldPlace::cell : mesh::FieldPlace::node;
}

bool on_request(const Quantity& quantity) {
  return quantity.written == quantities::Written::on_request;
}

bool rubs(const contact::ContactPair* pair) {
  return pair->parts().spec.friction.has_value();
}

/// The unit of ζ_c, which is a work per area or a slip; one, as of a number, where pairs differ.
const char* internal_variable_unit(const coupling::Phases& phases) {
  bool works = false, slips = false;
  for (const contact::ContactPair* pair : phases.contacts) {
    if (!rubs(pair)) continue;
    const bool slip = pair->parts().spec.friction->internal_variable == contact::InternalVariable::slip;
    (slip ? slips : works) = true;
  }
  return works && slips ? "1" : slips ? "m" : "N/m";
}

bool heats(const contact::ContactPair* pair) {
  return pair->parts().spec.heat.has_value();
}

bool with_heat(const coupling::Phases& phases) {
  return phases.heat != nullptr && std::any_of(phases.contacts.begin(), phases.contacts.end(), heats);
}

/// An interface has a temperature without friction too, where it stores heat.
bool interfaces_store(const coupling::Phases& phases) {
  return std::ranges::any_of(
      phases.contacts, [](const contact::ContactPair* pair) { return pair->parts().heat.has_temperature(); });
}

bool with_friction(const coupling::Phases& phases) {
  return phases.mechanics != nullptr && std::any_of(phases.contacts.begin(), phases.contacts.end(), rubs);
}

}  // namespace

StateFields::StateFields(const mesh::Mesh& mesh, const coupling::Phases& phases, AnalysisKind kind)
    : mesh_(mesh), phases_(phases), kind_(kind), ghosts_(mesh) {
  // Fields are made once, with room for their values: those of each phase that exists, those of the criteria,
  // and those of contact. Values are filled in when they are asked for.
  find_side_areas(kind);
  bodies_.set_cylindrical(kind == AnalysisKind::axisymmetric);
  if (phases.heat != nullptr) {
    add(of_heat::k_temperature);
    add(of_heat::k_solid_fraction);
    add_heat_flux();
  }
  if (phases.mechanics != nullptr) {
    add(of_mechanics::k_displacement);
    if (phases.mechanics->bodies().inertia != nullptr) {
      add(of_mechanics::k_velocity);
      add(of_mechanics::k_acceleration);
    }
    add_elements();
    add_nodal_stress();
  }
  const std::size_t n_of_phases = values_.size();
  add_criteria();
  for (const auto& v : values_)
    bodies_.add(
        {v->name, v->unit, v->components, v->place, v->values, v->compute, {}, v->on_request, v->compute_of});
  // Nodal fields of the phases are shown on the contact surfaces too.
  if (!phases.contacts.empty()) add_contact_fields(n_of_phases);
}

void StateFields::add_contact_fields(std::size_t n_of_phases) {
  FieldSet contact;
  for (std::size_t i = 0; i < n_of_phases; ++i)
    if (const auto& v = values_[i]; v->place == mesh::FieldPlace::node && !v->compute)
      contact.add({v->name, v->unit, v->components, v->place, v->values});
  // A field of contact is in both sets. On bodies some are counted for the covered area alone.
  const auto add_everywhere = [&](const Quantity& quantity, const char* unit = nullptr) {
    const std::vector<double>& values = add(quantity);
    Values& v = *values_.back();
    if (unit != nullptr) v.unit = unit;
    contact.add({v.name, v.unit, v.components, v.place, values});
    bodies_.add({v.name,
                 v.unit,
                 v.components,
                 v.place,
                 values,
                 {},
                 quantity.per_covered_area ? std::span<const double>(covered_) : std::span<const double>()});
  };
  for (const Quantity* quantity : k_contact) add_everywhere(*quantity);
  if (with_heat(phases_)) {
    add_everywhere(of_contact::k_contact_heat_flux);
    if (with_friction(phases_)) add_everywhere(of_contact::k_frictional_heat_flux);
  }
  if (with_friction(phases_)) {
    add_everywhere(of_contact::k_friction_traction);
    for (const Quantity* quantity : k_remembered)
      add_everywhere(*quantity, quantity == &of_contact::k_internal_variable ? internal_variable_unit(phases_)
                                                                             : nullptr);
    add_everywhere(of_contact::k_contact_status);
  }
  if (phases_.heat != nullptr && (with_friction(phases_) || interfaces_store(phases_)))
    add_everywhere(of_contact::k_interface_temperature);
  // Each pair has its two surfaces, which are written as parts of their own.
  for (const contact::ContactPair* pair : phases_.contacts)
    for (const std::string& surface : {pair->parts().spec.slave, pair->parts().spec.master})
      if (surface == pair->parts().spec.slave || !pair->parts().spec.rigid_master)
        surfaces_[surface] = contact;
}

void StateFields::find_side_areas(AnalysisKind kind) {
  if (phases_.contacts.empty()) return;
  covered_.assign(mesh_.x.size(), 0.0);
  // For each side of each contact the area that belongs to each node.
  for (const contact::ContactPair* pair : phases_.contacts) {
    auto& sides = side_area_.emplace_back();
    for (std::size_t side = 0; side < 2; ++side) {
      sides[side].assign(mesh_.x.size(), 0.0);
      const auto surface =
          mesh_.surfaces.find(side == 0 ? pair->parts().spec.slave : pair->parts().spec.master);
      if (surface == mesh_.surfaces.end()) continue;  // a rigid one
      for (const mesh::ElementBlock& faces : surface->second.faces) {
        const mesh::FaceGeometry g(mesh_, faces, kind, mesh::gauss_rule(faces.shape, 4));
        const auto n = as_size(g.n_nodes), n_points = as_size(g.n_points);
        for (Index f = 0; f < g.n_faces; ++f)
          for (std::size_t q = 0; q < n_points; ++q)
            for (std::size_t a = 0; a < n; ++a)
              sides[side][as_size(faces.element(f)[a])] +=
                  g.values[q * n + a] * g.weight[as_size(f) * n_points + q];
      }
    }
  }
}

StateFields::Values& StateFields::add_values(const quantities::Quantity& quantity) {
  values_.push_back(std::make_unique<Values>(Values{.name = std::string(quantity.name),
                                                    .unit = std::string(quantity.unit),
                                                    .components = quantity.components(kind_),
                                                    .place = place_of(quantity),
                                                    .of_contact = quantity.of_contact(),
                                                    .on_request = on_request(quantity)}));
  return *values_.back();
}

std::vector<double>& StateFields::add(const quantities::Quantity& quantity) {
  Values& v = add_values(quantity);
  v.values.assign(value_count(mesh_, v.place, v.components), 0.0);
  by_name_[v.name] = &v.values;
  return v.values;
}

std::vector<double>& StateFields::values_of(const quantities::Quantity& quantity) {
  return *by_name_.find(quantity.name)->second;
}

void StateFields::add_elements() {
  for (const auto& [quantity, which] : k_elements) {
    if (quantity.needs.plasticity && !phases_.mechanics->bodies().plastic) continue;
    const bool isentropic = phases_.mechanics->bodies().options.mapping == mechanics::Mapping::isentropic;
    if (quantity.needs.isentropic && !isentropic) continue;
    if (quantity.needs.melting && phases_.coherency == nullptr) continue;
    add_values(quantity).compute = [this, field = which] {
      return mechanics::element_field(mesh_, shown_, field);
    };
  }
}

void StateFields::add_heat_flux() {
  const auto add = [this](const Quantity& quantity, auto element_values) {
    add_values(quantity).compute = [this, element_values] {
      return element_values(
          mesh_, kind_,
          [this](int body) -> const material::Material& { return phases_.heat->storage().material(body); },
          values_of(of_heat::k_temperature));
    };
  };
  add(of_heat::k_heat_flux, element_heat_flux);
  add(of_heat::k_conduction_dissipation, element_conduction_dissipation);
}

void StateFields::add_nodal_stress() {
  // Recovered stress is costly and computed only when it is read.
  const auto nodal = [this](int body) {
    if (!recovery_) recovery_ = std::make_unique<StressRecovery>(mesh_, kind_);
    return recovery_->at_nodes(mechanics::element_field(mesh_, shown_, ElementField::stress), body);
  };
  const auto add = [this](const Quantity& quantity,
                          const std::function<std::vector<double>(int body)>& compute) {
    Values& v = add_values(quantity);
    v.compute = [compute] { return compute(-1); };
    v.compute_of = compute;
  };
  add(of_mechanics::k_nodal_stress, nodal);
  add(of_mechanics::k_nodal_von_mises, [nodal](int body) { return von_mises_values(nodal(body)); });
  for (std::size_t rank = 0; rank < k_principal.size(); ++rank)
    add(*k_principal[rank],
        [nodal, rank](int body) { return principal_values(nodal(body), static_cast<int>(rank)); });
}

void StateFields::add_criteria() {
  if (phases_.criteria == nullptr) return;
  for (const Quantity* quantity : criteria::fields_of(*phases_.criteria)) {
    Values* v = &add_values(*quantity);
    by_name_[v->name] = &v->values;
    v->compute = [v, n = value_count(mesh_, v->place, v->components)] {
      return v->values.empty() ? std::vector<double>(n, 0.0) : v->values;
    };
  }
}

void StateFields::release_criteria() {
  if (phases_.criteria == nullptr) return;
  for (const Quantity* quantity : criteria::fields_of(*phases_.criteria))
    std::vector<double>().swap(values_of(*quantity));
}

void StateFields::update_criteria(const coupling::State& state) {
  if (phases_.criteria == nullptr) return;
  std::vector<std::span<double>> values;
  for (const Quantity* quantity : criteria::fields_of(*phases_.criteria)) {
    std::vector<double>& of_field = values_of(*quantity);
    of_field.resize(value_count(mesh_, place_of(*quantity), quantity->components(kind_)));
    values.emplace_back(of_field);
  }
  phases_.criteria->fill({state.time - state.poured, state.heat, state.mechanics}, state.criteria, values);
}

void StateFields::update(const coupling::State& state) {
  // Bodies that are not there in the stage have no values.
  const linear::ActiveSet& there =
      phases_.heat != nullptr ? heat::active(*phases_.heat) : phases_.mechanics->bodies().active;
  const linear::ActiveSet* active = there.complete() ? nullptr : &there;
  bodies_.set_active(active);
  if (phases_.growth != nullptr)
    bodies_.set_there([this](std::int64_t element) { return phases_.growth->there(element); });
  for (auto& [name, fields] : surfaces_) fields.set_active(active);
  if (phases_.heat != nullptr) {
    std::ranges::copy(state.heat.temperature, values_of(of_heat::k_temperature).begin());
    std::ranges::copy(phases_.heat->states().solid_fraction(state.heat),
                      values_of(of_heat::k_solid_fraction).begin());
  }
  if (phases_.mechanics != nullptr) {
    std::ranges::copy(state.mechanics.displacement, values_of(of_mechanics::k_displacement).begin());
    if (phases_.mechanics->bodies().inertia != nullptr) {
      std::ranges::copy(state.mechanics.velocity, values_of(of_mechanics::k_velocity).begin());
      std::ranges::copy(state.mechanics.acceleration, values_of(of_mechanics::k_acceleration).begin());
    }
    shown_.elements = state.mechanics.elements;
  }
  if (!phases_.contacts.empty()) update_contacts(state.heat.temperature);
}

// A node of several pairs shows its closest partner; nodes away from the surfaces show zero.
void StateFields::update_contacts(std::span<const double> temperature) {
  for (const auto& v : values_)
    if (v->of_contact) std::fill(v->values.begin(), v->values.end(), 0.0);
  std::vector<double>&gap = values_of(of_contact::k_gap),
  &pressure = values_of(of_contact::k_contact_pressure), &conductance = values_of(of_contact::k_conductance);
  std::vector<char> seen(gap.size(), 0);
  std::fill(covered_.begin(), covered_.end(), 0.0);
  for (std::size_t number = 0; number < phases_.contacts.size(); ++number) {
    const contact::ContactPair* pair = phases_.contacts[number];
    const auto& [slave_area, master_area] = side_area_[number];
    const contact::ContactNodalFields fields = contact::nodal_fields(pair->view(), temperature);
    std::vector<char> closest(fields.nodes.size(), 0);
    for (std::size_t k = 0; k < fields.nodes.size(); ++k) {
      const auto i = as_size(fields.nodes[k]);
      if (!std::isfinite(fields.opening[k]) || (seen[i] != 0 && gap[i] <= fields.opening[k])) continue;
      seen[i] = closest[k] = 1;
      gap[i] = fields.opening[k];
      pressure[i] = fields.pressure[k];
      conductance[i] = fields.conductance[k];
      // More than all of it: a rule of few points at the rim of a quadratic face.
      const double area = std::max(slave_area[i], master_area[i]);
      covered_[i] = area > 0 ? std::clamp(fields.paired_area[k] / area, 0.0, 1.0) : 0.0;
    }
    update_heat(fields, closest);
    if (phases_.mechanics != nullptr && rubs(pair)) update_friction(fields, closest);
  }
  for (const auto& v : values_)
    if (v->of_contact) ghosts_.update(v->values, v->components);
  ghosts_.update(covered_, 1);
}

// Shows the heat of the pair with the closest partner.
void StateFields::update_heat(const contact::ContactNodalFields& fields, std::span<const char> closest) {
  const auto show = [&](const Quantity& quantity, const std::vector<double>& values) {
    const auto found = by_name_.find(quantity.name);
    if (found == by_name_.end()) return;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (closest[k] != 0) (*found->second)[as_size(fields.nodes[k])] = values[k];
  };
  show(of_contact::k_contact_heat_flux, fields.heat_flux);
  show(of_contact::k_frictional_heat_flux, fields.frictional_heat_flux);
  const auto interface = by_name_.find(of_contact::k_interface_temperature.name);
  // The slave's alone: the master remembers none.
  for (std::size_t k = 0; interface != by_name_.end() && k < fields.temperature.size(); ++k)
    if (closest[k] != 0 && std::isfinite(fields.temperature[k]))
      (*interface->second)[as_size(fields.nodes[k])] = fields.temperature[k];
}

// Updates the fields of friction. The history fields of a surface in several pairs are the largest of all
// pairs; the fields of the present contact are those of the pair with the closest partner.
void StateFields::update_friction(const contact::ContactNodalFields& fields, std::span<const char> closest) {
  const std::array<const std::vector<double>*, std::size(k_remembered)> remembered = {
      &fields.slip, &fields.internal_variable, &fields.coefficient, &fields.dissipation, &fields.wear_depth};
  std::vector<double>&traction = values_of(of_contact::k_friction_traction),
  &status = values_of(of_contact::k_contact_status);
  const auto components = as_size(phases_.mechanics->bodies().components);
  for (std::size_t k = 0; k < fields.nodes.size(); ++k) {
    const auto i = as_size(fields.nodes[k]);
    for (std::size_t f = 0; f < remembered.size(); ++f) {
      double& value = values_of(*k_remembered[f])[i];
      value = std::fmax(value, (*remembered[f])[k]);  // NaN where the node has none
    }
    if (closest[k] == 0) continue;
    status[i] = fields.status[k];
    for (std::size_t c = 0; c < components; ++c) traction[i * components + c] = fields.traction[k][c];
  }
}

}  // namespace solidus::results
