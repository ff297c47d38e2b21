/// The solution of a step of the mechanical phase by Newton's method, in as many attempts as it takes.

#include <algorithm>
#include <cmath>

#include "mechanics/held_equilibrium.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/mechanical_failure.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

namespace {

/// Equilibrium at the end of a step from `old`, for Newton's method.
class Equilibrium final : public linear::NonlinearSystem {
 public:
  Equilibrium(MechanicalPhase& phase, const MechanicalState& old) : phase_(phase), old_(old) {}
  double residual(std::span<const double> x, std::span<double> r) override {
    return phase_.equations().residual(x, r);
  }
  linear::BlockMatrix& tangent(std::span<const double> x) override { return phase_.equations().tangent(x); }
  double relative_step(std::span<const double> x, std::span<const double> d) override {
    return phase_.equations().relative_step(old_, x, d);
  }

 private:
  MechanicalPhase& phase_;
  const MechanicalState& old_;
};

}  // namespace

MechanicalReport MechanicalPhase::solve(const MechanicalState& old, MechanicalState& trial,
                                        const MechanicalPass& pass) {
  equations_.begin(old, pass);
  Equilibrium equilibrium(*this, old);
  // No tolerance below the rounding of the forces, and no more iterations than the pass allows.
  linear::NewtonOptions newton_options = bodies_.options.newton;
  newton_options.absolute_tolerance = std::max(newton_options.absolute_tolerance, equations_.round_off());
  if (pass.newton_steps > 0) newton_options.max_iterations = pass.newton_steps;
  if (bodies_.pressure && pass.iterate == nullptr && pass.start.empty()) release_pores(*bodies_.pressure);
  std::vector<double> x = bodies_.start(old, pass);
  const bool guessed = try_guess(pass, x);
  MechanicalReport report;
  report.newton =
      linear::newton(equilibrium, system_.solver(), bodies_.ghosts, system_.fields(), x, newton_options);
  if (guessed && !report.newton.converged) {
    // A guess may lift a body off its support, which leaves a singular tangent.
    const linear::NewtonReport from_guess = std::move(report.newton);
    x = bodies_.start(old, pass);
    report.newton =
        linear::newton(equilibrium, system_.solver(), bodies_.ghosts, system_.fields(), x, newton_options);
    report.newton.add_solves(from_guess);
  }
  // With contact a second attempt goes another way from the start; without it Newton's answer is kept.
  if (!report.newton.converged && pass.newton_steps == 0 && !bodies_.contributions.empty()) {
    const linear::NewtonReport failed = std::move(report.newton);
    x = bodies_.start(old, pass);
    report.newton =
        attempt_again(*this, old, system_.solver(), bodies_.ghosts, system_.fields(), x, newton_options);
    if (!report.newton.converged) report.newton.reason = failed.reason + ", nor in a second attempt";
    report.newton.add_solves(failed);
  }
  // Further elements may have filled with pores, which changes the equations: they are solved again until
  // none has.
  for (int iteration = 1;
       report.newton.converged && bodies_.pressure &&
       fill_pores(*bodies_.pressure, std::span<const double>(x).subspan(bodies_.n_displacements()),
                  iteration);
       ++iteration) {
    const linear::NewtonReport before = std::move(report.newton);
    equations_.forget_residual();
    report.newton =
        linear::newton(equilibrium, system_.solver(), bodies_.ghosts, system_.fields(), x, newton_options);
    report.newton.add_solves(before);
  }
  const bool may_end = pass.newton_steps > 0 && report.newton.out_of_iterations;
  if (!report.newton.converged && !may_end)
    reject(*this, report.newton.reason, x,
           report.newton.no_direction ? Failure::linear_solver : Failure::equilibrium);
  MechanicalReport concluded = equations_.conclude(old, pass, std::move(x), trial);
  concluded.newton = std::move(report.newton);
  return concluded;
}

double MechanicalPhase::unbalanced(std::span<const double> x) {
  std::vector<double> r(bodies_.n_residuals());
  equations_.residual(x, r);
  for (std::size_t i = 0; i < bodies_.n_forces(); ++i)
    if (bodies_.loads->fixed()[i] != 0) r[i] = 0;
  system_.matrix().constraints().sum(std::span(r).first(bodies_.n_forces()));
  double squares = 0;
  for (const double value : r) squares += value * value;
  return std::sqrt(parallel::global_sum(squares));
}

bool MechanicalPhase::try_guess(const MechanicalPass& pass, std::vector<double>& x) {
  if (!parallel::any_process(!pass.guess.empty())) return false;
  std::vector<double> guess = x;
  std::copy(pass.guess.begin(), pass.guess.end(), guess.begin());
  // The guess keeps prescribed displacements. It is taken only if it lowers the unbalanced forces.
  bodies_.loads->prescribe(pass.time, std::span(guess).first(bodies_.n_displacements()));
  if (bodies_.pressure && !pass.guessed_pressure.empty())
    to_unknowns(*bodies_.pressure, pass.guessed_pressure,
                std::span(guess).subspan(bodies_.n_displacements()));
  const double here = unbalanced(x);
  if (here <= equations_.round_off()) return false;
  const double there = unbalanced(guess);
  if (!(there < here)) return false;
  x = std::move(guess);
  return true;
}

}  // namespace solidus::mechanics
