/// Piecewise-linear property tables: exact values, derivatives and first integrals, O(1) look-up.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "numbers/pieces.hpp"

namespace solidus {

/// Value of a table outside its points: its end value, or the line through its last two points. `error`
/// continues with the end value too, because nothing may throw inside a kernel, but `outside` then reports
/// it: the caller asks once per step.
enum class Extrapolation { constant, linear, error };

/// A continuous function y(x) given by points with strictly increasing x. A single point is a constant.
class Table {
 public:
  // In table.cpp: materials and conditions hold dozens of tables, and every file that copies one would hold
  // the code of all these.
  Table();
  Table(const Table&);
  Table(Table&&) noexcept;
  Table& operator=(const Table&);
  Table& operator=(Table&&) noexcept;
  ~Table();
  /// A constant.
  Table(double y);  // NOLINT: a number is a constant table
  /// Throws std::invalid_argument when x and y differ in length, are empty, not finite, or x does not
  /// increase strictly.
  Table(std::vector<double> x, std::vector<double> y, Extrapolation extrapolation = Extrapolation::constant);

  /// y and dy/dx near an argument: the line that the table follows there.
  template <class T>
  using Line = Pieces::Line<T>;
  Line<double> line(double x) const;
  Line<Lane> line(const Lane& x) const {
    return constant() ? Line<Lane>{Lane(y_[0]), Lane(0.0)} : line_of_lanes(x);
  }
  double value(double x) const { return line(x).value; }
  Lane value(const Lane& x) const { return line(x).value; }
  /// dy/dx of the piece that holds x, the right-hand one at a point of the table (the left-hand one at its
  /// end); zero outside when the continuation is constant.
  double derivative(double x) const { return line(x).slope; }
  Lane derivative(const Lane& x) const { return line(x).slope; }
  /// ∫_a^b y dx, closed form, any order of a and b.
  double integral(double a, double b) const;
  /// ∫_a^b y/x dx for a, b > 0, closed form (entropy from a capacity).
  double integral_over_x(double a, double b) const;

  bool constant() const { return y_.size() == 1; }
  /// True where x lies outside the points and the policy is `error`.
  bool outside(double x) const;
  Extrapolation extrapolation() const { return extrapolation_; }
  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  double min_value() const;
  double max_value() const;
  /// The table multiplied by a number.
  Table scaled(double factor) const;

 private:
  Line<Lane> line_of_lanes(const Lane& x) const;
  bool flat(double x) const;  ///< x lies outside and the continuation is constant
  /// Adds up `part(from, to, y_from, slope)` over the linear parts of [a, b].
  template <class Part>
  double add_parts(double a, double b, Part part) const;

  std::vector<double> x_{0.0}, y_{0.0};
  Pieces pieces_;  ///< one from each point on; that of the last point continues the one before
  Extrapolation extrapolation_ = Extrapolation::constant;
};

}  // namespace solidus
