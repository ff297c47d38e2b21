/// Heat content, temperature and Kirchhoff's potential of a material as one curve.
///
/// h(Θ) and v(Θ) = u(Θ)/κ (nodal_potential.hpp) are piecewise quadratic, with jumps of h where a change is
/// isothermal. On the pieces between the bends of either, one look-up gives all that an iteration asks for:
/// Θ(h), v(h) and dv/dh, or Θ(v) and h(v). The closed forms are those of material/enthalpy.hpp and
/// kirchhoff_potential.hpp.
#pragma once

#include <vector>

#include "heat/conduction/kirchhoff_potential.hpp"
#include "material/enthalpy.hpp"
#include "numbers/interval_search.hpp"

namespace solidus::heat {

class StorageCurve {
 public:
  StorageCurve(const material::EnthalpyCurve& enthalpy, const KirchhoffPotential& potential);

  struct AtHeat {
    double temperature;  ///< [K]
    double potential;    ///< v [K]
    double slope;        ///< dv/dh [K m³/J]; zero within a jump
  };
  AtHeat at_heat(double h) const;
  struct AtPotential {
    double temperature;   ///< [K]
    double lower, upper;  ///< h, the ends of a jump [J/m³]
    double slope;         ///< dv/dh [K m³/J]; zero at a jump, where h decides
  };
  AtPotential at_potential(double v) const;

 private:
  /// With t = Θ − t0 in [0, width]: h = h0 + c0 t + c1/2 t², v = v0 + k0 t + k1/2 t².
  struct Piece {
    double t0, width;
    double h0, c0, c1;
    double v0, k0, k1;
    double height;  ///< of h from t0 to the end of the piece, without the jump there
    double jump;    ///< of h at t0
  };
  static std::vector<Piece> pieces_of(const material::EnthalpyCurve& enthalpy,
                                      const KirchhoffPotential& potential);
  static IntervalSearch search_of(const std::vector<Piece>& pieces, double Piece::*start);

  std::vector<Piece> pieces_;  ///< the last one goes on to +∞, below the first one `below_` to −∞
  Piece below_{};
  IntervalSearch by_heat_, by_potential_;
};

}  // namespace solidus::heat
