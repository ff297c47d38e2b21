/// Numbers that a person would write into a case file.
#pragma once

#include <cmath>

namespace solidus::new_case {

/// The next multiple of `to`.
inline double rounded_up(double value, double to) {
  return to * std::ceil(value / to - 1e-9);
}

/// The thickness of a wall of the mould in whole millimetres, below a centimetre in tenths of them [m].
inline double of_wall(double least) {
  return rounded_up(least, least < 0.01 ? 1e-4 : 1e-3);
}

/// A value with two digits.
inline double two_digits(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return digit * std::round(value / digit);
}

/// The round number that a place of a part was drawn at, where its measured value is off by no more than
/// measuring: -0.00009 mm in a part of 120 mm is 0.
inline double round_place(double value, double length) {
  const double digit = std::pow(10.0, std::floor(std::log10(1e-4 * length)));
  const double round = digit * std::round(value / digit) + 0.0;  // no -0
  return std::abs(round - value) < 1e-5 * length ? round : value;
}

/// A measured place to the micrometre: 1.03e-06 mm off a plane of symmetry is 0.
inline double to_micrometre(double value) {
  return 1e-6 * std::round(1e6 * value) + 0.0;  // no -0
}

}  // namespace solidus::new_case
