/// Processes meet in pairs; nodes are asked for by their keys with numbers over all processes.
#include "mesh/refinement/exchange.hpp"

#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

/// A key that another process understands.
struct Question {
  std::array<GlobalIndex, 4> vertex{-1, -1, -1, -1};
  std::uint32_t code = 0;
};

/// Local numbers of the nodes of the mesh that is refined by those over all processes.
class LocalNumbers {
 public:
  explicit LocalNumbers(const Mesh& mesh) : mesh_(mesh) {
    for (Index i = mesh.n_owned_nodes; i < mesh.n_nodes(); ++i)
      ghosts_.emplace(mesh.global_node[as_size(i)], i);
  }
  Index of(GlobalIndex number) const {
    const GlobalIndex owned = number - mesh_.first_owned;
    if (owned >= 0 && owned < mesh_.n_owned_nodes) return as_index(owned);
    const auto ghost = ghosts_.find(number);
    return ghost == ghosts_.end() ? -1 : ghost->second;
  }

 private:
  const Mesh& mesh_;
  std::unordered_map<GlobalIndex, Index> ghosts_;
};

Question question_of(const Level& level, Index node) {
  const InputNumbers& global = level.part.mesh.global_node;
  Question question;
  if (node < level.n_old()) {
    question.vertex[0] = global[as_size(node)];
    return question;
  }
  const NodeKey& key = level.table.key(node);
  question.code = key.code;
  for (std::size_t i = 0; i < 4; ++i)
    if (key.vertex[i] >= 0) question.vertex[i] = global[as_size(key.vertex[i])];
  return question;
}

/// The node that another process asks for.
Index answer_to(const Question& question, const Level& level, const LocalNumbers& local) {
  NodeKey key;
  key.code = question.code;
  for (std::size_t i = 0; i < 4; ++i)
    if (question.vertex[i] >= 0) key.vertex[i] = local.of(question.vertex[i]);
  const Index node = question.code == 0 ? key.vertex[0] : level.table.find(key);
  if (node < 0 || !level.is_mine(node))
    throw std::logic_error("a process does not have the node of a refined mesh that is its own");
  return node;
}

}  // namespace

std::vector<std::vector<char>> exchange(std::vector<std::vector<char>> messages) {
  const int n = processes::count(), rank = processes::rank();
  std::vector<std::vector<char>> received(as_size(n));
  // In each round every process has one partner, which has it as its own; the lower one speaks first.
  for (int round = 0; round < n; ++round) {
    const int partner = (round - rank + n) % n;
    if (partner == rank) {
      received[as_size(rank)] = std::move(messages[as_size(rank)]);
      continue;
    }
    if (rank < partner) processes::send(messages[as_size(partner)], partner);
    received[as_size(partner)] = processes::receive(partner);
    if (rank > partner) processes::send(messages[as_size(partner)], partner);
  }
  return received;
}

Sharing::Sharing(const Level& level) : given_(level.first.size() - 1), taken_(level.first.size() - 1) {
  for (Index i = 0; i < level.n_nodes(); ++i)
    if (!level.is_mine(i)) taken_[as_size(level.owner[as_size(i)])].push_back(i);
  // Each process asks the owners for the nodes that it holds of theirs.
  std::vector<std::vector<char>> messages;
  for (const std::vector<Index>& nodes : taken_) {
    std::vector<Question> questions;
    questions.reserve(nodes.size());
    for (const Index node : nodes) questions.push_back(question_of(level, node));
    Packer packer;
    packer.put(questions);
    messages.push_back(std::move(packer).buffer());
  }
  messages = exchange(std::move(messages));
  const LocalNumbers local(level.part.mesh);
  for (std::size_t r = 0; r < messages.size(); ++r) {
    Unpacker unpacker(messages[r]);
    for (const Question& question : unpacker.vector<Question>())
      given_[r].push_back(answer_to(question, level, local));
  }
}

}  // namespace solidus::mesh
