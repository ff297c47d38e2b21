/// Disjoint sets within a process, then labels by the least node number, which processes exchange for the
/// parts that they share.
#include "criteria/connectivity.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "criteria/gather.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

namespace {

/// Sets of numbers that are joined; each is told by its least number.
class Joined {
 public:
  explicit Joined(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  std::size_t root(std::size_t i) {
    auto k = as_index(i);
    while (parent(k) != k) {
      parent(k) = parent(parent(k));
      k = parent(k);
    }
    return as_size(k);
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = as_index(std::min(a, b));
  }

 private:
  Index& parent(Index i) { return parent_[as_size(i)]; }
  std::vector<Index> parent_;
};

/// Merges labels when pairs of them denote the same part: each is mapped to the least of all that are
/// connected with it.
std::map<double, double> joined_labels(const std::vector<double>& pairs) {
  std::vector<double> labels = pairs;
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  const auto place = [&](double label) {
    return as_size(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin());
  };
  Joined joined(labels.size());
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) joined.join(place(pairs[k]), place(pairs[k + 1]));
  std::map<double, double> result;
  for (std::size_t i = 0; i < labels.size(); ++i) result[labels[i]] = labels[joined.root(i)];
  return result;
}

}  // namespace

Connectivity::Connectivity(const mesh::Mesh& mesh, const parallel::GhostExchange& ghosts,
                           std::vector<char> chosen)
    : mesh_(mesh), ghosts_(ghosts), chosen_(std::move(chosen)) {}

/// A ghost's owner may call its part by another number: then both are one part.
/// @param label  of each local node on this process, and then of all of them
void Connectivity::join_over_processes(std::span<const char> inside, std::vector<double>& label) const {
  std::vector<double> of_owner = label;
  ghosts_.update(of_owner, 1);
  // Such pairs of labels are few: only parts that lie on more than one process have them.
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t i = as_size(mesh_.n_owned_nodes); i < inside.size(); ++i)
    if (inside[i] != 0 && of_owner[i] != label[i]) pairs.emplace_back(label[i], of_owner[i]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  // All processes get all pairs and come to the same common labels.
  std::vector<double> flat;
  for (const auto& [mine, owners] : pairs) flat.insert(flat.end(), {mine, owners});
  const std::map<double, double> common = joined_labels(gathered(flat));
  // A label without a pair is a part of this process alone and stays.
  if (common.empty()) return;
  for (double& one : label)
    if (const auto found = common.find(one); found != common.end()) one = found->second;
}

ConnectedParts Connectivity::parts(std::span<const char> inside) const {
  // Inside nodes of one element are connected; elements with all nodes inside make their part whole.
  const std::size_t n = inside.size();
  // Disjoint sets: joining two nodes costs next to nothing, whatever the shape of the parts.
  Joined joined(n);
  std::vector<char> whole(n, 0);  // a node of each whole element
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (chosen_[as_size(block.body)] == 0) continue;
    const auto n_nodes = as_size(mesh::node_count(block.shape));
    for (Index e = 0; e < block.size(); ++e) {
      const std::span<const Index> nodes{block.element(e), n_nodes};
      const auto is_inside = [&](Index i) { return inside[as_size(i)] != 0; };
      const auto first = std::find_if(nodes.begin(), nodes.end(), is_inside);
      if (first == nodes.end()) continue;
      std::size_t found = 1;
      for (auto node = first + 1; node != nodes.end(); ++node)
        if (is_inside(*node)) {
          joined.join(as_size(*first), as_size(*node));
          ++found;
        }
      if (found == n_nodes) whole[as_size(*first)] = 1;
    }
  }

  // Each part is named by its least node number on this process.
  ConnectedParts parts;
  parts.label.assign(n, ConnectedParts::k_none);
  for (std::size_t i = 0; i < n; ++i)
    if (inside[i] != 0) {
      const std::size_t root = joined.root(i);  // of all its nodes the least local number: it comes first
      const auto number = static_cast<double>(mesh_.input_node[i]);
      parts.label[root] = root == i ? number : std::min(parts.label[root], number);
    }
  for (std::size_t i = 0; i < n; ++i)
    if (inside[i] != 0) parts.label[i] = parts.label[joined.root(i)];

  join_over_processes(inside, parts.label);

  // Which parts hold a whole element, over all processes.
  std::vector<double> own;
  for (std::size_t i = 0; i < n; ++i)
    if (whole[i] != 0 && (own.empty() || own.back() != parts.label[i])) own.push_back(parts.label[i]);
  std::sort(own.begin(), own.end());
  own.erase(std::unique(own.begin(), own.end()), own.end());
  parts.whole = gathered(own);
  std::sort(parts.whole.begin(), parts.whole.end());
  parts.whole.erase(std::unique(parts.whole.begin(), parts.whole.end()), parts.whole.end());
  return parts;
}

}  // namespace solidus::criteria
