/// Points of the isotherm are found between the nodes of elements near the surface and handed from node to
/// node, each of which keeps the nearest. A pass reads what the pass before has left, so that the result
/// depends neither on the order of elements nor on the number of processes.
#include "coupling/skin_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/surfaces/surface.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

namespace {

constexpr double k_far = std::numeric_limits<double>::infinity();

/// Elements are left out if all of their edges are at least this many least thicknesses long: as a rule their
/// shells are that thick before they are coherent.
constexpr double k_coarse = 4;

double distance(const mesh::Point& a, const mesh::Point& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square);
}

}  // namespace

SkinDepth::SkinDepth(const mesh::Mesh& mesh, std::span<const std::string> surfaces,
                     std::span<const char> melts, std::span<const double> length)
    : mesh_(mesh), has_ghosts_(parallel::any_process(as_index(mesh.x.size()) > mesh.n_owned_nodes)) {
  // Nodes of the surfaces that can melt are the first; ℓ of a node is that of its body.
  std::vector<double> of_node(mesh.x.size(), 0.0);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    if (melts[b] != 0)
      for (const Index node : mesh.blocks[b].nodes)
        of_node[as_size(node)] = std::max(of_node[as_size(node)], length[as_size(mesh.blocks[b].body)]);
  std::vector<char> known(mesh.x.size(), 0);
  for (const std::string& name : surfaces) {
    const contact::ContactSurface surface(mesh, name);
    for (Index f = 0; f < surface.n_faces(); ++f)
      for (const Index node : surface.nodes(f)) {
        if (known[as_size(node)] != 0 || of_node[as_size(node)] == 0) continue;
        known[as_size(node)] = 1;
        nodes_.push_back(node);
      }
  }
  on_surface_.assign(nodes_.size(), 1);
  for (const Index node : nodes_) length_.push_back(of_node[as_size(node)]);
  find_cells(melts, length);
  any_ = parallel::any_process(!cell_ends_.empty());
}

void SkinDepth::find_cells(std::span<const char> melts, std::span<const double> length) {
  // Every node learns of a node of the surface that is near: layer by layer, from the node of an element
  // that knows the nearest one.
  std::vector<Nearest> from(mesh_.x.size(), {k_far, {0, 0, 0}});
  for (const Index node : nodes_) from[as_size(node)] = {0, mesh_.x[as_size(node)]};
  const auto each_element = [&](const auto& visit) {
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const mesh::ElementBlock& block = mesh_.blocks[b];
      const double reach = length[as_size(block.body)];
      if (melts[b] == 0 || !(reach > 0)) continue;
      const std::size_t n = block.nodes.empty() ? 0 : block.nodes.size() / as_size(block.size());
      for (Index e = 0; e < block.size(); ++e) {
        const std::span<const Index> nodes(block.element(e), n);
        const Index nearest = *std::ranges::min_element(
            nodes, {}, [&](const Index node) { return from[as_size(node)].distance; });
        if (from[as_size(nearest)].distance < reach)
          visit(nodes, as_size(mesh::vertex_count(block.shape)), from[as_size(nearest)].point, reach);
      }
    }
  };
  for (bool more = true; parallel::any_process(more);) {
    more = false;
    std::vector<Nearest> next = from;
    each_element([&](std::span<const Index> nodes, std::size_t, const mesh::Point& point, double) {
      for (const Index node : nodes) {
        const double d = distance(mesh_.x[as_size(node)], point);
        if (!(d < next[as_size(node)].distance)) continue;
        next[as_size(node)] = {d, point};
        more = true;
      }
    });
    exchange({}, next);
    from = std::move(next);
  }
  const auto is_coarse = [&](std::span<const Index> vertices, double reach) {
    for (std::size_t a = 0; a < vertices.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (distance(mesh_.x[as_size(vertices[a])], mesh_.x[as_size(vertices[b])]) < k_coarse * reach)
          return false;
    return true;
  };
  // Elements with a node nearer than ℓ, whose other nodes get numbers behind those of the surfaces.
  constexpr Index k_none = -1;
  std::vector<Index> number(mesh_.x.size(), k_none);
  for (std::size_t k = 0; k < nodes_.size(); ++k) number[as_size(nodes_[k])] = as_index(k);
  each_element([&](std::span<const Index> nodes, std::size_t n_vertices, const mesh::Point&, double reach) {
    if (is_coarse(nodes.first(n_vertices), reach)) return;
    for (const Index node : nodes) {
      Index& k = number[as_size(node)];
      if (k == k_none) {
        k = as_index(nodes_.size());
        nodes_.push_back(node);
        length_.push_back(reach);
        on_surface_.push_back(0);
      }
      cell_nodes_.push_back(k);
    }
    cell_ends_.push_back(cell_nodes_.size());
  });
}

