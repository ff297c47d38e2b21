/// Residual of each body's equilibrium, measured against the forces that this body exchanges.
///
/// Thermal stresses cancel within a body and can be a million times larger than its weight; a mould clamped
/// at its bottom has support forces a thousand times larger than the weight of the casting in it. Measured
/// against either, a casting that floats above its mould would pass for balanced. So every body (bodies that
/// share nodes count as one) has its own reference: its loads, its supports, its contact forces.
#pragma once

#include <span>
#include <vector>

#include "linear/active_set.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

class BodyBalance {
 public:
  /// Finds which of the active bodies share nodes. Collective.
  BodyBalance(const mesh::Mesh& mesh, const linear::ActiveSet& active, int components);

  void begin();
  /// Squares of the internal forces of a block before they cancel.
  void add_internal(int body, double squares);
  /// Loads and contact forces, [owned node][component].
  void add_exchanged(std::span<const double> force);
  /// The residual; where prescribed it is a support force, on the axis of an axisymmetric mesh it is neither.
  void add_residual(std::span<const double> r, std::span<const char> fixed, std::span<const char> supported);
  /// The residual of the volume of mixed elements in the unit of a force, and the magnitudes of the terms
  /// that it is the sum of, as far as this step has changed them: its reference. [owned node][field]
  void add_volume_residual(std::span<const double> r, int fields);
  void add_volume_change(std::span<const double> change, int fields);
  /// The number R with ‖r‖/R = max over the bodies of ‖r_body‖/reference_body, forces and volumes each
  /// measured against their own reference; over all processes.
  /// Collective.
  double reference();

  /// Size of a step relative to the increment since t_n: the largest ‖step‖/‖increment‖ of a body. Where the
  /// root mean square of its increment over its nodes is below 1e-8 of its extent, a body is at rest, and its
  /// step is compared with that. Collective.
  /// @param step, increment  [owned node][component] [m]
  double relative_step(std::span<const double> step, std::span<const double> increment) const;

 private:
  std::size_t group_of_entry(std::size_t entry, int of_node) const {
    return node_group_[entry / as_size(of_node)];
  }

  int components_;
  std::vector<std::size_t> body_group_;  ///< of each body
  std::vector<std::size_t> node_group_;  ///< of each owned node
  std::size_t n_groups_ = 0;
  std::vector<double> extent_;  ///< of each group, corner to corner [m]
  /// Squares of each group: forces exchanged, internal and left over; volumes left over and changed.
  struct Sums {
    double exchanged = 0, internal = 0, residual = 0, volume_residual = 0, volume_change = 0;
  };
  std::vector<Sums> sums_;
};

}  // namespace solidus::mechanics
