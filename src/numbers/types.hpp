/// Basic types: indices on one process and over all processes, the kinds of analysis, and physical constants.
#pragma once

#include <cstdint>

namespace solidus {

using Index = std::int32_t;        ///< counts and local numbers on one process
using GlobalIndex = std::int64_t;  ///< numbers over all processes

/// Kind of analysis: the meaning of the two or three coordinates of a mesh.
enum class AnalysisKind {
  plane_strain,  ///< x, y in the plane, thickness one metre
  axisymmetric,  ///< x = radius, y = axis; integrals run over the whole revolution (2π r)
  solid          ///< three-dimensional
};

/// Number of displacement components per node.
constexpr int displacement_components(AnalysisKind kind) {
  return kind == AnalysisKind::solid ? 3 : 2;
}

inline constexpr double k_zero_celsius = 273.15;              ///< [K]
inline constexpr double k_stefan_boltzmann = 5.670374419e-8;  ///< [W/(m² K⁴)], CODATA 2018

}  // namespace solidus
