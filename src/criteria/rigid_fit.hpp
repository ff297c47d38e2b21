/// The displacement of a body without its best rigid-body motion: the remainder is distortion.
///
///   t, θ  minimise  ∫ |u − t − θ × (x − c)|² dV,   c the centre of volume
///   t = ∫ u dV / V,   I θ = ∫ (x − c) × u dV,   I = ∫ (|x − c|² 1 − (x − c) ⊗ (x − c)) dV
///
/// Rotations are small, as everywhere. In plane strain the rotation is that about z; an axisymmetric body
/// only moves along its axis. Integrals by nodal volumes (mesh::nodal_weights).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::criteria {

/// A small rigid motion: u = translation + rotation × (x − centre).
struct SmallMotion {
  mesh::Point centre{}, translation{}, rotation{};
  mesh::Point at(const mesh::Point& x) const;
};

class RigidFit {
 public:
  /// Collective. Keeps a reference to the mesh.
  RigidFit(const mesh::Mesh& mesh, AnalysisKind kind);
  /// The best fit of every body. Collective.
  /// @param displacement [local node][component] [m]
  std::vector<SmallMotion> fit(std::span<const double> displacement) const;

 private:
  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  struct OfBody {
    std::vector<Index> nodes;
    std::vector<double> volume;  ///< of each, of the elements that this process counts [m³]
    double total = 0;            ///< over all processes
    mesh::Point centre{};
    std::array<mesh::Point, 3> inverse_inertia{};
  };
  std::vector<OfBody> bodies_;
};

}  // namespace solidus::criteria
