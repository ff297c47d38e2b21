/// Energy and entropy by which conduction has moved a point ahead of its deformation.
#pragma once

#include <vector>

#include "numbers/simd.hpp"

namespace solidus::mechanics {

/// Densities of entropy and energy of deformation and hardening.
struct StructuralDensities {
  Lane entropy;  ///< S [J/(m³ K)]
  Lane energy;   ///< E [J/m³]
};

/// What points are expected to take up in the deformation that follows, [block][batch][point]; empty blocks
/// have none (StructuralPoints::expect_expansion).
using StructuralLead = std::vector<PackVector<StructuralDensities>>;

}  // namespace solidus::mechanics
