/// The state of feeding around a node, as a row of the record's column "metal".
#pragma once

#include <cstddef>
#include <span>

#include "criteria/metal_volume.hpp"

namespace solidus::criteria {

/// Numbers of a row, as shares of the first where they have no unit.
enum FeedingNumber : std::size_t {
  k_room,     ///< volume of the casting around the node [m³]; zero: none
  k_metal,    ///< metal, by its volume as melt at the reference temperature
  k_thermal,  ///< θ and φ of that metal (metal_volume.hpp)
  k_phase,
  k_drained,   ///< how far its melt has sunk: zero at the top of the node, one at its bottom
  k_pipe,      ///< emptied, open to the atmosphere
  k_sink,      ///< emptied behind a skin that was drawn in
  k_cavity,    ///< emptied inside
  k_pores,     ///< between the dendrites
  k_gas,       ///< gas pores (gas_law.hpp)
  k_wall,      ///< room that the wall of the mould has given way to
  k_freezing,  ///< time since the metal began to freeze [s]
  k_pressure,  ///< of the melt in mush, without its weight, from that of the pools on [Pa]
  k_poured,    ///< metal as it was poured, as k_metal
  k_feeding_numbers
};

/// Rows [node][number] of a column.
class FeedingRows {
 public:
  explicit FeedingRows(std::span<double> values) : values_(values) {}
  double& operator()(std::size_t node, FeedingNumber number) const {
    return values_[node * k_feeding_numbers + number];
  }
  double emptied(std::size_t node) const {
    return (*this)(node, k_pipe) + (*this)(node, k_sink) + (*this)(node, k_cavity);
  }
  /// The share of the room that metal should fill.
  double fill(std::size_t node) const {
    return 1 - emptied(node) - (*this)(node, k_pores) - (*this)(node, k_gas) + (*this)(node, k_wall);
  }

 private:
  std::span<double> values_;
};

/// What a step asks of a node.
struct FeedingDemand {
  double solid_before = 1, solid_after = 1;  ///< solid fractions
  double mobile = 0;                         ///< share that moves with the melt, mean of the step
  VolumeParts before, fed, after;  ///< at the start, until which melt feeds it, at the end of the step
  bool present = false;            ///< its bodies have not left
  double metal = 0;                ///< that it needs to stay full, as FeedingNumber::k_metal
};

}  // namespace solidus::criteria
