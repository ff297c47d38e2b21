/// Nodes are put in the order of space, so that neighbours compress well; cells become simplices and skins.
#include "results/report/body_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::results {

namespace fs = std::filesystem;
using boost::property_tree::ptree;
using mesh::Point;
using mesh::Shape;

FieldFile::FieldFile(const fs::path& path) {
  add(path);
}

void FieldFile::add(const fs::path& path) {
  files_.push_back(std::make_unique<mesh::VtuFile>(path));
  const mesh::VtuFile& file = *files_.back();
  if (file.type() == "PUnstructuredGrid" && files_.size() == 1) {
    for (const fs::path& each : mesh::grid_files(file, path)) add(each);
    return;
  }
  if (file.type() != "UnstructuredGrid")
    file.fail(fmt::format("the file holds a grid of the type '{}'", file.type()), "an UnstructuredGrid");
  for (const auto& [tag, child] : mesh::children(file, "UnstructuredGrid"))
    if (tag == "Piece") {
      const auto [n_points, n_cells] = mesh::piece_size(file, child);
      pieces_.push_back({&file, &child, n_points, n_cells});
    }
}

namespace {

/// The bits of a coordinate, spread so that two others fit between them.
std::uint64_t spread(std::uint64_t bits) {
  std::uint64_t out = 0;
  for (std::uint64_t k = 0; k < 21; ++k) out |= ((bits >> k) & 1U) << (3 * k);
  return out;
}

/// The order of nodes along Morton's curve: neighbours in the list are neighbours in space.
std::vector<std::int32_t> order_in_space(const std::vector<Point>& x) {
  // Coordinates are scaled to 21 bits each; their bits are interleaved to one key.
  Point low{}, high{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto by = [i](const Point& a, const Point& b) { return a[i] < b[i]; };
    const auto [least, most] = std::minmax_element(x.begin(), x.end(), by);
    if (!x.empty()) low[i] = (*least)[i], high[i] = (*most)[i];
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-300});
  std::vector<std::uint64_t> key(x.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i)
      key[n] |= spread(static_cast<std::uint64_t>((x[n][i] - low[i]) / size * 2097151.0)) << i;
  std::vector<std::int32_t> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&key](std::int32_t a, std::int32_t b) { return key[as_size(a)] < key[as_size(b)]; });
  return order;
}

/// Renumbers nodes along the curve and sorts the cells by their first node.
void sort_in_space(BodyMesh& body) {
  const std::vector<std::int32_t> order = order_in_space(body.x);
  std::vector<std::int32_t> place(order.size());
  BodyMesh sorted = body;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto from = as_size(order[i]);
    place[from] = static_cast<std::int32_t>(i);
    sorted.x[i] = body.x[from];
    sorted.input_node[i] = body.input_node[from];
  }
  for (std::int32_t& node : sorted.triangles) node = place[as_size(node)];
  const auto n = as_size(body.corners);
  std::vector<std::array<std::int32_t, 4>> cells(body.cells.size() / n);
  // Cells follow with their nodes renumbered.
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells[c] = {-1, -1, -1, -1};
    for (std::size_t k = 0; k < n; ++k) cells[c][k] = place[as_size(body.cells[n * c + k])];
    // Triangles of the plane keep their turn and begin with their least node; tetrahedra rise.
    if (n == 3)
      std::rotate(cells[c].begin(), std::min_element(cells[c].begin(), cells[c].begin() + 3),
                  cells[c].begin() + 3);
    else
      std::sort(cells[c].begin(), cells[c].end());
  }
  std::sort(cells.begin(), cells.end());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t k = 0; k < n; ++k) sorted.cells[n * c + k] = cells[c][k];
  body = std::move(sorted);
}

/// A face by its vertices in rising order, and its triangles.
struct Face {
  std::array<std::int32_t, 4> key;
  std::array<std::int32_t, 8> nodes;
  Shape shape;
};

void add_faces(Shape shape, const std::vector<std::int32_t>& nodes, std::vector<Face>& faces) {
  for (int f = 0; f < mesh::face_count(shape); ++f) {
    const std::span<const int> local = mesh::face_nodes(shape, f);
    Face face{{-1, -1, -1, -1}, {}, mesh::face_shape(shape)};
    for (std::size_t k = 0; k < local.size(); ++k) face.nodes[k] = nodes[as_size(local[k])];
    std::copy_n(face.nodes.begin(), mesh::vertex_count(face.shape), face.key.begin());
    std::sort(face.key.begin(), face.key.end());
    faces.push_back(face);
  }
}

