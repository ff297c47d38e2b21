/// Sparsity pattern of a contact pair: the cliques of nodes that it may couple. They are recorded once for
/// the matrices of both phases, so that the patterns agree.
#pragma once

#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "linear/block_matrix.hpp"

namespace solidus::contact {

class ContactGraph {
 public:
  /// Keeps a reference.
  explicit ContactGraph(ContactKinematics& kinematics) : kinematics_(kinematics) {}

  bool may_change() const { return kinematics_.partners_change(); }
  /// Whether another matrix has newer cliques than this version, or forget() asks for some.
  bool renewed(int version) const { return version != version_; }
  /// The same, or whether a matrix with the cliques of this version lacks places.
  bool outdated(int version) const { return renewed(version) || kinematics_.graph_outdated(); }
  /// Adds the cliques, recorded again where nodes meet that did not. Returns their version.
  int add_to(linear::NodeGraph& graph);
  /// Makes the next add_to() record again, so that it depends on the present configuration alone
  /// (checkpoints).
  void forget() {
    if (may_change()) version_ = 0;
  }

 private:
  ContactKinematics& kinematics_;
  int version_ = 0;   ///< zero: nothing recorded
  int recorded_ = 0;  ///< versions so far
  std::vector<std::vector<Index>> cliques_;
};

}  // namespace solidus::contact
