/// The wall is found, its vertices are moved into the body, and the room behind it is filled with columns
/// of elements; middle nodes and groups follow at the end.
#include "mesh/making/wall_layers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "mesh/making/layer_displacement.hpp"
#include "mesh/making/layer_elements.hpp"
#include "mesh/making/wall_topology.hpp"
#include "mesh/quality.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// Thickness of all layers over the mean edge of the wall where none is asked for: the elements behind them,
/// which are as large as the edges, are pushed together to make room.
constexpr double k_of_edge = 0.8;

double length(const Point& p) {
  return std::hypot(p[0], p[1], p[2]);
}

/// The mean length of the edges of one surface of the wall.
double mean_edge(const RawMesh& mesh, const WallTopology& wall, int surface) {
  double sum = 0;
  std::size_t n = 0;
  for (const WallFace& face : wall.wall) {
    if (face.surface != surface) continue;
    for (int a = 0; a < (face.n_vertices == 2 ? 1 : face.n_vertices); ++a, ++n) {
      const Point &p = mesh.x[as_size(face.nodes[as_size(a)])],
                  &q = mesh.x[as_size(face.nodes[as_size((a + 1) % face.n_vertices)])];
      sum += length({p[0] - q[0], p[1] - q[1], p[2] - q[2]});
    }
  }
  return n > 0 ? sum / static_cast<double>(n) : 0;
}

/// Returns the depths at which the layers end, as shares of the thickness of all of them.
std::vector<double> shares(const WallLayers& layers) {
  std::vector<double> levels;
  double sum = 0, thickness = 1;
  for (int k = 0; k < layers.number; ++k, thickness *= layers.growth) levels.push_back(sum += thickness);
  for (double& level : levels) level /= sum;
  return levels;
}

class Builder {
 public:
  Builder(RawMesh& mesh, const WallLayers& layers, WallTopology wall, std::vector<Point> displacement,
          const std::vector<double>& levels)
      : mesh_(mesh),
        layers_(layers),
        wall_(std::move(wall)),
        u_(std::move(displacement)),
        levels_(levels),
        body_(mesh.groups.at(layers.body)) {}

  void build() {
    find_rim_groups();
    orient_faces();
    place_vertices();
    find_middles();
    move_surfaces();
    move_elements();
    add_layers();
    add_rims();
  }

 private:
  bool has_layers(Index vertex) const {
    return as_size(vertex) < first_.size() && first_[as_size(vertex)] >= 0;
  }
  /// The vertex of a column at the end of a layer; level 0 is the wall.
  Index vertex(Index wall, int level) const {
    return level == 0 || !has_layers(wall) ? wall : as_index(first_[as_size(wall)] + level - 1);
  }
  Index inner(Index wall) const { return vertex(wall, layers_.number); }
  LayerColumn column(Index wall, int level) const {
    return {wall, vertex(wall, level), vertex(wall, level + 1)};
  }
  Index add_node(const Point& x) {
    mesh_.x.push_back(x);
    mesh_.input_node.push_back(++last_node_);
    return as_index(mesh_.x.size()) - 1;
  }
  Point displaced(Index node, double share) const {
    Point x = mesh_.x[as_size(node)];
    for (std::size_t i = 0; i < 3; ++i) x[i] += share * u_[as_size(node)][i];
    return x;
  }

