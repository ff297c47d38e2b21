/// The discrete field around a line that takes heat out of a mesh (channel_line.hpp).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

/// Solves ∫∇N_i · ∇u dV = −taken_i at the nodes around those with taken_i ≠ 0 in the elements of a body; the
/// next nodes have the values of `far`, as have those on the skin of the body that give no heat. Conjugate
/// gradients. Collective.
/// @param taken  heat that is taken out, [owned node] [m], for a unit of it per length
/// Returns u, [local node], ghosts up to date; zero far away.
std::vector<double> line_excess(const mesh::Mesh& mesh, AnalysisKind kind, int body, bool closed,
                                std::span<const double> taken,
                                const std::function<double(const mesh::Point&)>& far);

}  // namespace solidus::heat
