/// A compressed list: for each point its nodes, shares and weight, one behind the other.
#include "contact/points/partners.hpp"

namespace solidus::contact {

void PartnerList::clear() {
  partnered.clear();
  counted.clear();
  weight.clear();
  n_slave.clear();
  first.assign(1, 0);
  nodes.clear();
  share.clear();
}

void PartnerList::add(const PointMotion& motion, bool counted_here) {
  partnered.push_back(motion.partnered ? 1 : 0);
  counted.push_back(counted_here ? 1 : 0);
  weight.push_back(motion.partnered ? motion.weight : 0.0);
  n_slave.push_back(motion.partnered ? motion.n_slave : 0);
  if (motion.partnered) {
    nodes.insert(nodes.end(), motion.nodes.begin(), motion.nodes.end());
    share.insert(share.end(), motion.share.begin(), motion.share.end());
  }
  first.push_back(nodes.size());
}

std::size_t PartnerList::bytes() const {
  return partnered.capacity() + counted.capacity() + (weight.capacity() + share.capacity()) * sizeof(double) +
         n_slave.capacity() * sizeof(int) + first.capacity() * sizeof(std::size_t) +
         nodes.capacity() * sizeof(Index);
}

}  // namespace solidus::contact