  /// The groups whose faces meet the wall at an edge of its rim (a vertex of a plane mesh).
  void find_rim_groups() {
    // Vertices of lines, or edges of faces, that one wall face alone has are the rim.
    std::map<Index, int> vertices;
    for (const WallFace& face : wall_.wall)
      if (face.n_vertices == 2)
        for (int a = 0; a < 2; ++a) ++vertices[face.nodes[as_size(a)]];
    for (const auto& [vertex, n] : vertices)
      if (n == 1) rim_[{vertex, vertex}];
    for (const auto& [edge, n] : wall_.wall_edges)
      if (n == 1) rim_[edge];
    // Groups with a face around the wall that has a rim edge are told apart by it.
    for (const auto& [name, group] : mesh_.groups) {
      if (group.dimension != mesh_.dimension - 1) continue;
      for (const RawBlock& block : group.blocks) {
        const int n = vertex_count(block.shape);
        for (std::size_t f = 0; f < block.nodes.size(); f += as_size(node_count(block.shape))) {
          const Index* face = block.nodes.data() + f;
          if (!is_around(face_key(face, n))) continue;
          for (int a = 0; a < n; ++a) {
            const Edge edge = n == 2 ? Edge{face[a], face[a]} : edge_key(face[a], face[(a + 1) % n]);
            const auto found = rim_.find(edge);
            if (found == rim_.end()) continue;
            if (found->second.empty() || found->second.back() != name) found->second.push_back(name);
          }
        }
      }
    }
  }
  /// A face of the body that touches the wall and is none of its faces.
  bool is_around(const FaceKey& key) const {
    return wall_.faces.contains(key) && !wall_.wall_faces.contains(key);
  }

  /// The mesh is not oriented yet: faces of mirrored elements turn, so that all are outward.
  void orient_faces() {
    for (WallFace& face : wall_.wall) {
      const FaceOwner& owner = wall_.faces.at(face_key(face.nodes.data(), face.n_vertices));
      const RawBlock& block = body_.blocks[as_size(owner.block)];
      face_shape_.push_back(block.shape);
      const Index* element =
          block.nodes.data() + static_cast<std::ptrdiff_t>(owner.element) * node_count(block.shape);
      face.nodes.resize(as_size(face.n_vertices));
      if (element_quality(mesh_, block.shape, element) < 0)
        std::reverse(face.nodes.begin(), face.nodes.end());
    }
  }

