/// Functions that the kernels require of a law besides its update: one overload per law, selected by the
/// types of its properties and state.
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "material/derivatives/isentropic.hpp"
#include "material/viscoelastic.hpp"
#include "material/viscoplastic.hpp"
#include "mechanics/state/element_field.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// The part of the properties that every law has, at Θ_n.
template <class T>
const material::PointProperties<T>& elastic_part(const material::Viscoelastic&,
                                                 const material::PointProperties<T>& p) {
  return p;
}
template <class T>
const material::PointProperties<T>& elastic_part(const material::Viscoplastic&,
                                                 const material::Viscoplastic::Properties<T>& p) {
  return p.elastic;
}
template <class T>
material::PointProperties<T> elastic_part(const material::Isentropic& law,
                                          const material::Isentropic::Properties<T>& p) {
  const auto e = law.at_temperature(p, p.temperature).elastic;
  return {e.bulk.v, e.shear.v, e.thermal_strain.v, e.solid_fraction.v, e.viscosity.v};
}

/// The isothermal law with flow, and its properties at Θ_n.
inline const material::Viscoplastic& isothermal_law(const material::Viscoplastic& law) {
  return law;
}
inline const material::Viscoplastic& isothermal_law(const material::Isentropic& law) {
  return law.isothermal();
}
template <class T>
const material::Viscoplastic::Properties<T>& isothermal_part(const material::Viscoplastic&,
                                                             const material::Viscoplastic::Properties<T>& p) {
  return p;
}
template <class T>
material::Viscoplastic::Properties<T> isothermal_part(const material::Isentropic& law,
                                                      const material::Isentropic::Properties<T>& p) {
  return {elastic_part(law, p), p.flow};
}

/// The law that works at a given temperature: of an isentropic law the isothermal one, every other law
/// itself.
inline const material::Viscoplastic& law_at_temperature(const material::Isentropic& law) {
  return law.isothermal();
}
template <class Law>
const Law& law_at_temperature(const Law& law) {
  return law;
}

/// Sets η of a melt whose material has none [Pa s].
inline void set_melt_viscosity(const Lane& viscosity, material::PointProperties<Lane>& p) {
  p.viscosity = viscosity;
}
inline void set_melt_viscosity(const Lane& viscosity, material::Viscoplastic::Properties<Lane>& p) {
  p.elastic.viscosity = viscosity;
}
inline void set_melt_viscosity(const Lane& viscosity, material::Isentropic::Properties<Lane>& p) {
  p.viscosity = viscosity;
}

/// The lanes of a state that the material can change, rising: no viscous strain without a melt, no back
/// strain without kinematic hardening. Others are zero. One at least.
std::vector<std::size_t> kept_lanes(const material::Viscoelastic& law);
std::vector<std::size_t> kept_lanes(const material::Viscoplastic& law);
std::vector<std::size_t> kept_lanes(const material::Isentropic& law);

/// Returns the strain to be subtracted from the total strain to obtain the elastic one.
template <class T>
Sym<T> inelastic_strain(const material::Viscoelastic::State<T>& state) {
  return state.viscous_strain;
}
template <class T>
Sym<T> inelastic_strain(const material::Viscoplastic::State<T>& state) {
  return state.viscous_strain + state.plastic_strain;
}

/// Returns the part of tr ε that is not elastic: flow and viscosity keep the volume.
template <class State>
Lane inelastic_volume(const State&) {
  return Lane(0.0);
}

/// Returns the variables of the energy stored by hardening besides temperature: ξ and ζ:ζ.
template <class T>
std::array<T, 2> hardening_of(const material::Viscoelastic::State<T>&) {
  return {T(0.0), T(0.0)};
}
template <class T>
std::array<T, 2> hardening_of(const material::Viscoplastic::State<T>& state) {
  return {state.hardening, dot(state.back_strain, state.back_strain)};
}

/// Returns their change since `old`: Δξ and ζ : Δζ.
template <class T>
std::array<T, 2> hardening_change(const material::Viscoelastic::State<T>&,
                                  const material::Viscoelastic::State<T>&) {
  return {T(0.0), T(0.0)};
}
template <class T>
std::array<T, 2> hardening_change(const material::Viscoplastic::State<T>& state,
                                  const material::Viscoplastic::State<T>& old) {
  return {state.hardening - old.hardening, dot(state.back_strain, state.back_strain - old.back_strain)};
}

/// s : ε̇^vp and the plastic part of D_mech [W/m³].
struct PlasticPower {
  Lane power{}, dissipation{};
};

/// S^I of a state [J/(m³ K)], and the energy of plastic work that is stored in addition to that of hardening
/// [J/m³].
template <class T>
T inelastic_entropy(const material::Viscoelastic::State<T>&) {
  return T(0.0);
}
template <class T>
T inelastic_entropy(const material::Viscoplastic::State<T>& state) {
  return state.inelastic_entropy;
}
template <class T>
T cold_work(const material::Viscoelastic::State<T>&) {
  return T(0.0);
}
template <class T>
T cold_work(const material::Viscoplastic::State<T>& state) {
  return state.cold_work;
}
template <class Response>
PlasticPower plastic_power(const material::Viscoelastic&, const Response&) {
  return {};
}
template <class Response>
PlasticPower plastic_power(const material::Viscoplastic&, const Response& r) {
  return {r.plastic_power, r.plastic_dissipation};
}
template <class Response>
PlasticPower plastic_power(const material::Isentropic&, const Response& r) {
  return {r.plastic_power, r.plastic_dissipation};
}

