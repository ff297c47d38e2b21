/// Overview of a case as the program has understood it, in a foundry engineer's numbers: the table of
/// `solidus check`, also in summary.json.
///
/// Volumes, areas and masses are those of the mesh as it is: in plane strain of one metre of thickness, in
/// axisymmetry of the whole revolution.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/shape.hpp"
#include "numbers/types.hpp"
#include "results/output/json_document.hpp"

namespace solidus::results {

struct BodyOverview {
  std::string name, material;
  mesh::Point low{}, high{};  ///< corners of the bounding box [m]
  double volume = 0;          ///< [m³]
  double mass = 0;            ///< [kg]
  double skin = 0;            ///< area of its boundary, faces shared with other bodies included [m²]
  double start_low = 0, start_high = 0;        ///< temperatures at the start [K]
  double shortest_edge = 0, longest_edge = 0;  ///< of its elements, between vertices [m]
  GlobalIndex nodes = 0, elements = 0;
  bool only_conducts = false;
  std::vector<std::string> stages;  ///< in which it is there; empty: all
};

/// A skin and what it faces.
struct SkinOverview {
  std::string name;                              ///< of the contact or condition
  std::string surface, body;                     ///< of the skin (of a contact: of the slave)
  std::string faces;                             ///< the surface, tool or surroundings on the other side
  double area = 0;                               ///< of the skin [m²]
  double paired = 0;                             ///< the part with a partner; without contact all of it [m²]
  std::optional<double> least_gap, largest_gap;  ///< of a contact at the start, negative: overlap [m]
  bool touches = false;                          ///< gaps and overlaps count as none
  std::string law;                               ///< "1000 W/m2/K, in the gap 420 to 600 W/m2/K"
};

/// Overview of a poured body, with the estimate of its freezing (check/freezing_estimate.hpp).
struct PourOverview {
  std::string body;
  double pouring = 0, liquidus = 0, solidus = 0;  ///< temperatures [K]
  double modulus = 0;                             ///< volume over cooled skin, V/A [m]
  double local_modulus = 0;                       ///< the same around its thickest place; 0: not known [m]
  double depth = 0;                               ///< of the node farthest from the cooled skin [m]
  double elements_across = 0;                     ///< between skin and centre, 2 depth / mean edge at most
  std::optional<double> biot;                     ///< h (V/A) / k of the metal at its solidus
  std::optional<double> fourier;                  ///< alpha t / (V/A)² at the end of the run
  std::optional<double> freezing_time;            ///< [s]
  std::string governed_by;                        ///< "the mould", "the interface", "the metal"
  double mould_reach = 0;   ///< sqrt(alpha t) of the mould in the freezing time [m]; 0: no mould
  std::string no_estimate;  ///< why there is no freezing time
  /// V/A that the freezing time goes by [m].
  double freezing_modulus() const { return local_modulus > 0 ? local_modulus : modulus; }
  /// t/(V/A)² of it [s/m²].
  double chvorinov() const { return freezing_time.value_or(0) / (freezing_modulus() * freezing_modulus()); }
};

struct EffortOverview {
  double steps = 0;
  bool steps_known = true;  ///< fixed steps; else estimated
  double seconds = 0;       ///< wall time
  double bytes = 0;         ///< memory of all processes
};

struct Overview {
  AnalysisKind kind = AnalysisKind::plane_strain;
  std::vector<BodyOverview> bodies;
  std::vector<SkinOverview> skins;
  std::optional<mesh::Point> gravity;  ///< [m/s²]; absent: no weight
  std::vector<PourOverview> pours;
  EffortOverview effort;
  /// Delay of displacements and stresses behind the temperatures of their time, if the scheme has one: the
  /// step [s]; zero: the step that is chosen.
  std::optional<double> lag;
  double end = 0;  ///< of the run [s]
  /// The steps by which temperatures lag where deformation takes up heat, in schemes that conduct before it
  /// does.
  double heat_lag = 0;
};

/// The table that `check` prints: aligned lines, each beginning with a line break and two blanks.
std::string text(const Overview& overview);
/// For summary.json, SI units with absolute temperatures.
Json json(const Overview& overview);

}  // namespace solidus::results
