/// Fractions of phase changes during a step, taken from the nodes to the quadrature points.
///
/// Where a change is isothermal the temperature alone does not tell how much is solid, the heat content of a
/// node does. So mechanics takes all fractions from the nodes, those of changes with a range too: one rule
/// for both, and one in which the volume that has frozen is that whose latent heat is gone (closed rule,
/// w_i = ∫N_i dV). With f_k,i the fraction of change k at node i, of the material of the body,
///
///   f_S = Σ_i N_i f_S,i,   e^pc − e^pc(Θ_0) = Σ_i N_i Σ_k (ΔV/V)_k [f_k,i − f_k(Θ_0,i)] (2.65, 2.75)
///
/// Within a step they are those of t_n in every scheme (4.81).
#pragma once

#include <span>
#include <vector>

#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

/// Phase fields of one body, [local node]; values at nodes of other bodies are without meaning.
struct PhaseFields {
  std::span<const double> solid_fraction;  ///< f_S,i; empty: the material does not melt, f_S = 1
  std::span<const double> straining;       ///< e^pc_i − e^pc_i(Θ_0); empty: zero
};

class NodalPhases {
 public:
  /// @param materials            one per body; kept by reference
  /// @param initial_temperature  Θ_0 [K], [local node]; there an isothermal change is molten
  NodalPhases(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
              std::span<const double> initial_temperature);

  /// Evaluates the fields of the body of a mesh block at its nodes; they are valid until the next call.
  /// @param temperature, plateau_share  of MechanicalPass
  PhaseFields evaluate(std::size_t block, std::span<const double> temperature,
                       std::span<const double> plateau_share);
  std::size_t bytes() const;

 private:
  /// Data of a block whose material changes its phase.
  struct OfBlock {
    const material::Material* material = nullptr;  ///< null: nothing
    bool strains = false;                          ///< a change of it has a change of volume
    std::vector<Index> nodes;                      ///< of its elements, each once
    std::vector<double> initial_straining;         ///< e^pc(Θ_0), [nodes]
  };
  std::vector<OfBlock> blocks_;                     ///< [block of the mesh]
  std::vector<double> solid_fraction_, straining_;  ///< work, [local node]
};

}  // namespace solidus::mechanics
