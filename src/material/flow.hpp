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

/// The places of the built-in laws in hardening_laws(), kinematic_laws(), rate_laws() and liquid_laws()
/// (laws/); what is added comes after them.
enum class IsotropicHardening { none, linear, saturation, power, table };
enum class KinematicHardening { none, linear, armstrong_frederick };
enum class RateDependence { none, perzyna };
enum class LiquidModel { maxwell, modified_shear, degenerated };

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
  std::array<Table, k_kinematic_parameters> recall;  ///< the parameters of that law in its order

  RateDependence rate_dependence = RateDependence::perzyna;
  /// The parameters of that law in its order, such as rate[Perzyna::viscosity]; as they are here, with a
  /// viscosity of zero everywhere, the flow is rate independent.
  std::array<Table, k_rate_parameters> rate{Table(0.0), Table(1.0), Table(1.0)};

  /// Taylor–Quinney factor β(Θ), the share of plastic power that becomes heat. Absent: what hardening does
  /// not store (2.118).
  std::optional<Table> heat_share;

  /// The tables that the kinds read, in the order of the material file.
  std::vector<Property> properties() const;
  bool rate_independent() const;
  /// Whether γ̇ is in proportion to the overstress at every temperature, or there is none.
  bool linear_rate() const;
  bool added_rate() const { return rate_dependence > RateDependence::perzyna; }
  bool powered_rate() const { return rate_dependence == RateDependence::perzyna && !linear_rate(); }
};

}  // namespace solidus::material
