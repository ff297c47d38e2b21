/// One weight for each node as long as every node has one body; bodies and starts of nodes are listed from
/// the first node on that has more.
#include "heat/storage/node_shares.hpp"

#include <numeric>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

NodeShares::NodeShares(int body, std::vector<double> weights)
    : bodies_(1, body), weights_(std::move(weights)), n_ended_(weights_.size()) {}

void NodeShares::add(const NodeShare& share) {
  if (bodies_.empty()) bodies_.push_back(share.body);
  if (bodies_.size() == 1 && !weights_.empty() && bodies_.front() != share.body) {
    const int body = bodies_.front();
    bodies_.reserve(weights_.capacity());
    bodies_.assign(weights_.size(), body);
  }
  const bool same_body = bodies_.size() == 1 && bodies_.front() == share.body;
  weights_.push_back(share.weight);
  if (!same_body) bodies_.push_back(share.body);
}

void NodeShares::end_node() {
  ++n_ended_;
  if (start_.empty()) {
    if (weights_.size() == n_ended_) return;
    start_.resize(n_ended_);  // each node before this one has one share
    std::iota(start_.begin(), start_.end(), 0);
  }
  start_.push_back(as_index(weights_.size()));
}

std::size_t NodeShares::bytes() const {
  return start_.capacity() * sizeof start_[0] + bodies_.capacity() * sizeof bodies_[0] +
         weights_.capacity() * sizeof weights_[0];
}

}  // namespace solidus::heat
