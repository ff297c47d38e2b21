#include "results/state_fields.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::results {

namespace {

// Copies [element][component] of one block behind what is there already.
template <std::size_t n>
void append(std::vector<double>& to, std::size_t& at, const std::vector<std::array<double, n>>& from) {
  for (const auto& values : from)
    for (const double v : values) to[at++] = v;
}
void append(std::vector<double>& to, std::size_t& at, const std::vector<double>& from) {
  for (const double v : from) to[at++] = v;
}

}  // namespace

StateFields::StateFields(const mesh::Mesh& mesh, const coupling::Phases& phases)
    : mesh_(mesh), phases_(phases), ghosts_(mesh) {
  if (phases.heat != nullptr) {
    add("temperature", "K", 1, Place::node);
    add("solid_fraction", "1", 1, Place::node);
  }
  if (phases.mechanics != nullptr) {
    add("displacement", "m", phases.mechanics->components(), Place::node);
    if (phases.mechanics->dynamic()) {
      add("velocity", "m/s", phases.mechanics->components(), Place::node);
      add("acceleration", "m/s2", phases.mechanics->components(), Place::node);
    }
    add("stress", "Pa", 6, Place::cell);
    add("von_mises", "Pa", 1, Place::cell);
    add("pressure", "Pa", 1, Place::cell);
    add("viscous_strain", "1", 6, Place::cell);
    add("dissipation", "W/m3", 1, Place::cell);
    if (phases.mechanics->plastic()) {
      add("plastic_strain", "1", 6, Place::cell);
      add("equivalent_plastic_strain", "1", 1, Place::cell);
      add("back_stress", "Pa", 6, Place::cell);
      add("flow_stress", "Pa", 1, Place::cell);
    }
  }
  for (const auto& v : values_) bodies_.add({v->name, v->unit, v->components, v->place, v->values});
  if (phases.contacts.empty()) return;

  FieldSet contact;
  for (const auto& v : values_)
    if (v->place == Place::node) contact.add({v->name, v->unit, v->components, v->place, v->values});
  for (const auto& [name, unit] :
       {std::pair{"gap", "m"}, {"contact_pressure", "Pa"}, {"conductance", "W/m2/K"}}) {
    const std::vector<double>& values = add(name, unit, 1, Place::node);
    contact.add({name, unit, 1, Place::node, values});
    bodies_.add({name, unit, 1, Place::node, values});
  }
  for (const contact::ContactPair* pair : phases.contacts)
    for (const std::string& surface : {pair->spec().slave, pair->spec().master}) surfaces_[surface] = contact;
}

std::vector<double>& StateFields::add(std::string name, std::string unit, int components, Place place) {
  auto v = std::make_unique<Values>(Values{std::move(name), std::move(unit), components, place, {}});
  v->values.assign(value_count(mesh_, place, components), 0.0);
  by_name_[v->name] = &v->values;
  values_.push_back(std::move(v));
  return values_.back()->values;
}

void StateFields::update(const coupling::State& state) {
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
    update_elements();
  }
  if (!phases_.contacts.empty()) update_contacts(state.heat.temperature);
}

void StateFields::update_elements() {
  const std::vector<mechanics::ElementFields> blocks = phases_.mechanics->element_fields();
  std::map<std::string, std::size_t> filled;
  const auto append_to = [&](const char* name, const auto& values) {
    append(*by_name_.at(name), filled[name], values);
  };
  for (const mechanics::ElementFields& block : blocks) {
    append_to("stress", block.stress);
    append_to("von_mises", block.von_mises);
    append_to("pressure", block.pressure);
    append_to("viscous_strain", block.viscous_strain);
    append_to("dissipation", block.dissipation);
    if (!phases_.mechanics->plastic()) continue;
    append_to("plastic_strain", block.plastic_strain);
    append_to("equivalent_plastic_strain", block.equivalent_plastic_strain);
    append_to("back_stress", block.back_stress);
    append_to("flow_stress", block.flow_stress);
  }
}

// A node of several pairs shows its closest partner; nodes away from the surfaces show zero.
void StateFields::update_contacts(std::span<const double> temperature) {
  std::vector<double>&gap = *by_name_["gap"], &pressure = *by_name_["contact_pressure"],
  &conductance = *by_name_["conductance"];
  for (std::vector<double>* field : {&gap, &pressure, &conductance})
    std::fill(field->begin(), field->end(), 0.0);
  std::vector<char> seen(gap.size(), 0);
  for (const contact::ContactPair* pair : phases_.contacts) {
    const contact::ContactNodalFields fields = pair->nodal_fields(temperature);
    for (std::size_t k = 0; k < fields.nodes.size(); ++k) {
      const auto i = static_cast<std::size_t>(fields.nodes[k]);
      if (!std::isfinite(fields.opening[k]) || (seen[i] != 0 && gap[i] <= fields.opening[k])) continue;
      seen[i] = 1;
      gap[i] = fields.opening[k];
      pressure[i] = fields.pressure[k];
      conductance[i] = fields.conductance[k];
    }
  }
  for (std::vector<double>* field : {&gap, &pressure, &conductance}) ghosts_.update(*field, 1);
}

}  // namespace solidus::results
