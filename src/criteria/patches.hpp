/// The elements around the nodes of chosen bodies, and gradients of nodal fields in them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::criteria {

/// Every element at an owned node is here, so a patch is whole without the other processes. The lists of all
/// nodes of a mesh of tetrahedra would take 95 bytes a node, so they are made for the nodes that a step
/// needs.
class Patches {
 public:
  struct Element {
    Index block, number;
  };
  /// @param chosen  one per body: its elements take part; copied
  Patches(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<char> chosen);

  /// Lists the elements around these owned nodes, and no others, for around().
  void gather(std::span<const Index> owned);
  /// Frees the lists.
  void clear();
  /// Calls visit(element) for every element of the chosen bodies, in the order of around().
  template <class Visit>
  void for_elements(const Visit& visit) const {
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      if (chosen_[as_size(mesh_.blocks[b].body)] == 0) continue;
      for (Index e = 0; e < mesh_.blocks[b].size(); ++e) visit(Element{as_index(b), e});
    }
  }

  /// Elements around a node, one after the other.
  class Around {
   public:
    class Iterator {
     public:
      Iterator(const Patches& patches, const std::uint32_t* at) : patches_(&patches), at_(at) {}
      Element operator*() const { return patches_->element(*at_); }
      Iterator& operator++() {
        ++at_;
        return *this;
      }
      bool operator==(const Iterator& other) const { return at_ == other.at_; }

     private:
      const Patches* patches_;
      const std::uint32_t* at_;
    };
    Around(const Patches& patches, const std::uint32_t* first, const std::uint32_t* last)
        : begin_(patches, first), end_(patches, last) {}
    Iterator begin() const { return begin_; }
    Iterator end() const { return end_; }

   private:
    Iterator begin_, end_;
  };
  /// Elements of the chosen bodies around one of the nodes gathered.
  Around around(Index node) const;
  std::span<const Index> nodes(const Element& e) const {
    const mesh::ElementBlock& block = mesh_.blocks[as_size(e.block)];
    return {block.element(e.number), as_size(mesh::node_count(block.shape))};
  }
  int body(const Element& e) const { return mesh_.blocks[as_size(e.block)].body; }

  struct Gradient {
    mesh::Point value = {};  ///< at the centre of the element, where linear shapes are most accurate
    double volume = 0;       ///< [m³], of the whole revolution with an axis
  };
  /// @param values  of the element's nodes, in their order
  Gradient gradient(const Element& e, std::span<const double> values) const;
  std::size_t bytes() const;

 private:
  /// Basis functions of the shape of one block at its centre.
  struct Centre {
    std::vector<double> values, gradients;  ///< N_a; ∂N_a/∂ξ_i as [node][dimension]
    double weight = 0;                      ///< volume of the reference shape
  };
  template <std::size_t dim>
  Gradient gradient_in(const Centre& centre, std::span<const Index> element,
                       std::span<const double> values) const;
  Element element(std::uint32_t number) const {
    Index block = 0;
    while (number >= first_[as_size(block) + 1]) ++block;
    return {block, as_index(number - first_[as_size(block)])};
  }

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  std::vector<char> chosen_;
  std::vector<Centre> centres_;  ///< per block
  // A tetrahedral mesh has 23 of these numbers a node: four bytes each, with one count over all blocks.
  std::vector<std::uint32_t> first_;     ///< number of the first element of each block; one more at the end
  std::vector<std::uint32_t> position_;  ///< of an owned node among those gathered; empty: none are
  std::vector<std::uint32_t> start_, elements_;
};

inline constexpr std::size_t k_most_nodes = 20;  ///< of an element (hex20)

}  // namespace solidus::criteria
