/// The block-iterative scheme (monograph 4.1.2, 4.2–4.4): both phases in alternation until they agree. What
/// they agree on is the solution of both at once (4.1.1, backward Euler), whatever the passes:
///
///   isothermal:  equilibrium with σ(ε, z, Θ⁽ⁱ⁾)                                              (4.46)
///   isentropic:  equilibrium with σ(ε, z, Θ̄),  S(ε, z, Θ̄) = S(ε⁽ⁱ⁾, z⁽ⁱ⁾, Θ⁽ⁱ⁾)            (4.40)
///   thermal:     the balance of energy at a configuration, from Θ_n and S_n                   (4.43, 4.53)
///
/// Every pass starts from the state at t_n; an iterate says only what it holds and where Newton's method sets
/// out. Friction follows Θ_c⁽ⁱ⁾ of the interface (isentropic passes: its entropy), fractions of phase changes
/// are those of Θ⁽ⁱ⁾. In Gauss–Seidel's sweep the thermal pass works at the newest configuration, in Jacobi's
/// at the one before; the first iteration is that of the split in both.
///
/// An iteration whose changes do not fall to a half in eight goes half as far from the 24th on, again and
/// again: heat that follows a contact which closes by it would send whole steps round between two states.
///
/// Isothermal passes converge where the coupling number (or its relaxed value) is below one, isentropic ones
/// whatever it is (docs/theory/coupling.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coupling/contact_work.hpp"
#include "coupling/phases.hpp"
#include "coupling/relaxation.hpp"
#include "coupling/scheme.hpp"

namespace solidus::coupling {

struct IterationOptions {
  enum class Sweep { gauss_seidel, jacobi };
  enum class Loop {
    nested,  ///< every pass to the tolerance of its phase
    /// One Newton step a pass until they agree, and whole passes from there; nested in a step where that does
    /// not converge.
    single
  };
  Sweep sweep = Sweep::gauss_seidel;
  Loop loop = Loop::nested;
  RelaxationOptions relaxation;  ///< of the temperature that the mechanical pass sees
  /// Tolerance of the changes between two iterates, relative to those of the step.
  double tolerance = 1e-8;
  int max_iterations = 100;
};

class BlockIterative final : public CouplingScheme {
 public:
  /// The phases must outlive the scheme; the mapping of the mechanical one makes the passes. Throws
  /// std::invalid_argument unless both are there, and for isentropic passes without structural heat.
  BlockIterative(Phases phases, IterationOptions options);

  void synchronise(const State& state) override;
  void forget() override;
  /// Throws StepRejected besides when the iteration diverges or does not converge. The state it leaves is
  /// that of the last two passes, a mechanical and then a thermal one: the first law closes whatever the
  /// tolerance of the iteration.
  StepEffort advance(const State& old, State& trial, double time, double dt) override;

  /// Largest changes in one iteration, over all nodes and processes.
  struct Change {
    double temperature = 0;   ///< that the thermal pass asks for, at nodes and of interfaces [K]
    double displacement = 0;  ///< [m]
  };
  /// Changes of the last step, one per iteration.
  const std::vector<Change>& changes() const { return changes_; }

 private:
  struct Iterate;
  struct Attempt {
    double time = 0, dt = 0;  ///< end and length of the step [s]
    int newton_steps = 0;     ///< of a pass; zero: as many as its phase needs
  };
  /// Solves the step with passes of so many Newton steps.
  /// @param contact  as it was at the start of the step
  /// @param effort   what passes need is added
  void solve(const State& old, State& trial, const Attempt& attempt, ContactWork contact, StepEffort& effort);
  /// Iterates from the start of the step on. Throws StepRejected when the iteration diverges or does not
  /// converge.
  void iterate_until_agreement(const State& old, Iterate& it);
  /// Returns whether the phase reached its tolerance. Zero Newton steps: as many as it takes.
  bool mechanical(const State& old, Iterate& it, int newton_steps) const;
  bool thermal(const State& old, Iterate& it, int newton_steps) const;
  void iterate(const State& old, Iterate& it);
  bool alternates(const Iterate& it) const;
  const std::vector<double>& answered(const Iterate& it) const;
  bool agrees(const State& old, const Iterate& it) const;
  void require_progress(const Iterate& it) const;
  /// Halves the way from iterate to iterate where the changes do not fall.
  void damp(Iterate& it) const;
  [[noreturn]] void diverged(const Iterate& it, const std::string& how) const;
  std::string largest_change(const Iterate& it) const;
  void relax(Iterate& it);

  Phases phases_;
  IterationOptions options_;
  std::array<Relaxation, 2> relaxation_;  ///< Jacobi's sweep is two iterations that alternate
  std::vector<Change> changes_;
};

}  // namespace solidus::coupling
