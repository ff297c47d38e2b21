/// Limits of conduction, and the ranges of temperature that they follow from (conduction_limiter.hpp).
#pragma once

#include <span>

#include "heat/iteration/heat_parts.hpp"

namespace solidus::heat {

class HeatLimits {
 public:
  /// @param closed  limits are for the closed rule; with the open one none are found
  HeatLimits(HeatParts& parts, bool closed) : parts_(parts), closed_(closed) {}

  /// Whether conduction is limited from here on. Off at first, and with the open rule.
  void use(bool on) { parts_.conduction.limit(on && closed_); }
  /// Finds the limits of conduction again at these temperatures; they hold until the next call. Returns
  /// whether they have changed: a change of the flows there by no more than `negligible` [W] over all
  /// processes is left out. Collective.
  bool find(std::span<const double> temperature, double negligible = -1);
  /// Nothing is held back until the next find().
  void clear();
  /// Limits conduction at nodes outside this range as far as possible, until release(); find() makes it so.
  /// Returns whether there are such nodes, and others than before, on any process. Collective.
  HeldNodes::Found hold(std::span<const double> temperature, const TemperatureRange& range);
  void release();
  /// The range of the temperatures that are prescribed, or that surfaces exchange heat with, at the time set
  /// [K]; +∞ and −∞ where there is none. Collective.
  TemperatureRange surroundings() const;
  /// surroundings(), but without end where fluxes, sources or contributions (those that bring heat at the
  /// last find(), rather than pass it on) can heat or cool beyond them. Collective.
  /// @param with_contributions  false: they are taken to pass heat on
  TemperatureRange ambient(bool with_contributions = true) const;
  /// `range`, but where contributions alone leave it open that of `start`, of surroundings and of the nodes
  /// that contributions act on, at these temperatures. Collective.
  /// @param range  ambient(), or more
  TemperatureRange closed(const TemperatureRange& range, const TemperatureRange& start,
                          std::span<const double> temperature);

 private:
  HeatParts& parts_;
  bool closed_;
};

}  // namespace solidus::heat
