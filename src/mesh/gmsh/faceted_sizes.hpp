/// Bodies that skins of triangles enclose, and the sizes of elements that they ask for.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/closed_shells.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/meshing_ways.hpp"
#include "mesh/making/size_field.hpp"

namespace solidus::mesh {

/// One volume, which several shells may bound: the first from outside. The block of mould has none of its
/// own.
struct FacetedRegion {
  std::string body;
  std::vector<std::size_t> shells;  ///< numbers
  int volume = 0;                   ///< Gmsh's number
};

/// A shell of even depth bounds a body from outside, those in it from inside; odd ones bound cavities, which
/// are cores where there is a mould. The block of mould comes last.
/// Throws UnusableGeometry where a size is of a body that is not there. @param path  for the message
std::vector<FacetedRegion> faceted_regions(const ClosedShells& all, const CastingGeometry& geometry,
                                           const std::string& path);

/// Corners of a box.
struct ShellBox {
  Point low, high;
};

/// The box around all shells, and with the walls of the mould. @param unit  of the file [m]
ShellBox box_of_shells(const ClosedShells& all);
ShellBox box_with_mould(const ClosedShells& all, const CastingGeometry& geometry, double unit);

/// Sizes by the thickness of walls, in units of the file.
class FacetedSizes {
 public:
  /// @param unit  of the file [m]
  FacetedSizes(const ClosedShells& all, const std::vector<FacetedRegion>& regions,
               const CastingGeometry& geometry, const FacetedWay& way, double unit);

  /// The largest size in a body, and its growth for each length away from smaller elements.
  double largest(const std::string& body) const;
  double growth(const std::string& body) const;
  /// The size at a place on the skins, and in a body.
  double on_skins(const Point& x) const { return fields_.begin()->second.at(x); }
  double within(const std::string& body, const Point& x) const { return fields_.at(growth(body)).at(x); }
  /// The one size of each shell with which it has as many triangles as with the sizes that it asks for.
  std::vector<double> sizes_of_shells() const;
  /// @param element_order  of the mesh
  MeshingOutlook outlook(int element_order) const;

 private:
  const BodySize* size_of(const std::string& body) const;
  std::vector<SizeSample> sample_walls();
  double volume_of(const FacetedRegion& region) const;
  std::vector<SkinPiece> pieces_of(const std::vector<std::array<Point, 3>>& skin, double largest) const;

  const ClosedShells& all_;
  const std::vector<FacetedRegion>& regions_;
  const CastingGeometry& geometry_;
  const FacetedWay& way_;
  double unit_, coarse_;
  ShellBox box_;
  std::map<double, SizeField> fields_;                              ///< by growth
  std::map<std::string, std::vector<std::array<Point, 3>>> skins_;  ///< of bodies, outward, in small pieces
};

}  // namespace solidus::mesh
