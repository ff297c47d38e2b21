/// Contact forces as a term of the mechanical phase; an internal part of ContactPair.
#pragma once

#include <string>
#include <vector>

#include "contact/forces/step.hpp"
#include "contact/points/geometry.hpp"
#include "contact/points/integration.hpp"
#include "contact/points/point_law.hpp"
#include "contact/points/slot_cache.hpp"
#include "linear/contribution.hpp"
#include "linear/coupled_matrix.hpp"
#include "mesh/mesh.hpp"

namespace solidus::contact {

/// r_b = Σ_p w B_b (t_N n + F T) of the displacement it is called with, from the step's start, and the exact
/// derivative away from g_N = 0 and the edge of the slip cone:
///
///   K_bc = Σ_p w B_b { n ⊗ t_N' ∂g_N/∂x_c + F [ ∂T/∂T^trial (∂T̄_n/∂x_c + ε_T ∂ΔG/∂x_c) + ∂T/∂t_N ⊗ t_N'
///   ∂g_N/∂x_c ] }
///          + geometric terms of the kinematics
///
/// T̄_n: T_n as the kinematics carry it. With `symmetric` ∂T/∂t_N is left out, and of the rest the symmetric
/// part is taken; the symmetric part of the whole would be indefinite wherever points slip.
///
/// The tangent holds a share of the penalty at every point (ContactParameters::stabilisation). Against a
/// melt, with next to no stiffness, that share is much, and Newton's iteration creeps: from its ninth tangent
/// on the share falls. Where too little is held, rounding moves a body that nothing else holds: hold() lets
/// the tangents of an iteration hold more.
///
/// Where the friction law finds no state the residual is not a number: Newton's method shortens its step.
class MechanicsTerm : public linear::Contribution {
 public:
  /// Its tangents get this in addition to the derivative of the forces; forces, and so the solution, do not.
  class Stabilisation {
   public:
    /// @param amount  as the pair gives it, a share of the penalty (ContactParameters)
    explicit Stabilisation(double amount) : amount_(amount) {}
    /// Another Newton iteration follows.
    void restart() { n_tangents_ = 0; }
    /// Another Newton iteration follows, whose tangents hold so many times the amount; so do those after it.
    void hold(double times) {
      times_ = times;
      restart();
    }
    /// Another tangent of the iteration.
    void next();
    bool none() const { return amount_ == 0; }
    /// The share of the penalty that this tangent gets at a point of this weight.
    double of(double weight) const { return weight * times_ * amount_ * left_; }

   private:
    double amount_, left_ = 1, times_ = 1;
    int n_tangents_ = 0;  ///< of this iteration
  };

  /// The last residual found these changes and failures of points.
  struct Outcome {
    Index changes = 0;  ///< points that changed between open, sticking and slipping since the one before
    FrictionStatus failure = FrictionStatus::converged;  ///< the first one of the friction law
  };

  /// Keeps references.
  /// @param name    of the pair, for the log: with level debug every residual leaves a line
  /// @param active  false: no term at all
  MechanicsTerm(std::string name, const ContactGeometry& geometry, const PointLaw& law,
                const ContactStep& step, const bool& active, double stabilisation, bool symmetric);
  Stabilisation& stabilisation() { return stabilisation_; }
  /// Whether the tangent holds how a point's weight falls where it slides beyond the rim of its master, which
  /// makes it unsymmetric. Else it does not, and iterations with such points converge linearly.
  void follow_weights(bool on) { follows_weights_ = on; }

  bool graph_may_change() const override { return geometry_.graph().may_change(); }
  bool graph_outdated() const override {
    const ContactGraph& graph = geometry_.graph();
    return active_ ? graph.outdated(version_) : graph.renewed(version_);
  }
  void add_to_graph(linear::NodeGraph& graph) const override;
  void bind(const linear::BlockMatrix& matrix) override;
  void add_residual(std::span<const double> x, std::span<double> r) override;
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override;
  /// Adds ∂r/∂Θ at the displacement of the last call, where friction follows the bodies' temperatures.
  void add_temperature_tangent(linear::CoupledMatrix& matrix);

  const Outcome& outcome() const { return outcome_; }
  std::size_t bytes() const { return slots_.bytes() + status_.capacity(); }

 private:
  struct Run;
  struct Count;
  void log(const Count& count) const;
  template <int dim>
  void add_tangents(linear::BlockMatrix& matrix);
  template <int dim>
  void add_point(const PointMotion& motion, Index point, Run& run);
  template <int dim>
  void flush(Run& run, linear::BlockMatrix& matrix);

  std::string name_;
  Index n_owned_;
  const ContactGeometry& geometry_;
  const ContactKinematics& kinematics_;
  const PointLaw& law_;
  const ContactStep& step_;
  const bool& active_;
  Stabilisation stabilisation_;
  bool symmetric_;
  bool follows_weights_ = false;
  mutable int version_ = 0;  ///< of the graph it has
  SlotCache slots_;
  /// Places in a matrix of the blocks that couple forces with temperatures.
  struct CoupledSlots {
    SlotCache slots;
    const linear::BlockMatrix* matrix = nullptr;  ///< that they know
  };
  CoupledSlots coupled_;
  std::vector<PointStatus> status_;  ///< at the last residual
  Outcome outcome_;
};

}  // namespace solidus::contact
