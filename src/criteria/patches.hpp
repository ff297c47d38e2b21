/// The elements around the nodes of chosen bodies, and gradients of nodal fields in them.
#pragma once

#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace solidus::criteria {

/// Every element at an owned node is here, so a patch is whole without the other processes.
class Patches {
 public:
  struct Element {
    Index block, number;
  };
  /// @param chosen  one per body: its elements take part
  Patches(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<char>& chosen);

  /// Elements of the chosen bodies around an owned node.
  auto around(Index node) const {
    const auto i = static_cast<std::size_t>(node);
    return std::span(elements_).subspan(start_[i], start_[i + 1] - start_[i]) |
           std::views::transform([this](std::uint32_t number) { return element(number); });
  }
  std::span<const Index> nodes(const Element& e) const {
    const mesh::Block& block = mesh_.blocks[static_cast<std::size_t>(e.block)];
    return {block.element(e.number), static_cast<std::size_t>(mesh::node_count(block.shape))};
  }
  int body(const Element& e) const { return mesh_.blocks[static_cast<std::size_t>(e.block)].body; }

  struct Gradient {
    mesh::Point value = {};  ///< at the centre of the element, where linear shapes are most accurate
    double volume = 0;       ///< [m³], of the whole revolution with an axis
  };
  /// @param values  of the element's nodes, in their order
  Gradient gradient(const Element& e, std::span<const double> values) const;
  std::size_t bytes() const;

 private:
  /// Of one block's shape at its centre.
  struct Centre {
    std::vector<double> values, gradients;  ///< N_a; ∂N_a/∂ξ_i as [node][dimension]
    double weight = 0;                      ///< volume of the reference shape
  };
  Element element(std::uint32_t number) const {
    Index block = 0;
    while (number >= first_[static_cast<std::size_t>(block) + 1]) ++block;
    return {block, static_cast<Index>(number - first_[static_cast<std::size_t>(block)])};
  }

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  std::vector<Centre> centres_;  ///< per block
  // A tetrahedral mesh has 23 of these numbers a node: four bytes each, with one count over all blocks.
  std::vector<std::uint32_t> first_;  ///< number of the first element of each block; one more at the end
  std::vector<std::uint32_t> start_, elements_;
};

inline constexpr std::size_t k_most_nodes = 20;  ///< of an element (hex20)

}  // namespace solidus::criteria
