/// Blocks are filtered by the times of birth; faces are judged by how many of their elements are there.
#include "linear/growing_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/birth_groups.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::linear {

namespace {

/// Adds one element of a block to another; whether this process counts it is kept.
void append(mesh::ElementBlock& to, const mesh::ElementBlock& from, Index element) {
  const Index* nodes = from.element(element);
  to.nodes.insert(to.nodes.end(), nodes, nodes + mesh::node_count(from.shape));
  to.input_element.push_back(from.input_element[as_size(element)]);
  if (element < from.n_counted) ++to.n_counted;
}

/// The nodes of an element's face, vertices first.
std::vector<Index> nodes_of_face(const mesh::ElementBlock& block, Index element, int face) {
  std::vector<Index> nodes;
  for (const int a : mesh::face_nodes(block.shape, face)) nodes.push_back(block.element(element)[a]);
  return nodes;
}

void find_nodes(mesh::Surface& surface) {
  surface.nodes.clear();
  for (const mesh::ElementBlock& faces : surface.faces)
    surface.nodes.insert(surface.nodes.end(), faces.nodes.begin(), faces.nodes.end());
  std::sort(surface.nodes.begin(), surface.nodes.end());
  surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
}

}  // namespace

GrowingMesh::GrowingMesh(const mesh::Mesh& whole, std::vector<Births> births, std::vector<std::string> bare,
                         double interval)
    : whole_(whole),
      births_(std::move(births)),
      bare_(std::move(bare)),
      time_(-std::numeric_limits<double>::infinity()),
      present_(whole) {
  // Times of activation are grouped first, so that all that follows sees the grouped ones. Elements are also
  // found by their number in the input, for fields and checkpoints.
  round_times(interval);
  for (std::size_t b = 0; b < births_.size(); ++b)
    for (std::size_t e = 0; e < births_[b].size(); ++e)
      births_of_.emplace_back(whole_.blocks[b].input_element[e], births_[b][e]);
  std::sort(births_of_.begin(), births_of_.end());
  find_faces();
}

void GrowingMesh::round_times(double interval) {
  times_ = group_times(births_, interval);
}

void GrowingMesh::find_faces() {
  const auto key_of = [](const mesh::ElementBlock& block, Index e, int k) {
    return mesh::face_key(nodes_of_face(block, e, k).data(),
                          mesh::vertex_count(mesh::face_shape(block.shape)));
  };
  // Faces of elements that are born come first; of others only those that they share.
  for (const bool grows : {true, false})
    for (std::size_t b = 0; b < whole_.blocks.size(); ++b) {
      const mesh::ElementBlock& block = whole_.blocks[b];
      if (births_[b].empty() == grows) continue;
      for (Index e = 0; e < block.size(); ++e)
        for (int k = 0; k < mesh::face_count(block.shape); ++k) {
          const mesh::FaceKey key = key_of(block, e, k);
          auto found = faces_.find(key);
          if (found == faces_.end()) {
            if (!grows) continue;
            found = faces_.try_emplace(key).first;
            order_.push_back(key);
          }
          found->second.sides.push_back({static_cast<std::int32_t>(b), e, k});
        }
    }
  // Faces of named surfaces keep their surface and need no other one when they are bare.
  for (const auto& [name, surface] : whole_.surfaces)
    for (const mesh::ElementBlock& faces : surface.faces)
      for (Index f = 0; f < faces.size(); ++f)
        if (const auto found = faces_.find(mesh::face_key(faces.element(f), mesh::vertex_count(faces.shape)));
            found != faces_.end())
          found->second.named = true;
}

bool GrowingMesh::born(const Side& side) const {
  const Births& of_block = births_[as_size(side.block)];
  return of_block.empty() || of_block[as_size(side.element)] <= time_;
}

/// How many of the elements at a face are active: one of two makes it bare.
int GrowingMesh::present_sides(const Face& face) const {
  return static_cast<int>(std::ranges::count_if(face.sides, [&](const Side& s) { return born(s); }));
}

