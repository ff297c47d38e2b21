/// The end of a run as the start of a structural analysis: an input file for CalculiX or Abaqus with mesh,
/// sets, materials, temperatures and residual stress as initial conditions, and one static step without
/// further loading; or its temperatures over time as the load of an analysis.
///
/// The stress given is the one whose nodal forces ∫ Bᵀ σ dV are those of the run, so that it is in
/// equilibrium there too: where the run has a constant volumetric mode (6.2), the pressure of an element is
/// its mean.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linear/active_set.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::results {

enum class Dialect {
  calculix,  ///< stress at every integration point
  abaqus     ///< stress of the elements' means, with the equivalent plastic strain and flow curves
};

/// The temperatures of a moment.
struct TemperatureMoment {
  double time = 0;                  ///< [s]
  std::vector<double> temperature;  ///< [node] [K]
};

/// Everything of one process, which holds the whole mesh. SI units throughout, temperatures absolute.
struct StructuralDeck {
  std::string title;
  AnalysisKind kind = AnalysisKind::solid;
  const mesh::Mesh& mesh;
  const linear::ActiveSet& active;  ///< only active bodies are written
  std::span<const material::Material> materials;
  std::span<const double> displacement;  ///< [node][component] [m], added to the coordinates; empty: not
  std::span<const double> temperature;   ///< [node] [K]
  /// [block][element][point of mesh::stiffness_rule], components xx, yy, zz, xy, yz, xz (axisymmetric: rr,
  /// axial, hoop, r-axial) [Pa]
  std::vector<std::vector<std::vector<std::array<double, 6>>>> stress;
  std::vector<std::vector<double>> plastic_strain;  ///< equivalent, [block][element]; empty: elastic
  std::span<const char> fixed;                      ///< [node][component]: held where they are
  std::vector<Index> supports =
      {};  ///< held besides, for want of contact (deck_supports.hpp), as [node][component]
  std::vector<std::string> body_names = {};  ///< of the element sets and materials; empty: those of the mesh
  std::vector<std::vector<Index>> constraints;  ///< degrees of freedom that move as one
  std::vector<double> force;                    ///< of loads and contact, [node][component] [N]
  /// Two moments or more: the deck starts free of stress at the first, and has a step for each that follows,
  /// in which temperatures go there linearly. No stress, plastic strain or force is written then.
  std::vector<TemperatureMoment> history = {};
};

/// Throws std::invalid_argument for a shape that neither program has.
std::string structural_deck(const StructuralDeck& deck, Dialect dialect);

}  // namespace solidus::results
