/// Means of loads over a part of a step.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "numbers/load_window.hpp"
#include "numbers/place_function.hpp"

namespace solidus::heat {

/// The quantities of a load that are averaged over a step together, as LoadLaw::Kind lists them.
using LoadValues = std::array<double, 2>;

/// A load as its functions make it: the last one drives it, the others multiply.
struct LoadLaw {
  enum class Kind {
    power,     ///< factor × value: {what heats, what cools}, both positive
    film,      ///< c (Θ_a − Θ): {c, c Θ_a}, c the product of the factors
    radiation  ///< ε σ (Θ_a⁴ − Θ⁴): {ε, ε Θ_a⁴}
  };
  Kind kind = Kind::power;
  std::vector<PlaceFunction> functions;

  LoadValues values(std::span<const double> of_functions) const;
  /// The quantities at a time, where all functions are uniform in space. Throws InputError as the functions
  /// do.
  LoadValues values_at(double time) const;
  bool uniform() const;
  bool steady() const;
  std::vector<const PlaceFunction*> pointers() const;
  /// Θ_a of a film or of radiation from means of its values.
  /// @param otherwise  where the surface exchanges nothing
  double ambient(const LoadValues& mean, double otherwise) const;
};

/// Times of evaluation and their weights, which add up to one.
struct TimePoint {
  double time = 0, weight = 1;
};

/// Gauss points of a mean over the window, exact between the times at which tables bend for products of the
/// functions of degree 2 n − 1.
/// @param n          points a piece, two or four
/// @param functions  of the load; what they depend on between bends is smooth as far as this knows
/// @param parts      the window is divided into at least so many equal parts
std::vector<TimePoint> time_points(const LoadWindow& window, std::span<const PlaceFunction* const> functions,
                                   int n, int parts = 1);

/// The mean over the window of a load whose functions are uniform: exact for tables; where a formula is among
/// them by bisection until halves agree to 1e-5 of the largest value seen. What begins and ends within a 32nd
/// of the window may not be seen.
LoadValues mean_load(const LoadWindow& window, const LoadLaw& law);

}  // namespace solidus::heat
