/// The metal around the deepest place of a casting, the skin that cools it there and the mould behind that
/// skin: what the place freezes by, where the casting as a whole is mostly thin walls elsewhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::check {

/// A part of the skin of a body: a named surface, or the faces that it shares with another body.
struct SkinPlace {
  std::string surface;                    ///< empty: shared faces
  std::optional<std::size_t> other = {};  ///< the body on the other side; absent: surroundings
};

/// Mould behind a part of the skin.
struct MouldLayer {
  double area = 0;    ///< of the skin [m²]
  double volume = 0;  ///< of the mould whose nearest skin that is [m³]
};

/// In plane strain per metre of thickness, in axisymmetry of the whole revolution.
struct LocalShape {
  double volume = 0;         ///< of the metal in the ball [m³]
  std::vector<double> area;  ///< [skin] its area in the ball [m²]
  std::vector<double> all;   ///< [skin] its whole area [m²]
  /// [skin] the same area by how much mould is behind it, the narrowest third first; empty where nothing of
  /// the other body was found.
  std::vector<std::vector<MouldLayer>> layers;
};

/// A ball of metal.
struct PlaceInMetal {
  mesh::Point centre{};
  double depth = 0;   ///< of its centre below the cooled skin, above zero [m]
  double radius = 0;  ///< [m]
  /// Length along the skin over which the mould behind it counts as one, as deep as heat goes into it [m].
  double spread = 0;
};

/// Measures what lies in a ball. Mould counts to six depths beyond, where the nearest skin lies in the ball,
/// so that a pin in a bore, a core and the tongue between two ribs have the volume that is there for them.
/// Collective; the same on every process.
LocalShape measure_around(const mesh::Mesh& mesh, AnalysisKind kind, std::size_t body,
                          const PlaceInMetal& place, const std::vector<SkinPlace>& skins);

}  // namespace solidus::check
