/// Heat through the interface: by contact when closed, across the gap when open.
///
///   q = h (Θ_s − Θ_m) + σ_r F (Θ_s⁴ − Θ_m⁴)        [W/m²], from slave to master
///
///   closed (g <= 0):       power   h = h_open(0, Θ_g) + h_co (t_N/H_e)^ε   for ε > 0   (3.49 beside the gas)
///                                  h = h_co                                for ε = 0
///                          spots   h = h_S(t_N, Θ_g) + h_G(t_N, Θ_g)                   (3.46–3.48)
///                          table   h(t_N), h(t_N, Θ_g)
///   open (gap g > 0):      constant   h_o
///                          table      h(g), h(g, Θ_g)                                  (7.9)
///                          gas        k_a/(g + k_a/h_o)                                (3.50)
///
/// g [m] opening, t_N [Pa] contact pressure, Θ_g [K] mean of the two surfaces' temperatures, h_co, h_o
/// [W/(m² K)], H_e [Pa] Vickers hardness, k_a [W/(m K)] conductivity of the gas, F = 1/(1/ε_1 + 1/ε_2 − 1) of
/// two large grey parallel surfaces that face each other (view factor 1: the gap is small against them), σ_r
/// the Stefan–Boltzmann constant. h_S, h_G: contact/asperities.hpp. With spots, the law `gas` of the gap
/// begins where h_G ends, k_a/(g + Y_0 + c_g Θ_g); any other law of the gap is that of the gas between the
/// spots too, h_G = h_open(0).
///
/// Continuity where contact is lost, at t_N = 0 and g = 0: spots vanish with the pressure, and conduct beside
/// what crosses a gap of zero. A constant or tabulated closed value must meet the law of the gap: a law that
/// jumps there is refused. Radiation acts in both states (it is small beside h when closed), so it does not
/// jump either.
///
/// C¹ with `smooth`: over the pressures 0 to p_t and over the gaps 0 to g_t the law is the cubic that joins
/// its value at contact, with slope zero, to value and slope at p_t or g_t. So the slope in the gap is
/// continuous whatever the penalty is, and that of spots has a bound. Bends inside of tables stay.
///
/// One coefficient from body to body. 3.45 is one-sided, from each body to an interface temperature Θ_c, with
/// 1/h = 1/h_1 + 1/h_2 (OneSided): h_1 = h/s and h_2 = h/(1 − s), s the share of the resistance that lies on
/// the slave's side, a half unless the data say otherwise.
///
/// Source: monograph 3.45–3.50, table 7.9.
#pragma once

#include <optional>
#include <vector>

#include "base/errors.hpp"
#include "base/table.hpp"
#include "contact/asperities.hpp"
#include "contact/table_family.hpp"

namespace solidus::contact {

struct HeatTransferSpec {
  enum class ContactLaw { power, spots, table };
  enum class GapLaw { constant, table, gas };
  ContactLaw contact_law = ContactLaw::power;
  double conductance = 0;  ///< law `power`: h_co [W/(m² K)], body to body
  double exponent = 0;     ///< law `power`: ε of 3.49 [1]
  /// H_e [Pa], needed by `power` when the exponent is not zero, and by `spots` with `gas`.
  std::optional<double> hardness;
  Asperities asperities;                     ///< law `spots`
  std::optional<Table> contact_conductance;  ///< law `table`: h(t_N) [W/(m² K)] of the pressure [Pa]

  GapLaw gap_law = GapLaw::constant;
  /// h_o [W/(m² K)] of `constant` and `gas`; absent: the value at contact. Not with `spots` and `gas`.
  std::optional<double> open_conductance;
  std::optional<Table> gap_table;  ///< law `table`: h(g) [W/(m² K)] of the opening [m], g >= 0
  double gas_conductivity = 0;     ///< k_a [W/(m K)]
  double temperature_jump = 0;     ///< c_g [m/K], of `spots` with `gas` only

  /// Tables that change with the temperature stand here instead, in the order of the temperatures.
  struct AtTemperature {
    double temperature = 0;  ///< [K]
    std::optional<Table> contact_conductance, gap_table;
  };
  std::vector<AtTemperature> families;

  /// s, the share of the resistance 1/h that lies between the slave and Θ_c (3.45), between 0 and 1.
  double slave_resistance = 0.5;
  /// Emissivities of the slave's and the master's surface; absent or zero: no radiation.
  double slave_emissivity = 0, master_emissivity = 0;

  bool smooth = false;
  /// With `smooth`: g_t [m], p_t [Pa]; absent: 1 µm, 0.1 MPa.
  std::optional<double> transition_gap, transition_pressure;
  SourceLocation where;
};

/// h and its derivatives; those at a bend of a table are those of the piece on its right.
struct Conductance {
  double value = 0;           ///< [W/(m² K)]
  double by_opening = 0;      ///< ∂h/∂g where open [W/(m³ K)], else zero
  double by_pressure = 0;     ///< ∂h/∂t_N where closed, else zero; zero at t_N = 0 where it has no bound
  double by_temperature = 0;  ///< ∂h/∂Θ_g [W/(m² K²)]
};

/// From each body to the interface temperature: 1/h = 1/h_1 + 1/h_2 [W/(m² K)].
struct OneSided {
  double slave = 0, master = 0;
};

class HeatTransferLaw {
 public:
  /// Throws InputError for data that make no law: negative or missing values, or a jump at g = 0.
  explicit HeatTransferLaw(HeatTransferSpec spec);

  /// Returns the conductance of an interface with this opening [m] (zero or negative: closed), pressure t_N
  /// [Pa] and mean temperature Θ_g [K]. Temperatures below zero, which an iteration may pass, count as zero.
  Conductance at(double opening, double pressure, double temperature) const;
  /// Whether h changes with Θ_g.
  bool of_temperature() const { return of_temperature_; }
  /// h_1 and h_2 of a conductance (3.45).
  OneSided one_sided(double conductance) const {
    return {conductance / spec_.slave_resistance, conductance / (1 - spec_.slave_resistance)};
  }
  /// h_1/(h_1 + h_2), the part of the interface's heat that the slave takes where neither side conducts.
  double slave_share(bool master_takes_heat = true) const {
    return master_takes_heat ? 1 - spec_.slave_resistance : 1.0;
  }
  /// σ_r F [W/(m² K⁴)], zero without radiation.
  double radiation_factor() const { return radiation_factor_; }

 private:
  /// Conductance of one state (open or closed), a function of the gap or of the pressure.
  struct Branch {
    double value = 0, slope = 0, by_temperature = 0;
    double mixed = 0;  ///< change of the slope with the temperature
  };
  Branch open(double gap, double temperature) const;
  Branch closed(double pressure, double temperature) const;
  Branch pressed_spots(double pressure, double temperature) const;
  static Branch transition(double x, double width, const Branch& start, const Branch& end);
  bool spots() const { return spec_.contact_law == HeatTransferSpec::ContactLaw::spots; }
  void read_tables();
  void check_contact() const;
  void check_gap() const;
  /// At the temperatures that matter.
  void check_continuity() const;
  void check_transition() const;

  HeatTransferSpec spec_;
  TableFamily contact_tables_, gap_tables_;
  double open_conductance_ = 0;                               ///< h_o
  double transition_gap_ = 1e-6, transition_pressure_ = 1e5;  ///< g_t, p_t
  std::vector<double> temperatures_;                          ///< of the families; any one without [K]
  bool of_temperature_ = false;
  double radiation_factor_ = 0;
};

}  // namespace solidus::contact
