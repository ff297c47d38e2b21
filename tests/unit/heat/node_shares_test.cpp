#include "heat/storage/node_shares.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace solidus::heat {
namespace {

using Shares = std::vector<std::pair<int, double>>;  ///< of one node

NodeShares filled(const std::vector<Shares>& nodes) {
  NodeShares shares;
  for (const Shares& node : nodes) {
    for (const auto& [body, weight] : node) shares.add({body, weight});
    shares.end_node();
  }
  return shares;
}

std::vector<Shares> read(const NodeShares& shares) {
  std::vector<Shares> nodes;
  for (Index i = 0; i < shares.n_nodes(); ++i) {
    nodes.emplace_back();
    for (const NodeShare s : shares[i]) nodes.back().emplace_back(s.body, s.weight);
    EXPECT_EQ(shares[i].size(), nodes.back().size());
    EXPECT_EQ(shares[i].empty(), nodes.back().empty());
  }
  return nodes;
}

TEST(NodeShares, GiveBackWhatWasAdded) {
  const std::vector<std::vector<Shares>> all = {
      {},
      {{{2, 0.5}}},
      {{{2, 0.5}}, {{2, 1.5}}, {{2, 2.5}}},                 // one body
      {{{0, 0.5}}, {{0, 1.5}}, {{1, 2.5}}, {{0, 3.5}}},     // two bodies, one share each
      {{{0, 0.5}}, {{0, 1.5}, {1, 0.25}}, {{1, 2.5}}, {}},  // a node of both, one of none
      {{}, {{1, 0.5}}, {{1, 1.5}}},                         // the first one of none
      {{{1, 0.5}}, {}, {{1, 1.5}}, {{0, 1.0}, {1, 2.0}, {2, 3.0}}},
      {{{3, 0.5}, {3, 0.25}}, {{3, 1.5}}}};  // two shares of one body
  for (const std::vector<Shares>& nodes : all) EXPECT_EQ(read(filled(nodes)), nodes);
}

TEST(NodeShares, OfOneBodyAreTheVolumesAlone) {
  const std::vector<double> volumes = {0.5, 1.5, 2.5};
  const NodeShares shares(2, volumes);
  EXPECT_EQ(read(shares), (std::vector<Shares>{{{2, 0.5}}, {{2, 1.5}}, {{2, 2.5}}}));
  EXPECT_EQ(shares.bytes(), volumes.size() * sizeof(double) + sizeof(int));
}

}  // namespace
}  // namespace solidus::heat
