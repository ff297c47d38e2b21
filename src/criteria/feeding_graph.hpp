/// The nodes of a casting as rooms that hold metal: what lies next to what, how high, and what is open.
///
/// A node stands for the part of the casting around it, from half way to the lowest node next to it up to
/// half way to the highest. Melt flows between nodes that an element has both, through
///
///   g_ij = max(0, −∫ ∇N_i · ∇N_j dV)   [m], over dt and mobility the flow per pressure
///
/// with the rule of the nodes, so that no flow goes against its pressure whatever the shape of elements.
#pragma once

#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "criteria/gas_law.hpp"
#include "criteria/upward.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::criteria {

/// What of the skin of a casting is open to the atmosphere and what melt can draw in. Where neither a body
/// nor a contact nor a condition of heat is, a plane of symmetry is taken for it: melt draws nothing in
/// there.
struct FeedingOptions {
  std::vector<char> bodies = {};      ///< [body] that are followed
  std::vector<char> risers = {};      ///< [body] whose skin is open where it faces up; none: of all followed
  std::array<double, 3> up{0, 1, 0};  ///< of length one
  std::optional<AxisOfTurning> turning = {};  ///< what is cast turns about it, and melt feeds away from it
  std::vector<std::string> vented = {};       ///< groups of the mesh that are open; empty: what faces up
  std::vector<std::string> covered = {};      ///< groups of the mesh that are not open
  double mould_rigidity = 1;                  ///< share of the expansion of graphite that feeds
  /// The length by which graphite moves the wall of the mould at most [m], and the skin of each body that has
  /// such a wall [body] [m²], in two dimensions as volumes; no skins: no limit.
  double wall_movement = 0;
  std::vector<double> walled = {};
  GasOptions gas = {};
  std::set<std::string> touched = {};  ///< surfaces in contact with a mould
  std::set<std::string> cooled = {};   ///< surfaces with a condition of heat
  Upward upward() const { return {up, turning}; }
};

class FeedingGraph {
 public:
  /// Throws InputError for a group that the mesh has not. Collective.
  FeedingGraph(const mesh::Mesh& mesh, AnalysisKind kind, const FeedingOptions& options);

  struct Neighbour {
    Index node;    ///< local
    float factor;  ///< g_ij [m]
  };
  std::span<const Neighbour> around(Index owned) const {
    const auto i = as_size(owned);
    return {neighbours_.data() + start_[i], neighbours_.data() + start_[i + 1]};
  }
  double low(std::size_t node) const { return low_[node]; }    ///< [m], of an owned node
  double high(std::size_t node) const { return high_[node]; }  ///< [m]
  bool skin(std::size_t node) const { return skin_[node] != 0; }
  bool vented(std::size_t node) const { return vented_[node] != 0; }
  std::size_t bytes() const;

 private:
  void connect(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<char>& bodies);
  void measure(const mesh::Mesh& mesh, const FeedingOptions& options);
  void mark(const mesh::Mesh& mesh, const FeedingOptions& options);

  std::vector<std::size_t> start_;  ///< [owned node], one more at the end
  std::vector<Neighbour> neighbours_;
  std::vector<double> low_, high_;   ///< [local node], exact for owned ones
  std::vector<char> skin_, vented_;  ///< [local node]
};

}  // namespace solidus::criteria
