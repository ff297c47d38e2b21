/// A force per volume that is the same in all elements, for tests of mixed kernels.
#pragma once

#include <array>
#include <vector>

#include "mechanics/elements/mixed_kernel.hpp"
#include "mechanics/solver/nodal_pressure.hpp"

namespace solidus::test {

/// @param force  [N/m³]
inline void set_weight(const mesh::Mesh& mesh, const mechanics::NodalPressure& pressure,
                       const std::array<double, 3>& force) {
  Index most = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) most = std::max(most, block.size());
  std::vector<double> of_elements;
  for (Index e = 0; e < most; ++e) of_elements.insert(of_elements.end(), force.begin(), force.end());
  for (mechanics::MixedKernel* kernel : pressure.kernels()) kernel->set_body_force(of_elements);
}

}  // namespace solidus::test