/// Values of a point or, averaged, of an element for results (units as in ElementField).
template <class T>
struct ViscoelasticValues {
  using OfOne = ViscoelasticValues<double>;
  Sym<T> stress, strain, viscous_strain;
  T dissipation{};
};
template <class T>
struct ViscoplasticValues {
  using OfOne = ViscoplasticValues<double>;
  Sym<T> stress, strain, viscous_strain, plastic_strain, back_stress;
  T equivalent_plastic_strain{}, flow_stress{}, dissipation{}, thermal_dissipation{}, inelastic_entropy{};
};
template <class T>
struct IsentropicValues {
  using OfOne = IsentropicValues<double>;
  ViscoplasticValues<T> mechanical;
  T temperature{};  ///< Θ̄
};

template <class Response>
ViscoelasticValues<Lane> values_of(const material::Viscoelastic&, const material::PointProperties<Lane>&,
                                   const Response& r, const Sym<Lane>& strain) {
  return {r.stress, strain, r.state.viscous_strain, r.dissipation};
}
/// The flow stress and all values that follow from state and properties: everything but stress, strain and
/// dissipation.
ViscoplasticValues<Lane> values_of(const material::Viscoplastic& law,
                                   const material::Viscoplastic::Properties<Lane>& p,
                                   const material::Viscoplastic::State<Lane>& state);
template <class Response>
ViscoplasticValues<Lane> values_of(const material::Viscoplastic& law,
                                   const material::Viscoplastic::Properties<Lane>& p, const Response& r,
                                   const Sym<Lane>& strain) {
  ViscoplasticValues<Lane> v = values_of(law, p, r.state);
  v.stress = r.stress;
  v.strain = strain;
  v.dissipation = r.dissipation;
  v.thermal_dissipation = r.thermal_dissipation;
  return v;
}
/// The same for the isentropic mapping, at Θ̄ but for the frozen properties.
ViscoplasticValues<Lane> values_of(const material::Isentropic& law,
                                   const material::Isentropic::Properties<Lane>& p,
                                   const material::Isentropic::State<Lane>& state, const Lane& temperature);
template <class Response>
IsentropicValues<Lane> values_of(const material::Isentropic& law,
                                 const material::Isentropic::Properties<Lane>& p, const Response& r,
                                 const Sym<Lane>& strain) {
  IsentropicValues<Lane> v{values_of(law, p, r.state, r.temperature), r.temperature};
  v.mechanical.stress = r.stress;
  v.mechanical.strain = strain;
  v.mechanical.dissipation = r.dissipation;
  v.mechanical.thermal_dissipation = r.thermal_dissipation;
  return v;
}

/// The values that the law at a given temperature has, among those of a law.
inline ViscoplasticValues<Lane>& values_at_temperature(IsentropicValues<Lane>& values) {
  return values.mechanical;
}
template <class Values>
Values& values_at_temperature(Values& values) {
  return values;
}

/// One field of an element, to component_count() places; what a law does not know is zero.
void put(ElementField which, const ViscoelasticValues<double>& values, double* to);
void put(ElementField which, const ViscoplasticValues<double>& values, double* to);
void put(ElementField which, const IsentropicValues<double>& values, double* to);

/// sum += weight × values, of a struct that holds nothing but lanes.
template <class Values>
void add_weighted(Values& sum, const Lane& weight, const Values& values) {
  using Lanes = std::array<Lane, sizeof(Values) / sizeof(Lane)>;
  auto total = std::bit_cast<Lanes>(sum);
  const auto added = std::bit_cast<Lanes>(values);
  for (std::size_t i = 0; i < total.size(); ++i) total[i] += weight * added[i];
  sum = std::bit_cast<Values>(total);
}

/// Lane by lane `a` where the mask holds, else `b`: structs that hold nothing but lanes.
template <class Values>
Values select_lanes(const LaneMask& mask, const Values& a, const Values& b) {
  using Lanes = std::array<Lane, sizeof(Values) / sizeof(Lane)>;
  auto chosen = std::bit_cast<Lanes>(a);
  const auto others = std::bit_cast<Lanes>(b);
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = select(mask, chosen[i], others[i]);
  return std::bit_cast<Values>(chosen);
}

/// In words, for the message of a step that failed.
std::string text(const Sym<double>& a);
std::string text(const material::Viscoelastic::State<double>& state);
std::string text(const material::Viscoplastic::State<double>& state);

/// One element of a batch: the same struct on double, of one on Lane that holds nothing but lanes. Reads that
/// lane alone, as results ask for every element.
template <class OnDouble, class OnLane>
OnDouble element_of(const OnLane& batch, int lane) {
  static_assert(sizeof(OnLane) == sizeof(OnDouble) * k_lanes);
  std::array<double, sizeof(OnDouble) / sizeof(double)> values;
  const char* from = reinterpret_cast<const char*>(&batch) + as_size(lane) * sizeof(double);
  for (double& value : values) {
    std::memcpy(&value, from, sizeof value);
    from += sizeof(Lane);
  }
  return std::bit_cast<OnDouble>(values);
}

}  // namespace solidus::mechanics