/// Faces that one cell alone has.
void add_skin(std::vector<Face>& faces, BodyMesh& body) {
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].key == faces[i].key) ++end;
    if (end == i + 1)
      for (const auto& triangle : face_triangles(faces[i].shape))
        for (const int corner : triangle) body.triangles.push_back(faces[i].nodes[as_size(corner)]);
    i = end;
  }
}

double measure(const std::vector<Point>& x, const std::vector<int>& simplex,
               const std::vector<std::int32_t>& nodes) {
  std::array<Point, 3> edge{};
  const auto at = [&](std::size_t k) { return x[as_size(nodes[as_size(simplex[k])])]; };
  for (std::size_t k = 1; k < simplex.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) edge[k - 1][i] = at(k)[i] - at(0)[i];
  const auto& [a, b, c] = edge;
  const Point normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return simplex.size() == 3 ? std::hypot(normal[0], normal[1], normal[2]) / 2
                             : std::fabs(normal[0] * c[0] + normal[1] * c[1] + normal[2] * c[2]) / 6;
}

/// The parts of the cells of a piece, handed to `use(cell, shape, points of the piece)`.
template <class F>
void for_each_part(const FieldFile::Piece& piece, const mesh::CellTable& table, const F& use) {
  std::map<int, std::optional<mesh::CellParts>> known;
  // Every type of cell is divided once and looked up afterwards.
  for (std::size_t c = 0; c < piece.n_cells; ++c) {
    const auto [found, is_new] = known.try_emplace(table.types[c]);
    if (is_new) found->second = mesh::parts_of(table.types[c]);
    if (!found->second) piece.file->fail(fmt::format("cells of VTK's type {} are not read", table.types[c]));
    const std::size_t begin = c == 0 ? 0 : table.offsets[c - 1];
    for (const std::vector<int>& part : found->second->corners) {
      std::vector<std::int32_t> points;
      for (const int corner : part) {
        if (begin + as_size(corner) >= table.offsets[c])
          piece.file->fail(fmt::format("the file is damaged: cell {} has too few corners", c));
        points.push_back(table.corners[begin + as_size(corner)]);
      }
      use(c, found->second->shape, points);
    }
  }
}

/// What is read of a piece.
struct PieceData {
  std::vector<double> node, element, body, x;
  mesh::CellTable cells;
};

/// Adds a body for each number that pieces have, in the order of these numbers. Returns where each one is.
std::map<double, std::size_t> number_bodies(const std::vector<PieceData>& read, int dimension,
                                            std::vector<BodyMesh>& bodies) {
  std::map<double, std::size_t> index;
  for (const PieceData& r : read)
    for (const double number : r.body) index.try_emplace(number);
  for (auto& [number, at] : index) {
    at = bodies.size();
    bodies.push_back({.number = static_cast<int>(number),
                      .corners = dimension + 1,
                      .input_node = {},
                      .x = {},
                      .cells = {},
                      .triangles = {}});
  }
  return index;
}

}  // namespace

std::vector<double> Bodies::numbers(const FieldFile::Piece& piece, const char* section, const char* name,
                                    std::size_t n) const {
  const ptree* array = mesh::find_array(*piece.tree, section, name);
  if (array == nullptr)
    piece.file->fail(fmt::format("the file has no data '{}'", name), "a field file that Solidus wrote");
  return piece.file->numbers(*array, n);
}

int Bodies::body_index(double number) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (bodies_[b].number == number) return static_cast<int>(b);
  return -1;
}

