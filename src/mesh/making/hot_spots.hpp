/// Finds the thickest places of a body: the largest spheres that lie in it. Rank 0 only.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

struct InscribedSphere {
  Point centre{};
  double radius = 0;  ///< [m]
};

/// The largest inscribed spheres of bodies that are one piece of metal, the largest first: each centre is a
/// local maximum of the distance to their common skin, and lies in none of the spheres before it. Faces that
/// the bodies share are no skin.
/// @param most  at most so many, none below half of the largest radius
/// @param on    where given, only spheres whose centres lie on this plane, the largest there
std::vector<InscribedSphere> inscribed_spheres(const RawMesh& mesh, const std::vector<std::string>& bodies,
                                               std::size_t most, std::optional<HalfSpace> on = {});

/// The thickness of walls of a body, from the smallest to the largest, each standing for the same share of
/// the area of its skin [m]; empty where no ray finds a wall.
std::vector<double> thickness_by_area(const RawMesh& mesh, const std::string& body);

/// Volume [m³] and area of the skin [m²] of a body, its centre of volume and its box.
struct BodyExtent {
  double volume = 0, area = 0;
  Point centre{}, low{}, high{};
};
BodyExtent extent_of(const RawMesh& mesh, const std::string& body);

/// Bodies as they are seen from above.
class ViewFromAbove {
 public:
  ViewFromAbove(const RawMesh& mesh, const std::vector<std::string>& bodies);
  /// The height at which a vertical line leaves the bodies for the last time [m]; the point's own where it
  /// meets no face above it.
  double top(const Point& point) const;
  /// The height at which a vertical line from a point in the bodies leaves them first [m]; below top() where
  /// a hollow lies above the point, the point's own where it meets no face above it.
  double first_exit(const Point& point) const;
  /// Heights at which a vertical line through a point meets the skin, in no order.
  std::vector<double> crossings(const Point& point) const;
  const std::vector<std::array<Point, 3>>& faces() const { return faces_; }

 private:
  std::vector<std::array<Point, 3>> faces_;  ///< triangles of their common skin
};

}  // namespace solidus::mesh
