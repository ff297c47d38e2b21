/// Heat between two rough surfaces that touch: through the spots where asperities meet, and through the gas
/// between them (monograph 3.46–3.48), for surfaces whose heights are Gaussian and whose asperities yield.
///
///   h_S = 1.25 k̄ m/σ (t_N/H_c)^0.95                                                         (3.47)
///   t_N/H_c = [ t_N/c_1 · (1.62·10⁶ σ/m)^(−c_2) ]^(1/(1 + 0.071 c_2))
///   h_G = k_g / (Y + c_g Θ_g),   Y = 1.36 σ √(−ln(5.59 t_N/H_e))                            (3.48)
///
/// σ   [m]       roughness: root mean square height of both surfaces together, √(σ_1² + σ_2²)
/// m   [1]       mean slope of the asperities, √(m_1² + m_2²)
/// k̄   [W/(m K)] mean conductivity of the bodies, 2 k_1 k_2/(k_1 + k_2), of the temperature
/// c_1 [Pa], c_2 hardness of small indentations: H_v = c_1 (d/1 µm)^c_2 of an indentation with the diagonal
/// d;
///               c_2 = 0: the hardness is c_1 whatever the size
/// H_e [Pa]      Vickers hardness
/// k_g [W/(m K)] conductivity of the gas, c_g [m/K] its temperature jump: c_g Θ_g = α β Λ(Θ_g),
/// about 1.3·10⁻⁹
///               m/K for air at 1 bar; Θ_g [K] its mean temperature
/// Y   [m]       distance of the mean planes of the surfaces
///
/// Misprints of the monograph: the exponent of 3.47 is 0.95/(1 + 0.071 c_2), not 0.71, and in 3.48 the sum
/// Y + c_g Θ_g is written below the fraction. Both follow from the model (docs/theory/interface.md), which
/// the tests solve without its fits.
///
/// Validity: the fits of h_S hold for 10⁻⁶ < t_N/H_c < 2·10⁻² to 2 % (c_2 = 0), that of Y for 10⁻⁵ < t_N/H_e
/// < 2·10⁻² to 2 %. Outside, where root and logarithm of Y end (5.59 t_N >= H_e; t_N = 0), Y goes on: along
/// its tangent towards the separation Y_0 = 4.5 σ at which contact is lost, and as 1/(1 + r t_N) under large
/// pressures, so that the conductance of the gas grows there as the pressure does, no faster than that of the
/// spots: iterates of a solution pass through pressures beyond the hardness. So h is positive, grows with the
/// pressure, and has a continuous slope for t_N > 0.
///
/// Source: Cooper, Mikić and Yovanovich 1969; Yovanovich 1981; Song and Yovanovich 1987; monograph 3.46–3.48.
#pragma once

#include <optional>

#include "numbers/table.hpp"

namespace solidus::contact {

struct Asperities {
  double roughness = 0;               ///< σ [m]
  double slope = 0;                   ///< m [1]
  std::optional<Table> conductivity;  ///< k̄ [W/(m K)] of the temperature [K]; absent: that of the bodies
  double hardness_coefficient = 0;    ///< c_1 [Pa]
  double hardness_exponent = 0;       ///< c_2 [1]

  /// h_S [W/(m² K)], its derivatives and the mixed one. At t_N = 0, where it has no bound, ∂h_S/∂t_N is given
  /// as zero.
  struct Pressed {
    double value = 0, by_pressure = 0, by_temperature = 0, mixed = 0;
  };
  Pressed spots(double pressure, double temperature) const;
  /// Y [m] and its slope, of a relative pressure t_N/H_e >= 0.
  struct PlaneDistance {
    double value = 0, slope = 0;
  };
  PlaneDistance separation(double relative_pressure) const;
};

}  // namespace solidus::contact
