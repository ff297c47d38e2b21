/// Permeability of mush: how melt flows between the dendrites.
///
///   q = (K/μ) (∇p + ρ g_0)              Darcy's law, q [m/s] the volume of melt that passes an area, p the
///                                       mean stress (positive in tension), ρ g_0 the body force
///   K(f_S) = λ₂² (1 − f_S)³/(180 f_S²)  Blake and Kozeny, λ₂ the spacing of secondary dendrite arms
///
/// λ₂ is that of the material's [casting] (casting.hpp) after k_coarsening_time, within a factor of two that
/// of parts which freeze in 10 to 1000 s; K hardly depends on it except by (1 − f_S)³. Below k_least_solid K
/// rises no more: nothing holds melt back there. K. D. Carlson, C. Beckermann, Metall. Mater. Trans. A 40
/// (2009) 163-175; M. C. Flemings, Solidification Processing, 1974, section 7.4.
#pragma once

#include <algorithm>

#include "material/casting.hpp"
#include "numbers/simd.hpp"

namespace solidus::material {

/// 180 of the law of Blake and Kozeny.
inline constexpr double k_blake_kozeny = 180;
/// Local solidification time that λ₂ is taken at [s].
inline constexpr double k_coarsening_time = 100;
/// λ₂ after that time [m] and μ [Pa s] where a card does not say: those of most casting alloys.
inline constexpr double k_usual_arm_spacing = 50e-6, k_usual_melt_viscosity = 2e-3;

/// Solid fraction below which K is constant.
inline constexpr double k_least_solid = 0.25;

class Permeability {
 public:
  explicit Permeability(const Casting& casting) {
    const double spacing = casting.secondary_arm_spacing(k_coarsening_time).value_or(k_usual_arm_spacing);
    factor_ = spacing * spacing / (k_blake_kozeny * casting.melt_viscosity.value_or(k_usual_melt_viscosity));
  }

  /// K/μ [m²/(Pa s)], T a number or a Lane; zero in solid metal.
  template <class T>
  T mobility(const T& solid_fraction) const {
    using std::max;
    const T solid = max(solid_fraction, T(k_least_solid)), liquid = max(T(1.0) - solid, T(0.0));
    return T(factor_) * liquid * liquid * liquid / (solid * solid);
  }

 private:
  double factor_;  ///< λ₂²/(180 μ)
};

}  // namespace solidus::material