Bodies::Bodies(const FieldFile& file) {
  // The first field file of a run gives the meshes of all moments. Its pieces, one a process, are read whole
  // first, because the dimension of the bodies has to be known.
  std::vector<PieceData> read;
  for (const FieldFile::Piece& piece : file.pieces()) {
    PieceData& r = read.emplace_back();
    r.node = numbers(piece, "PointData", "node", piece.n_points);
    r.element = numbers(piece, "CellData", "element", piece.n_cells);
    r.body = numbers(piece, "CellData", "body", piece.n_cells);
    r.x = piece.file->numbers(mesh::points_array(*piece.file, *piece.tree), 3 * piece.n_points);
    r.cells = mesh::read_cells(*piece.file, *piece.tree, piece.n_cells, piece.n_points);
    for_each_part(piece, r.cells, [&](std::size_t, Shape shape, const auto&) {
      dimension_ = std::max(dimension_, mesh::dimension(shape));
    });
  }
  if (dimension_ < 2)
    throw InputError({}, "the field files have no areas or volumes: there is nothing to show");

  const std::map<double, std::size_t> index = number_bodies(read, dimension_, bodies_);
  local_.resize(bodies_.size());
  std::vector<std::vector<Face>> faces(bodies_.size());
  // Nodes that several pieces have are one node, found by their number in the input. Elements are divided
  // into simplices, and faces are collected to find the skin.
  for (std::size_t p = 0; p < read.size(); ++p) {
    const PieceData& r = read[p];
    for_each_part(file.pieces()[p], r.cells,
                  [&](std::size_t c, Shape shape, std::vector<std::int32_t> nodes) {
                    if (mesh::dimension(shape) != dimension_) return;
                    const std::size_t b = index.at(r.body[c]);
                    BodyMesh& body = bodies_[b];
                    for (std::int32_t& node : nodes) {
                      const auto point = as_size(node);
                      const auto input = mesh::whole_number(r.node[point]);
                      const auto [found, is_new] =
                          local_[b].try_emplace(input, static_cast<std::int32_t>(body.x.size()));
                      if (is_new) {
                        body.x.push_back({r.x[3 * point], r.x[3 * point + 1], r.x[3 * point + 2]});
                        body.input_node.push_back(static_cast<std::int32_t>(input));
                      }
                      node = found->second;
                    }
                    for (const std::vector<int>& simplex : simplices(shape))
                      for (const int corner : simplex) body.cells.push_back(nodes[as_size(corner)]);
                    if (dimension_ == 3) add_faces(shape, nodes, faces[b]);
                  });
  }
  // The skin is what belongs to one element alone. Nodes are sorted in space, so that neighbours lie close in
  // the packed data.
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    add_skin(faces[b], bodies_[b]);
    sort_in_space(bodies_[b]);
    for (std::size_t n = 0; n < bodies_[b].input_node.size(); ++n)
      local_[b][bodies_[b].input_node[n]] = static_cast<std::int32_t>(n);
  }
}

const std::vector<PieceMap>& Bodies::maps(const FieldFile& file) {
  maps_.resize(file.pieces().size());
  for (std::size_t p = 0; p < maps_.size(); ++p) {
    const FieldFile::Piece& piece = file.pieces()[p];
    std::vector<double> node = numbers(piece, "PointData", "node", piece.n_points);
    std::vector<double> element = numbers(piece, "CellData", "element", piece.n_cells);
    if (node != maps_[p].node || element != maps_[p].element)
      maps_[p] = make_map(piece, std::move(node), std::move(element));
  }
  return maps_;
}

PieceMap Bodies::make_map(const FieldFile::Piece& piece, std::vector<double> node,
                          std::vector<double> element) const {
  // The map of a piece says where its values go: for each cell the body, nodes and weight, for each point the
  // bodies whose node it is.
  PieceMap map{std::move(node), std::move(element), {}, {}};
  const std::vector<double> body = numbers(piece, "CellData", "body", piece.n_cells);
  const mesh::CellTable table = mesh::read_cells(*piece.file, *piece.tree, piece.n_cells, piece.n_points);
  map.cells.resize(piece.n_cells);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  // body, point
  for_each_part(piece, table, [&](std::size_t c, Shape shape, std::vector<std::int32_t> nodes) {
    PieceMap::Cell& cell = map.cells[c];
    cell.body = mesh::dimension(shape) == dimension_ ? body_index(body[c]) : -1;
    if (cell.body < 0) return;
    const auto b = as_size(cell.body);
    for (std::int32_t& at : nodes) {
      pairs.emplace_back(cell.body, at);
      const auto found = local_[b].find(mesh::whole_number(map.node[as_size(at)]));
      if (found == local_[b].end())
        piece.file->fail("the mesh of the file is not that of the first field file of the run");
      at = found->second;
    }
    for (const std::vector<int>& simplex : simplices(shape))
      cell.weight += measure(bodies_[b].x, simplex, nodes);
    cell.nodes.insert(cell.nodes.end(), nodes.begin(), nodes.end());
  });
  // The place of a cell is the mean of its nodes, for extremes that are told with their place.
  for (PieceMap::Cell& cell : map.cells)
    for (const std::int32_t n : cell.nodes)
      for (std::size_t i = 0; i < 3; ++i)
        cell.centre[i] +=
            bodies_[as_size(cell.body)].x[as_size(n)][i] / static_cast<double>(cell.nodes.size());
  // A point that several bodies share is a target for each of them.
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [b, point] : pairs)
    map.targets.push_back({point, b, local_[as_size(b)].at(mesh::whole_number(map.node[as_size(point)]))});
  return map;
}

}  // namespace solidus::results
