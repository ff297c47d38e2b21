/// Loading of a material point: segments of linear ramps of strain or stress components and of temperature.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "numbers/tensor.hpp"
#include "system/errors.hpp"

namespace solidus::point {

/// Quantity that is imposed on a component; the other of the two is computed.
enum class Control { strain, stress };

/// A straight line in time from the present value: to a target, at a rate, or (neither) held.
struct Ramp {
  std::optional<double> target, rate;

  bool held() const { return !target && !rate; }
};

struct ComponentRamp : Ramp {
  Control of = Control::stress;  ///< [1] or [Pa], rates per second; tensor components, xy is half of gamma
};

/// Everything that happens between two times. The duration is given, or follows from the one ramp that has a
/// target and a rate.
struct Segment {
  std::array<ComponentRamp, 6> components;  ///< xx, yy, zz, xy, yz, xz
  Ramp temperature;                         ///< [K], [K/s]; held when temperature follows from energy
  std::optional<double> duration;           ///< [s]
  int steps = 50;
  std::optional<double> first_step;  ///< [s]; the steps then grow by a constant factor
  SourceLocation where;
};

/// Throws InputError where a segment has no duration, or more than one.
void check_duration(const Segment& segment);

/// The values at the end of a step.
struct Target {
  std::array<Control, 6> of;
  Sym<double> value;   ///< [1] or [Pa], by `of`
  double temperature;  ///< [K]
};

/// A segment whose beginning is known: targets at any part of it.
class Path {
 public:
  /// @param strain, stress, temperature  at the beginning
  /// Throws InputError where its duration is zero: a target that is there already.
  Path(const Segment& segment, const Sym<double>& strain, const Sym<double>& stress, double temperature);

  double duration() const { return duration_; }
  Target at(double time) const;       ///< @param time since the beginning [s]
  std::vector<double> steps() const;  ///< sizes of the steps [s]; they add up to the duration

 private:
  const Segment* segment_;
  Target begin_, end_;
  double duration_;
};

}  // namespace solidus::point
