/// Wear depth by Archard's law, a value for output: it does not change the geometry.
///
///   dh = k t_N γ/H(Θ)
///
/// of both surfaces together, of which the master loses the share m and the slave 1 − m. The slave remembers
/// its depth at its points, the master at its nodes (master_wear.hpp).
///
/// h [m] depth worn off, k [1] Archard's coefficient, t_N [Pa] pressure, γ [m] slip of the step, H [Pa]
/// hardness of the softer surface. Validity: mild adhesive wear, k about 1e-8 … 1e-3. Source: Archard 1953,
/// J. Appl. Phys. 24, 981.
#pragma once

#include "numbers/table.hpp"
#include "system/errors.hpp"

namespace solidus::contact {

struct WearParameters {
  double coefficient = 0;   ///< k [1], >= 0
  Table hardness{1.0};      ///< H [Pa] over temperature [K], > 0
  double master_share = 0;  ///< m, 0 to 1
  SourceLocation where;

  /// dh of a step.
  double depth_increment(double pressure, double slip, double temperature) const {
    return coefficient * pressure * slip / hardness.value(temperature);
  }
};

}  // namespace solidus::contact
