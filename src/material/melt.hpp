/// The stiffness of a melt whose viscosity is not given: the numerical choice of η in s = η ε̇ (2.83, 2.104).
///
/// The viscosity of molten metal, some 1e-3 Pa s, has no effect on stress, so η is a number of the method and
/// not of the metal. It is that of a modulus 2Ĝ and a time t_r of the casting:
///
///   η = 2Ĝ t_r,   2Ĝ = max(min(k_melt_heads p, k_melt_strengths σ_s), k_least_melt_share k),
///   t_r = k_melt_time M²/a
///
/// p    [Pa] the metallostatic head ρ g H of the body, H its extent along gravity; without gravity
///      k_weightless_head
/// σ_s  [Pa] what the shell bears: its yield stress at the solidus, or without plasticity G times
///      k_shell_strain
/// k    [Pa] the bulk modulus at the liquidus
/// M    [m] the section, volume over the surface through which the body cools (mechanics/loads/section.hpp)
/// a    [m²/s] the thermal diffusivity at the liquidus
///
/// M²/a is the time in which heat crosses the section; no casting freezes faster, and most take ten to five
/// hundred times as long. Over the time that it takes to freeze melt that follows its shrinking skin with
/// strains of some per cent then has stresses far below the head that carries it and below the tension at
/// which pores open. Nothing here follows the step, so a limit exists when steps get short; a tenth of the
/// viscosity changes answers by less than a step does. For the sake of the arithmetic η/Δt is kept between
/// k_least_step_share k and k_most_step_share k in very long and very short steps. Measured in
/// docs/decisions/0056-a-step-works-with-its-own-mean.md.
///
/// Towards coherency and beyond the metal is a network of dendrites, whose creep is a property of the metal
/// and does not depend on the step. Its viscosity is
///
///   η(f_S) = max(2Ĝ t_r, η_N(f_S)),   η_N = η_c (η_s/η_c)^((f_S − f_c)/(1 − f_c))  from coherency f_c on,
///                                    η_N = η_c k_mush_onset^((f_c − f_S)/k_mush_onset_width)  below it,
///   η_s = σ_s/k_mush_rate,  η_c = k_mush_strength η_s:
///
/// at a strain rate of k_mush_rate mush carries η ε̇/(1 − f_S), from some tens of kilopascals at coherency to
/// more than the strength of the shell where little melt is left. Strengths of solidifying alloys rise as
/// steeply (D. G. Eskin, Suyitno, L. Katgerman, Prog. Mater. Sci. 49 (2004) 629-711). Below coherency melt
/// flows between the dendrites and feeds what shrinks: the thin melt. The two meet within
/// k_mush_onset_width, so that a skin that has just become coherent does not lie next to a liquid.
#pragma once

#include <algorithm>
#include <cmath>

#include <string>

#include "material/material.hpp"
#include "numbers/simd.hpp"

namespace solidus::material {

/// 2Ĝ in heads: a strain increment of 1e-2 then costs a tenth of the head.
inline constexpr double k_melt_heads = 10;
/// p without gravity, the head of some centimetres of metal [Pa].
inline constexpr double k_weightless_head = 1e3;
/// 2Ĝ in yield stresses of the shell: a strain increment of 1e-2 then costs a hundredth of it.
inline constexpr double k_melt_strengths = 1;
/// Strength of an elastic shell, as a share of its shear modulus.
inline constexpr double k_shell_strain = 1e-3;
/// 2Ĝ as a share of the bulk modulus: less gains nothing.
inline constexpr double k_least_melt_share = 1e-7;
/// t_r in times that heat takes to cross the section.
inline constexpr double k_melt_time = 0.01;
/// η/Δt as shares of the bulk modulus: less leaves the linear solvers too few digits, more would make melt as
/// stiff as what holds it in a step of microseconds.
inline constexpr double k_least_step_share = 1e-8, k_most_step_share = 1e-2;
/// Strength of the mush at coherency as a share of that of the shell, and the strain rate it is meant at
/// [1/s].
inline constexpr double k_mush_strength = 1e-2, k_mush_rate = 1e-3;
/// Fall of the viscosity of the network below coherency, and the solid fraction over which it falls so far.
inline constexpr double k_mush_onset = 1e-3, k_mush_onset_width = 0.05;
/// Where a material has no conductivity: that of metals at their melting point is 5e-6 to 6e-5 [m²/s]. And
/// the section where no body is given: that of a plate of 20 mm [m].
inline constexpr double k_metal_diffusivity = 2e-5, k_section = 0.01;
/// The pressure of the atmosphere at sea level [Pa].
inline constexpr double k_atmosphere = 101325;

/// Viscosity of metal that is partly solid.
struct MushViscosity {
  double coherency = 1;     ///< f_c
  double at_coherency = 0;  ///< η_c [Pa s]; zero: the mush is as thin as the melt
  double rise = 0;          ///< ln(η_s/η_c)/(1 − f_c)
  double onset = 0;         ///< −ln(k_mush_onset)/k_mush_onset_width

  /// η at a solid fraction, T a number or a Lane [Pa s].
  /// @param melt  that of the melt in the step
  template <class T>
  T at(const T& solid_fraction, const T& melt) const {
    using std::max;
    return max(melt, of_network(solid_fraction));
  }
  /// The stress that mush below a solid fraction of 1 carries at k_mush_rate [Pa].
  template <class T>
  T strength(const T& solid_fraction) const {
    return T(k_mush_rate) * of_network(solid_fraction) / (T(1.0) - solid_fraction);
  }
  /// The curve above without the melt [Pa s].
  template <class T>
  T of_network(const T& solid_fraction) const {
    using std::exp;
    const T above = solid_fraction - T(coherency);
    return T(at_coherency) * exp(select(above > T(0.0), T(rise), T(onset)) * above);
  }
};

/// The viscosity of the mush of a material that solidifies and deforms; zero if its coherency_fraction is 1.
MushViscosity mush_viscosity(const Material& material);

/// Modulus of a melt, with the quantity that it was chosen in proportion to.
struct MeltModulus {
  enum class Bound { head, weightless, strength, arithmetic };
  double modulus = 0;    ///< 2Ĝ [Pa]; zero: the material gives its viscosity, or has no melt
  double time = 0;       ///< t_r [s]
  double bulk = 0;       ///< k [Pa]
  double reference = 0;  ///< the head, the atmosphere, σ_s or k, whichever decides [Pa]
  Bound bound = Bound::head;
  double extent = 0;  ///< H [m]; zero without gravity
  MushViscosity mush{};

  /// η of the melt in a step [Pa s].
  double viscosity(double dt) const {
    return std::clamp(modulus * time, k_least_step_share * bulk * dt, k_most_step_share * bulk * dt);
  }
};

/// Zero unless the material chooses_viscosity().
/// @param gravity  its magnitude [m/s²]
/// @param extent   of the body along gravity [m]
/// @param section  volume of the body over the surface through which it cools [m]; zero: not known
MeltModulus melt_modulus(const Material& material, double gravity, double extent, double section);
/// "10 times the metallostatic head of 2.4e+03 Pa (rho g H, H = 0.1 m)".
std::string measured_against(const MeltModulus& melt);

}  // namespace solidus::material
