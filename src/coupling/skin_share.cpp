/// Each surface that a casting shows to another body is a list of nodes with their share of its area.
#include "coupling/skin_share.hpp"

#include <algorithm>
#include <cmath>

#include "contact/surfaces/surface.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

SkinShare::SkinShare(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const std::string> surfaces,
                     const Coherency& coherency) {
  // A process may have a node of a replicated surface without its elements, which tell whether it melts: the
  // owner of the node says so.
  std::vector<double> melts(mesh.x.size());
  for (std::size_t i = 0; i < melts.size(); ++i) melts[i] = coherency.melts(as_index(i)) ? 1.0 : 0.0;
  parallel::GhostExchange(mesh).update(melts, 1);
  for (const std::string& name : surfaces) {
    // Each node of a face has an equal part of its area, in axisymmetry of what it sweeps. Faces come in the
    // same order on every process (ContactSurface), and so do the sums.
    const contact::ContactSurface surface(mesh, name);
    std::vector<Part> parts;
    double area = 0;
    for (Index f = 0; f < surface.n_faces(); ++f) {
      const contact::Face face = surface.reference_face(f);
      const std::span<const Index> nodes = surface.nodes(f);
      const double part = face.measure() / static_cast<double>(nodes.size());
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        if (melts[as_size(nodes[a])] == 0) continue;
        parts.push_back(
            {nodes[a], kind == AnalysisKind::axisymmetric ? part * std::abs(face.x[a][0]) : part});
        area += parts.back().share;
      }
    }
    if (!(area > 0)) continue;
    for (Part& part : parts) part.share /= area;
    surfaces_.push_back(std::move(parts));
  }
}

double SkinShare::change(std::span<const double> before, std::span<const double> after) const {
  double largest = 0;
  if (before.empty() || after.empty()) return largest;
  // The share counts up to full coherency; more solid changes nothing at a surface.
  const auto coherent = [](std::span<const double> of, Index node) {
    return std::min(of[as_size(node)], 1.0);
  };
  // For each surface the share that becomes coherent; the largest counts.
  for (const std::vector<Part>& surface : surfaces_) {
    double change = 0;
    for (const Part& part : surface)
      change += part.share * (coherent(after, part.node) - coherent(before, part.node));
    largest = std::max(largest, std::abs(change));
  }
  return largest;
}

}  // namespace solidus::coupling
