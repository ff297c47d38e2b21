/// Work, dissipation and entropy of a step, summed over the points of a block, lane by lane.
#pragma once

#include <algorithm>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/law_parts.hpp"

namespace solidus::mechanics {

/// Over the counted elements.
struct StepSums {
  Lane internal_work{0.0}, stabilisation_work{0.0};  ///< [J]
  Lane dissipation{0.0}, least{0.0}, largest{0.0};   ///< [W], extremes [W/m³]
  Lane inelastic_entropy{0.0};                       ///< [J/K]
  PlasticPower plastic;                              ///< [W]

  /// @param share  volume of the counted elements at a point, or zero [m³]
  void add_power(const Lane& share, const Lane& dissipation_of_point, const PlasticPower& plastic_of_point) {
    dissipation += share * dissipation_of_point;
    plastic.dissipation += share * plastic_of_point.dissipation;
    plastic.power += share * plastic_of_point.power;
  }
  /// @param counted  one for elements that count, else zero
  void add_extremes(const Lane& counted, const Lane& dissipation_of_point) {
    least = min(least, counted * dissipation_of_point);
    largest = max(largest, counted * dissipation_of_point);
  }
  /// Sums over the lanes, of a step of length dt [s].
  BlockWork total(double dt) const {
    BlockWork work;
    work.internal_work = sum(internal_work);
    work.stabilisation_work = sum(stabilisation_work);
    work.dissipation = dt * sum(dissipation);
    work.plastic_dissipation = dt * sum(plastic.dissipation);
    work.plastic_work = dt * sum(plastic.power);
    work.inelastic_entropy = sum(inelastic_entropy);
    for (int lane = 0; lane < k_lanes; ++lane) {
      work.least_dissipation = std::min(work.least_dissipation, least[lane]);
      work.largest_dissipation = std::max(work.largest_dissipation, largest[lane]);
    }
    return work;
  }
};

}  // namespace solidus::mechanics
