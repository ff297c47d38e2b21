/// Groups of faces by rule: by their body, their direction and their place. Of any mesh. Rank 0 only.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// All that are given hold together.
struct FaceRule {
  std::string name = {};             ///< of the group that is made
  std::string owner = {};            ///< a body; empty: any
  std::optional<Point> normal = {};  ///< outward, of any length > 0
  double angle = 0;                  ///< between it and a face's normal, at most [rad]
  std::optional<Point> plane = {};   ///< a point of the plane in which faces lie [m], with `normal`
  std::optional<std::array<Point, 2>> box = {};  ///< corners; faces lie inside [m]
  std::optional<Point> nearest = {};  ///< [m]; of what the others leave the smooth part nearest to it
};

/// Makes the group of the faces of the bodies' skins for which the rule holds. Faces that two bodies share
/// belong to the skins of both; the first body's are taken.
/// Warns where the smooth part nearest to a place is a strip of a curved face in coarse elements, with the
/// share that was taken.
/// @param source  for messages
/// Throws InputError for a rule that holds for none.
void add_faces_by_rule(RawMesh& mesh, const std::vector<std::string>& bodies, const FaceRule& rule,
                       const std::string& source);

/// A smooth part of the skin of a body, up to edges where neighbours bend by more than an angle.
struct SkinPatch {
  std::string body;
  std::size_t faces = 0;
  double area = 0;                      ///< [m²]
  Point centre{}, normal{};             ///< means by area [m]; normal of length below one where it is curved
  Point low{}, high{};                  ///< corners of its box [m]
  std::vector<std::size_t> neighbours;  ///< patches of the same list across its edges
  std::vector<std::array<Point, 3>> triangles;  ///< of its faces, in three dimensions [m]
};

/// All patches of the bodies' skins, body by body, the largest first.
std::vector<SkinPatch> skin_patches(const RawMesh& mesh, const std::vector<std::string>& bodies,
                                    double angle);

/// The patches as a file of ParaView (legacy VTK, text): triangles with the number of their patch, as in the
/// table, and that of their body in the order of the list; lengths in m.
std::string to_vtk(const std::vector<SkinPatch>& patches);

/// The patches as a table; lengths in mm.
std::string to_text(const std::vector<SkinPatch>& patches);

}  // namespace solidus::mesh
