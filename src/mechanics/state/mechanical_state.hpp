/// State of the mechanical phase between steps. It is complete: a step reads nothing else, and a checkpoint
/// of the phase is this without `elements`, which no step reads.
#pragma once

#include <vector>

#include "mechanics/state/element_values.hpp"
#include "numbers/simd.hpp"
#include "numbers/tensor.hpp"

namespace solidus::mechanics {

/// The history of one mesh block: [batch][point][component], whatever the law keeps (viscoelastic: the
/// viscous strain, components in the order of Sym; viscoplastic: Viscoplastic::State). Lanes beyond the
/// block's elements are padding. Mixed elements keep their volumetric strain behind it.
struct BlockHistory {
  int n_components = 0, n_points = 0;
  PackVector<Lane> values;
};

/// The stress of one mesh block whose product with a later increment is work.
struct StressAtWork {
  PackVector<Sym<Lane>> stress;  ///< [batch][point] [Pa]
  // Mixed elements also have ζ div u̇ where melt flows, [batch], and p_a − p̄ where there is a hoop,
  // [batch][node].
  PackVector<Lane> compaction, variation;  ///< [Pa]
};

/// Forces in equilibrium whose product with a later increment is work.
struct ForcesAtWork {
  std::vector<StressAtWork> stress;        ///< one per block of the mesh
  std::vector<double> external, residual;  ///< loads and what supports hold, [owned node][component] [N]
};

struct MechanicalState {
  std::vector<double> displacement;   ///< [local node][component] [m], ghosts up to date
  std::vector<BlockHistory> history;  ///< one per block of the mesh
  /// The mean stress of mixed elements at the nodes, [local node][field] [Pa] (nodal_pressure.hpp); empty
  /// where there are none.
  std::vector<double> pressure;
  /// The solid fractions that the last pass has ended with, with which the next one begins, [local
  /// node][field] (phase_fields.hpp); empty where nothing melts.
  std::vector<double> solid_fraction;
  /// The history at t_{n−1} for the two-step method, and t_n − t_{n−1} [s], zero if it is not known. Empty
  /// with backward Euler.
  std::vector<BlockHistory> before;
  double dt_before = 0;
  /// Values of the elements for results, one per block of the mesh, of the pass that has led to this state.
  /// Empty where there was none, after a restart too.
  std::vector<SharedElementValues> elements;
  // With inertia, else empty (mechanics/loads/motion.hpp); [local node][component], prescribed ones included.
  std::vector<double> velocity;      ///< [m/s]
  std::vector<double> acceleration;  ///< [m/s²]
  // And of methods that remember t_n: forces on owned nodes, stress at the points as
  // [batch][point][component].
  std::vector<double> net_force;     ///< internal and contact forces less loads [N]
  std::vector<double> load;          ///< of pressures, tractions and gravity [N]
  std::vector<BlockHistory> stress;  ///< of the mechanical phase, order of Sym [Pa]; one per block
};

}  // namespace solidus::mechanics
