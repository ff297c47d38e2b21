/// The contact interface as a body of its own: its temperature Θ_c, entropies and energy (monograph 3.4, 3.8,
/// 5.4.2, 5.5.2).
///
///   S^e_c = C_co ln(Θ_c/Θ_0) − ∂K_c/∂Θ                                                          (3.42c)
///   Θ_c (S^e_c − S^e_c,n) = Δt (Q_1 + Q_2) + Δt D_c,mech,   Q_i = h_i (Θ_i − Θ_c)         (5.33, 5.34, 5.42)
///   S^p_c = S^p_c,n − γ t_N dμ_0/dΘ                                                    (3.53c, an increment)
///
/// C_co [J/(m² K)] heat capacity of the interface, zero allowed: then Θ_c is where the fluxes balance. h_i
/// [W/(m² K)] conductance from body i to the interface, Q_i [W/m²] heat out of body i into it. The entropy of
/// K_c follows the lines of the tables at Θ_n, as in FrictionLaw::isentropic.
///
/// The balance starts from S^e_c at t_n, so it is the same after either mechanical phase: the isothermal one
/// has added −ΔK_Θ to S^e_c at Θ_n and 5.64 takes H^fc off again; the isentropic one has kept S^e_c (5.33).
///
/// Conventions and proofs: docs/theory/friction.md.
#pragma once

#include <array>
#include <optional>

#include "contact/interface/friction.hpp"

namespace solidus::contact {

/// Θ_0 of 3.41b, where the thermal part of E_c and S^e_c is zero [K].
inline constexpr double k_interface_reference = 293.15;

/// S^e_c [J/(m² K)] (3.42c).
double interface_entropy(const FrictionLaw& law, double temperature, double internal_variable);
/// E_c without the springs W_c: C_co (Θ_c − Θ_0) + K_c − Θ_c ∂K_c/∂Θ [J/m²] (3.34, 3.41).
double interface_energy(const FrictionLaw& law, double temperature, double internal_variable);
/// The same without friction: C_co ln(Θ_c/Θ_0) and C_co (Θ_c − Θ_0).
double interface_entropy(double heat_capacity, double temperature);
double interface_energy(double heat_capacity, double temperature);
/// Increment of S^p_c by slip, −γ t_N dμ_0/dΘ >= 0 [J/(m² K)] (3.53c); Θ_c times it is D_c,ther Δt (3.59).
double plastic_entropy_increment(const FrictionLaw& law, double slip, double pressure, double temperature);

/// The bodies at the interface: slave, master.
struct InterfaceSides {
  std::array<double, 2> temperature;  ///< Θ_i [K]
  std::array<double, 2> conductance;  ///< h_i [W/(m² K)], >= 0
  /// h_1/(h_1 + h_2) where neither conducts: how heat made in the interface is shared, the limit of
  /// conductances that vanish in this ratio.
  double slave_share = 0.5;
};

/// Data of the interface at the start of a step, for its balance.
struct InterfaceStep {
  double time_step = 0;           ///< Δt [s]
  double heat_capacity = 0;       ///< C_co
  double temperature = 0;         ///< Θ_c at t_n [K]
  double structural_entropy = 0;  ///< −ΔK_Θ: FrictionResponse
  double dissipation = 0;         ///< D_c,mech Δt: FrictionResponse
};

struct InterfaceResponse {
  bool balanced = true;             ///< false: no temperature fits (no heat capacity, too much stored heat)
  double temperature = 0;           ///< Θ_c at t_{n+1}
  std::array<double, 2> flux{};     ///< Q_i
  std::array<double, 2> by_side{};  ///< ∂Θ_c/∂Θ_i
  /// ∂Q_i/∂Θ_j: symmetric while h_i do not depend on temperature.
  std::array<std::array<double, 2>, 2> flux_slope{};
  /// dr/dΘ_c of the balance r [W/(m² K)]; ∂Θ_c/∂h_i = (Θ_i − Θ_c)/stiffness. Infinite where nothing conducts
  /// and nothing stores.
  double stiffness = 0;
};

/// Θ_c with slip held as the mechanical phase has left it. The balance is convex in Θ_c: Newton's method from
/// the isentropic temperature cannot fail. Where nothing conducts and nothing stores, the heat is shared as
/// InterfaceSides::slave_share says and Θ_c is the mean with the same weights.
InterfaceResponse interface_balance(const InterfaceStep& step, const InterfaceSides& sides);

/// The fluxes at a known Θ_c, with dr/dΘ_c = `stiffness` of the balance that it comes from.
InterfaceResponse interface_response(const InterfaceSides& sides, double temperature, double stiffness);

/// Slip and Θ_c as the solution of both equations, Φ_c = 0 and the balance (5.32–5.51, of which 5.40 is the
/// pair of equations): the return mapping of the simultaneous scheme, where trial traction, pressure and the
/// bodies' temperatures are those of t_{n+1}, and on demand that of the thermal phase of a split.
struct InterfaceReturn {
  FrictionResponse friction;  ///< at Θ_c of the end; dissipation by μ_0(Θ_c) (5.51); slopes at fixed Θ_c
  InterfaceResponse heat;     ///< its stiffness holds how slip answers Θ_c
  double traction_by_temperature = 0;  ///< ∂‖T‖/∂Θ_c [Pa/K]
  /// Derivatives of the heat source of the balance with respect to trial traction and pressure, ∂(D_c,mech −
  /// Θ_c Ṡ^e_c)/∂x at fixed Θ_c [W/(m² Pa)]: ∂Θ_c/∂x = source/stiffness, ∂Q_i/∂x = −by_side[i] source.
  double source_by_trial = 0, source_by_pressure = 0;
};
/// One of two stages of a thermal phase, over which the slip of the whole step acts at an even rate.
struct InterfaceStage {
  double time_step = 0;    ///< of the stage [s]
  double temperature = 0;  ///< Θ_c from which its capacity sets out [K]
};
/// @param in         ζ_c and Θ_c at t_n, trial traction and pressure at t_{n+1}
/// @param time_step  over which slip makes heat [s]
/// @param stage      absent: the whole of it, from Θ_c at t_n
InterfaceReturn interface_return_mapping(const FrictionLaw& law, const FrictionInput& in, double time_step,
                                         const InterfaceSides& sides,
                                         const std::optional<InterfaceStage>& stage = {});

/// Θ_c of an interface at rest, where Q_1 + Q_2 = 0: to begin with.
double resting_temperature(const InterfaceSides& sides);

}  // namespace solidus::contact
