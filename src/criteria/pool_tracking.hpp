/// Tracking of pools of melt: connected parts of the melt get pool numbers that persist from step to step.
#pragma once

#include <vector>

#include "criteria/pools.hpp"

namespace solidus::criteria {

/// A connected part of the melt.
struct MeltPart {
  double label = 0;                                   ///< ConnectedParts::label
  double volume = 0;                                  ///< [m³]
  double solid = 0;                                   ///< the solid in it [m³]
  bool whole = false;                                 ///< holds a whole element
  bool fed = false;                                   ///< holds a node of the feeders
  double temperature = -1, fraction = 1, number = 0;  ///< of its hottest node [K], 1, in the input
  mesh::Point where = {};                             ///< of that node
};
/// Volume that a part of the melt shares with a pool of the previous step.
struct Overlap {
  double label = 0;
  int pool = 0;
  double volume = 0;  ///< [m³]
};
/// The node of a pool that passed the limit last in this step.
struct LastNode {
  int pool = 0;
  double time = 0, number = 0, temperature = 0;
  mesh::Point where = {};
};

/// Everything that a step shows of the melt, over all processes, each list by rising labels or numbers.
struct Melt {
  std::vector<MeltPart> parts;
  std::vector<Overlap> overlaps;
  std::vector<LastNode> last;
};
/// Merges the parts of the melt that the processes have found; the result is the same on all. Collective.
Melt gathered(const Melt& own);

/// Brings the pools to the time of `melt`, and says the number of each part (zero: a crumb).
/// @param whole    volume of the bodies: parts whose volumes differ by less than 1e-9 of it are alike
/// @param feeders  whether there are any
std::vector<int> follow_pools(std::vector<Pool>& pools, const Melt& melt, double time, double whole,
                              bool feeders);

}  // namespace solidus::criteria
