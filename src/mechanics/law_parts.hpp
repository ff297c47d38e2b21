/// What the kernels ask of a law beside its update: one overload per law, found by the types of its
/// properties and state.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <string>
#include <type_traits>

#include "material/viscoelastic.hpp"
#include "material/viscoplastic.hpp"

namespace solidus::mechanics {

/// The part of the properties that every law has.
template <class T>
const material::PointProperties<T>& elastic_part(const material::PointProperties<T>& p) {
  return p;
}
template <class T>
const material::PointProperties<T>& elastic_part(const material::Viscoplastic::Properties<T>& p) {
  return p.elastic;
}

/// What to subtract from the strain for the elastic one.
template <class T>
Sym<T> inelastic_strain(const material::Viscoelastic::State<T>& state) {
  return state.viscous_strain;
}
template <class T>
Sym<T> inelastic_strain(const material::Viscoplastic::State<T>& state) {
  return state.viscous_strain + state.plastic_strain;
}

inline std::string text(const Sym<double>& a) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}, {:.4g}, {:.4g}, {:.4g})", a[0], a[1], a[2], a[3], a[4], a[5]);
}
/// A state in words, for the message of a step that failed.
inline std::string text(const material::Viscoelastic::State<double>& state) {
  return fmt::format("viscous strain {}", text(state.viscous_strain));
}
inline std::string text(const material::Viscoplastic::State<double>& state) {
  return fmt::format("equivalent plastic strain {:.4g}, plastic strain {}, back strain {}, viscous strain {}",
                     state.hardening, text(state.plastic_strain), text(state.back_strain),
                     text(state.viscous_strain));
}

/// One element of a batch: the same struct on double, of one on Lane that holds nothing but lanes.
template <class OnDouble, class OnLane>
OnDouble element_of(const OnLane& batch, int lane) {
  static_assert(std::is_trivially_copyable_v<OnDouble> && std::is_trivially_copyable_v<OnLane>);
  static_assert(sizeof(OnLane) == sizeof(OnDouble) * k_lanes);
  constexpr std::size_t n = sizeof(OnDouble) / sizeof(double);
  std::array<Lane, n> lanes;
  std::memcpy(static_cast<void*>(lanes.data()), &batch, sizeof batch);
  std::array<double, n> values;
  for (std::size_t i = 0; i < n; ++i) values[i] = lanes[i][lane];
  OnDouble result;
  std::memcpy(static_cast<void*>(&result), values.data(), sizeof result);
  return result;
}

}  // namespace solidus::mechanics
