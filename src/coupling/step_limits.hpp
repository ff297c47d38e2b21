/// Limits on the error and on the change in a step, and the choice of the limit that bounds the step size.
#pragma once

#include <string>

namespace solidus::coupling {

/// Method by which the local error is estimated (coupling/error_estimate.hpp).
enum class ErrorControl { none, predictor, doubling };

struct StepLimits {
  ErrorControl control = ErrorControl::none;
  double temperature = 1;       ///< local error per step [K]
  double displacement = 1e-6;   ///< local error per step [m]
  double solid_fraction = 0.1;  ///< change per step of the solid share of all bodies that can melt [1]
  bool inertia = false;         ///< displacements are integrated in time, as temperatures are
  double stress = 0.005;        ///< local error per step, as a share of the stress [1]

  double skin = 0.03;  ///< change per step of the coherent share of a skin in contact [1]
  double opening = 0;  ///< of a skin that lets go in a step [m]; zero: any
  /// Steps get shorter while the last melt freezes, down to this share of the time since it was poured
  /// (longest_before_solid()); zero: no casting deforms, and they do not.
  double last_melt = 0;

  bool operator==(const StepLimits&) const = default;
};

/// Measured errors and changes of a step that converged.
struct StepMeasure {
  int iterations = 0;                                    ///< the largest Newton count of its phases
  double temperature_error = 0, displacement_error = 0;  ///< [K], [m]; zero where nothing measures them
  double stress_error = 0;                               ///< [1]; zero where nothing creeps
  double solid_fraction_change = 0;
  double skin_change = 0;    ///< largest change of the coherent share of a skin (coupling/skin_share.hpp)
  double skin_opening = 0;   ///< ErrorEstimate::skin_opening() [m]
  bool ended_early = false;  ///< augmentations did not converge (contact/forces/augmented_lagrangian.hpp)
};

/// The limit that wants the smallest step.
struct Strictest {
  /// By which the step should have been multiplied; errors go with its square, changes with itself. Aims a
  /// fifth of the step below the limit. Infinite where nothing was committed.
  double factor = 0;
  std::string name;       ///< "temperature error"
  std::string excess;     ///< "temperature error 3.2 K, allowed 1 K"
  double ratio = 0;       ///< of measured to allowed value, of the limit exceeded most
  bool exceeded = false;  ///< so far that the step is to be repeated
};

Strictest strictest(const StepLimits& limits, const StepMeasure& measure);

/// The longest step [s] that still tells when a casting is solid: half of what is left at the mean rate since
/// it was poured, and not less than a share of the time since. Endless while a fifth is melt, and where
/// nothing is.
/// @param melt     liquid share of all bodies that can melt [1]
/// @param elapsed  since the casting was poured [s]
/// @param least    that share, StepLimits::last_melt
double longest_before_solid(double melt, double elapsed, double least);

}  // namespace solidus::coupling