  void place_vertices() {
    last_node_ = *std::max_element(mesh_.input_node.begin(), mesh_.input_node.end());
    const std::size_t n = mesh_.x.size();
    first_.assign(n, -1);
    for (std::size_t i = 0; i < n; ++i) {
      if (wall_.on_wall[i] == 0 || length(u_[i]) == 0) continue;
      first_[i] = as_index(mesh_.x.size());
      for (const double share : levels_) {
        add_node(displaced(as_index(i), share));
        column_.push_back(as_index(i));
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      if (wall_.on_wall[i] == 0) mesh_.x[i] = displaced(as_index(i), 1);
  }

  /// The mid nodes of the body's edges, by the edges' vertices behind the layers, and those of the wall.
  void find_middles() {
    for (const RawBlock& block : body_.blocks) {
      if (order(block.shape) == 1) continue;
      const std::vector<LocalEdge> local = edges_of(block.shape);
      for (std::size_t e = 0; e < block.nodes.size(); e += as_size(node_count(block.shape)))
        for (const LocalEdge& l : local) {
          const auto node = [&](int a) { return block.nodes[e + as_size(a)]; };
          place_middle(node(l.a), node(l.b), node(l.middle));
        }
    }
  }
  void place_middle(Index a, Index b, Index middle) {
    const Edge behind = edge_key(inner(a), inner(b));
    if (middle_.contains(behind)) return;
    Point x = mesh_.x[as_size(middle)];
    for (std::size_t i = 0; i < 3; ++i) x[i] += 0.5 * (u_[as_size(a)][i] + u_[as_size(b)][i]);
    if (is_wall_edge(a, b))
      for (std::size_t i = 0; i < 3; ++i)
        bulge_[edge_key(a, b)][i] =
            mesh_.x[as_size(middle)][i] - 0.5 * (mesh_.x[as_size(a)][i] + mesh_.x[as_size(b)][i]);
    const bool stays_on_wall = is_wall_edge(a, b) && behind != edge_key(a, b);
    if (stays_on_wall) middle_[edge_key(a, b)] = middle;
    if (stays_on_wall)
      middle_[behind] = add_node(x);
    else
      mesh_.x[as_size(middle_[behind] = middle)] = x;
  }
  bool is_wall_edge(Index a, Index b) const {
    if (mesh_.dimension == 2) {
      const Index edge[2] = {a, b};
      return wall_.wall_faces.contains(face_key(edge, 2));
    }
    return wall_.wall_edges.contains(edge_key(a, b));
  }

  /// Replaces vertices of an element or face that is not of the wall by those behind the layers.
  void move_nodes(Shape shape, Index* nodes) {
    for (int a = 0; a < vertex_count(shape); ++a) nodes[a] = inner(nodes[a]);
    if (order(shape) == 2)
      for (const LocalEdge& l : edges_of(shape))
        nodes[l.middle] = middle_.at(edge_key(nodes[l.a], nodes[l.b]));
  }
  void move_surfaces() {
    for (auto& [name, group] : mesh_.groups) {
      if (group.dimension != mesh_.dimension - 1) continue;
      for (RawBlock& block : group.blocks)
        for (std::size_t f = 0; f < block.nodes.size(); f += as_size(node_count(block.shape)))
          if (is_around(face_key(block.nodes.data() + f, vertex_count(block.shape))))
            move_nodes(block.shape, block.nodes.data() + f);
    }
  }
  void move_elements() {
    for (RawBlock& block : body_.blocks)
      for (std::size_t e = 0; e < block.nodes.size(); e += as_size(node_count(block.shape)))
        move_nodes(block.shape, block.nodes.data() + e);
  }

  /// The wall's vertex that a column begins at.
  Index wall_of(Index vertex) const {
    return as_size(vertex) < first_.size() ? vertex : column_[as_size(vertex) - first_.size()];
  }
  Index middle_of(Index a, Index b) {
    const auto [found, is_new] = middle_.try_emplace(edge_key(a, b), -1);
    if (!is_new) return found->second;
    Point x{};
    for (std::size_t i = 0; i < 3; ++i) x[i] = 0.5 * (mesh_.x[as_size(a)][i] + mesh_.x[as_size(b)][i]);
    // Layers on a curved wall are curved as it is: they may be thinner than it bulges.
    if (const auto bulge = bulge_.find(edge_key(wall_of(a), wall_of(b))); bulge != bulge_.end())
      for (std::size_t i = 0; i < 3; ++i) x[i] += bulge->second[i];
    return found->second = add_node(x);
  }
  void append(RawGroup& group, Shape shape, std::vector<Index> nodes) {
    if (order(shape) == 2) {
      nodes.resize(as_size(node_count(shape)));
      for (const LocalEdge& l : edges_of(shape))
        nodes[as_size(l.middle)] = middle_of(nodes[as_size(l.a)], nodes[as_size(l.b)]);
    }
    auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                              [&](const RawBlock& b) { return b.shape == shape; });
    if (block == group.blocks.end()) block = group.blocks.insert(group.blocks.end(), RawBlock{shape, {}, {}});
    block->nodes.insert(block->nodes.end(), nodes.begin(), nodes.end());
    block->input_element.push_back(++last_element_);
  }
  void add_layers() {
    for (const auto& [name, group] : mesh_.groups)
      for (const RawBlock& block : group.blocks)
        for (const GlobalIndex number : block.input_element) last_element_ = std::max(last_element_, number);
    for (std::size_t f = 0; f < wall_.wall.size(); ++f)
      for (int level = 0; level < layers_.number; ++level) {
        std::vector<LayerColumn> columns;
        for (const Index wall : wall_.wall[f].nodes) columns.push_back(column(wall, level));
        for (std::vector<Index>& element : layer_elements(face_shape_[f], columns))
          append(body_, face_shape_[f], std::move(element));
      }
  }
  void add_rims() {
    const Shape shape = body_.blocks.front().shape;
    for (const auto& [edge, groups] : rim_)
      for (int level = 0; level < layers_.number; ++level) {
        std::vector<LayerColumn> columns{column(edge.first, level)};
        if (edge.second != edge.first) columns.push_back(column(edge.second, level));
        for (const std::vector<Index>& face : rim_faces(shape, columns))
          for (const std::string& name : groups) append(mesh_.groups.at(name), face_shape(shape), face);
      }
  }

  RawMesh& mesh_;
  const WallLayers& layers_;
  WallTopology wall_;
  std::vector<Point> u_;
  const std::vector<double>& levels_;
  RawGroup& body_;
  std::vector<Shape> face_shape_;                    ///< of the element of each face of the wall
  std::vector<Index> column_;                        ///< [new vertex]: the wall's vertex below it
  std::unordered_map<Edge, Point, EdgeHash> bulge_;  ///< of the wall's edges: mid node off the chord
  std::vector<Index> first_;                         ///< [old node]: the first node of its column; −1: none
  std::map<Edge, std::vector<std::string>> rim_;
  std::unordered_map<Edge, Index, EdgeHash> middle_;
  GlobalIndex last_node_ = 0, last_element_ = 0;
};

/// Quads and hexahedra cannot lose a layer at some of their vertices only.
void require_room(const RawMesh& mesh, const WallTopology& wall, const RawGroup& body,
                  const std::vector<Point>& u, const std::string& source,
                  const std::vector<WallLayers>& together) {
  for (const WallFace& face : wall.wall) {
    const FaceOwner& owner = wall.faces.at(face_key(face.nodes.data(), face.n_vertices));
    if (is_simplex(body.blocks[as_size(owner.block)].shape)) continue;
    for (int a = 0; a < face.n_vertices; ++a) {
      const Index node = face.nodes[as_size(a)];
      if (length(u[as_size(node)]) > 0) continue;
      throw InputError({source},
                       "there is no room for layers on '" + together[as_size(face.surface)].surface +
                           "' at node " + std::to_string(mesh.input_node[as_size(node)]),
                       "thinner layers, or triangles or tetrahedra, whose layers may end there");
    }
  }
}

/// How many vertices of a surface have layers, and how thick those are in the mean.
void count_columns(const WallTopology& wall, int surface, const std::vector<Point>& u,
                   WallLayerReport& report) {
  std::vector<Index> vertices;
  for (const WallFace& face : wall.wall)
    if (face.surface == surface)
      vertices.insert(vertices.end(), face.nodes.begin(), face.nodes.begin() + face.n_vertices);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const Index i : vertices) {
    ++(length(u[as_size(i)]) > 0 ? report.n_columns : report.n_bare);
    report.mean += length(u[as_size(i)]);
  }
  report.mean /= std::max<double>(1, static_cast<double>(vertices.size()));
}

}  // namespace

