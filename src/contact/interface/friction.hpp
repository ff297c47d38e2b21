/// Coulomb friction with a coefficient that hardens, softens and wears (monograph 3.5–3.7), as a point law in
/// the magnitude of the traction: the return mapping is radial (3.54, 5.30), so the caller supplies the
/// direction.
///
///   Φ_c = ‖T‖ − μ(ζ_c, Θ_c) t_N <= 0                                                      (3.51, 3.63)
///   T   = T^trial (1 − ε_T γ/‖T^trial‖),   γ = Δt γ_c >= 0 the slip of the step             (5.31a)
///   ζ_c = ζ_n + γ t_N   (normal work, 3.53b),   ζ_n + γ μ t_N   (frictional work),   or   ζ_n + γ   (slip)
///
/// Everything is taken at the end of the step. The scalar equation Φ_c(γ) = 0 is solved by Newton's method
/// inside a bracket; it always ends, and says when there is no solution or more than one.
///
/// SI throughout: ζ_c in N/m for the two kinds of work, in m for slip. Only normal work is stored
/// (K_c, 3.41c) and only for it the dissipation is 3.58, γ μ_0 t_N; otherwise no potential exists, nothing is
/// stored and all the work of friction is dissipated, γ μ t_N.
///
/// Conventions, validity and thermodynamics: docs/theory/friction.md.
#pragma once

#include <optional>

#include "contact/interface/friction_coefficient.hpp"

namespace solidus::contact {

/// Quantity that is accumulated in the internal variable ζ_c.
enum class InternalVariable { normal_work, frictional_work, slip };

/// Friction as specified by the user, in SI.
struct FrictionParameters {
  FrictionCoefficientSpec coefficient;
  InternalVariable internal_variable = InternalVariable::normal_work;
  std::optional<double> tangential_penalty;  ///< ε_T [Pa/m]; absent: the factor on ε_N
  double tangential_penalty_factor = 1;
  /// Drops the unsymmetric part of the tangent: ∂‖T‖/∂t_N in it, not in the forces.
  bool symmetric = false;
  /// The thermal phase of a split finds slip and Θ_c again (5.40–5.51) instead of keeping the slip of the
  /// mechanical phase.
  bool thermal_return_mapping = false;
  SourceLocation where;
};

/// Input of the friction law at a point.
struct FrictionInput {
  double trial = 0;              ///< ‖T_n + ε_T ΔG‖ [Pa]
  double pressure = 0;           ///< t_N [Pa], >= 0
  double internal_variable = 0;  ///< ζ_c at t_n, >= 0
  double temperature = 0;        ///< Θ_c at t_n [K]
  /// Result of the pass before in a scheme that iterates within the step; absent: t_n. update() holds its
  /// Θ_c, isentropic() its entropy; slip and ζ_c set out from t_n in any case. The lines of the tables along
  /// which the entropy follows are those at Θ_c of t_n.
  struct Iterate {
    double temperature = 0;        ///< Θ_c [K]
    double internal_variable = 0;  ///< ζ_c
  };
  std::optional<Iterate> iterate{};
  double stiffening = 1;  ///< ε_T of the point over that of the law (ContactPointState::stiffening)
  /// Θ_c and ζ_c whose temperature or entropy the mechanical phase holds.
  Iterate held() const { return iterate.value_or(Iterate{temperature, internal_variable}); }
};

enum class FrictionStatus {
  converged,
  coefficient_vanishes,  ///< μ <= 0 is reached within the step
  temperature_runs_off,  ///< the isentropic phase would double or halve Θ_c
  not_unique,            ///< the step has no or several solutions that follow from its start
  not_converged          ///< numbers that are not finite
};
/// Describes for StepRejected the failure and its remedy.
const char* reason(FrictionStatus status);

struct FrictionResponse {
  FrictionStatus status = FrictionStatus::converged;
  bool sticks = true;
  double slip = 0;               ///< γ [m]
  double traction = 0;           ///< ‖T‖ [Pa]
  double coefficient = 0;        ///< μ at the end
  double internal_variable = 0;  ///< ζ_c at t_{n+1}
  double temperature = 0;        ///< Θ_c: as it was (isothermal), intermediate (isentropic, 5.24)
  double dissipation = 0;        ///< D_c,mech Δt [J/m²] (3.58)
  /// Increment of S^e_c by slip at fixed Θ_c: −ΔK_Θ, with ∂K_c/∂Θ along the lines of the tables at Θ_n [J/(m²
  /// K)] (3.42c). Θ_c times it is the frictional contact heating H^fc Δt (3.67b).
  double structural_entropy = 0;
  /// ∂‖T‖/∂‖T^trial‖ (1 where it sticks) and ∂‖T‖/∂t_N, of the law as it was solved.
  double trial_slope = 1, pressure_slope = 0;
  double stiffness = 0;  ///< −dΦ_c/dγ [Pa/m] where it slips
};

class FrictionLaw {
 public:
  /// @param tangential_penalty ε_T [Pa/m], > 0
  /// @param heat_capacity      C_co of the interface [J/(m² K)], >= 0
  /// Throws InputError as FrictionCoefficient does.
  FrictionLaw(const FrictionParameters& spec, double tangential_penalty, double heat_capacity = 0);

