/// Heat through the interface: by contact when closed, across the gap when open.
///
///   q = h (Θ_s − Θ_m) + σ_r F (Θ_s⁴ − Θ_m⁴)        [W/m²], from slave to master
///
///   closed (g_N >= 0)  h = h_c(t_N, Θ_g), plus what the gap conducts where the law says so  (3.46-3.49)
///   open (g_N < 0)     h = h_o(g, Θ_g), g = −g_N                                              (3.50, 7.9)
///
/// g_N [m] penetration, g [m] width of the gap, t_N [Pa] contact pressure, Θ_g [K] mean of the two surfaces'
/// temperatures; h_c and h_o are laws in files of their own (laws/contact_law.hpp, laws/gap_law.hpp). σ_r is
/// the Stefan–Boltzmann constant. With a = A_m/A_s, the master's area over the slave's that it faces,
///
///   F = 1/[(1/ε_s − 1) + max(1, 1/a) + (1/ε_m − 1)/a]
///
/// of two grey diffuse surfaces of which the smaller one sees the other alone: 1/(1/ε_s + 1/ε_m − 1) of
/// parallel planes, and exact for concentric cylinders and spheres, whichever of the two is the slave.
///
/// In addition to a closed law the gap conducts h_o(0), or, where the surfaces are rough and the law of the
/// gap holds for the gas between them too, h_o(Y(t_N)), Y the distance of their mean planes. Such a gap
/// begins where that ends: h_o(g + Y(0)).
///
/// Continuity where contact is lost, at t_N = 0 and g = 0: a closed law that conducts in parallel with the
/// gap's vanishes with the pressure. One that is all of the conductance must meet the law of the gap: a law
/// that jumps there is refused. Radiation acts in both states (it is small against h when closed), so it does
/// not jump either.
///
/// C¹ with `smooth`: over the pressures 0 to p_t and over the gaps 0 to g_t the law is the cubic that joins
/// its value at contact, with slope zero, to value and slope at p_t or g_t. So the slope in the gap is
/// continuous whatever the penalty is, and that of spots has a bound. Bends inside of tables stay.
///
/// One coefficient from body to body. 3.45 is one-sided, from each body to an interface temperature Θ_c, with
/// 1/h = 1/h_1 + 1/h_2 (OneSided): h_1 = h/s and h_2 = h/(1 − s), s the share of the resistance that lies on
/// the slave's side, a half unless the data say otherwise; a law with h_1(t_N, Θ_g) and h_2(t_N, Θ_g) of its
/// own (laws/sided_contact.hpp) says it at every pressure and temperature, over a gap that at no pressure.
///
/// Source: monograph 3.45–3.50, table 7.9; the network of surface and space resistances of grey enclosures
/// (e.g. R. Siegel, J. R. Howell, Thermal Radiation Heat Transfer).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "numbers/table.hpp"
#include "system/errors.hpp"

namespace solidus::contact {

class ContactLaw;  // laws/contact_law.hpp
class GapLaw;      // laws/gap_law.hpp
struct LawConductance;

struct HeatTransferSpec {
  std::shared_ptr<const ContactLaw> contact_law;  ///< null: PowerContact with no conductance
  std::shared_ptr<const GapLaw> gap_law;          ///< null: ConstantGap with the conductance of contact

  /// Tables that change with the temperature are here instead, in the order of the temperatures.
  struct AtTemperature {
    double temperature = 0;  ///< [K]
    std::optional<Table> contact_conductance, gap_table;
  };
  std::vector<AtTemperature> families;

  /// s, the share of the resistance 1/h that lies between the slave and Θ_c (3.45), between 0 and 1; absent:
  /// a half, or what the law of contact says.
  std::optional<double> slave_resistance;
  /// Emissivities of the slave's and the master's surface; absent or zero: no radiation.
  double slave_emissivity = 0, master_emissivity = 0;

  /// Factors on the law as a whole: on the conductance of contact, and on what the gap conducts beyond it,
  /// 1/h(g) = 1/(h(0) f_c) + (1/h(g) - 1/h(0))/f_g. Both laws still meet where the gap opens.
  double conductance_factor = 1, gap_factor = 1;

  bool smooth = false;
  /// With `smooth`: g_t [m], p_t [Pa]; absent: 1 µm, 0.1 MPa.
  std::optional<double> transition_gap, transition_pressure;
  SourceLocation where;
};

/// The spec with a conductivity of 1 W/(m K) where the law of contact takes that of bodies that are not known
/// yet. Spots conduct nothing without pressure, so at none it is the law itself.
HeatTransferSpec without_bodies(HeatTransferSpec spec);

/// h and its derivatives; those at a bend of a table are those of the piece on its right.
struct Conductance {
  double value = 0;           ///< [W/(m² K)]
  double by_penetration = 0;  ///< ∂h/∂g_N where open [W/(m³ K)], else zero
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

  /// Returns the conductance of an interface with the penetration g_N [m] (negative: open), pressure t_N [Pa]
  /// and mean temperature Θ_g [K]. Temperatures below zero, which an iteration may pass, count as zero.
  Conductance at(double penetration, double pressure, double temperature) const;
  /// Whether h changes with Θ_g.
  bool of_temperature() const { return of_temperature_; }
  /// s at a pressure [Pa], zero over a gap, and a mean temperature [K].
  double slave_resistance(double pressure = 0, double temperature = 300) const;
  /// h_1 and h_2 of a conductance (3.45).
  static OneSided one_sided(double conductance, double slave_resistance) {
    return {conductance / slave_resistance, conductance / (1 - slave_resistance)};
  }
  /// h_1/(h_1 + h_2), the part of the interface's heat that the slave takes where neither side conducts.
  static double slave_share(double slave_resistance, bool master_takes_heat = true) {
    return master_takes_heat ? 1 - slave_resistance : 1.0;
  }
  /// σ_r F per area of the slave [W/(m² K⁴)], zero without radiation.
  /// @param area_ratio  a
  double radiation_factor(double area_ratio = 1) const;
  /// dσ_r F/da [W/(m² K⁴)]; at a = 1 the mean of both sides.
  double radiation_by_area(double area_ratio) const;

 private:
  LawConductance open(double gap, double temperature) const;
  LawConductance closed(double pressure, double temperature) const;
  /// The law without its factors.
  Conductance given(double penetration, double pressure, double temperature) const;
  void prepare_laws();
  /// At the temperatures that matter.
  void check_continuity() const;
  void check_transition() const;

  HeatTransferSpec spec_;            ///< its laws ready for use
  bool between_asperities_ = false;  ///< the gap's gas is between the asperities of rough surfaces too
  double transition_gap_ = 1e-6, transition_pressure_ = 1e5;  ///< g_t, p_t
  std::vector<double> temperatures_;                          ///< of the laws; any one without [K]
  bool of_temperature_ = false;
};

}  // namespace solidus::contact
