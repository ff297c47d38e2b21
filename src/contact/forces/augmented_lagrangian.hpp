/// Multipliers of the augmented Lagrangian of a contact pair, by Uzawa's method from the mean penetrations
/// around the slave's nodes:
///
///   λ += a_N ε_N Σ_a N_a ḡ_a,   ḡ_a = Σ_p w N_a² g_N / Σ_p w N_a²  over closed points
///
/// There are more points than the unknowns of a face can bring to zero penetration one by one, but their
/// means can be. Where a mean falls slowly from one augmentation to the next its step is lengthened by
/// Aitken's factor a_N, from 1 to 30: a node at the edge of contact has few closed points, hence a weak
/// spring.
///
/// Weights N_a² are positive where those of quadratic faces, N_a, are not; but the step is then no gradient
/// of the energy, and where the closed points change from one augmentation to the next it may go round.
/// Augmentations by points,
///
///   λ_p = max(λ_p + ε_N g_p, −p_a),
///
/// are the method of multipliers proper, a proximal-point iteration of the dual energy: it falls in every
/// augmentation, whatever opens and closes, where the energy is convex (R. T. Rockafellar, Math. Oper. Res. 1
/// (1976) 97–116), but by a share of two per cent or less where contact is stiffer than the penalty. Their
/// steps therefore follow the secants of the augmentations before (secants.hpp). They end where no point
/// penetrates and none that is apart presses, and with them the means; the pressures are then less smooth
/// from point to point.
///
/// A last resort, where several shorter steps have failed (allow_early_end): augmentations end at their last
/// equilibrium, with the multipliers that it was found with. Forces balance there; what is left is a
/// penetration, as with a penalty, of at most k_largest_left of the mean size of the slave's faces.
#pragma once

#include <optional>
#include <vector>

#include "contact/forces/penetration.hpp"
#include "contact/forces/secants.hpp"
#include "contact/forces/step.hpp"
#include "contact/interface/normal.hpp"
#include "contact/points/geometry.hpp"

namespace solidus::contact {

/// The penetrations from which an augmentation raises the multipliers: means around nodes, or those of the
/// points.
enum class AugmentedBy { means, points };

class AugmentedLagrangian {
 public:
  /// Keeps references. Without a law that has multipliers the functions below do nothing.
  /// @param allowed             penetration that may be left [m]
  /// @param face_size           mean size of the slave's faces [m]
  /// @param pressure_tolerance  in place of it, ContactParameters::pressure_tolerance
  /// @param stiffness           ⟨E/h⟩ of the stiffer surface (penalty.hpp) [Pa/m]; zero: not known
  AugmentedLagrangian(const ContactGeometry& geometry, const NormalLaw& law, double allowed, double face_size,
                      std::optional<double> pressure_tolerance, double stiffness)
      : geometry_(geometry),
        law_(law),
        allowed_(allowed),
        largest_left_(k_largest_left * face_size),
        pressure_tolerance_(pressure_tolerance),
        stiffness_(stiffness > 0 ? stiffness : law.penalty) {}
  /// The augmentations of another step follow.
  /// @param goes_on  of the same step, in a further pass: augmentations that have ended early stay ended
  void begin(bool goes_on = false) {
    last_penetration_.clear();
    secants_.clear();
    by_points_ = false;
    before_.clear();
    ended_ = ended_ && goes_on;
  }
  /// Whether augmentations that do not settle may end early, from now on.
  void allow_early_end(bool on) { may_end_ = on; }
  /// Whether they may end at a state in equilibrium. Collective.
  bool may_end_at(const ContactState& now) const { return ended_ || (may_end_ && holds_bound(now)); }
  /// Whether a state leaves penetrations within the bound of augmentations that end early. Collective.
  bool holds_bound(const ContactState& now) const { return largest(now).penetration <= largest_left_; }
  /// Whether they may end at the state that the last augmentation set out from.
  bool may_take_back() const { return may_end_ && !ended_ && !before_.empty() && left_ <= largest_left_; }
  /// Takes the last augmentation back, whose equilibrium was not found, and ends the augmentations of the
  /// step.
  void take_back(ContactStep& step);
  /// Ends the augmentations of the step with the multipliers of now.
  void end_turns() { ended_ = true; }
  bool ended_early() const { return ended_; }
  /// Takes the next augmentation: raises the multipliers of the step's start from the state that this
  /// augmentation has led to, and lets friction set out from the tractions of that state. Collective.
  void augment(const ContactState& now, ContactStep& step, AugmentedBy by);
  /// The largest mean penetration around a node of the slave, as a share of what is allowed. Collective.
  double excess(const ContactState& now) const;
  /// An estimate of the error of the pressures, as a share of their mean: the largest mean penetration left
  /// around a node of the slave, taken up by the elements next to the surface, ⟨E/h⟩ ḡ_a over the mean t_N of
  /// the closed points; zero without pressure. The default penalty alone would leave a tenth. Collective.
  double pressure_error(const ContactState& now) const;

 private:
  static constexpr double k_largest_left = 1e-3;
  /// Lengthens the steps of the nodes from their mean penetrations now and one augmentation before.
  void accelerate(const std::vector<double>& penetration);
  /// Returns the steps of the multipliers in an augmentation by points, [point] [Pa]. Collective.
  std::vector<double> step_of_points(const ContactState& now, const ContactStep& step);
  bool acts() const { return law_.kind == NormalKind::augmented_lagrangian; }
  Penetration largest(const ContactState& now) const { return largest_penetration(geometry_, now); }

  const ContactGeometry& geometry_;
  const NormalLaw& law_;
  double allowed_, largest_left_;  ///< [m]
  std::optional<double> pressure_tolerance_;
  double stiffness_;
  /// ḡ_a [m] and a_N in the last augmentation of this step, [local node]; empty in the first augmentation.
  std::vector<double> last_penetration_, step_factor_;
  Secants secants_;         ///< of the multipliers of the points, in augmentations by points
  bool by_points_ = false;  ///< an augmentation of this step was
  /// λ_N [Pa] and t_T [Pa] before the last augmentation, [point], and the penetration that was left there
  /// [m].
  struct Start {
    double multiplier = 0;
    Point traction{};
  };
  std::vector<Start> before_;
  double left_ = 0;
  bool may_end_ = false;  ///< early
  bool ended_ = false;    ///< early, in this step
};

}  // namespace solidus::contact
