/// A quantity over position and time: a number, a table of time, or a law of both.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "numbers/time_function.hpp"

namespace solidus {

/// Coordinates [m]; two-dimensional analyses leave the third zero.
using Position = std::array<double, 3>;

/// f(x, t), in SI.
class PlaceLaw {
 public:
  virtual ~PlaceLaw() = default;
  /// @param values  one per position
  /// Throws InputError where the law has no value that is allowed. Not collective.
  virtual void values(std::span<const Position> x, double time, std::span<double> values) const = 0;
};

class PlaceFunction {
 public:
  PlaceFunction() = default;
  PlaceFunction(double constant) : uniform_(constant) {}                 // NOLINT: a number is everywhere
  PlaceFunction(Table table) : uniform_(std::move(table)) {}             // NOLINT: a table is one of time
  PlaceFunction(TimeFunction uniform) : uniform_(std::move(uniform)) {}  // NOLINT: the same everywhere
  /// @param start, duration  of the stage whose time the law counts [s]: it is held at the stage's end
  explicit PlaceFunction(std::shared_ptr<const PlaceLaw> law, double start = 0,
                         double duration = std::numeric_limits<double>::infinity())
      : law_(std::move(law)), start_(start), duration_(duration) {}

  /// Whether it is the same everywhere.
  bool uniform() const { return law_ == nullptr; }
  /// The value everywhere; of a uniform function.
  double value(double time) const { return uniform_.value(time); }
  double derivative(double time) const { return uniform_.derivative(time); }
  /// @param values  one per position. Throws InputError as the law does. Not collective.
  void values(std::span<const Position> x, double time, std::span<double> values) const {
    if (law_ == nullptr)
      std::fill(values.begin(), values.end(), uniform_.value(time));
    else
      law_->values(x, time >= start_ + duration_ ? duration_ : time - start_, values);
  }

 private:
  TimeFunction uniform_;
  std::shared_ptr<const PlaceLaw> law_;
  double start_ = 0;
  double duration_ = std::numeric_limits<double>::infinity();
};

}  // namespace solidus
