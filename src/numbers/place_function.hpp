/// A quantity over position and time: a number, a table of time, or a law of both.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "numbers/time_function.hpp"

namespace solidus {

/// Coordinates [m]; two-dimensional analyses leave the third zero.
using Position = std::array<double, 3>;

/// A place around which a law has values of note, within a distance of it [m].
struct PlaceSpot {
  Position centre{};
  double radius = 0;  ///< parts of elements there are made no larger than this
};

/// How a law travels: the time in which it moves by its own length, infinite where it is at rest, and how
/// much of that time a step may take.
struct Crossing {
  double time = std::numeric_limits<double>::infinity();  ///< [s]
  double share = 1;
};

/// f(x, t), in SI.
class PlaceLaw {
 public:
  virtual ~PlaceLaw() = default;
  /// @param values  one per position
  /// Throws InputError where the law has no value that is allowed. Not collective.
  virtual void values(std::span<const Position> x, double time, std::span<double> values) const = 0;
  /// Whether it differs from place to place.
  virtual bool uses_place() const { return true; }
  /// Whether its value at a place changes in time.
  virtual bool uses_time() const { return true; }
  /// Whether it is one distribution that moves, the same at all times for who moves with it.
  virtual bool only_moves() const { return false; }
  /// Adds coordinates in (low, high) of an axis at which the law is known to jump or bend.
  virtual void add_breaks(std::size_t axis, double low, double high, double time,
                          std::vector<double>& coordinates) const {
    (void)axis, (void)low, (void)high, (void)time, (void)coordinates;
  }
  /// Adds the place around which it is concentrated at a time, where it is known to be.
  virtual void add_spots(double time, std::vector<PlaceSpot>& spots) const { (void)time, (void)spots; }
  /// Adds the times in (from, to) at which it is known to jump or bend everywhere.
  virtual void add_bends(double from, double to, std::vector<double>& times) const {
    (void)from, (void)to, (void)times;
  }
  /// How it travels between two times; nothing where that is not known beforehand.
  virtual std::optional<Crossing> crossing(double from, double to) const {
    (void)from, (void)to;
    return {};
  }
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
  bool uniform() const { return law_ == nullptr || !law_->uses_place(); }
  /// Whether it is the same at all times.
  bool steady() const { return law_ == nullptr ? uniform_.constant() : !law_->uses_time(); }
  /// Whether it is given by numbers with straight lines between them.
  bool tabulated() const { return law_ == nullptr; }
  bool only_moves() const { return law_ != nullptr && law_->only_moves(); }
  /// The value everywhere; of a uniform function. Throws InputError as the law does.
  double value(double time) const {
    if (law_ == nullptr) return uniform_.value(time);
    double value = 0;
    law_->values(std::span(&k_anywhere, 1), on_clock(time), std::span(&value, 1));
    return value;
  }
  double derivative(double time) const { return uniform_.derivative(time); }
  /// The table of a function that is tabulated(), whatever its argument is.
  const Table& table() const { return uniform_.table(); }
  /// Adds the times in (from, to) at which its slope may change, as far as it is tabulated.
  void add_bends(double from, double to, std::vector<double>& times) const {
    if (law_ == nullptr) return uniform_.add_bends(from, to, times);
    if (start_ + duration_ > from && start_ + duration_ < to) times.push_back(start_ + duration_);
    const std::size_t first = times.size();
    law_->add_bends(from - start_, std::min(to - start_, duration_), times);
    for (std::size_t i = first; i < times.size(); ++i) times[i] += start_;
  }
  void add_spots(double time, std::vector<PlaceSpot>& spots) const {
    if (law_ != nullptr) law_->add_spots(on_clock(time), spots);
  }
  std::optional<Crossing> crossing(double from, double to) const {
    return law_ != nullptr ? law_->crossing(on_clock(from), on_clock(to)) : std::nullopt;
  }
  void add_breaks(std::size_t axis, double low, double high, double time,
                  std::vector<double>& coordinates) const {
    if (law_ != nullptr) law_->add_breaks(axis, low, high, on_clock(time), coordinates);
  }
  /// @param values  one per position. Throws InputError as the law does. Not collective.
  void values(std::span<const Position> x, double time, std::span<double> values) const {
    if (law_ == nullptr)
      std::fill(values.begin(), values.end(), uniform_.value(time));
    else
      law_->values(x, on_clock(time), values);
  }

 private:
  static constexpr Position k_anywhere{};
  double on_clock(double time) const { return time >= start_ + duration_ ? duration_ : time - start_; }

  TimeFunction uniform_;
  std::shared_ptr<const PlaceLaw> law_;
  double start_ = 0;
  double duration_ = std::numeric_limits<double>::infinity();
};

}  // namespace solidus
