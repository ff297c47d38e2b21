/// Sizes of elements that the parts of a casting ask for: by the thickness of their walls, and no larger than
/// their narrow faces and short curves. In the reader's process, while Gmsh has the geometry open.
#pragma once

#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/gmsh/casting_parts.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/size_field.hpp"

namespace solidus::mesh {

/// The asked sizes of a body, or those of the first body that has any; null where none are asked for.
const BodySize* size_of(const CastingGeometry& geometry, const std::string& body);

class CastingSizes {
 public:
  /// @param scale  of all sizes
  /// @param unit   of the file [m]
  /// @param details  narrow faces and short curves count
  CastingSizes(const std::vector<BodyVolumes>& parts, const CastingGeometry& geometry, double scale,
               double unit, bool details);

  /// The largest size of an entity by dimension and number, the least of the bodies that it belongs to, in
  /// units of the file.
  const std::map<std::pair<int, int>, double>& limits() const { return limit_; }
  /// Growth of the size away from smaller elements, by volume.
  const std::map<int, double>& growth() const { return growth_; }
  /// Measures the thickness of the walls, narrow faces and short curves on a first mesh of the surfaces,
  /// which Gmsh holds.
  std::vector<SizeSample> samples();
  /// The outlook on the mesh, after samples().
  /// @param field  of the samples: the size on all surfaces
  MeshingOutlook outlook(const SizeField& field, int element_order) const;

 private:
  void limit_entities();
  std::vector<std::array<Point, 3>> skin_of(const BodyVolumes& part) const;
  void read_nodes();
  void sample_narrow_faces(std::vector<SizeSample>& all) const;
  void sample_short_curves(std::vector<SizeSample>& all) const;

  const std::vector<BodyVolumes>& parts_;
  const CastingGeometry& geometry_;
  double scale_, unit_;
  bool details_;
  std::map<std::pair<int, int>, double> limit_;
  std::map<int, double> growth_;
  std::unordered_map<std::size_t, Point> x_;  ///< of the first mesh, by number
};

}  // namespace solidus::mesh
