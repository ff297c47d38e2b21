/// In which form the heat of deformation enters the heat balance (structural_heat.hpp), and what a step
/// changes.
#pragma once

namespace solidus::mechanics {

/// The equations are in structural_heat.hpp.
enum class StructuralForm { entropy, energy, literal, temperature };

/// Changes of the structural energy [J] and of the structural entropy [J/K].
struct StructuralChange {
  double energy = 0, entropy = 0;
  /// Sum of the magnitudes of what new phases and lines of tables have brought at fixed entropy and strain:
  /// the work p Δe^pc of a phase change and ½ k (Δe^pc)² [J].
  double transformed = 0;
  /// Σ_e |Σ_i h_i/Θ_i − Σ_q h_q/Θ_q| with h = Θ ΔS of the points q of an element, spread over its nodes i:
  /// the entropy that heat of deformation gains or loses on its way to nodes of another temperature [J/K].
  double spread = 0;
};

}  // namespace solidus::mechanics
