/// Partners of the points of a pair at the last update(), for terms whose partners are held fixed during the
/// solve (heat).
#pragma once

#include <span>
#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// Structure of arrays over the points, in the order of the pair. A process may lack points that none of its
/// nodes can meet.
struct PartnerList {
  std::vector<char> partnered;     ///< else the point has no nodes
  std::vector<char> counted;       ///< this process counts the point in sums
  std::vector<double> weight;      ///< w [m²]
  std::vector<int> n_slave;        ///< nodes of the slave, which come first
  std::vector<std::size_t> first;  ///< of each point in `nodes` and `share`; one more at the end
  std::vector<Index> nodes;        ///< local numbers
  std::vector<double> share;       ///< B_b

  Index n_points() const { return as_index(weight.size()); }
  std::span<const Index> nodes_of(Index point) const { return of(nodes, point); }
  std::span<const double> share_of(Index point) const { return of(share, point); }
  void clear();
  void add(const PointMotion& motion, bool counted_here);
  std::size_t bytes() const;

 private:
  template <class T>
  std::span<const T> of(const std::vector<T>& values, Index point) const {
    const auto p = as_size(point);
    return std::span(values).subspan(first[p], first[p + 1] - first[p]);
  }
};

}  // namespace solidus::contact