void SkinDepth::offer(Index node, const mesh::Point& point, std::vector<Nearest>& nearest) const {
  Nearest& best = nearest[as_size(node)];
  const double d = distance(mesh_.x[as_size(nodes_[as_size(node)])], point);
  if (!(d < length_[as_size(node)])) return;
  if (d < best.distance || (d == best.distance && point < best.point)) best = {d, point};
}

void SkinDepth::exchange(std::span<const Index> nodes, std::vector<Nearest>& nearest) const {
  if (!has_ghosts_) return;
  constexpr int k_components = 4;
  std::vector<double> values(k_components * mesh_.x.size(), k_far);
  const auto place = [&](std::size_t k) { return k_components * (nodes.empty() ? k : as_size(nodes[k])); };
  for (std::size_t k = 0; k < nearest.size(); ++k) {
    values[place(k)] = nearest[k].distance;
    for (std::size_t c = 0; c < 3; ++c) values[place(k) + 1 + c] = nearest[k].point[c];
  }
  parallel::GhostExchange(mesh_).update(values, k_components);
  for (std::size_t k = 0; k < nearest.size(); ++k) {
    nearest[k].distance = values[place(k)];
    for (std::size_t c = 0; c < 3; ++c) nearest[k].point[c] = values[place(k) + 1 + c];
  }
}

void SkinDepth::spread(std::vector<Nearest>& nearest) const {
  std::vector<Nearest> next = nearest;
  for (bool more = true; more;) {
    for (std::size_t e = 0; e < cell_ends_.size(); ++e) {
      const std::span<const Index> nodes = nodes_of(e);
      for (const Index other : nodes) {
        const Nearest& of_other = nearest[as_size(other)];
        if (!(of_other.distance < k_far)) continue;
        for (const Index node : nodes)
          if (node != other) offer(node, of_other.point, next);
      }
    }
    exchange(nodes_, next);
    bool changed = false;
    for (std::size_t k = 0; k < next.size(); ++k) changed = changed || next[k].point != nearest[k].point;
    more = parallel::any_process(changed);
    nearest = next;
  }
}

void SkinDepth::limit(std::span<const double> of_nodes, std::span<double> coherency) const {
  if (!any_) return;
  // Where metal is coherent at one node of an element and melt at another, the isotherm lies between them.
  std::vector<Nearest> nearest(nodes_.size(), {k_far, {0, 0, 0}});
  for (std::size_t e = 0; e < cell_ends_.size(); ++e) {
    const std::span<const Index> nodes = nodes_of(e);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const auto i = as_size(nodes_[as_size(nodes[a])]), j = as_size(nodes_[as_size(nodes[b])]);
        if ((of_nodes[i] >= 1) == (of_nodes[j] >= 1)) continue;
        const double t = (1 - of_nodes[i]) / (of_nodes[j] - of_nodes[i]);
        mesh::Point point;
        for (std::size_t c = 0; c < point.size(); ++c) point[c] = std::lerp(mesh_.x[i][c], mesh_.x[j][c], t);
        offer(nodes[a], point, nearest);
        offer(nodes[b], point, nearest);
      }
  }
  exchange(nodes_, nearest);
  spread(nearest);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (on_surface_[k] != 0 && nearest[k].distance < length_[k]) {
      double& c = coherency[as_size(nodes_[k])];
      c = std::min(c, nearest[k].distance / length_[k]);
    }
}

}  // namespace solidus::coupling
