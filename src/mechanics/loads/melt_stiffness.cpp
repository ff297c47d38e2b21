/// Height and section of each melting body, from which the material finds the modulus of its melt.
#include "mechanics/loads/melt_stiffness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mechanics/loads/section.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::mechanics {

namespace {

/// Extent of a body along a unit vector [m]. Collective.
double extent_along(const mesh::Mesh& mesh, int body, const std::array<double, 3>& direction) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != body) continue;
    for (const Index node : block.nodes) {
      const mesh::Point& x = mesh.x[as_size(node)];
      const double along = x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2];
      low = std::min(low, along);
      high = std::max(high, along);
    }
  }
  return parallel::global_max(high) + parallel::global_max(-low);
}

/// What a melt that turns presses on its wall with, per density: ½ ω² (r_1² − r_0²) = a H, H = r_1 − r_0 of
/// its body. Collective.
struct TurningHead {
  double acceleration = 0, extent = 0;  ///< a [m/s²], H [m]
};

TurningHead head_of_turning(const mesh::Mesh& mesh, int body, const Turning& turning) {
  if (turning.omega == 0) return {};
  double low = std::numeric_limits<double>::max(), high = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != body) continue;
    for (const Index node : block.nodes) {
      const double squared = turning.squared_radius(mesh.x[as_size(node)]);
      low = std::min(low, squared);
      high = std::max(high, squared);
    }
  }
  low = std::sqrt(parallel::global_min(low));
  high = std::sqrt(parallel::global_max(high));
  return {0.5 * turning.omega * turning.omega * (high + low), high - low};
}

}  // namespace

std::vector<material::MeltModulus> melt_moduli(const mesh::Mesh& mesh, AnalysisKind kind,
                                               const std::vector<material::Material>& materials,
                                               const linear::ActiveSet& active,
                                               const MechanicalConditions& conditions) {
  // The modulus of a melt is measured against the metallostatic head of its body along gravity or, where it
  // turns, away from the axis, or against the atmosphere without either.
  const std::array<double, 3>& gravity = conditions.gravity;
  const double g = std::hypot(gravity[0], gravity[1], gravity[2]);
  std::array<double, 3> direction{};
  for (std::size_t i = 0; i < 3 && g > 0; ++i) direction[i] = gravity[i] / g;
  std::vector<material::MeltModulus> melt(materials.size());
  // The section of a body is needed only if some material leaves its viscosity to the program.
  std::vector<double> section;
  for (std::size_t b = 0; b < materials.size(); ++b) {
    const auto body = static_cast<int>(b);
    if (!active.body(body) || !materials[b].mechanical() || !materials[b].chooses_viscosity()) continue;
    if (section.empty()) section = sections(mesh, kind, conditions, active);
    // Of weight and turning the one that presses more.
    double acceleration = g, extent = g > 0 ? extent_along(mesh, body, direction) : 0.0;
    const TurningHead turning = head_of_turning(mesh, body, conditions.turning);
    if (turning.acceleration * turning.extent > acceleration * extent) {
      acceleration = turning.acceleration;
      extent = turning.extent;
    }
    melt[b] = material::melt_modulus(materials[b], acceleration, extent, section[b]);
  }
  return melt;
}

}  // namespace solidus::mechanics
