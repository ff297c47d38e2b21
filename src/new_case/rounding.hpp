/// Numbers that a person would write into a case file.
#pragma once

#include <cmath>

namespace solidus::model {

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

}  // namespace solidus::model