/// Blocks and surfaces are filled again only where elements are activated between the last time and this one.
bool GrowingMesh::advance(double time) {
  const auto changes = [&](double t) { return t > time_ && t <= time; };
  const bool first = time_ == -std::numeric_limits<double>::infinity();
  const bool any = first || std::any_of(times_.begin(), times_.end(), changes);
  time_ = std::max(time, time_);
  if (!any) return false;
  fill_blocks();
  fill_surfaces();
  return true;
}

bool GrowingMesh::there(std::int64_t input_element) const {
  const auto found = std::lower_bound(births_of_.begin(), births_of_.end(), input_element,
                                      [](const auto& birth, std::int64_t n) { return birth.first < n; });
  return found == births_of_.end() || found->first != input_element || found->second <= time_;
}

void GrowingMesh::fill_blocks() {
  for (std::size_t b = 0; b < whole_.blocks.size(); ++b) {
    if (births_[b].empty()) continue;
    const mesh::ElementBlock& from = whole_.blocks[b];
    mesh::ElementBlock& to = present_.blocks[b];
    to.nodes.clear();
    to.input_element.clear();
    to.n_counted = 0;
    for (Index e = 0; e < from.size(); ++e)
      if (births_[b][as_size(e)] <= time_) append(to, from, e);
  }
}

void GrowingMesh::fill_surfaces() {
  for (const auto& [name, surface] : whole_.surfaces) {
    mesh::Surface& to = present_.surfaces.at(name);
    to.faces.clear();
    for (const mesh::ElementBlock& faces : surface.faces) {
      mesh::ElementBlock& left = to.faces.emplace_back();
      left.shape = faces.shape;
      left.body = faces.body;
      for (Index f = 0; f < faces.size(); ++f) {
        const auto face = faces_.find(mesh::face_key(faces.element(f), mesh::vertex_count(faces.shape)));
        // A face that no growing element touches is always there; any other one as long as exactly one of its
        // sides is active.
        if (face == faces_.end() || present_sides(face->second) == 1) append(left, faces, f);
      }
    }
  }
  add_bare_faces();
  for (auto& [name, surface] : present_.surfaces) find_nodes(surface);
}

void GrowingMesh::add_bare_faces() {
  // A face counts on the process that owns the first of its vertices; faces that count come first.
  for (const bool counted : {true, false})
    for (const mesh::FaceKey& key : order_) {
      const Face& face = faces_.at(key);
      if (face.named || face.sides.size() != 2 || present_sides(face) != 1) continue;
      // The bare face belongs to the active element; the surface that it joins is the one named for the
      // growing body.
      const Side& side = born(face.sides[0]) ? face.sides[0] : face.sides[1];
      const Side& growing = births_[as_size(face.sides[0].block)].empty() ? face.sides[1] : face.sides[0];
      const std::string& joins = bare_[as_size(whole_.blocks[as_size(growing.block)].body)];
      if (joins.empty()) continue;
      const mesh::ElementBlock& block = whole_.blocks[as_size(side.block)];
      const std::vector<Index> nodes = nodes_of_face(block, side.element, side.face);
      GlobalIndex lowest = std::numeric_limits<GlobalIndex>::max();
      Index first = 0;
      for (const Index node : nodes)
        if (whole_.global_node[as_size(node)] < lowest)
          lowest = whole_.global_node[as_size(node)], first = node;
      if ((first < whole_.n_owned_nodes) != counted) continue;
      // Blocks of bare faces follow those of the surface itself, one for each shape and body.
      std::vector<mesh::ElementBlock>& blocks = present_.surfaces.at(joins).faces;
      const std::size_t own = whole_.surfaces.at(joins).faces.size();
      auto to =
          std::find_if(blocks.begin() + static_cast<std::ptrdiff_t>(own), blocks.end(),
                       [&](const mesh::ElementBlock& faces) {
                         return faces.shape == mesh::face_shape(block.shape) && faces.body == block.body;
                       });
      if (to == blocks.end()) {
        to = blocks.insert(to, mesh::ElementBlock{});
        to->shape = mesh::face_shape(block.shape);
        to->body = block.body;
      }
      to->nodes.insert(to->nodes.end(), nodes.begin(), nodes.end());
      to->input_element.push_back(block.input_element[as_size(side.element)]);
      if (counted) ++to->n_counted;
    }
}

}  // namespace solidus::linear
