/// Record of every step of a material point, and the columns in which it is shown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "numbers/tensor.hpp"

namespace solidus::point {

/// SI, absolute temperature.
struct MaterialPointRecord {
  double time = 0, temperature = 0;
  Sym<double> strain, stress, plastic_strain, viscous_strain, back_stress;
  double thermal_strain = 0;       ///< linear, e^θ/3
  double equivalent_plastic = 0;   ///< ξ
  double solid_fraction = 1;       ///< f_S
  double flow_stress = 0;          ///< w (σ_0 + K_ξ): the yield stress of a tensile test now
  double viscous_dissipation = 0;  ///< 2.114 [W/m³]
  double plastic_dissipation = 0;  ///< 2.117 [W/m³]
  double plastic_power = 0;        ///< s : ε̇^vp [W/m³]
  double thermal_dissipation = 0;  ///< 2.120 [W/m³]
  double isotropic_energy = 0;     ///< K of 2.49d [J/m³]
  double kinematic_energy = 0;     ///< ⅓ K ζ : ζ [J/m³]
  double work = 0;                 ///< ∫ σ : dε [J/m³]
  double dissipated = 0;           ///< ∫ D_mech dt [J/m³]
  double internal_energy = 0;      ///< with latent heat, zero at the start [J/m³]
  double entropy = 0;              ///< with that of latent heat, zero at the start [J/(m³ K)]
  double heat = 0;                 ///< taken in: internal energy less work [J/m³]
  int iterations = 0, cuts = 0;    ///< Newton's, and how often the step was halved
  std::vector<double> residuals;   ///< of Newton's method [Pa]; no column
};

struct RecordColumn {
  std::string name, unit;  ///< "stress_xx", "MPa"
  std::string si;          ///< the unit of MaterialPointRecord, "Pa"
  double scale, offset;    ///< shown = scale × SI + offset
  double (*of)(const MaterialPointRecord&);

  std::string header() const { return name + "[" + unit + "]"; }
  double shown(const MaterialPointRecord& record) const { return scale * of(record) + offset; }
};

/// Every column of a history, in order.
const std::vector<RecordColumn>& columns();
/// The column of that name; null when there is none.
const RecordColumn* find_column(std::string_view name);

inline constexpr const char* k_component_names[6] = {"xx", "yy", "zz", "xy", "yz", "xz"};

}  // namespace solidus::point
