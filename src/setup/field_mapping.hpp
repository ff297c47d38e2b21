/// Maps the temperature field of a file to the nodes of a body so that its enthalpy is kept.
#pragma once

#include <span>
#include <vector>

#include "cases/case_spec.hpp"
#include "input/place_spec.hpp"
#include "material/enthalpy.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

struct MappedEnthalpy {
  std::vector<double> values;            ///< h [J/m³], one a node asked for
  double source_volume = 0, volume = 0;  ///< [m³], of the file and of the body
  double share = 0;  ///< α of the correction, 0 to 1; negative toward the lowest enthalpy
  /// Share of the body's volume whose nodes lie farther outside of the file's grid than facets of curved
  /// walls do, and the largest distance to it [m].
  double outside = 0, farthest = 0;
  bool kept = false;  ///< whether the body has the file's enthalpy per volume; else its volume is another one
};

/// See initial_temperature.hpp.
/// @param nodes    local nodes of the body, ghosts too
/// @param weights  ∫ of the closed rule at each [m³], zero for ghosts
/// Collective: sums over processes. Throws InputError on every process.
MappedEnthalpy map_enthalpy(const PlaceSpec& place, AnalysisKind kind, const material::EnthalpyCurve& curve,
                            const mesh::Mesh& mesh, std::span<const Index> nodes,
                            std::span<const double> weights);

/// Weights of the closed rule at the nodes of a body [m³], [local node]; ghosts have a part of theirs.
std::vector<double> closed_weights(const mesh::Mesh& mesh, int body, AnalysisKind kind);

}  // namespace solidus::setup
