/// Makes a mesh of parts and mould from the geometry of parts: a block of mould around them, risers on them,
/// chills, gating, half of them; sizes that follow the thickness of walls. Rank 0 only.
///
/// Bodies that touch share the faces between them, and so their nodes (the model splits them where there is
/// an interface). What is mould within closed cavities of the parts is a core.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

/// Sizes of the elements of a body. All in metres.
struct BodySize {
  std::string body;
  double size = 0, smallest = 0;
  double across = 2;    ///< elements through the thickness of a wall; 0: thickness does not count
  double growth = 0.4;  ///< of the size for each length away from smaller elements
};

struct MouldBlock {
  std::string name, core;         ///< of the groups; several cores are core_1, core_2, …
  std::array<double, 6> walls{};  ///< x lowest, x highest, y …, z … beyond the box around the parts [m]
};

/// A riser that stands along z, with a neck at its foot or to its side and with a sleeve. All in metres.
struct RiserCylinder {
  std::string name;                 ///< of the groups; that of the sleeve is NAME_sleeve
  Point foot{};                     ///< centre of its foot
  double diameter = 0, height = 0;  ///< the height with the neck
  /// The neck is so wide up to so high above the foot; as wide as the riser: none.
  double neck_diameter = 0, neck_height = 0;
  /// A point in the part to which a neck leads from the axis of the riser, at the point's height as far as
  /// the riser goes; then there is none at the foot.
  std::optional<Point> neck_to = {};
  double sleeve = 0;  ///< thickness of the sleeve around what is above the neck; 0: none
};

/// A box of which what lies outside of the parts is a chill.
struct ChillBlock {
  std::string name;
  Point low{}, high{};  ///< [m]
};

/// The way of the metal into a part: an upright sprue, a level runner and an ingate. Runner and ingate lie on
/// one floor and lead straight from the sprue to the part. All in metres.
struct GatingSystem {
  std::string name;  ///< of the groups
  Point gate{};      ///< middle of the end of the ingate, at the part or within it
  double gate_width = 0, gate_height = 0, gate_length = 0;
  double runner_width = 0, runner_height = 0;
  Point top{};                                 ///< middle of the top of the sprue
  double foot_diameter = 0, top_diameter = 0;  ///< of the sprue

  double floor() const { return gate[2] - 0.5 * gate_height; }
};

/// Half-space that is cut off: everything above `at` along an axis.
struct HalfSpace {
  int axis = 0;
  double at = 0;  ///< [m]
};

struct CastingGeometry {
  std::vector<BodySize> sizes;  ///< bodies without one take that of the first
  std::optional<MouldBlock> mould;
  std::vector<RiserCylinder> risers;
  std::vector<ChillBlock> chills;
  std::vector<GatingSystem> gatings;
  std::optional<HalfSpace> symmetry;
  /// Number of the way (meshing_ways.hpp), from zero: mesh_casting() tries them one after the other.
  int attempt = 0;
  /// The way that mesh_casting() takes first, and the only one where it gives a mesh.
  std::optional<int> only_way;
};

/// A geometry that no way of meshing helps, as it is or with what the case says of it: it has no solid, its
/// bodies overlap, the riser lies beyond the plane of symmetry. mesh_casting() tries no other way after it.
class UnusableGeometry : public InputError {
  using InputError::InputError;
};

/// Least quality (mesh/quality.hpp) of a mesh that is taken at once.
inline constexpr double k_sound_quality = 0.15;
/// Least quality of a mesh that is good enough not to try others with elements of less than 0.8 of the size,
/// which cost several times as much and seldom are better.
inline constexpr double k_usable_quality = 0.05;
/// Meshes a STEP, BREP, IGES or STL file, or what the skins of the bodies of a mesh enclose, in one way after
/// the other until every body has elements and the least quality is k_sound_quality, those that are much
/// finer only where the least quality of the others is below k_usable_quality; else takes the best of those
/// that gave a mesh, with a warning. The first way of those that succeeds is reported where it is not the
/// first of all. With `only_way` that way is taken where it gives a mesh. Each way is a reader process of its
/// own. Throws InputError with the complaints of each way where none gives a mesh.
/// @param enough  the least quality, 0 where any mesh will do
RawMesh mesh_casting(const MeshSource& source, CastingGeometry geometry, double enough = k_sound_quality);

}  // namespace solidus::mesh
