/// Multipliers of the augmented Lagrangian of a contact pair, by Uzawa's method from the mean penetrations
/// around the slave's nodes:
///
///   λ += a_N ε_N Σ_a N_a ḡ_a,   ḡ_a = Σ_p w N_a² g_N / Σ_p w N_a²  over closed points
///
/// There are more points than the unknowns of a face can bring to zero penetration one by one, but their
/// means can be. Where a mean falls slowly from turn to turn its step is lengthened by Aitken's factor a_N,
/// from 1 to 30: a node at the edge of contact has few closed points, hence a weak spring.
///
/// Weights N_a² are positive where those of quadratic faces, N_a, are not; but the step is then no gradient
/// of the energy, and where the closed points change from turn to turn it may go round. Turns by points,
///
///   λ_p = max(λ_p + ε_N g_p, −p_a),
///
/// are the method of multipliers proper, a proximal-point iteration of the dual energy: it falls in every
/// turn, whatever opens and closes, where the energy is convex (R. T. Rockafellar, Math. Oper. Res. 1 (1976)
/// 97–116). They end where no point penetrates and none that is apart presses, and with them the means; the
/// pressures are then less smooth from point to point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/geometry.hpp"
#include "contact/normal.hpp"
#include "contact/step.hpp"

namespace solidus::contact {

/// The penetrations from which a turn raises the multipliers: means around nodes, or those of the points.
enum class AugmentedBy { means, points };

class AugmentedLagrangian {
 public:
  /// Keeps references.
  /// @param allowed             penetration that may be left [m]
  /// @param pressure_tolerance  in place of it, ContactParameters::pressure_tolerance
  /// @param stiffness           ⟨E/h⟩ of the stiffer surface (penalty.hpp) [Pa/m]; zero: not known
  AugmentedLagrangian(const ContactGeometry& geometry, const NormalLaw& law, double allowed,
                      std::optional<double> pressure_tolerance, double stiffness)
      : geometry_(geometry),
        law_(law),
        allowed_(allowed),
        pressure_tolerance_(pressure_tolerance),
        stiffness_(stiffness > 0 ? stiffness : law.penalty) {}
  /// Whether the law has multipliers; without them the functions below do nothing.
  bool acts() const { return law_.kind == NormalKind::augmented_lagrangian; }
  /// The turns of another step follow.
  void begin() { last_penetration_.clear(); }
  /// Takes the next turn: raises the multipliers of the step's start from the state that this turn has led
  /// to, and lets friction set out from the tractions of that state. Collective.
  void augment(const ContactState& now, ContactStep& step, AugmentedBy by);
  /// The largest mean penetration around a node of the slave, as a share of what is allowed. Collective.
  double excess(const ContactState& now) const;
  /// An estimate of the error of the pressures, as a share of their mean: the largest mean penetration left
  /// around a node of the slave, taken up by the elements next to the surface, ⟨E/h⟩ ḡ_a over the mean t_N of
  /// the closed points; zero without pressure. The default penalty alone would leave a tenth. Collective.
  double pressure_error(const ContactState& now) const;
  /// Describes the place of the largest mean penetration, for messages. Collective.
  std::string worst_penetration(const ContactState& now) const;

 private:
  /// Lengthens the steps of the nodes from their mean penetrations now and one turn before.
  void accelerate(const std::vector<double>& penetration);
  /// Largest |ḡ_a| [m] and t_N [Pa] of a state. Collective.
  struct Largest {
    double penetration = 0, pressure = 0;
  };
  Largest largest(const ContactState& now) const;
  /// Mean penetrations ḡ_a, [local node] [m]. Collective.
  std::vector<double> nodal_penetration(const ContactState& now) const;

  const ContactGeometry& geometry_;
  const NormalLaw& law_;
  double allowed_;
  std::optional<double> pressure_tolerance_;
  double stiffness_;
  /// ḡ_a [m] and a_N in the last turn of this step, [local node]; empty in the first turn.
  std::vector<double> last_penetration_, step_factor_;
};

}  // namespace solidus::contact
