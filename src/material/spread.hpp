/// The spread of a value: how far the true one may lie from the one that is given.
///
/// A spread covers 95 % of a distribution that is symmetric in its own measure, so it is two standard
/// deviations there:
///
///   relative  r   X = X_0 (1 + r z/2), z of the standard normal distribution
///   factor    f   X = X_0 f^(z/2): a normal distribution of ln X, 95 % of it between X_0/f and X_0 f
///   shift     s   T = T_0 + s z/2, for temperatures
#pragma once

#include <optional>
#include <string>

#include "input/keys.hpp"

namespace solidus::material {

struct Spread {
  std::optional<double> relative, factor;  ///< 1
  std::optional<double> shift;             ///< [K]
  std::string source;                      ///< where it is printed, or what it is guessed from
  bool estimate = false;                   ///< not printed with the value
  SourceLocation where;
};

/// The keys of a spread, `{ relative = 0.05, source = "…" }`; one section for all quantities that may have
/// one.
const Section<Spread>& spread_keys();

/// Checks that exactly one measure is given, the one of temperatures for a temperature and for nothing else,
/// and a source or the mark of an estimate. Throws InputError with the place of the spread.
/// @param what  the quantity, for messages
void check_spread(const Spread& spread, bool of_temperature, const std::string& what);

/// The spread in words, "5 %", "a factor of 1.5", "3 K".
std::string spread_text(const Spread& spread);

}  // namespace solidus::material
