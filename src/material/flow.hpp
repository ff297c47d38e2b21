/// Data of the flow rule, by which a material yields, hardens and creeps (monograph 2.49d, 2.106–2.112),
/// every parameter a table over absolute temperature. The laws are in hardening.hpp and viscoplastic.hpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "material/flow_curves.hpp"
#include "material/laws/parameter.hpp"
#include "numbers/table.hpp"

namespace solidus::material {

/// A table by its path in a material file, "plasticity.flow_stress", with its SI unit.
struct Property {
  std::string name;
  std::string unit;
  const Table* table;  ///< of the material that was asked
};

/// The places of the built-in laws in hardening_laws() (laws/hardening_law.hpp); what is added comes after
/// them.
enum class IsotropicHardening { none, linear, saturation, power, table };
enum class KinematicHardening { none, linear, armstrong_frederick };

/// Models of the liquid (2.3.1).
enum class LiquidModel {
  maxwell,         ///< 2.50: spring G/f_S in series with a dashpot η/(1 − f_S)
  modified_shear,  ///< 2.77, 2.78: shear modulus f_S G(Θ_S), zero in the liquid
  degenerated      ///< 2.79–2.83: yield radius times f_S; the liquid is purely viscoplastic
};

/// Below it the overstress rises with more than the tenth power of the rate.
inline constexpr double k_least_rate_exponent = 0.1;

struct Flow {
  Table flow_stress;  ///< σ_0(Θ) [Pa], at ξ = 0; falls with temperature (2.121)

  IsotropicHardening isotropic = IsotropicHardening::none;
  /// The parameters of that law in its order, such as hardening[Voce::saturation_rate]; zero beyond them.
  std::array<Table, k_hardening_parameters> hardening;
  FlowCurves curves;  ///< σ(ξ, Θ), of kind table; flow_stress is its value at ξ = 0

  KinematicHardening kinematic = KinematicHardening::none;
  Table kinematic_modulus;  ///< K(Θ) [Pa]: q̇ = 2/3 K ε̇^vp, so K is the slope of a uniaxial test
  Table recall;             ///< of Armstrong–Frederick: the uniaxial back stress saturates at K/recall

  /// η(Θ) of the overstress [Pa s], zero everywhere: rate independent. With exponent n and drag stress D the
  /// flow rate is γ̇ = f_S/η Φ (Φ/D)^(n − 1): for n = 1 the monograph's 2.109b, else η_2.109b = η D^(n − 1).
  Table viscosity;
  Table exponent{1.0};     ///< n(Θ), at least k_least_rate_exponent
  Table drag_stress{1.0};  ///< D(Θ) [Pa], of n other than 1

  /// Taylor–Quinney factor β(Θ), the share of plastic power that becomes heat. Absent: what hardening does
  /// not store (2.118).
  std::optional<Table> heat_share;

  /// The tables that the kinds read, in the order of the material file.
  std::vector<Property> properties() const;
  bool rate_independent() const { return viscosity.max_value() == 0; }
  bool linear_rate() const { return exponent.min_value() == 1 && exponent.max_value() == 1; }
};

}  // namespace solidus::material
