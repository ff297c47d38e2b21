/// A rectangle or box of two bodies "left" and "right" that share the nodes of the plane between them, which
/// is the surface "between".
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::test {

/// The elements to the left of x, or right of it.
inline mesh::RawBlock on_one_side(const mesh::RawMesh& raw, const mesh::RawBlock& all, double x, bool left) {
  mesh::RawBlock part{all.shape, {}, {}};
  const auto n = static_cast<std::size_t>(mesh::node_count(all.shape));
  for (std::size_t e = 0; e < all.input_element.size(); ++e) {
    double centre = 0;
    for (std::size_t a = 0; a < n; ++a)
      centre += raw.x[static_cast<std::size_t>(all.nodes[e * n + a])][0] / static_cast<double>(n);
    if ((centre < x) != left) continue;
    part.nodes.insert(part.nodes.end(), all.nodes.begin() + static_cast<std::ptrdiff_t>(e * n),
                      all.nodes.begin() + static_cast<std::ptrdiff_t>((e + 1) * n));
    part.input_element.push_back(all.input_element[e]);
  }
  return part;
}

/// The faces of some elements in the plane.
inline mesh::RawBlock faces_at(const mesh::RawMesh& raw, const mesh::RawBlock& block, double x) {
  mesh::RawBlock faces{mesh::face_shape(block.shape), {}, {}};
  const auto n = static_cast<std::size_t>(mesh::node_count(block.shape));
  for (std::size_t e = 0; e < block.input_element.size(); ++e)
    for (int k = 0; k < mesh::face_count(block.shape); ++k) {
      std::vector<Index> nodes;
      for (const int a : mesh::face_nodes(block.shape, k))
        nodes.push_back(block.nodes[e * n + static_cast<std::size_t>(a)]);
      bool in_plane = true;
      for (const Index node : nodes)
        in_plane = in_plane && std::abs(raw.x[static_cast<std::size_t>(node)][0] - x) < 1e-9;
      if (!in_plane) continue;
      faces.nodes.insert(faces.nodes.end(), nodes.begin(), nodes.end());
      faces.input_element.push_back(1000000 + static_cast<GlobalIndex>(faces.input_element.size()));
    }
  return faces;
}

/// On rank 0.
inline mesh::RawMesh split_block(mesh::Shape shape, std::vector<double> size, std::vector<int> divisions,
                                 double x) {
  mesh::RawMesh raw = mesh::make_block({std::move(size), {}, std::move(divisions), "block"}, shape);
  const mesh::RawBlock all = raw.groups.at("block").blocks.front();
  raw.groups.erase("block");
  for (const bool left : {true, false})
    raw.groups[left ? "left" : "right"] = {raw.dimension, {on_one_side(raw, all, x, left)}};
  raw.groups["between"] = {raw.dimension - 1, {faces_at(raw, raw.groups.at("left").blocks.front(), x)}};
  mesh::validate_and_orient(raw, "block");
  return raw;
}

}  // namespace solidus::test
