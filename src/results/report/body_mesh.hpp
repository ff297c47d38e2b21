/// The bodies of a run's field files: their nodes in the order of space, their cells as simplices, their
/// skins.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesh/files/vtu_pieces.hpp"
#include "mesh/shape.hpp"

namespace solidus::results {

/// A .vtu, or the parts of all processes that a .pvtu lists.
class FieldFile {
 public:
  /// Throws InputError for a file that is missing, damaged or no unstructured grid.
  explicit FieldFile(const std::filesystem::path& path);

  struct Piece {
    const mesh::VtuFile* file;
    const boost::property_tree::ptree* tree;
    std::size_t n_points, n_cells;
  };
  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  void add(const std::filesystem::path& path);
  std::vector<std::unique_ptr<mesh::VtuFile>> files_;
  std::vector<Piece> pieces_;
};

/// One body. Nodes that bodies share are there once a body.
struct BodyMesh {
  int number = 0;                        ///< cell data `body`
  int corners = 4;                       ///< of a cell: 4, tetrahedra; 3, triangles
  std::vector<std::int32_t> input_node;  ///< [node] number in the mesh file
  std::vector<mesh::Point> x;            ///< [node] [m]
  std::vector<std::int32_t> cells;       ///< [cell][corner]
  std::vector<std::int32_t> triangles;   ///< of the skin, counter-clockwise from outside; in the plane none
};

/// The places in the body meshes of the numbers of a piece.
struct PieceMap {
  std::vector<double> node, element;  ///< numbers of the input, as the file has them: the same, the same map
  struct Target {
    std::int32_t point, body, node;  ///< point of the piece, index of the body, node of the body
  };
  std::vector<Target> targets;
  struct Cell {
    std::int32_t body;                ///< index
    double weight;                    ///< area or volume [m², m³]
    mesh::Point centre;               ///< [m]
    std::vector<std::int32_t> nodes;  ///< of the body
  };
  std::vector<Cell> cells;  ///< [cell of the piece]
};

/// The bodies of a run, from its first field file.
class Bodies {
 public:
  /// Throws InputError for files without areas or volumes, or without the data `node`, `element` and `body`.
  explicit Bodies(const FieldFile& file);

  const std::vector<BodyMesh>& all() const { return bodies_; }
  int dimension() const { return dimension_; }
  /// The maps of a file's pieces: kept ones where its numbering is the same as before.
  const std::vector<PieceMap>& maps(const FieldFile& file);

 private:
  std::vector<double> numbers(const FieldFile::Piece& piece, const char* section, const char* name,
                              std::size_t n) const;
  PieceMap make_map(const FieldFile::Piece& piece, std::vector<double> node,
                    std::vector<double> element) const;
  int body_index(double number) const;

  int dimension_ = 0;
  std::vector<BodyMesh> bodies_;
  std::vector<std::unordered_map<std::int64_t, std::int32_t>> local_;  ///< [body] input node to node
  std::vector<PieceMap> maps_;
};

/// Simplices of a cell by its own corners, with mid nodes: hexahedra as those that its first corner spans
/// with the faces opposite. Empty for shapes of lower dimension than two.
std::vector<std::vector<int>> simplices(mesh::Shape shape);
/// Triangles of a face.
std::vector<std::array<int, 3>> face_triangles(mesh::Shape face);

}  // namespace solidus::results
