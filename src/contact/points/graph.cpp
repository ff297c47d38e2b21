/// Cliques are recorded as one list of nodes with the starts of each, so that both phases can read them
/// without the pair.
#include "contact/points/graph.hpp"

namespace solidus::contact {

namespace {

struct Recorder final : ContactKinematics::CliqueSink {
  std::vector<std::vector<Index>>& cliques;
  explicit Recorder(std::vector<std::vector<Index>>& to) : cliques(to) {}
  void add(std::span<const Index> nodes) override { cliques.emplace_back(nodes.begin(), nodes.end()); }
};

}  // namespace

int ContactGraph::add_to(linear::NodeGraph& graph) {
  if (version_ == 0 || kinematics_.graph_outdated()) {
    cliques_.clear();
    Recorder recorder(cliques_);
    kinematics_.add_to_graph(recorder);
    version_ = ++recorded_;
  }
  for (const std::vector<Index>& clique : cliques_)
    graph.add_cliques(clique, static_cast<int>(clique.size()));
  return version_;
}

}  // namespace solidus::contact
