/// First the cells that must be split, then those that have to follow since they share a cut face, at last
/// the parts, which join the blocks of their groups.
#include "mesh/files/split_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/tetrahedra.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

using Faces = std::span<const std::array<int, 4>>;
using Corners = std::span<const Index>;
/// The corners of a face in rising order; a triangle has −1 first.
using CellFace = std::array<Index, 4>;

// Corners of the faces, outward; −1 behind those of a triangle. In the order of Abaqus.
constexpr std::array<std::array<int, 4>, 5> k_wedge_faces{
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<std::array<int, 4>, 5> k_pyramid_faces{
    {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};
constexpr std::array<std::array<int, 4>, 6> k_hexahedron_faces{
    {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}}};

Faces faces_of(Shape shape) {
  switch (shape) {
    case Shape::wedge6:
      return k_wedge_faces;
    case Shape::pyramid5:
      return k_pyramid_faces;
    case Shape::hex8:
    case Shape::hex20:
      return k_hexahedron_faces;
    default:
      return {};
  }
}

bool repeats(Corners corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (corners[i] == corners[j]) return true;
  return false;
}

CellFace key_of(Corners corners) {
  CellFace key{-1, -1, -1, -1};
  std::copy(corners.begin(), corners.end(), key.begin() + static_cast<std::ptrdiff_t>(4 - corners.size()));
  std::ranges::sort(key);
  return key;
}

/// The different corners of a face of a cell, in order around it.
std::vector<Index> face_corners(Corners cell, const std::array<int, 4>& face) {
  std::vector<Index> corners;
  for (const int a : face) {
    if (a < 0) continue;
    const Index node = cell[as_size(a)];
    if (std::ranges::find(corners, node) == corners.end()) corners.push_back(node);
  }
  return corners;
}

/// A face of three or four corners as triangles: all have its corner with the lowest number.
std::vector<Triangle> triangles_of(std::vector<Index> corners) {
  if (corners.size() < 3) return {};
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  std::vector<Triangle> triangles;
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  return triangles;
}

struct HashOfFace {
  std::size_t operator()(const CellFace& key) const {
    std::size_t hash = 0;
    for (const Index node : key) hash = 1099511628211U * (hash ^ as_size(static_cast<std::uint32_t>(node)));
    return hash;
  }
};

class Splitter {
 public:
  Splitter(RawMesh& mesh, const std::string& path) : mesh_(mesh), path_(path) {}

  void split() {
    find_cells();
    if (n_wedges_ + n_pyramids_ + n_collapsed_ > 0) {
      spread();
      split_blocks();
      split_surfaces();
      note();
    }
    split_collapsed_surfaces();
  }

 private:
  /// A cell of the mesh; copies of it in several groups are apart, and alike.
  struct Cell {
    const RawBlock* block;
    std::size_t at;
    Corners corners() const {
      const auto all = as_size(node_count(block->shape));
      return std::span(block->nodes).subspan(all * at, as_size(vertex_count(block->shape)));
    }
    bool operator<(const Cell& other) const {
      return block != other.block ? std::less<>()(block, other.block) : at < other.at;
    }
  };

  void find_cells();
  void spread();
  void split_blocks();
  void add_parts(const Cell& cell, RawBlock& to) const;
  void split_surfaces();
  void split_collapsed_surfaces();
  void note();
  bool is_split(const Cell& cell) const {
    const Shape shape = cell.block->shape;
    return shape == Shape::wedge6 || shape == Shape::pyramid5 || split_.contains(cell);
  }
  [[noreturn]] void fail(const Cell& cell, const std::string& what, const std::string& allowed) const {
    const Corners corners = cell.corners();
    Point middle{};
    for (const Index node : corners)
      for (std::size_t i = 0; i < 3; ++i)
        middle[i] += mesh_.x[as_size(node)][i] / static_cast<double>(corners.size());
    throw InputError(
        {path_},
        fmt::format("element {} ({}) at ({:.6g}, {:.6g}, {:.6g}) m {}", cell.block->input_element[cell.at],
                    name(cell.block->shape), middle[0], middle[1], middle[2], what),
        allowed);
  }

  RawMesh& mesh_;
  const std::string& path_;
  std::size_t n_wedges_ = 0, n_pyramids_ = 0, n_collapsed_ = 0;
  std::vector<Cell> seeds_;  ///< cells that have to be split
  std::set<Cell> split_;     ///< hexahedra that are split
  std::set<CellFace> cut_;   ///< quadrilaterals of all cells that are split
};

void Splitter::find_cells() {
  std::set<std::vector<Index>> seen;  // a cell of several groups is counted once
  // Cells that cannot stay: wedges, pyramids, and hexahedra with nodes that fall together.
  for (const auto& [name, group] : mesh_.groups)
    for (const RawBlock& block : group.blocks) {
      if (faces_of(block.shape).empty()) continue;
      const std::size_t n = block.input_element.size();
      for (std::size_t at = 0; at < n; ++at) {
        const Cell cell{&block, at};
        // What makes a cell one to split, and its number for the notes: each cell once, however
        // many groups hold it.
        const bool wedge = block.shape == Shape::wedge6, pyramid = block.shape == Shape::pyramid5;
        const bool collapsed = block.shape == Shape::hex8 && repeats(cell.corners());
        if (!wedge && !pyramid && !collapsed) continue;
        seeds_.push_back(cell);
        if (collapsed) split_.insert(cell);
        const Corners corners = cell.corners();
        if (!seen.insert({corners.begin(), corners.end()}).second) continue;
        n_wedges_ += wedge ? 1 : 0;
        n_pyramids_ += pyramid ? 1 : 0;
        n_collapsed_ += collapsed ? 1 : 0;
      }
    }
}

// From face to face over all hexahedra that hang together with a cell that is split.
void Splitter::spread() {
  // Hexahedra by their quadrilaterals, which are where a cut spreads.
  std::unordered_map<CellFace, std::vector<Cell>, HashOfFace> hexahedra;
  for (const auto& [name, group] : mesh_.groups)
    for (const RawBlock& block : group.blocks)
      if (block.shape == Shape::hex8 || block.shape == Shape::hex20)
        for (std::size_t at = 0; at < block.input_element.size(); ++at)
          for (const auto& face : k_hexahedron_faces)
            if (const auto corners = face_corners(Cell{&block, at}.corners(), face); corners.size() == 4)
              hexahedra[key_of(corners)].push_back({&block, at});
  std::vector<Cell> front = seeds_;
  while (!front.empty()) {
    const Cell cell = front.back();
    front.pop_back();
    // Each quadrilateral is cut once; both of its cells must then be split.
    for (const auto& face : faces_of(cell.block->shape)) {
      const std::vector<Index> corners = face_corners(cell.corners(), face);
      if (corners.size() != 4 || !cut_.insert(key_of(corners)).second) continue;
      const auto beside = hexahedra.find(key_of(corners));
      if (beside == hexahedra.end()) continue;
      for (const Cell& other : beside->second) {
        if (other.block->shape == Shape::hex20)
          fail(other, "lies next to wedges, pyramids or split hexahedra, which are of first order",
               "a mesh of first order");
        if (split_.insert(other).second) front.push_back(other);
      }
    }
  }
}

void Splitter::add_parts(const Cell& cell, RawBlock& to) const {
  const Corners corners = cell.corners();
  const Index lowest = std::ranges::min(corners);
  const auto x = [&](Index node) -> const Point& { return mesh_.x[as_size(node)]; };
  // From the lowest node a tetrahedron to each triangle of the faces that do not have it, so that neighbours
  // cut their common face alike.
  std::size_t n_positive = 0, n_parts = 0;
  for (const auto& face : faces_of(cell.block->shape))
    for (const Triangle& t : triangles_of(face_corners(corners, face))) {
      if (std::ranges::find(t, lowest) != t.end()) continue;
      const double volume = volume_6(x(lowest), x(t[2]), x(t[1]), x(t[0]));
      if (volume == 0 || !std::isfinite(volume)) fail(cell, "has a part of no volume", "cells with a volume");
      n_positive += volume > 0 ? 1 : 0;
      ++n_parts;
      to.nodes.insert(to.nodes.end(), {lowest, t[0], t[1], t[2]});
      to.input_element.push_back(cell.block->input_element[cell.at]);
    }
  if (n_parts == 0) fail(cell, "has no volume", "cells with a volume");
  // Parts of both signs overlap each other.
  if (n_positive != 0 && n_positive != n_parts)
    fail(cell, "is so warped that the tetrahedra it is split into overlap",
         "cells whose faces are nearly plane");
}

void Splitter::split_blocks() {
  for (auto& [name, group] : mesh_.groups) {
    RawBlock parts{Shape::tet4, {}, {}};
    std::vector<RawBlock> kept;
    // Cells that are split leave their block; their parts join the tetrahedra of the group.
    for (RawBlock& block : group.blocks) {
      const auto all = as_size(node_count(block.shape));
      RawBlock whole{block.shape, {}, {}};
      for (std::size_t at = 0; at < block.input_element.size(); ++at)
        if (const Cell cell{&block, at}; is_split(cell)) {
          add_parts(cell, parts);
        } else {
          whole.nodes.insert(whole.nodes.end(), block.nodes.begin() + static_cast<std::ptrdiff_t>(all * at),
                             block.nodes.begin() + static_cast<std::ptrdiff_t>(all * (at + 1)));
          whole.input_element.push_back(block.input_element[at]);
        }
      if (!whole.input_element.empty()) kept.push_back(std::move(whole));
    }
    if (parts.input_element.empty()) continue;
    // The parts join the tetrahedra that the group has already, or make a block of their own.
    const auto tetrahedra = std::ranges::find(kept, Shape::tet4, &RawBlock::shape);
    if (tetrahedra == kept.end()) {
      kept.push_back(std::move(parts));
    } else {
      tetrahedra->nodes.insert(tetrahedra->nodes.end(), parts.nodes.begin(), parts.nodes.end());
      for (std::size_t i = 0; i < parts.input_element.size(); ++i)
        tetrahedra->input_element.push_back(parts.input_element[i]);
    }
    group.blocks = std::move(kept);
  }
}

/// Moves those quadrilaterals of a group that `chosen` takes to its triangles.
template <class Chosen>
void cut_quadrilaterals(RawGroup& group, const Chosen& chosen) {
  RawBlock parts{Shape::tri3, {}, {}};
  std::vector<RawBlock> kept;
  // Quadrilaterals that are cut become triangles of the same group, with the number of the face.
  for (RawBlock& block : group.blocks) {
    if (block.shape != Shape::quad4) {
      kept.push_back(std::move(block));
      continue;
    }
    // What stays whole keeps its place in its own block.
    RawBlock whole{Shape::quad4, {}, {}};
    for (std::size_t at = 0; at < block.input_element.size(); ++at) {
      const Corners corners = std::span(block.nodes).subspan(4 * at, 4);
      if (!chosen(corners)) {
        whole.nodes.insert(whole.nodes.end(), corners.begin(), corners.end());
        whole.input_element.push_back(block.input_element[at]);
        continue;
      }
      for (const Triangle& t : triangles_of(face_corners(corners, {0, 1, 2, 3}))) {
        parts.nodes.insert(parts.nodes.end(), t.begin(), t.end());
        parts.input_element.push_back(block.input_element[at]);
      }
    }
    if (!whole.input_element.empty()) kept.push_back(std::move(whole));
  }
  // Triangles join those of the group.
  if (!parts.input_element.empty()) {
    const auto triangles = std::ranges::find(kept, Shape::tri3, &RawBlock::shape);
    if (triangles == kept.end()) {
      kept.push_back(std::move(parts));
    } else {
      triangles->nodes.insert(triangles->nodes.end(), parts.nodes.begin(), parts.nodes.end());
      for (std::size_t i = 0; i < parts.input_element.size(); ++i)
        triangles->input_element.push_back(parts.input_element[i]);
    }
  }
  group.blocks = std::move(kept);
}

void Splitter::split_surfaces() {
  for (auto& [name, group] : mesh_.groups)
    cut_quadrilaterals(group, [&](Corners corners) { return cut_.contains(key_of(corners)); });
}

void Splitter::split_collapsed_surfaces() {
  for (auto& [name, group] : mesh_.groups) {
    const bool any = std::ranges::any_of(group.blocks, [](const RawBlock& block) {
      if (block.shape != Shape::quad4) return false;
      for (std::size_t at = 0; at < block.input_element.size(); ++at)
        if (repeats(std::span(block.nodes).subspan(4 * at, 4))) return true;
      return false;
    });
    if (any) cut_quadrilaterals(group, repeats);
  }
}

void Splitter::note() {
  std::string what;
  const auto list = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) what += fmt::format("{}{} {}", what.empty() ? "" : ", ", n, n == 1 ? one : many);
  };
  list(n_wedges_, "wedge", "wedges");
  list(n_pyramids_, "pyramid", "pyramids");
  list(n_collapsed_, "hexahedron with repeated corners", "hexahedra with repeated corners");
  if (split_.size() > n_collapsed_)
    what += fmt::format(" and the {} hexahedra that hang together with them", split_.size() - n_collapsed_);
  mesh_.notes.push_back(what + " are split into tetrahedra, which match across shared faces");
}

}  // namespace

void split_cells(RawMesh& mesh, const std::string& path) {
  Splitter(mesh, path).split();
}

std::span<const int> face_of_split_cell(Shape shape, int face) {
  if (shape != Shape::wedge6 && shape != Shape::pyramid5) return {};
  const Faces faces = faces_of(shape);
  if (face < 0 || as_size(face) >= faces.size()) return {};
  const std::array<int, 4>& corners = faces[as_size(face)];
  return std::span(corners).first(corners[3] < 0 ? 3 : 4);
}

}  // namespace solidus::mesh
