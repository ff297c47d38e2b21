/// The parts of a geometry file, measured: what `solidus new` chooses mould, sizes and riser by.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/files/file_unit.hpp"
#include "mesh/making/hot_spots.hpp"
#include "mesh/raw_mesh.hpp"
#include "new_case/new_case.hpp"
#include "setup/geometry_bodies.hpp"

namespace solidus::new_case {

/// Lengths in m.
struct PartMeasures {
  mesh::RawMesh mesh;                         ///< of the parts alone, coarse, or the elements of the file
  std::optional<mesh::LengthUnit> file_unit;  ///< that the file says itself
  std::vector<setup::GeometryBody> bodies;
  std::vector<std::string> metal;  ///< names of castings and risers
  bool has_mould = false;          ///< the file holds one
  bool meshed = false;             ///< the file holds the elements of parts and mould
  mesh::Point low{}, high{};       ///< corners of the box around all bodies
  double volume = 0, area = 0;     ///< of the metal
  std::vector<double> thickness;   ///< of its walls, by equal shares of the skin, rising; not empty
  double time_of_direct_ways = 0;  ///< that meshing it has left (mesh/making/kept_mesh.hpp) [s]
  std::vector<mesh::InscribedSphere> spheres;  ///< the largest that the metal holds, the largest first

  /// The thickness that a share of the skin has at most.
  double thickness_at(double share) const {
    return thickness[static_cast<std::size_t>(share * static_cast<double>(thickness.size() - 1))];
  }
  bool has_riser() const;
};

/// Reads the file, meshing what is no mesh. Throws InputError for a file that is no solid, and for options
/// that it cannot have.
PartMeasures measure_part(const NewCaseOptions& options);

}  // namespace solidus::new_case
