/// Terms that a phase's equations receive from outside: contact forces, heat through an interface, structural
/// heating.
#pragma once

#include <span>

#include "linear/block_matrix.hpp"

namespace solidus::linear {

/// One stage of a step of the thermal phase (heat/thermal_phase.hpp): a term that stores heat stores it over
/// `dt`, from E* = E_n + carried (E(x) − E_n) with the x of the stage before.
struct RungeKuttaStage {
  double dt = 0;       ///< [s]
  double carried = 0;  ///< zero in the first stage
};

/// An extra term of a system in one nodal field (temperature: 1 component, displacement: 2 or 3). It adds
/// only to rows of owned nodes. `x` is local (ghosts up to date), [node][component]; `r` on owned nodes.
class Contribution {
 public:
  virtual ~Contribution() = default;
  /// Adds the couplings of nodes to the graph before the matrix exists: once, or again if graph_outdated().
  virtual void add_to_graph(NodeGraph& graph) const = 0;
  /// Whether nodes may couple later that do not now. The same on every process.
  virtual bool graph_may_change() const { return false; }
  /// Whether the matrix that the term is bound to lacks places that it needs. This process's opinion.
  virtual bool graph_outdated() const { return false; }
  /// Looks up slots once the matrix exists.
  virtual void bind(const BlockMatrix& matrix) = 0;
  /// r += the term at x (the phase solves r = 0 with r = internal − external, units: N for forces, W for
  /// heat).
  virtual void add_residual(std::span<const double> x, std::span<double> r) = 0;
  /// matrix += ∂(term)/∂x at x.
  virtual void add_tangent(std::span<const double> x, BlockMatrix& matrix) = 0;
  /// Whether the term stores what it takes, rather than passing it on.
  virtual bool stores() const { return false; }
  /// For terms that exchange heat between nodes: from here on no heat passes from cold to hot at these nodes,
  /// [local node], ghosts up to date; they add to those of earlier calls. Empty: everywhere as it is without.
  virtual void limit_exchange(std::span<const char> /*nodes*/) {}
  /// For terms that store.
  virtual void begin_stage(const RungeKuttaStage& /*stage*/, std::span<const double> /*x*/) {}
};

/// Whether a matrix with these terms must be made again, on any process. Collective only where that may be.
bool graph_outdated(std::span<Contribution* const> contributions);

}  // namespace solidus::linear
