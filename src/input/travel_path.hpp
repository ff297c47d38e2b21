/// A path of points with times: what travels along it stands at each point at its time, moves straight on to
/// the next, and is on by a share from there to the next.
///
/// It is given by a straight line, by a CSV file whose heading names `t`, `x`, `y` and, in space, `z` with
/// their units, and `on` (a share from 0 to 1; without it 1), or by a small subset of G-code:
///
///   G0, G1 X Y Z F   straight moves, with the tool off or as it was switched; F is the feed
///   G4 P or S        waits for P milliseconds or S seconds
///   G20, G21         inches, millimetres (at the start)
///   G90, G91         coordinates are absolute (at the start), or relative
///   M3, M4           on;  M5  off;  M30, M2  the end
///
/// with line numbers N and comments in parentheses or behind a semicolon. Feeds are per minute.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "numbers/place_function.hpp"
#include "system/errors.hpp"

namespace solidus {

struct TravelPoint {
  double time = 0;  ///< [s]
  Position x{};     ///< [m]
  double on = 1;    ///< share of the power from here to the next point
};

class TravelPath {
 public:
  /// @param points  with rising times, two at least
  /// Throws std::invalid_argument where they are none.
  explicit TravelPath(std::vector<TravelPoint> points);

  const std::vector<TravelPoint>& points() const { return points_; }
  double begin() const { return points_.front().time; }
  double end() const { return points_.back().time; }
  /// Where it stands; before its begin and behind its end at the first and last point.
  Position at(double time) const;
  /// The share by which it is on; zero before its begin and from its end on.
  double on(double time) const;
  /// The direction of travel, of length one: where it stands still that of the last move, before the first
  /// move that of the first; without any move all zero.
  Position heading(double time) const;
  /// The largest speed while it is on between two times [m/s].
  double fastest(double from, double to) const;
  /// The times in (from, to) at which it turns, changes its speed or is switched.
  void add_bends(double from, double to, std::vector<double>& times) const;
  /// The times at which it is switched on, off or to another share, rising.
  std::vector<double> switches() const;

 private:
  std::size_t segment(double time) const;

  std::vector<TravelPoint> points_;
  std::vector<Position> headings_;  ///< from each point to the next
};

/// Reads a file, G-code where its name ends with .gcode, .nc, .ngc or .tap, else CSV.
/// @param dimension  coordinates that the file must have at least
/// @param start      is added to all times of the file [s]
/// @param where      of the key that names the file
/// Throws InputError with the line of the file.
TravelPath read_travel_path(const std::filesystem::path& file, int dimension, double start,
                            const SourceLocation& where);
/// The same from the text of a file; `name` stands for the file in messages.
TravelPath parse_gcode(const std::string& text, const std::string& name, double start);

}  // namespace solidus
