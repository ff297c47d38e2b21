/// Multi-point constraints: groups of degrees of freedom that have one common value, with one unknown for
/// each group, by exact elimination.
///
/// u = T u', where T gives every member of a group the value of its leader. The system in u' is Tᵀ K T and Tᵀ
/// r: rows and columns of the members add up in those of the leader, and the constraint forces do no work and
/// drop out.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::linear {

class MultiPointConstraints {
 public:
  MultiPointConstraints() = default;
  /// @param groups degrees of freedom (local node × block size + component), ghosts included: every process
  ///               gives the same groups in the same order, with those members that it knows. No degree of
  ///               freedom may be in two groups (assert). Collective.
  MultiPointConstraints(const mesh::Mesh& mesh, int block_size, std::vector<std::vector<Index>> groups);

  bool empty() const { return groups_.empty(); }
  /// The number over all processes of the unknown that gives a local degree of freedom its value.
  GlobalIndex unknown(Index entry) const { return unknown_[as_size(entry)]; }
  /// Owned members that are no leaders, and so no unknowns.
  const std::vector<Index>& followers() const { return followers_; }

  /// Tᵀ r on owned entries: leaders get the sum of their group, followers zero. Collective.
  void sum(std::span<double> r) const;
  /// T u' on owned entries: followers get the value of their leader. Collective.
  void share(std::span<double> x) const;

 private:
  struct Group {
    std::vector<Index> members;  ///< owned ones
    Index leader = -1;           ///< where this process owns it, else −1
  };
  std::vector<Group> groups_;
  std::vector<GlobalIndex> unknown_;  ///< [local entry]
  std::vector<Index> followers_;
};

}  // namespace solidus::linear
