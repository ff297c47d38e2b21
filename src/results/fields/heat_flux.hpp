/// The heat flux q = −k(Θ) ∇Θ in elements (Fourier's law, monograph 2.61).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::results {

/// Means over the elements, [cell][dimension] [W/m²] (axisymmetric: radial, axial).
/// @param material_of  of a body
/// @param temperature  [local node] [K]
std::vector<double> element_heat_flux(const mesh::Mesh& mesh, AnalysisKind kind,
                                      const std::function<const material::Material&(int)>& material_of,
                                      std::span<const double> temperature);

/// D_cond = −q·∇Θ/Θ = k |∇Θ|²/Θ (2.9b), what conduction dissipates: means over the elements, [cell] [W/m³].
/// It is never negative. Parameters as above.
std::vector<double> element_conduction_dissipation(
    const mesh::Mesh& mesh, AnalysisKind kind,
    const std::function<const material::Material&(int)>& material_of, std::span<const double> temperature);

}  // namespace solidus::results