std::vector<WallLayerReport> add_wall_layers(RawMesh& mesh, const std::vector<WallLayers>& together,
                                             const std::string& source) {
  const WallLayers& layers = together.front();
  std::vector<std::string> surfaces;
  for (const WallLayers& one : together) {
    assert(one.body == layers.body && one.number == layers.number && one.growth == layers.growth);
    surfaces.push_back(one.surface);
  }
  // The wall is found on the body's own side; its topology decides where layers end.
  WallTopology wall = find_wall(mesh, surfaces, layers.body, source);
  const RawGroup& body = mesh.groups.at(layers.body);
  const std::vector<double> levels = shares(layers);
  // The whole thickness follows from the first layer or from the edges at the wall.
  std::vector<WallLayerReport> reports(together.size());
  std::vector<double> thickness;
  for (std::size_t s = 0; s < together.size(); ++s) {
    reports[s].whole = together[s].first ? *together[s].first / levels.front()
                                         : k_of_edge * mean_edge(mesh, wall, static_cast<int>(s));
    reports[s].first = reports[s].whole * levels.front();
    thickness.push_back(reports[s].whole);
  }
  // The mesh makes room before layers are put in.
  std::vector<Point> u = layer_displacement(mesh, body, wall, thickness, levels);
  require_room(mesh, wall, body, u, source, together);
  // Each report says how many columns have found room.
  for (std::size_t s = 0; s < together.size(); ++s) count_columns(wall, static_cast<int>(s), u, reports[s]);
  Builder(mesh, layers, std::move(wall), std::move(u), levels).build();
  return reports;
}

WallLayerReport add_wall_layers(RawMesh& mesh, const WallLayers& layers, const std::string& source) {
  return add_wall_layers(mesh, std::vector<WallLayers>{layers}, source).front();
}

}  // namespace solidus::mesh
