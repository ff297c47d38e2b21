/// Times at which functions of time bend or jump, where steps of a run should end.
#pragma once

#include <functional>
#include <vector>

#include "numbers/table.hpp"

namespace solidus {

struct TimeEvent {
  double time = 0;
  /// The function counts by its values at the ends of steps, not by its mean over them: no other event may
  /// stand for this one.
  bool at_ends = false;
  /// The function has two values here; what has gone before does not predict what follows.
  bool jump = false;

  bool operator==(const TimeEvent&) const = default;
};

/// The most events that one function may have in a stage; of a longer table those that matter most.
inline constexpr int k_most_events = 1000;

/// Points of a table in (from, to), the fewest that a search finds such that straight lines between them and
/// the values at the ends follow the table to within `tolerance`; at most k_most_events, the first chosen
/// being those farthest from the lines so far (Ramer 1972, Douglas and Peucker 1973). Rising.
std::vector<double> corners(const Table& table, double from, double to, double tolerance);

/// Times in (from, to) at which a function jumps or its slope does, found by comparing its values on a grid:
/// a jump stays and a change of slope falls as the distance where a smooth function falls as its square. What
/// begins and ends between two times of the grid is not seen. None if there are more than k_most_events.
/// @param f        any values; one that is not finite is left out
/// @param spacing  largest distance of the times compared [s]; there are between 2^12 and 2^18 of them
std::vector<TimeEvent> breaks(const std::function<double(double)>& f, double from, double to, double spacing);

/// Brings events in order and leaves out those that another stands for: within `same` of the one before all
/// of them, within `shortest` those that need not be met exactly.
std::vector<TimeEvent> in_order(std::vector<TimeEvent> events, double same, double shortest);

}  // namespace solidus
