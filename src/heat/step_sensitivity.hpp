/// How the end of a step changes with its start and with the data: forward differentiation through the step.
///
/// A neighbour is the same phase with one datum changed by a small amount ε, and a state that differs from
/// that of the run by O(ε). A stage of the run has solved F(y, y*) = 0 for its end y from its start y*. The
/// neighbour's own residual at that end, with its own start, tells all that has changed, and the tangent of
/// the run tells how the end follows:
///
///   K δv = −[F_ε(y, y*_ε) − F(y, y*)],   K = D + ∂r/∂v,   D_i = 1/(Δt dv_i/dH_i)
///   δH_i = δv_i / (dv_i/dH_i),   on a plateau δv_i = 0 and δH_i = −Δt (F_ε − F + K δv)_i
///
/// which is the derivative with respect to the datum, times ε, but for terms in ε² (the residual is evaluated
/// at ε, the tangent at zero). One matrix serves all neighbours of a stage: each costs one residual and one
/// solve with factors that are there. v is the unknown of nodal_potential.hpp; phase change, films, radiation
/// and heat through contact are in F and K as in the run's own iteration. Of limits of conduction
/// (conduction_limiter.hpp) it is held how they follow from temperatures. Heat of deformation is that of each
/// neighbour's own, which its contribution has been given. A step has the derivative of the
/// equations that it has solved: where a node begins or ceases to lie on a plateau it is that of one side.
/// J. E. Tolsma and P. I. Barton, Ind. Eng. Chem. Res. 41 (2002) 181; W. F. Feehery, J. E. Tolsma and P. I.
/// Barton, Appl. Numer. Math. 25 (1997) 41: staggered corrector for sensitivities of implicit steps.
#pragma once

#include <span>
#include <vector>

#include "heat/thermal_phase.hpp"
#include "linear/sparse_factors.hpp"

namespace solidus::heat {

/// A phase with data that differ a little, on the same mesh.
struct NeighbourPhase {
  ThermalPhase* phase = nullptr;
  ThermalState state;  ///< at t_n, then at t_{n+1}
};

/// Of the residual, with which the error of a derivative is that of second order in the change of the datum.
inline constexpr double k_sensitivity_accuracy = 2e-6;

class StepSensitivity {
 public:
  /// @param phase  the phase that solves the steps, which keeps its stages; must outlive this object
  /// @param exact     the tangents of its contributions are exact; else what they leave of a residual is
  ///                  taken up by further solves
  /// @param accuracy  residual over that before the first solve, of one neighbour a stage, that will do then
  /// Throws InputError for a phase that has no derivative here: whose nodes do not hold the heat.
  StepSensitivity(ThermalPhase& phase, bool exact, double accuracy = k_sensitivity_accuracy);

  /// Brings the states of the neighbours through a step that the phase has taken. Nothing is solved between
  /// the step and this call. Throws StepRejected where a linear system has no solution. Collective.
  /// @param old, now  the states of the phase at t_n and t_{n+1}
  /// @param flows     of the step
  void advance(const ThermalState& old, const StageFlows& flows, const ThermalState& now,
               std::span<NeighbourPhase> neighbours);

 private:
  /// One implicit stage, from H* = H_n + carried (H − H_n) with the H of `before`.
  struct Stage {
    double dt = 0, carried = 0;
    LoadWindow loads;
  };
  /// A state that differs from that of the run: of a neighbour.
  struct Neighbour {
    ThermalPhase* phase;
    const ThermalState* old;
    ThermalState before;  ///< at the end of the stage before, then of this one
  };
  void advance_stage(const Stage& stage, const ThermalState& old, const ThermalState& before,
                     const ThermalState& now, std::span<Neighbour> neighbours);
  static void begin(ThermalPhase& phase, const Stage& stage, const ThermalState& from,
                    const ThermalState& old, const ThermalState& before, const ThermalState& now);
  static void add_residual(ThermalPhase& phase, const Stage& stage, const ThermalState& old,
                           const ThermalState& before, const ThermalState& end, std::vector<double>& f);
  ThermalState guess(const ThermalPhase& neighbour, const ThermalState& now) const;
  void linearise(const Stage& stage, const ThermalState& now);
  bool factorise();
  void iterate(std::span<const double> f, std::vector<double>& step, bool first);
  void solve(std::span<const double> f, std::vector<double>& step, bool first);
  void multiply(std::vector<double>& step, std::vector<double>& product) const;
  void follow(const Stage& stage, std::span<const double> f, std::vector<double>& step,
              ThermalState& end) const;

  ThermalPhase& phase_;
  bool exact_;
  double accuracy_;
  std::vector<double> to_heat_;  ///< dv/dH, zero on a plateau, [owned node]
  std::vector<double> slope_;    ///< dv/dΘ, [local node]
  std::vector<char> held_;       ///< δv is none, [owned node]
  linear::SparseFactors factors_;
  bool factorised_ = false;  ///< the factors are those of the present stage
};

}  // namespace solidus::heat
