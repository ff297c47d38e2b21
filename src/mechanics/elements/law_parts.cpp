/// One overload per law for each question that a kernel asks: what it stores, what it shows, how its lanes
/// are packed.
#include "mechanics/elements/law_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "material/hardening.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

namespace {

void put(const Sym<double>& tensor, double* to) {
  std::copy(tensor.c.begin(), tensor.c.end(), to);
}

/// Writes the fields that every law has.
template <class Values>
void put_common(ElementField which, const Values& values, double* to) {
  switch (which) {
    case ElementField::stress:
      return put(values.stress, to);
    case ElementField::strain:
      return put(values.strain, to);
    case ElementField::viscous_strain:
      return put(values.viscous_strain, to);
    case ElementField::dissipation:
      *to = values.dissipation;
      return;
    // Derived from the stress: von Mises's equivalent and the pressure, which is positive in
    // compression.
    case ElementField::von_mises:
      *to = von_mises(values.stress);
      return;
    case ElementField::pressure:
      *to = -trace(values.stress) / 3;
      return;
    default:
      std::fill_n(to, component_count(which), 0.0);
  }
}

/// Copies the strains that a state holds; flow stress and back stress follow from the properties.
ViscoplasticValues<Lane> values_of(const material::Viscoplastic::State<Lane>& state) {
  ViscoplasticValues<Lane> v;
  v.viscous_strain = state.viscous_strain;
  v.plastic_strain = state.plastic_strain;
  v.equivalent_plastic_strain = state.hardening;
  v.inelastic_entropy = state.inelastic_entropy;
  return v;
}

/// @param yield, kinematic_modulus σ_0 + K_ξ and K [Pa]; strength: w of the liquid models
void set_flow(ViscoplasticValues<Lane>& v, const material::Viscoplastic::State<Lane>& state, Lane strength,
              Lane yield, Lane kinematic_modulus) {
  v.flow_stress = strength * yield;
  v.back_stress = Lane(-2.0 / 3.0) * strength * kinematic_modulus * state.back_strain;
}

/// Appends the lanes of a member of a state.
template <class State, class Member>
void append_lanes(Member State::*member, std::vector<std::size_t>& lanes) {
  const State state{};
  const auto from = reinterpret_cast<const char*>(&(state.*member)) - reinterpret_cast<const char*>(&state);
  const auto first = as_size(from) / sizeof(Lane);
  for (std::size_t i = 0; i < sizeof(Member) / sizeof(Lane); ++i) lanes.push_back(first + i);
}

/// A block that takes part has a history: one lane at least.
std::vector<std::size_t> one_at_least(std::vector<std::size_t> lanes) {
  if (lanes.empty()) lanes.push_back(0);
  return lanes;
}

/// Returns the lanes of the state that both viscoplastic laws share.
std::vector<std::size_t> kept_lanes(const material::Material& material) {
  using State = material::Viscoplastic::State<Lane>;
  std::vector<std::size_t> lanes;
  // Strains that this material cannot have are not stored: viscous strain needs a melt, back strain kinematic
  // hardening, the entropy of flow a yield stress that depends on temperature.
  if (material.solidification() != nullptr) append_lanes(&State::viscous_strain, lanes);
  if (!material.flow) return one_at_least(std::move(lanes));
  append_lanes(&State::plastic_strain, lanes);
  if (material.flow->kinematic != material::KinematicHardening::none)
    append_lanes(&State::back_strain, lanes);
  append_lanes(&State::hardening, lanes);
  if (!material.flow->flow_stress.constant()) append_lanes(&State::inelastic_entropy, lanes);
  if (material.flow->heat_share) append_lanes(&State::cold_work, lanes);
  return lanes;
}

}  // namespace

std::vector<std::size_t> kept_lanes(const material::Viscoelastic& law) {
  std::vector<std::size_t> lanes;
  if (law.material().solidification() != nullptr)
    append_lanes(&material::Viscoelastic::State<Lane>::viscous_strain, lanes);
  return one_at_least(std::move(lanes));
}
std::vector<std::size_t> kept_lanes(const material::Viscoplastic& law) {
  return kept_lanes(law.material());
}
std::vector<std::size_t> kept_lanes(const material::Isentropic& law) {
  return kept_lanes(law.material());
}

ViscoplasticValues<Lane> values_of(const material::Viscoplastic& law,
                                   const material::Viscoplastic::Properties<Lane>& p,
                                   const material::Viscoplastic::State<Lane>& state) {
  ViscoplasticValues<Lane> v = values_of(state);
  if (!law.material().flow) return v;
  const material::Flow& flow = *law.material().flow;
  const Lane strength = law.shear(p.elastic, 1.0).strength;
  const auto hardening = hardening_stress(flow.isotropic, flow.curves, p.flow, state.hardening);
  set_flow(v, state, strength, p.flow.flow_stress + hardening.stress, p.flow.kinematic_modulus);
  return v;
}

ViscoplasticValues<Lane> values_of(const material::Isentropic& law,
                                   const material::Isentropic::Properties<Lane>& p,
                                   const material::Isentropic::State<Lane>& state, const Lane& temperature) {
  using J = Jet<Lane>;
  ViscoplasticValues<Lane> v = values_of(state);
  if (!law.material().flow) return v;
  const material::Flow& flow = *law.material().flow;
  // The mapping has found the temperature of the point; flow and hardening are taken there.
  const auto at = law.at_temperature(p, temperature).flow;
  const Lane strength = law.isothermal().shear(elastic_part(law, p), 1.0).strength;  // of f_S, frozen
  const auto hardening = hardening_stress<J>(flow.isotropic, flow.curves, at, J(state.hardening));
  set_flow(v, state, strength, at.flow_stress.v + hardening.stress.v, at.kinematic_modulus.v);
  return v;
}

void put(ElementField which, const ViscoelasticValues<double>& values, double* to) {
  put_common(which, values, to);
}

void put(ElementField which, const ViscoplasticValues<double>& values, double* to) {
  // Fields that only the viscoplastic law has; all others are common to the laws.
  switch (which) {
    case ElementField::plastic_strain:
      return put(values.plastic_strain, to);
    case ElementField::back_stress:
      return put(values.back_stress, to);
    case ElementField::equivalent_plastic_strain:
      *to = values.equivalent_plastic_strain;
      return;
    case ElementField::flow_stress:
      *to = values.flow_stress;
      return;
    case ElementField::thermal_dissipation:
      *to = values.thermal_dissipation;
      return;
    case ElementField::inelastic_entropy:
      *to = values.inelastic_entropy;
      return;
    default:
      put_common(which, values, to);
  }
}

void put(ElementField which, const IsentropicValues<double>& values, double* to) {
  if (which == ElementField::intermediate_temperature)
    *to = values.temperature;
  else
    put(which, values.mechanical, to);
}

std::string text(const Sym<double>& a) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}, {:.4g}, {:.4g}, {:.4g})", a[0], a[1], a[2], a[3], a[4], a[5]);
}

std::string text(const material::Viscoelastic::State<double>& state) {
  return fmt::format("viscous strain {}", text(state.viscous_strain));
}

std::string text(const material::Viscoplastic::State<double>& state) {
  return fmt::format("equivalent plastic strain {:.4g}, plastic strain {}, back strain {}, viscous strain {}",
                     state.hardening, text(state.plastic_strain), text(state.back_strain),
                     text(state.viscous_strain));
}

}  // namespace solidus::mechanics
