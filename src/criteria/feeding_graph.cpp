/// Made once from the mesh: neighbours with their conductances, heights of the nodes' shares, and which
/// nodes are open or have a skin.
#include "criteria/feeding_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "mesh/block_geometry.hpp"
#include "mesh/body_faces.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

namespace solidus::criteria {

namespace {

double dot(const mesh::Point& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

mesh::Point middle_of(const mesh::Mesh& mesh, std::span<const Index> vertices) {
  mesh::Point middle{};
  for (const Index v : vertices)
    for (std::size_t i = 0; i < 3; ++i)
      middle[i] += mesh.x[as_size(v)][i] / static_cast<double>(vertices.size());
  return middle;
}

/// The area of a face times its outward normal, of its first vertices.
mesh::Point area_vector(const mesh::Mesh& mesh, std::span<const Index> vertices) {
  const auto x = [&](std::size_t k) { return mesh.x[as_size(vertices[k])]; };
  if (vertices.size() == 2) return {x(1)[1] - x(0)[1], x(0)[0] - x(1)[0], 0};
  const std::size_t last = vertices.size() - 1;
  mesh::Point a{}, b{};
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = vertices.size() == 4 ? x(2)[i] - x(0)[i] : x(1)[i] - x(0)[i];
    b[i] = vertices.size() == 4 ? x(3)[i] - x(1)[i] : x(last)[i] - x(0)[i];
  }
  return {(a[1] * b[2] - a[2] * b[1]) / 2, (a[2] * b[0] - a[0] * b[2]) / 2, (a[0] * b[1] - a[1] * b[0]) / 2};
}

/// The nodes of groups, [local node].
std::vector<char> nodes_of(const mesh::Mesh& mesh, const std::vector<std::string>& groups, const char* key) {
  std::vector<char> marked(mesh.x.size(), 0);
  for (const std::string& group : groups) {
    const auto nodes = mesh.node_sets.find(group);
    if (nodes == mesh.node_sets.end())
      throw InputError({}, std::string("feeding.") + key + ": the mesh has no group '" + group + "'");
    for (const Index node : nodes->second) marked[as_size(node)] = 1;
  }
  return marked;
}

}  // namespace

FeedingGraph::FeedingGraph(const mesh::Mesh& mesh, AnalysisKind kind, const FeedingOptions& options)
    : low_(mesh.x.size(), 0.0),
      high_(mesh.x.size(), 0.0),
      skin_(mesh.x.size(), 0),
      vented_(mesh.x.size(), 0) {
  connect(mesh, kind, options.bodies);
  measure(mesh, options);
  mark(mesh, options);
}

// Entries of all elements are listed by their first node, then those of the same pair are added up.
void FeedingGraph::connect(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<char>& bodies) {
  const auto owned = as_size(mesh.n_owned_nodes);
  std::vector<std::size_t> entries(owned + 1, 0);
  // Bodies that are not followed hold no melt that could flow.
  const auto each_block = [&](const auto& visit) {
    for (const mesh::ElementBlock& block : mesh.blocks)
      if (bodies[as_size(block.body)] != 0) visit(block);
  };
  // Count first, then fill: the entries of each own node over its elements.
  each_block([&](const mesh::ElementBlock& block) {
    const int n = mesh::node_count(block.shape);
    for (const Index node : block.nodes)
      if (node < mesh.n_owned_nodes) entries[as_size(node) + 1] += as_size(n - 1);
  });
  std::partial_sum(entries.begin(), entries.end(), entries.begin());
  neighbours_.resize(entries.back());
  std::vector<std::size_t> next(entries.begin(), entries.end() - 1);
  each_block([&](const mesh::ElementBlock& block) {
    const mesh::BlockGeometry g(
        mesh, block, kind,
        mesh::order(block.shape) == 1 ? mesh::nodal_rule(block.shape) : mesh::stiffness_rule(block.shape));
    const int n = g.n_nodes;
    std::vector<Lane> factor(as_size(n * n));
    // The entry of two nodes is that of the conduction matrix, -∫ ∇N_a·∇N_b dV, which is the flow between
    // them for a unit of pressure and permeability.
    for (Index batch = 0; batch < g.n_batches; ++batch) {
      std::fill(factor.begin(), factor.end(), Lane(0.0));
      for (int q = 0; q < g.n_points; ++q) {
        const Lane* gradients = g.gradients_at(batch, q);
        const Lane weight = g.weight_at(batch, q);
        for (int a = 0; a < n; ++a)
          for (int b = 0; b < n; ++b)
            for (int d = 0; d < g.dim; ++d)
              factor[as_size(a * n + b)] -= weight * gradients[a * g.dim + d] * gradients[b * g.dim + d];
      }
      // Lanes beyond the last element of a block are padding.
      for (Index lane = 0; lane < k_lanes && batch * k_lanes + lane < block.size(); ++lane) {
        const Index* nodes = block.element(batch * k_lanes + lane);
        for (int a = 0; a < n; ++a) {
          if (nodes[a] >= mesh.n_owned_nodes) continue;
          for (int b = 0; b < n; ++b)
            if (a != b)
              neighbours_[next[as_size(nodes[a])]++] = {
                  nodes[b], static_cast<float>(factor[as_size(a * n + b)][static_cast<int>(lane)])};
        }
      }
    }
  });
  // Entries of one pair are added up; negative sums would flow uphill and are left out.
  start_.assign(owned + 1, 0);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < owned; ++i) {
    start_[i] = kept;
    const auto first = neighbours_.begin() + static_cast<std::ptrdiff_t>(entries[i]),
               last = neighbours_.begin() + static_cast<std::ptrdiff_t>(entries[i + 1]);
    std::stable_sort(first, last, [](const Neighbour& a, const Neighbour& b) { return a.node < b.node; });
    // Entries of one pair are neighbours after sorting; the sum of both elements is kept in place.
    for (auto entry = first; entry != last; ++entry) {
      if (kept > start_[i] && neighbours_[kept - 1].node == entry->node)
        neighbours_[kept - 1].factor += entry->factor;
      else
        neighbours_[kept++] = *entry;
    }
    for (std::size_t k = start_[i]; k < kept; ++k)
      neighbours_[k].factor = std::max(neighbours_[k].factor, 0.0F);
  }
  start_[owned] = kept;
  neighbours_.resize(kept);
  neighbours_.shrink_to_fit();
}

