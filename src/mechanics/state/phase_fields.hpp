/// Fractions of phase changes during a step, taken from the nodes to the quadrature points.
///
/// Where a change is isothermal the temperature alone does not tell how much is solid, the heat content of a
/// node does. So mechanics takes all fractions from the nodes, those of changes with a range too: one rule
/// for both, and one in which the volume that has frozen is that whose latent heat is gone (closed rule,
/// w_i = ∫N_i dV). With f_k,i the fraction of change k at node i, of the material of the body,
///
///   f_S = Σ_i N_i ½ (f_S,i^old + f_S,i),   e^pc − e^pc(Θ_0) = Σ_i N_i Σ_k (ΔV/V)_k [f_k,i − f_k(Θ_0,i)]
///
/// (2.65, 2.75). The strain of a step is that of its end. The solid fraction is the mean of the fractions
/// that the step before has ended with and that this one ends with: metal that freezes within a step
/// contracts while it freezes, not as the solid that it has become. Stiffness, viscosity, flow of melt and
/// pores of a step follow that mean, and metal is solid in a step if it was so at both ends. Only the thermal
/// contraction of a network of dendrites follows the mean over the temperatures of the step instead: metal
/// that completes an isothermal change within the step cools as a solid. Where the step ends the scheme says
/// (4.81): in the splits at Θ_n of the mechanical phase, in those that iterate within the step at Θ_{n+1}.
#pragma once

#include <span>
#include <vector>

#include "material/material.hpp"
#include "mechanics/state/body_fields.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// Phase fields of one body, [local node]; values at nodes of other bodies are without meaning.
struct PhaseFields {
  std::span<const double> solid_fraction;  ///< f_S,i of the step; empty: the material does not melt, f_S = 1
  std::span<const double> straining;       ///< e^pc_i − e^pc_i(Θ_0); empty: zero
  std::span<const double> freezing;        ///< (ΔV/V) Δf_S,i of freezing in the step; empty: zero
  /// The mean of f_S over the temperatures of the step, with which a network of dendrites contracts; empty as
  /// solid_fraction.
  std::span<const double> contracting;
};

/// Temperatures at which fractions are taken, [local node].
struct FractionPlace {
  std::span<const double> temperature;    ///< [K]
  std::span<const double> plateau_share;  ///< MechanicalPass::plateau_share
};

class NodalPhases {
 public:
  /// @param materials            one per body; kept by reference
  /// @param initial_temperature  Θ_0 [K], [local node]; there an isothermal change is molten
  /// Collective.
  NodalPhases(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
              std::span<const double> initial_temperature);

  /// f_S of the nodes, [local node][field of the body]; one where nothing melts. Empty where no body does.
  std::vector<double> solid_fraction(const FractionPlace& at) const;
  /// That of bodies that have just been poured, at Θ_0.
  const std::vector<double>& initial_solid_fraction() const { return initial_solid_fraction_; }
  /// The mean of the fractions at both ends of a step, of the same layout.
  /// @param before  MechanicalState::solid_fraction
  std::vector<double> mean_solid_fraction(std::span<const double> before, const FractionPlace& at) const;
  /// The fields in which bodies have their fractions.
  const BodyFields& fields() const { return fields_; }
  /// Evaluates the fields of the body of a mesh block at its nodes; they are valid until the next call.
  /// @param before  MechanicalState::solid_fraction; empty: the bodies stay as they are, at the end
  PhaseFields evaluate(std::size_t block, const FractionPlace& at, std::span<const double> before);
  std::size_t bytes() const;

 private:
  /// Data of a block whose material changes its phase.
  struct OfBlock {
    const material::Material* material = nullptr;  ///< null: nothing
    bool strains = false;                          ///< a change of it has a change of volume
    std::size_t field = 0;                         ///< of its body
    std::vector<Index> nodes;                      ///< of its elements, each once
    std::vector<double> initial_straining;         ///< e^pc(Θ_0), [nodes]
  };
  std::size_t place(std::size_t node, const OfBlock& of) const {
    return node * as_size(fields_.n_fields) + of.field;
  }

  std::size_t n_nodes_;
  BodyFields fields_;
  std::vector<OfBlock> blocks_;                 ///< [block of the mesh]
  std::vector<double> initial_solid_fraction_;  ///< at Θ_0, [local node][field]; empty: nothing melts
  std::vector<double> solid_fraction_, straining_, freezing_, contracting_;  ///< work, [local node]
};

}  // namespace solidus::mechanics
