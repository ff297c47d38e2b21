/// A quantity given at points of space, and of time, by a CSV file.
///
/// The heading names columns with their units: any of x, y, z, r, and t, and the values:
/// `z[mm],t[s],h[W/m2/K]`. Lines that begin with # are comments. Points that form a full grid of the
/// coordinates named (any order of lines) are interpolated linearly along each of them; a table of one
/// coordinate always is one. Other points are scattered: at every time the same number of neighbours is
/// weighted by inverse distance,
///   w_k = ((R − d_k)/(R d_k))²,  R the distance to the first neighbour left out
/// (Franke, Nielson 1980), which gives the values of the points there and stays between those of the
/// neighbours; between two times linearly. Outside of the points' box the nearest place of the box answers,
/// or nothing.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "input/units.hpp"
#include "system/errors.hpp"

namespace solidus {

class PointTable {
 public:
  /// @param column  name of the values' column; empty: the only one that is no coordinate
  /// @param unit    SI unit of the values
  /// @param where   of the key that names the file
  /// Throws InputError with the line of the file.
  PointTable(const std::filesystem::path& file, const std::string& column, std::string_view unit,
             const SourceLocation& where);

  /// Names of the coordinates that the file has, of x, y, z, r, t.
  const std::vector<std::string>& coordinates() const { return names_; }
  /// @param at  the coordinates() [m], [s]
  double value(std::span<const double> at) const;
  /// Whether a point lies outside the box of the points, by more than rounding.
  bool outside(std::span<const double> at) const;
  /// The times of the points, rising; empty where the file has no t.
  std::vector<double> times() const;
  /// Whether the points form a grid.
  bool grid() const { return !axes_.empty(); }

 private:
  void arrange(const std::filesystem::path& file);
  double on_grid(std::span<const double> at, std::size_t axis, std::size_t offset) const;
  double scattered(std::span<const double> at, std::size_t first, std::size_t last) const;

  std::vector<std::string> names_;
  std::vector<std::vector<double>> points_;  ///< coordinates of each point, then its value
  std::vector<std::vector<double>> axes_;    ///< of a grid: the rising values along each coordinate
  std::vector<double> values_;               ///< of a grid, the last coordinate runs fastest
  std::vector<double> low_, high_;           ///< the box of the points
  std::size_t n_space_ = 0;                  ///< coordinates but t, which is the last one where there is t
  std::vector<double> times_;                ///< of scattered points with t
  std::vector<std::size_t> first_of_time_;   ///< the first point of each, and the number of points
};

}  // namespace solidus
