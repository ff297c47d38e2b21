/// The case file that `solidus new` writes: a draft as commented TOML.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/hot_spots.hpp"
#include "new_case/die_channels.hpp"

namespace solidus::new_case {

struct DraftBody {
  std::string name, group, material, comment;
  cases::Role role = cases::Role::casting;
  double start = 20;       ///< [°C]
  bool heat_only = false;  ///< physics = "heat", though the material has elastic properties
};

struct DraftMould {
  std::string name;
  std::array<double, 6> walls{};  ///< [m]
};

/// An investment shell, cut out of the mould's block.
struct DraftShell {
  std::string name = "shell";
  double thickness = 0;  ///< [m]
};

/// Shots in a die: the casting freezes, leaves, and the next one comes.
struct DraftShots {
  int number = 0;
  double pour = 0, solidify = 0, open = 0, eject = 0, spray = 0, close = 0;  ///< durations [s]
  double spray_film = 0;                                                     ///< [W/(m² K)]
  std::string spray_source;
  double cooling = 0;  ///< film outside of the die that keeps its mean temperature [W/(m² K)]; 0: unknown

  double cycle() const { return pour + solidify + open + eject + spray + close; }
};

/// A riser ([[mesh.riser]]); lengths in m.
struct DraftRiser {
  std::string name = "riser";
  mesh::Point foot{};
  double diameter = 0, height = 0;
  double neck_diameter = 0;                  ///< 0: no neck
  double neck_height = 0;                    ///< above the foot, where the sleeve begins, too
  std::optional<mesh::Point> neck_to = {};   ///< of a riser next to the part
  double sleeve = 0;                         ///< thickness; 0: none
  std::optional<mesh::Point> hot_spot = {};  ///< that it was chosen for
  double modulus = 0;                        ///< of the hot spot
  /// Thickness of the mould between the thickest place and the metal above it, on which the riser stands
  /// [m]; none where metal leads straight up.
  std::optional<double> hollow = {};
};

/// A chill ([[mesh.chill]]), between two corners [m].
struct DraftChill {
  std::string name;
  mesh::Point lowest{}, highest{};
};

/// Layers of thin elements of a body on one of its surfaces.
struct DraftLayers {
  std::string name, surface, body;  ///< the body by its group of the mesh
  int number = 0;
  double growth = 1, first = 0;  ///< thickness of the one on the surface [m]
  bool operator==(const DraftLayers&) const = default;
};

struct DraftSymmetry {
  int axis = 0;
  double at = 0;  ///< [m]
};

/// How the mould is filled, [filling].
struct DraftFilling {
  std::optional<mesh::Point> gate = {};  ///< [m]; none: the program chooses
};

/// Draft of a new case, from measured and chosen values; SI but for temperatures in °C.
struct Draft {
  std::filesystem::path folder, geometry;
  std::string unit, process, alloy, law;
  bool coupled = true;  ///< the alloy has elastic properties
  bool meshed = false;  ///< the file holds the elements of parts and mould
  int way = 0;          ///< of meshing, from one, where it is written into the case; 0: it is not
  double pouring = 0, liquidus = 0, superheat = 0;
  double size = 0, smallest = 0, mould_size = 0;
  std::vector<DraftBody> bodies;
  std::optional<DraftMould> mould;
  std::optional<DraftShell> shell;
  std::vector<DraftRiser> risers;
  std::vector<mesh::GatingSystem> gatings;
  std::vector<DraftChill> chills;
  std::vector<std::string> riser_notes;  ///< on places that no riser feeds
  std::optional<DraftSymmetry> symmetry;
  std::vector<DraftLayers> layers;
  std::vector<std::string> films, symmetric;  ///< bodies with skins in air, in the plane of symmetry
  double film = 0;                            ///< [W/(m² K)]
  std::string film_source;
  std::vector<mesh::InscribedSphere> hot_spots;
  double end = 0, step = 0, every = 0;  ///< latest end, first step, between outputs [s]
  std::optional<DraftShots> shots;
  std::optional<DraftFilling> filling;
  std::vector<DieChannel> channels;
  std::vector<std::string> cavity;  ///< surfaces of the die that are free when the casting has left
};

/// Whether the drawing of a body has channels, which then take the heat that else a film on its outside does.
bool has_channels(const Draft& draft, const std::string& body);

std::string case_text(const Draft& draft);

}  // namespace solidus::new_case