void FeedingGraph::measure(const mesh::Mesh& mesh, const FeedingOptions& options) {
  // Low and high end of each node's share, widened by each of its elements.
  const Upward up = options.upward();
  for (std::size_t i = 0; i < mesh.x.size(); ++i) low_[i] = high_[i] = up.height(mesh.x[i]);
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (options.bodies[as_size(block.body)] == 0) continue;
    const auto n = as_size(mesh::node_count(block.shape));
    const auto n_vertices = as_size(mesh::vertex_count(block.shape));
    // The share of a node reaches half of the way to the lowest and highest vertex of its elements; of a
    // vertex of quadratic elements a quarter, as the node in the middle of the edge owns the rest.
    for (Index e = 0; e < block.size(); ++e) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      const std::span<const Index> nodes{block.element(e), n};
      for (const Index node : nodes.first(n_vertices)) {
        const double height = up.height(mesh.x[as_size(node)]);
        low = std::min(low, height);
        high = std::max(high, height);
      }
      for (std::size_t a = 0; a < n; ++a) {
        const auto i = as_size(nodes[a]);
        const double height = up.height(mesh.x[i]);
        const double part = n > n_vertices && a < n_vertices ? 0.25 : 0.5;
        low_[i] = std::min(low_[i], height - part * (height - low));
        high_[i] = std::max(high_[i], height + part * (high - height));
      }
    }
  }
}

// A face of the outside of all followed bodies. It is open where groups say so, or where it faces up and
// nothing else is there; it is skin where it is open or where heat leaves.
void FeedingGraph::mark(const mesh::Mesh& mesh, const FeedingOptions& options) {
  // Marks of the user's groups first, since they go before what geometry says.
  constexpr double k_upward = 0.5;  // of the normal along `up`
  const std::vector<char> vented = nodes_of(mesh, options.vented, "vented"),
                          covered = nodes_of(mesh, options.covered, "covered");
  const auto touched = mesh::body_face_keys(mesh, options.touched),
             cooled = mesh::body_face_keys(mesh, options.cooled);
  const Upward up = options.upward();
  const bool risers = std::ranges::find(options.risers, 1) != options.risers.end();
  const auto is_followed = [&](const mesh::BodyFace& face) {
    return options.bodies[as_size(face.body)] != 0;
  };
  mesh::each_body_face_at_owned(mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace> same) {
    if (!is_followed(face) || std::ranges::count_if(same, is_followed) > 1) return;
    // The area vector of a face points outwards; its part along `up` tells whether the face looks
    // up.
    const mesh::Point area = area_vector(mesh, face.vertices());
    const double size = std::sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    // Another body on the same face, or a contact with one, is a wall: neither air nor skin moves
    // there.
    const bool against_wall = same.size() > 1 || touched.contains(face.key);
    const bool upward = dot(area, up.direction(middle_of(mesh, face.vertices()))) > k_upward * size &&
                        !against_wall && (!risers || options.risers[as_size(face.body)] != 0);
    // A group marks a face only if all of its nodes are in it.
    const auto all = [&](const std::vector<char>& marked) {
      return std::ranges::all_of(face.vertices(), [&](Index node) { return marked[as_size(node)] != 0; });
    };
    const bool open = (options.vented.empty() ? upward : all(vented)) && !all(covered);
    const bool skin = open || against_wall || cooled.contains(face.key);
    // Marks of a face go to all of its nodes; a node may be on several faces.
    for (const Index node : face.all_nodes()) {
      if (skin) skin_[as_size(node)] = 1;
      if (open) vented_[as_size(node)] = 1;
    }
  });
  // A face may lie on one process only: its nodes' owners and ghosts learn of it here.
  const parallel::GhostExchange ghosts(mesh);
  std::vector<double> marks(2 * mesh.x.size());
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    marks[2 * i] = skin_[i];
    marks[2 * i + 1] = vented_[i];
  }
  ghosts.update(marks, 2);
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    skin_[i] = marks[2 * i] != 0;
    vented_[i] = marks[2 * i + 1] != 0;
  }
}

std::size_t FeedingGraph::bytes() const {
  return start_.capacity() * sizeof start_[0] + neighbours_.capacity() * sizeof neighbours_[0] +
         (low_.capacity() + high_.capacity()) * sizeof(double) + skin_.capacity() + vented_.capacity();
}

}  // namespace solidus::criteria
