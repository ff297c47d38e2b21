#include "results/state_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "heat/nodal_enthalpy.hpp"
#include "mesh/block_geometry.hpp"
#include "results/heat_flux.hpp"

namespace solidus::results {

namespace {

struct FieldName {
  const char *name, *unit;
};
// Fields of contact surfaces, and those that friction accumulates, which a surface keeps when its partner has
// been removed.
constexpr FieldName k_contact[] = {{"gap", "m"}, {"contact_pressure", "Pa"}, {"conductance", "W/m2/K"}};
constexpr const char* k_internal_variable = "internal_variable";
constexpr FieldName k_remembered[] = {{"slip", "m"},
                                      {k_internal_variable, "N/m"},
                                      {"friction_coefficient", "1"},
                                      {"friction_dissipation", "J/m2"},
                                      {"wear_depth", "m"}};

/// Fields per area in contact: a surface that is covered in part carries them there alone.
constexpr std::string_view k_of_area[] = {"contact_pressure", "contact_heat_flux", "frictional_heat_flux",
                                          "friction_traction"};

using mechanics::ElementField;
struct ElementFieldName {
  const char *name, *unit;
  ElementField which;
  bool plastic;             ///< of bodies that flow plastically
  bool on_request = false;  ///< Field::on_request
};
constexpr ElementFieldName k_elements[] = {
    {"stress", "Pa", ElementField::stress, false},
    {"von_mises", "Pa", ElementField::von_mises, false},
    {"pressure", "Pa", ElementField::pressure, false},
    {"viscous_strain", "1", ElementField::viscous_strain, false},
    {"dissipation", "W/m3", ElementField::dissipation, false},
    {"plastic_strain", "1", ElementField::plastic_strain, true},
    {"equivalent_plastic_strain", "1", ElementField::equivalent_plastic_strain, true},
    {"back_stress", "Pa", ElementField::back_stress, true},
    {"flow_stress", "Pa", ElementField::flow_stress, true},
    {"pore_fraction", "1", ElementField::pore_fraction, false},
    {"thermal_dissipation", "W/m3", ElementField::thermal_dissipation, true, true},
    {"inelastic_entropy", "J/m3/K", ElementField::inelastic_entropy, true, true},
    {"strain", "1", ElementField::strain, false, true},
    {"intermediate_temperature", "K", ElementField::intermediate_temperature, false, true}};

/// Names of the principal values of the recovered stress, the largest first.
constexpr const char* k_principal[] = {"principal_stress_1", "principal_stress_2", "principal_stress_3"};

bool rubs(const contact::ContactPair* pair) {
  return pair->spec().friction.has_value();
}

/// The unit of ζ_c, which is a work per area or a slip; one, as of a number, where pairs differ.
const char* internal_variable_unit(const coupling::Phases& phases) {
  bool works = false, slips = false;
  for (const contact::ContactPair* pair : phases.contacts) {
    if (!rubs(pair)) continue;
    const bool slip = pair->spec().friction->internal_variable == contact::InternalVariable::slip;
    (slip ? slips : works) = true;
  }
  return works && slips ? "1" : slips ? "m" : "N/m";
}

bool heats(const contact::ContactPair* pair) {
  return pair->spec().heat.has_value();
}

bool with_heat(const coupling::Phases& phases) {
  return phases.heat != nullptr && std::any_of(phases.contacts.begin(), phases.contacts.end(), heats);
}

/// An interface has a temperature without friction too, where it stores heat.
bool interfaces_store(const coupling::Phases& phases) {
  return std::ranges::any_of(phases.contacts, &contact::ContactPair::has_temperature);
}

bool with_friction(const coupling::Phases& phases) {
  return phases.mechanics != nullptr && std::any_of(phases.contacts.begin(), phases.contacts.end(), rubs);
}

}  // namespace

StateFields::StateFields(const mesh::Mesh& mesh, const coupling::Phases& phases, AnalysisKind kind)
    : mesh_(mesh), phases_(phases), kind_(kind), ghosts_(mesh) {
  find_side_areas(kind);
  bodies_.set_cylindrical(kind == AnalysisKind::axisymmetric);
  if (phases.heat != nullptr) {
    add("temperature", "K", 1, mesh::FieldPlace::node);
    add("solid_fraction", "1", 1, mesh::FieldPlace::node);
    add_heat_flux();
  }
  if (phases.mechanics != nullptr) {
    add("displacement", "m", phases.mechanics->components(), mesh::FieldPlace::node);
    if (phases.mechanics->dynamic()) {
      add("velocity", "m/s", phases.mechanics->components(), mesh::FieldPlace::node);
      add("acceleration", "m/s2", phases.mechanics->components(), mesh::FieldPlace::node);
    }
    add_elements();
    add_nodal_stress();
  }
  const std::size_t n_of_phases = values_.size();
  add_criteria();
  for (const auto& v : values_)
    bodies_.add(
        {v->name, v->unit, v->components, v->place, v->values, v->compute, {}, v->on_request, v->compute_of});
  if (phases.contacts.empty()) return;

  FieldSet contact;
  for (std::size_t i = 0; i < n_of_phases; ++i)
    if (const auto& v = values_[i]; v->place == mesh::FieldPlace::node && !v->compute)
      contact.add({v->name, v->unit, v->components, v->place, v->values});
  const auto add_everywhere = [&](const FieldName& field, int components) {
    const std::vector<double>& values = add(field.name, field.unit, components, mesh::FieldPlace::node);
    values_.back()->of_contact = true;
    contact.add({field.name, field.unit, components, mesh::FieldPlace::node, values});
    const bool of_area = std::ranges::find(k_of_area, std::string_view(field.name)) != std::end(k_of_area);
    bodies_.add({field.name,
                 field.unit,
                 components,
                 mesh::FieldPlace::node,
                 values,
                 {},
                 of_area ? std::span<const double>(covered_) : std::span<const double>()});
  };
  for (const FieldName& field : k_contact) add_everywhere(field, 1);
  if (with_heat(phases)) {
    add_everywhere({"contact_heat_flux", "W/m2"}, 1);
    if (with_friction(phases)) add_everywhere({"frictional_heat_flux", "W/m2"}, 1);
  }
  if (with_friction(phases)) {
    add_everywhere({"friction_traction", "Pa"}, phases.mechanics->components());
    for (const FieldName& field : k_remembered) {
      const bool internal = std::string_view(field.name) == k_internal_variable;
      add_everywhere({field.name, internal ? internal_variable_unit(phases) : field.unit}, 1);
    }
    add_everywhere({"contact_status", "1"}, 1);
  }
  if (phases.heat != nullptr && (with_friction(phases) || interfaces_store(phases)))
    add_everywhere({"interface_temperature", "K"}, 1);
  for (const contact::ContactPair* pair : phases.contacts)
    for (const std::string& surface : {pair->spec().slave, pair->spec().master})
      if (surface == pair->spec().slave || !pair->spec().rigid_master) surfaces_[surface] = contact;
}

void StateFields::find_side_areas(AnalysisKind kind) {
  if (phases_.contacts.empty()) return;
  covered_.assign(mesh_.x.size(), 0.0);
  for (const contact::ContactPair* pair : phases_.contacts) {
    auto& sides = side_area_.emplace_back();
    for (std::size_t side = 0; side < 2; ++side) {
      sides[side].assign(mesh_.x.size(), 0.0);
      const auto surface = mesh_.surfaces.find(side == 0 ? pair->spec().slave : pair->spec().master);
      if (surface == mesh_.surfaces.end()) continue;  // a rigid one
      for (const mesh::ElementBlock& faces : surface->second.faces) {
        const mesh::FaceGeometry g(mesh_, faces, kind, mesh::gauss_rule(faces.shape, 4));
        const auto n = static_cast<std::size_t>(g.n_nodes), n_points = static_cast<std::size_t>(g.n_points);
        for (Index f = 0; f < g.n_faces; ++f)
          for (std::size_t q = 0; q < n_points; ++q)
            for (std::size_t a = 0; a < n; ++a)
              sides[side][static_cast<std::size_t>(faces.element(f)[a])] +=
                  g.values[q * n + a] * g.weight[static_cast<std::size_t>(f) * n_points + q];
      }
    }
  }
}

std::vector<double>& StateFields::add(std::string name, std::string unit, int components,
                                      mesh::FieldPlace place) {
  auto v =
      std::make_unique<Values>(Values{std::move(name), std::move(unit), components, place, {}, false, {}});
  v->values.assign(value_count(mesh_, place, components), 0.0);
  by_name_[v->name] = &v->values;
  values_.push_back(std::move(v));
  return values_.back()->values;
}

void StateFields::add_elements() {
  for (const ElementFieldName& field : k_elements) {
    if (field.plastic && !phases_.mechanics->plastic()) continue;
    const bool isentropic = phases_.mechanics->mapping() == mechanics::Mapping::isentropic;
    if (field.which == ElementField::intermediate_temperature && !isentropic) continue;
    if (field.which == ElementField::pore_fraction && phases_.coherency == nullptr)
      continue;  // nothing melts
    const auto compute = [this, which = field.which] {
      return mechanics::element_field(mesh_, shown_, which);
    };
    values_.push_back(std::make_unique<Values>(Values{field.name,
                                                      field.unit,
                                                      component_count(field.which),
                                                      mesh::FieldPlace::cell,
                                                      {},
                                                      false,
                                                      compute,
                                                      field.on_request}));
  }
}

void StateFields::add_heat_flux() {
  const auto add = [this](const char* name, const char* unit, int components, auto element_values) {
    const auto compute = [this, element_values] {
      return element_values(
          mesh_, kind_,
          [this](int body) -> const material::Material& { return phases_.heat->storage().material(body); },
          *by_name_.at("temperature"));
    };
    values_.push_back(std::make_unique<Values>(
        Values{name, unit, components, mesh::FieldPlace::cell, {}, false, compute, true}));
  };
  add("heat_flux", "W/m2", mesh_.dimension, element_heat_flux);
  add("conduction_dissipation", "W/m3", 1, element_conduction_dissipation);
}

void StateFields::add_nodal_stress() {
  const auto nodal = [this](int body) {
    if (!recovery_) recovery_ = std::make_unique<StressRecovery>(mesh_, kind_);
    return recovery_->at_nodes(mechanics::element_field(mesh_, shown_, ElementField::stress), body);
  };
  const auto add = [this](const char* name, int components,
                          const std::function<std::vector<double>(int body)>& compute) {
    values_.push_back(std::make_unique<Values>(Values{name,
                                                      "Pa",
                                                      components,
                                                      mesh::FieldPlace::node,
                                                      {},
                                                      false,
                                                      [compute] { return compute(-1); },
                                                      true,
                                                      compute}));
  };
  add("nodal_stress", 6, nodal);
  add("nodal_von_mises", 1, [nodal](int body) { return von_mises_values(nodal(body)); });
  for (int rank = 0; rank < 3; ++rank)
    add(k_principal[rank], 1, [nodal, rank](int body) { return principal_values(nodal(body), rank); });
}

void StateFields::add_criteria() {
  if (phases_.criteria == nullptr) return;
  for (const criteria::CriterionField& field : phases_.criteria->fields()) {
    const mesh::FieldPlace place = field.place;
    values_.push_back(
        std::make_unique<Values>(Values{field.name, field.unit, field.components, place, {}, false, {}}));
    Values* v = values_.back().get();
    by_name_[v->name] = &v->values;
    v->compute = [v, n = value_count(mesh_, place, field.components)] {
      return v->values.empty() ? std::vector<double>(n, 0.0) : v->values;
    };
  }
}

void StateFields::release_criteria() {
  if (phases_.criteria == nullptr) return;
  for (const criteria::CriterionField& field : phases_.criteria->fields())
    std::vector<double>().swap(*by_name_.at(field.name));
}

void StateFields::update_criteria(const coupling::State& state) {
  if (phases_.criteria == nullptr) return;
  std::vector<std::span<double>> values;
  for (const criteria::CriterionField& field : phases_.criteria->fields()) {
    std::vector<double>& of_field = *by_name_.at(field.name);
    of_field.resize(value_count(mesh_, field.place, field.components));
    values.emplace_back(of_field);
  }
  phases_.criteria->fill({state.time - state.poured, state.heat, state.mechanics}, state.criteria, values);
}

void StateFields::update(const coupling::State& state) {
  const linear::ActiveSet& there =
      phases_.heat != nullptr ? phases_.heat->active() : phases_.mechanics->active();
  const linear::ActiveSet* active = there.complete() ? nullptr : &there;
  bodies_.set_active(active);
  for (auto& [name, fields] : surfaces_) fields.set_active(active);
  if (phases_.heat != nullptr) {
    std::copy(state.heat.temperature.begin(), state.heat.temperature.end(), by_name_["temperature"]->begin());
    const std::vector<double> solid = phases_.heat->solid_fraction(state.heat);
    std::copy(solid.begin(), solid.end(), by_name_["solid_fraction"]->begin());
  }
  if (phases_.mechanics != nullptr) {
    std::copy(state.mechanics.displacement.begin(), state.mechanics.displacement.end(),
              by_name_["displacement"]->begin());
    if (phases_.mechanics->dynamic()) {
      std::copy(state.mechanics.velocity.begin(), state.mechanics.velocity.end(),
                by_name_["velocity"]->begin());
      std::copy(state.mechanics.acceleration.begin(), state.mechanics.acceleration.end(),
                by_name_["acceleration"]->begin());
    }
    shown_.elements = state.mechanics.elements;
  }
  if (!phases_.contacts.empty()) update_contacts(state.heat.temperature);
}

// A node of several pairs shows its closest partner; nodes away from the surfaces show zero.
void StateFields::update_contacts(std::span<const double> temperature) {
  for (const auto& v : values_)
    if (v->of_contact) std::fill(v->values.begin(), v->values.end(), 0.0);
  std::vector<double>&gap = *by_name_["gap"], &pressure = *by_name_["contact_pressure"],
  &conductance = *by_name_["conductance"];
  std::vector<char> seen(gap.size(), 0);
  std::fill(covered_.begin(), covered_.end(), 0.0);
  for (std::size_t number = 0; number < phases_.contacts.size(); ++number) {
    const contact::ContactPair* pair = phases_.contacts[number];
    const auto& [slave_area, master_area] = side_area_[number];
    const contact::ContactNodalFields fields = contact::nodal_fields(pair->view(), temperature);
    std::vector<char> closest(fields.nodes.size(), 0);
    for (std::size_t k = 0; k < fields.nodes.size(); ++k) {
      const auto i = static_cast<std::size_t>(fields.nodes[k]);
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
  const auto show = [&](const char* name, const std::vector<double>& values) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) return;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (closest[k] != 0) (*found->second)[static_cast<std::size_t>(fields.nodes[k])] = values[k];
  };
  show("contact_heat_flux", fields.heat_flux);
  show("frictional_heat_flux", fields.frictional_heat_flux);
  const auto interface = by_name_.find("interface_temperature");
  // The slave's alone: the master remembers none.
  for (std::size_t k = 0; interface != by_name_.end() && k < fields.temperature.size(); ++k)
    if (closest[k] != 0 && std::isfinite(fields.temperature[k]))
      (*interface->second)[static_cast<std::size_t>(fields.nodes[k])] = fields.temperature[k];
}

// Updates the fields of friction. The history fields of a surface in several pairs are the largest of all
// pairs; the fields of the present contact are those of the pair with the closest partner.
void StateFields::update_friction(const contact::ContactNodalFields& fields, std::span<const char> closest) {
  const std::array<const std::vector<double>*, std::size(k_remembered)> remembered = {
      &fields.slip, &fields.internal_variable, &fields.coefficient, &fields.dissipation, &fields.wear_depth};
  std::vector<double>&traction = *by_name_["friction_traction"], &status = *by_name_["contact_status"];
  const auto components = static_cast<std::size_t>(phases_.mechanics->components());
  for (std::size_t k = 0; k < fields.nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(fields.nodes[k]);
    for (std::size_t f = 0; f < remembered.size(); ++f) {
      double& value = (*by_name_[k_remembered[f].name])[i];
      value = std::fmax(value, (*remembered[f])[k]);  // NaN where the node has none
    }
    if (closest[k] == 0) continue;
    status[i] = fields.status[k];
    for (std::size_t c = 0; c < components; ++c) traction[i * components + c] = fields.traction[k][c];
  }
}

}  // namespace solidus::results