  /// The mechanical phase at fixed temperature (5.59–5.63), and friction where temperature plays no part. The
  /// coefficient is that of FrictionInput::held().
  FrictionResponse update(const FrictionInput& in) const;
  /// The mechanical phase at fixed entropy S^e_c (5.24–5.31). Θ_c follows from the entropy in closed form, so
  /// one equation in γ is left. μ_0 is held at Θ_n (5.22). Without a heat capacity the interface has no
  /// temperature of its own to change, and this is update().
  FrictionResponse isentropic(const FrictionInput& in) const;

  const FrictionCoefficient& coefficient() const { return coefficient_; }
  InternalVariable internal_variable() const { return kind_; }
  /// ε_T of a point [Pa/m].
  double tangential_penalty(double stiffening = 1) const { return stiffening * penalty_; }
  double tangential_penalty(const FrictionInput& in) const { return in.stiffening * penalty_; }
  double heat_capacity() const { return heat_capacity_; }
  /// K_c is there: it is normal work that hardens.
  bool stores() const { return kind_ == InternalVariable::normal_work; }

 private:
  /// ζ_c of a slip γ and its derivatives.
  struct Growth {
    double zeta, gamma, trial, pressure;
  };
  Growth growth(const FrictionInput& in, double gamma) const;
  /// The end of slip.
  struct Slip {
    FrictionStatus status;
    double gamma;
    Growth at;
    FrictionCoefficient::Value mu;  ///< μ and its total derivative in ζ
  };
  /// @param radius ζ_c -> μ and its total derivative
  template <class Radius>
  FrictionResponse solve(const FrictionInput& in, Radius radius) const;
  /// @param first  the first iterate, in (0, ‖T^trial‖/ε_T]
  template <class Radius>
  Slip find_slip(const FrictionInput& in, Radius radius, double first) const;
  bool unique(const FrictionInput& in, const FrictionResponse& r) const;
  bool unique_between(const FrictionInput& in, const FrictionResponse& r, double from, double to,
                      int halvings) const;
  FrictionResponse with_heat(const FrictionInput& in, FrictionResponse r) const;

  FrictionCoefficient coefficient_;
  InternalVariable kind_;
  double penalty_, heat_capacity_;
  bool entropy_changes_ = false;  ///< K_c depends on temperature
};

inline FrictionLaw::Growth FrictionLaw::growth(const FrictionInput& in, double gamma) const {
  switch (kind_) {
    case InternalVariable::frictional_work: {  // μ t_N is ‖T‖ = ‖T^trial‖ − ε_T γ
      const double penalty = tangential_penalty(in), traction = in.trial - penalty * gamma;
      return {in.internal_variable + gamma * traction, traction - penalty * gamma, gamma, 0};
    }
    case InternalVariable::slip:
      return {in.internal_variable + gamma, 1, 0, 0};
    case InternalVariable::normal_work:
      break;
  }
  return {in.internal_variable + gamma * in.pressure, in.pressure, 0, gamma};
}

}  // namespace solidus::contact
