/// The skins of bodies as flat faces, for measuring their places, normals and distances from each other. Rank
/// 0 only, as reading a mesh is. Curved faces count by their vertices.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// A face of an element that no other element of the body has.
struct SkinFace {
  Shape shape = Shape::tri3;
  std::vector<Index> nodes;  ///< in the element's order, outward
  std::vector<Point> corners;
  Point centre{}, normal{};  ///< normal: outward, of length one
  double area = 0;           ///< [m²]; of a line its length [m]
};

/// A face with its measures, of which only the places of its corners are known.
SkinFace face_through(std::vector<Point> corners);

/// The skin of a group of full dimension, in the order of its elements.
std::vector<SkinFace> skin_of(const RawMesh& mesh, const std::string& body);

/// The place of a face (line, triangle, quad) nearest to a point.
Point nearest_on_face(const SkinFace& face, const Point& point);

/// The mean length of the edges of faces; zero for none.
double mean_edge(const std::vector<SkinFace>& faces);

/// Faces by the cells of a grid, to find those near a point.
class SkinSearch {
 public:
  /// @param reach  how far from a point faces are looked for [m]; the faces must outlive this
  SkinSearch(const std::vector<SkinFace>& faces, double reach);
  struct Found {
    std::size_t face = 0;
    double distance = 0;  ///< [m]
  };
  /// The nearest face within reach that looks the other way: its normal and `normal` have a product below
  /// −`opposed`. Nothing where there is none.
  std::optional<Found> facing(const Point& point, const Point& normal, double opposed = 0.3) const;
  /// The nearest face within reach, whichever way it looks. Nothing where there is none.
  std::optional<Found> nearest(const Point& point) const;

 private:
  using Cell = std::array<long, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      constexpr std::hash<long> bits;  // cells left of or below the origin have negative numbers
      return bits(c[0]) * 73856093U ^ bits(c[1]) * 19349663U ^ bits(c[2]) * 83492791U;
    }
  };
  Cell cell(const Point& p) const;

  const std::vector<SkinFace>& faces_;
  double reach_, size_;
  std::unordered_map<Cell, std::vector<std::size_t>, Hash> cells_;
};

/// Points spread over a face, each standing for an equal part of its area.
std::vector<Point> sample_points(const SkinFace& face);

/// The area of a surface group; zero where the mesh has none of this name [m²].
double area_of(const RawMesh& mesh, const std::string& surface);

/// Adds a surface group of these faces. Throws InputError where the mesh has a group of this name.
/// @param source  for the message: the file or shape of the mesh
void add_surface(RawMesh& mesh, const std::string& name, const std::vector<const SkinFace*>& faces,
                 const std::string& source);

}  // namespace solidus::mesh
