/// A lattice of cells with some left out: nodes are made where a cell needs them, boundaries where a cell
/// has no neighbour.
#include "mesh/making/grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_set>

#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

using Offset = std::array<int, 3>;

// The simplices of a cell: two triangles (right-angled, so never obtuse) or Kuhn's six tetrahedra around the
// diagonal.
constexpr std::array<std::array<int, 3>, 2> k_triangles{{{0, 1, 2}, {0, 2, 3}}};
constexpr std::array<std::array<int, 4>, 6> k_tetrahedra{
    {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};
constexpr std::array<Offset, 8> k_vertex{
    {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}};

// Positions of an element's nodes on the lattice of half cells: vertices given, mid nodes halfway along their
// edges.
std::vector<Offset> with_mid_nodes(Shape shape, const std::vector<Offset>& vertices) {
  std::vector<Offset> nodes(as_size(node_count(shape)));
  std::copy(vertices.begin(), vertices.end(), nodes.begin());
  if (order(shape) == 1) return nodes;
  const int edges_per_face = dimension(shape) == 2 ? 1 : vertex_count(face_shape(shape));
  const int n_vertices = vertex_count(face_shape(shape));
  for (int f = 0; f < face_count(shape); ++f) {
    const auto local = face_nodes(shape, f);
    for (int e = 0; e < edges_per_face; ++e) {
      const Offset& p = nodes[as_size(local[as_size(e)])];
      const Offset& q = nodes[as_size(local[as_size((e + 1) % n_vertices)])];
      Offset& mid = nodes[as_size(local[as_size(n_vertices + e)])];
      for (std::size_t i = 0; i < 3; ++i) mid[i] = (p[i] + q[i]) / 2;
    }
  }
  return nodes;
}

// The elements of one cell as lattice offsets of their nodes.
std::vector<std::vector<Offset>> cell_pattern(Shape shape) {
  std::vector<std::vector<Offset>> pattern;
  // Each element of a cell by its corners, whose middles follow for quadratic shapes.
  const auto add = [&](auto first, auto last) {
    std::vector<Offset> vertices;
    for (auto i = first; i != last; ++i) vertices.push_back(k_vertex[as_size(*i)]);
    pattern.push_back(with_mid_nodes(shape, vertices));
  };
  if (shape == Shape::tri3 || shape == Shape::tri6) {
    for (const auto& t : k_triangles) add(t.begin(), t.end());
  } else if (shape == Shape::tet4 || shape == Shape::tet10) {
    for (const auto& t : k_tetrahedra) add(t.begin(), t.end());
  } else {
    std::vector<int> all(as_size(vertex_count(shape)));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    add(all.begin(), all.end());
  }
  return pattern;
}

class NumberedGrid {
 public:
  NumberedGrid(const Grid& grid, RawMesh& mesh) : grid_(grid), mesh_(mesh) {
    std::size_t size = 1;
    for (std::size_t d = 0; d < grid.axes.size(); ++d) {
      extent_[d] = 2 * static_cast<int>(grid.axes[d].size()) - 1;
      size *= as_size(extent_[d]);
    }
    node_.assign(size, -1);
  }

  Index node(const Offset& at) {
    // Nodes are made when the first element asks for one; odd positions are the middles of cells.
    Index& number =
        node_[(as_size(at[2]) * as_size(extent_[1]) + as_size(at[1])) * as_size(extent_[0]) + as_size(at[0])];
    if (number >= 0) return number;
    number = as_index(mesh_.x.size());
    Point x{};
    for (std::size_t d = 0; d < grid_.axes.size(); ++d) {
      const GridAxis& axis = grid_.axes[d];
      const auto i = as_size(at[d] / 2);
      x[d] = at[d] % 2 == 0 ? axis[i] : 0.5 * (axis[i] + axis[i + 1]);
    }
    mesh_.x.push_back(x);
    mesh_.input_node.push_back(static_cast<GlobalIndex>(mesh_.x.size()));
    return number;
  }

 private:
  const Grid& grid_;
  RawMesh& mesh_;
  std::array<int, 3> extent_{1, 1, 1};
  std::vector<Index> node_;
};

RawBlock& block_of(RawGroup& group, Shape shape) {
  for (RawBlock& b : group.blocks)
    if (b.shape == shape) return b;
  group.blocks.push_back({shape, {}, {}});
  return group.blocks.back();
}

GlobalIndex count_elements(const RawMesh& mesh) {
  GlobalIndex n = 0;
  for (const auto& [name, group] : mesh.groups)
    for (const RawBlock& b : group.blocks)
      n += static_cast<GlobalIndex>(b.nodes.size()) / node_count(b.shape);
  return n;
}

void face_centre_and_normal(const RawMesh& mesh, const std::vector<Index>& face, int n_vertices,
                            Point& centre, Point& normal) {
  centre = {};
  const auto x = [&](int a) { return mesh.x[as_size(face[as_size(a)])]; };
  for (int a = 0; a < n_vertices; ++a)
    for (std::size_t i = 0; i < 3; ++i) centre[i] += x(a)[i] / n_vertices;
  const Point o = x(0), p = x(1), q = n_vertices > 2 ? x(2) : Point{o[0], o[1], 1};
  Point s{}, t{};
  for (std::size_t i = 0; i < 3; ++i) {
    s[i] = p[i] - o[i];
    t[i] = q[i] - o[i];
  }
  normal = {s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& c : normal) c /= length;
}

/// Whether a cell exists.
bool exists(const Grid& grid, const std::array<int, 3>& cell) {
  for (std::size_t d = 0; d < grid.axes.size(); ++d)
    if (cell[d] < 0 || cell[d] + 1 >= static_cast<int>(grid.axes[d].size())) return false;
  return !grid.keep || grid.keep(cell);
}

/// Where a cell lies: it lacks a neighbour, is the neighbour of one that does, or neither.
enum class Layer : char { outermost, second, inner };

template <class F>
bool any_neighbour(const Grid& grid, std::array<int, 3> cell, const F& f) {
  for (std::size_t d = 0; d < grid.axes.size(); ++d)
    for (const int way : {-1, 1}) {
      cell[d] += way;
      const bool found = f(cell);
      cell[d] -= way;
      if (found) return true;
    }
  return false;
}

Layer layer_of(const Grid& grid, const std::array<int, 3>& cell) {
  const auto lacks_one = [&](const std::array<int, 3>& c) {
    return any_neighbour(grid, c, [&](const auto& other) { return !exists(grid, other); });
  };
  if (lacks_one(cell)) return Layer::outermost;
  return any_neighbour(grid, cell, lacks_one) ? Layer::second : Layer::inner;
}

/// Elements of a grid, cell by cell.
struct Cells {
  std::vector<Index> elements;  ///< [cell][element][node]
  std::vector<Layer> layer;     ///< of each cell
};

// Faces that only one element of the grid has. They belong to the outermost cells, whose other faces these
// and the second layer have twice.
void add_boundary(RawMesh& mesh, const Grid& grid, const Cells& cells) {
  const std::vector<Index>& elements = cells.elements;
  const std::size_t per_cell = elements.size() / std::max<std::size_t>(cells.layer.size(), 1);
  const int nn = node_count(grid.shape), n_vertices = vertex_count(face_shape(grid.shape));
  // A second element takes the face out again: the remaining faces are the boundary, and the set stays small
  // on the way.
  std::unordered_set<FaceKey, FaceKeyHash> alone;
  std::vector<Index> face;
  const auto collect = [&](std::size_t e, int f) {
    face.clear();
    for (const int a : face_nodes(grid.shape, f)) face.push_back(elements[e + as_size(a)]);
  };
  for (std::size_t e = 0; e < elements.size(); e += as_size(nn))
    for (int f = 0; f < face_count(grid.shape) && cells.layer[e / per_cell] != Layer::inner; ++f) {
      collect(e, f);
      const auto [place, first] = alone.insert(face_key(face.data(), n_vertices));
      if (!first) alone.erase(place);
    }
  std::vector<char> outside(mesh.x.size(), 0);  // vertices of these faces
  for (const FaceKey& key : alone)
    for (const Index vertex : key.vertices)
      if (vertex >= 0) outside[as_size(vertex)] = 1;
  const auto is_outside = [&](Index vertex) { return outside[as_size(vertex)] != 0; };
  GlobalIndex number = count_elements(mesh);
  for (std::size_t e = 0; e < elements.size(); e += as_size(nn))
    for (int f = 0; f < face_count(grid.shape) && cells.layer[e / per_cell] == Layer::outermost; ++f) {
      collect(e, f);
      if (!std::all_of(face.begin(), face.begin() + n_vertices, is_outside)) continue;
      if (!alone.contains(face_key(face.data(), n_vertices))) continue;
      Point centre, normal;
      face_centre_and_normal(mesh, face, n_vertices, centre, normal);
      const std::string name = grid.surface(centre, normal);
      if (name.empty()) continue;
      RawGroup& group = mesh.groups[name];
      group.dimension = mesh.dimension - 1;
      RawBlock& block = block_of(group, face_shape(grid.shape));
      block.nodes.insert(block.nodes.end(), face.begin(), face.end());
      block.input_element.push_back(++number);
    }
}

}  // namespace

