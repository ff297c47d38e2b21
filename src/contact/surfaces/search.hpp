/// Search for the face of a surface that a point meets, with Boost.Geometry's R-tree over the faces' bounding
/// boxes.
#pragma once

#include <memory>
#include <vector>

#include "contact/surfaces/projection.hpp"
#include "contact/surfaces/surface.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// A point of a surface.
struct SurfacePoint {
  Index face = -1;  ///< −1: nothing within reach
  Projection projection;
};

/// Looks in the configuration it was built in; build it again when the surface has moved. Results do not
/// depend on the order of queries or the number of processes; of equally near faces the one with the lowest
/// number is taken.
class FaceSearch {
 public:
  explicit FaceSearch(std::vector<Face> faces);
  ~FaceSearch();
  FaceSearch(const FaceSearch&) = delete;
  FaceSearch& operator=(const FaceSearch&) = delete;

  const Face& face(Index f) const { return faces_[as_size(f)]; }
  /// Faces whose bounding boxes meet the box, sorted.
  std::vector<Index> candidates(const Point& low, const Point& high) const;
  /// The closest point of the surface within `max_distance` (3.4). With a `facing` normal only faces that
  /// look against it count.
  SurfacePoint closest(const Point& p, double max_distance, const Point* facing = nullptr) const;
  /// The nearest point of the surface on the line p + s n, |s| <= max_distance, on faces that look against n.
  /// @param tolerance how far beyond the edge of a face, in its reference coordinates, still counts
  SurfacePoint along(const Point& p, const Point& n, double max_distance, double tolerance) const;
  /// The same among the given faces only.
  SurfacePoint along(const Point& p, const Point& n, double max_distance, double tolerance,
                     const std::vector<Index>& among) const;

 private:
  std::vector<Face> faces_;
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// The faces of a surface in the reference configuration.
std::vector<Face> reference_faces(const ContactSurface& surface);

}  // namespace solidus::contact
