/// Heat through the interface: by contact when closed, across the gap when open.
///
///   q = h (Θ_s − Θ_m) + σ_r F (Θ_s⁴ − Θ_m⁴)        [W/m²], from slave to master
///
///   closed (t_N >= 0, g = 0):  h = h_open(0) + h_co (t_N/H_e)^ε     for ε > 0   (3.49 beside the gas, 3.46)
///                              h = h_co                             for ε = 0
///   open (gap g > 0):          h = h_open(g), one of
///                                constant   h_o
///                                a table    h(g)                              (7.9)
///                                gas        k_a/(g + k_a/h_o)                 (3.50)
///
/// g [m] opening, t_N [Pa] contact pressure, h_co, h_o [W/(m² K)], H_e [Pa] Vickers hardness, k_a [W/(m K)]
/// conductivity of the gas, F = 1/(1/ε_1 + 1/ε_2 − 1) of two large grey surfaces that face each other, σ_r
/// the Stefan–Boltzmann constant.
///
/// Continuity where contact is lost: 3.49 alone vanishes with the pressure, so for ε > 0 the spots conduct
/// beside the gas between them (h_S + h_G of 3.46), and both branches give h_open(0) at t_N = 0, g = 0. For
/// ε = 0 the closed value does not depend on the pressure: h_open(0) must be h_co, and a law where it is not
/// is refused. Radiation acts in both states (it is small beside h when closed), so it does not jump either.
///
/// One coefficient from body to body. 3.45 is one-sided, from each body to an interface temperature Θ_c: two
/// equal sides of 2h each, in general 1/h = 1/h_1 + 1/h_2.
///
/// Source: monograph 3.46, 3.49, 3.50, table 7.9.
#pragma once

#include <optional>

#include "base/errors.hpp"
#include "base/table.hpp"

namespace solidus::contact {

struct HeatTransferSpec {
  enum class GapLaw { constant, table, gas };
  double conductance = 0;          ///< h_co [W/(m² K)], body to body
  double exponent = 0;             ///< ε of 3.49 [1]
  std::optional<double> hardness;  ///< H_e [Pa], needed when the exponent is not zero
  GapLaw gap_law = GapLaw::constant;
  std::optional<double> open_conductance;  ///< h_o [W/(m² K)] of `constant` and `gas`; absent: h_co
  Table gap_table;                         ///< h(g) [W/(m² K)] of the opening [m], g >= 0
  double gas_conductivity = 0;             ///< k_a [W/(m K)]
  /// Emissivities of the slave's and the master's surface; absent or zero: no radiation.
  double slave_emissivity = 0, master_emissivity = 0;
  SourceLocation where;
};

class HeatTransferLaw {
 public:
  /// Throws InputError for data that make no law: negative or missing values, or a jump at g = 0.
  explicit HeatTransferLaw(HeatTransferSpec spec);

  /// h [W/(m² K)] of an interface with this opening [m] (negative: penetration) and pressure t_N [Pa].
  double conductance(double opening, double pressure) const {
    return opening > 0 ? open(opening) : closed(pressure);
  }
  /// ∂h/∂g of the opening [W/(m³ K)], where closed through t_N = −ε_N g; of the branch, at a bend of a table
  /// of the piece on its right. With 0 < ε < 1 it is without bound where contact begins, and zero at t_N = 0.
  /// @param penalty ε_N [Pa/m]
  double slope(double opening, double pressure, double penalty) const;
  double open(double gap) const;
  double closed(double pressure) const;
  /// σ_r F [W/(m² K⁴)], zero without radiation.
  double radiation_factor() const { return radiation_factor_; }

 private:
  HeatTransferSpec spec_;
  double open_conductance_ = 0;  ///< h_o
  double at_contact_ = 0;        ///< h_open(0)
  double radiation_factor_ = 0;
};

}  // namespace solidus::contact
