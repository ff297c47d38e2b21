/// The bodies of each owned node, with the volume that the node has of each.
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

/// Body of a node and the volume that the node has of it.
struct NodeShare {
  int body;
  double weight;  ///< [m³]
};

/// The shares of all owned nodes. Where each node has one share, of the same body, only the volumes are
/// stored, 8 bytes a node.
class NodeShares {
 public:
  /// The shares of one node.
  class List {
   public:
    class Iterator {
     public:
      using iterator_category = std::input_iterator_tag;
      using value_type = NodeShare;
      using difference_type = std::ptrdiff_t;
      using pointer = const NodeShare*;
      using reference = NodeShare;

      Iterator() = default;
      Iterator(const List& list, std::size_t i) : list_(&list), i_(i) {}
      NodeShare operator*() const { return (*list_)[i_]; }
      Iterator& operator++() {
        ++i_;
        return *this;
      }
      Iterator operator++(int) {
        const Iterator before = *this;
        ++i_;
        return before;
      }
      bool operator==(const Iterator& other) const { return i_ == other.i_; }

     private:
      const List* list_ = nullptr;
      std::size_t i_ = 0;
    };
    NodeShare operator[](std::size_t i) const { return {bodies_[same_body_ ? 0 : i], weights_[i]}; }
    NodeShare front() const { return (*this)[0]; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size_}; }

   private:
    friend class NodeShares;
    List(const int* bodies, bool same_body, const double* weights, std::size_t size)
        : bodies_(bodies), weights_(weights), size_(size), same_body_(same_body) {}
    const int* bodies_;
    const double* weights_;
    std::size_t size_;
    bool same_body_;
  };

  NodeShares() = default;
  /// One share for each node, all of the same body.
  /// @param weights  [owned node] [m³]
  NodeShares(int body, std::vector<double> weights);
  /// Room for so many shares.
  void reserve(std::size_t n) { weights_.reserve(n); }
  /// Adds a share of the node that is being filled.
  void add(const NodeShare& share);
  /// Ends the shares of a node: the next one is filled from here on.
  void end_node();

  Index n_nodes() const { return as_index(start_.empty() ? weights_.size() : start_.size() - 1); }
  List operator[](Index node) const {
    const auto i = as_size(node);
    const std::size_t first = start_.empty() ? i : as_size(start_[i]);
    const std::size_t size = start_.empty() ? 1 : as_size(start_[i + 1]) - first;
    const bool same_body = bodies_.size() == 1;
    return {bodies_.data() + (same_body ? 0 : first), same_body, weights_.data() + first, size};
  }
  /// Multiplies the volumes: share by share, in the order of the nodes and of their shares.
  template <class Factor>
  void scale(const Factor& factor) {
    for (Index node = 0; node < n_nodes(); ++node) {
      const List list = (*this)[node];
      for (std::size_t k = 0; k < list.size(); ++k)
        weights_[as_size(list.weights_ - weights_.data()) + k] *= factor(node, list[k].body);
    }
  }
  std::size_t bytes() const;

 private:
  std::vector<Index> start_;     ///< first share of each node and, last, their number; empty: one share each
  std::vector<int> bodies_;      ///< [share]; a single one: that of all shares
  std::vector<double> weights_;  ///< [share] [m³]
  std::size_t n_ended_ = 0;      ///< nodes that are filled
};

}  // namespace solidus::heat