GridAxis uniform_axis(double a, double b, int n) {
  GridAxis axis(as_size(n) + 1);
  for (int i = 0; i <= n; ++i) axis[as_size(i)] = i == n ? b : a + (b - a) * i / n;
  return axis;
}

GridAxis graded_axis(double a, double b, double first, double last) {
  const double length = b - a;
  // The mean of sizes in geometric progression from `first` to `last` is near their logarithmic mean.
  const double mean = std::abs(last - first) < 1e-9 * first ? first : (last - first) / std::log(last / first);
  const int n = std::max(1, static_cast<int>(std::lround(length / mean)));
  const double ratio = n == 1 ? 1 : std::pow(last / first, 1.0 / (n - 1));
  std::vector<double> at{0};
  double size = 1;
  for (int i = 0; i < n; ++i, size *= ratio) at.push_back(at.back() + size);
  GridAxis axis;
  for (const double s : at) axis.push_back(a + length * s / at.back());
  axis.back() = b;
  return axis;
}

void add_grid(RawMesh& mesh, const Grid& grid) {
  assert(static_cast<int>(grid.axes.size()) == dimension(grid.shape));
  mesh.dimension = dimension(grid.shape);
  NumberedGrid lattice(grid, mesh);
  const auto pattern = cell_pattern(grid.shape);
  // A grid of the plane is one cell deep.
  std::array<int, 3> n_cells{1, 1, 1};
  for (std::size_t d = 0; d < grid.axes.size(); ++d) n_cells[d] = static_cast<int>(grid.axes[d].size()) - 1;

  RawGroup& group = mesh.groups[grid.body];
  group.dimension = mesh.dimension;
  Cells cells;
  std::vector<Index>& elements = cells.elements;
  // Cells that the grid leaves out have no elements; for others the pattern gives the nodes.
  for (int k = 0; k < n_cells[2]; ++k)
    for (int j = 0; j < n_cells[1]; ++j)
      for (int i = 0; i < n_cells[0]; ++i) {
        if (!exists(grid, {i, j, k})) continue;
        if (grid.surface) cells.layer.push_back(layer_of(grid, {i, j, k}));
        for (const auto& element : pattern)
          for (const Offset& o : element)
            elements.push_back(lattice.node({2 * i + o[0], 2 * j + o[1], 2 * k + o[2]}));
      }
  // Elements are numbered on from those of grids before.
  GlobalIndex number = count_elements(mesh);
  RawBlock& block = block_of(group, grid.shape);
  block.nodes.insert(block.nodes.end(), elements.begin(), elements.end());
  const auto n = static_cast<GlobalIndex>(elements.size()) / node_count(grid.shape);
  for (GlobalIndex e = 0; e < n; ++e) block.input_element.push_back(++number);
  if (grid.surface) add_boundary(mesh, grid, cells);
}

}  // namespace solidus::mesh
