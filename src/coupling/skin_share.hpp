/// How far the skins of castings are coherent where they lie on other bodies: what a step changes of it
/// bounds the step.
///
/// Metal lets go of its wall once its skin is coherent, and from then on its contraction opens a gap. A part
/// of the skin that becomes coherent within a step lets go at the start or at the end of it, so that the gap
/// lacks, or has too much of, what the metal contracts in half a step, and nothing brings that back. An error
/// of temperature does not see it: where an alloy freezes within a few kelvin, the skin is melt before the
/// step and solid behind it, and temperatures are right.
///
/// The share of a surface is the mean of min(c, 1) over its area, with the coherency c of the nodes
/// (coupling/coherency.hpp). It goes from zero to one while the skin forms, and has a limit with the mesh.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "coupling/coherency.hpp"
#include "mesh/mesh.hpp"

namespace solidus::coupling {

class SkinShare {
 public:
  /// @param surfaces  names of surfaces in contact, of which every process has all faces
  ///                  (mesh::Surface::replicated); those that cannot melt do not count
  SkinShare(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const std::string> surfaces,
            const Coherency& coherency);

  /// Whether a surface can melt. The same on every process.
  bool any() const { return !surfaces_.empty(); }
  /// The largest change of the share of a surface between two moments [1]. The same bits on every process.
  /// Local.
  /// @param before, after  coherency, [local node], ghosts up to date; empty: nothing melts
  double change(std::span<const double> before, std::span<const double> after) const;

 private:
  struct Part {
    Index node;
    double share;  ///< of the area of the surface that can melt
  };
  std::vector<std::vector<Part>> surfaces_;
};

}  // namespace solidus::coupling
