/// The metal at a contact point, seen from the nodes of the two faces that meet there.
#pragma once

#include <span>

#include "numbers/types.hpp"

namespace solidus::contact {

/// How solid the nodes of the bodies are; empty spans: nothing melts.
struct Solidity {
  /// f_S/f_c of the nodes, the solid fraction over that at which metal is coherent, [local node]; one where
  /// nothing melts.
  std::span<const double> coherency{};
  /// The same of solid metal, 1/f_c, [local node]; one where nothing melts. Empty:
  /// metal is as solid as can be where it is coherent.
  std::span<const double> of_solid{};
};

struct Skin {
  bool molten = false;  ///< on either side it is below coherency in the mean of the nodes
  bool liquid = false;  ///< there no node of the face is coherent
  /// ⟨(f_S − f_c)/(1 − f_c)⟩ of the less solid side: zero up to coherency, one where all is solid or nothing
  /// melts.
  double strength = 1;
};

/// Nodes and means of nodes are melt below it: shape functions add up to one but for rounding.
inline constexpr double k_coherent = 1 - 1e-9;

/// The skin at a point.
/// @param nodes    of the slave's face, then of the master's, if there is one
/// @param share    of each, as in PointMotion
/// @param n_slave  how many of the nodes are the slave's
Skin skin_at(std::span<const Index> nodes, std::span<const double> share, std::size_t n_slave,
             const Solidity& of_nodes);

}  // namespace solidus::contact
