/// Values of nodes that lie on seams between processes, from their owners to all who hold them.
#pragma once

#include <vector>

#include "mesh/message.hpp"
#include "mesh/refinement/level.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// Sends each process a message and returns those that came, [rank]; what a process says to itself comes
/// back. Collective.
std::vector<std::vector<char>> exchange(std::vector<std::vector<char>> messages);

/// Who holds which nodes of whom.
class Sharing {
 public:
  /// Collective.
  explicit Sharing(const Level& level);

  /// Of each rank the nodes of this process that the other one holds, and the nodes of the other that this
  /// one holds, in the same order on both.
  const std::vector<std::vector<Index>>& given() const { return given_; }
  const std::vector<std::vector<Index>>& taken() const { return taken_; }

  /// Replaces the values of nodes that others own by those of their owners. Collective.
  template <class T>
  void update(std::vector<T>& values) const {
    std::vector<std::vector<char>> messages;
    for (const std::vector<Index>& nodes : given_) {
      std::vector<T> mine;
      mine.reserve(nodes.size());
      for (const Index node : nodes) mine.push_back(values[as_size(node)]);
      Packer packer;
      packer.put(mine);
      messages.push_back(std::move(packer).buffer());
    }
    messages = exchange(std::move(messages));
    for (std::size_t r = 0; r < messages.size(); ++r) {
      Unpacker unpacker(messages[r]);
      const auto theirs = unpacker.vector<T>();
      for (std::size_t i = 0; i < theirs.size(); ++i) values[as_size(taken_[r][i])] = theirs[i];
    }
  }

 private:
  std::vector<std::vector<Index>> given_, taken_;
};

}  // namespace solidus::mesh
