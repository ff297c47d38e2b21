/// A formula, a table or a field becomes a function of place and time; its values are checked wherever it
/// is evaluated.
#include "setup/place_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "input/keys.hpp"
#include "input/point_table.hpp"
#include "mesh/element_search.hpp"
#include "numbers/time_events.hpp"
#include "results/formats/field_reader.hpp"

namespace solidus::setup {

namespace {

std::string text(const Position& x, AnalysisKind kind) {
  return kind == AnalysisKind::solid ? fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2])
                                     : fmt::format("({:.6g}, {:.6g}) m", x[0], x[1]);
}

/// Names of the coordinates of an analysis, as numbers of k_place_variables; the position's component of
/// each.
struct Coordinate {
  std::size_t variable, component;
};
std::vector<Coordinate> coordinates(AnalysisKind kind) {
  switch (kind) {
    case AnalysisKind::plane_strain:
      return {{0, 0}, {1, 1}};
    case AnalysisKind::axisymmetric:
      return {{0, 0}, {1, 1}, {3, 0}, {2, 1}};
    case AnalysisKind::solid:
      return {{0, 0}, {1, 1}, {2, 2}};
  }
  return {};
}

std::string allowed_names(AnalysisKind kind, bool with_time) {
  std::string names;
  for (const Coordinate& c : coordinates(kind))
    names += (names.empty() ? "" : ", ") + k_place_variables[c.variable];
  return names + (with_time ? ", t" : "");
}

/// Evaluates at one position that does not move with the place any more.
using Evaluate = std::function<double(const Position& x, double time)>;

Evaluate formula(const PlaceSpec& spec, AnalysisKind kind) {
  const std::vector<Coordinate> known = coordinates(kind);
  for (std::size_t v = 0; v < k_variable_t; ++v)
    if (spec.formula->uses(v) &&
        std::none_of(known.begin(), known.end(), [&](const Coordinate& c) { return c.variable == v; }))
      throw InputError(spec.where,
                       fmt::format("the formula of '{}' uses {}, which this analysis does not have", spec.key,
                                   k_place_variables[v]),
                       allowed_names(kind, spec.with_time));
  return [known, formula = spec.formula](const Position& x, double time) {
    std::array<double, 5> variables{};
    for (const Coordinate& c : known) variables[c.variable] = x[c.component];
    variables[k_variable_t] = time;
    return formula->value(variables);
  };
}

Evaluate points(const PlaceSpec& spec, AnalysisKind kind, std::shared_ptr<const PointTable> table) {
  // Which coordinate each column of the table is; a column that the key does not have is refused.
  std::vector<std::size_t> component;  // of (x, y, z, t)
  for (const std::string& name : table->coordinates()) {
    std::optional<std::size_t> found;
    for (const Coordinate& c : coordinates(kind))
      if (k_place_variables[c.variable] == name) found = c.component;
    if (name == "t" && spec.with_time) found = 3;
    if (!found)
      throw InputError(
          spec.where,
          fmt::format("'{}' has a column {}, which '{}' does not have here", spec.file, name, spec.key),
          allowed_names(kind, spec.with_time));
    component.push_back(*found);
  }
  // The law keeps the table and the text for its messages, as it outlives this function.
  return [=, key = spec.key, file = spec.file, where = spec.where, refuse = spec.outside_is_error](
             const Position& x, double time) {
    std::array<double, 4> at{};
    for (std::size_t i = 0; i < component.size(); ++i) at[i] = component[i] == 3 ? time : x[component[i]];
    const std::span<const double> coordinates(at.data(), component.size());
    // Where the case refuses values from outside, the place is told.
    if (refuse && table->outside(coordinates))
      throw InputError(where,
                       fmt::format("'{}' is asked for at {}, t = {:g} s, outside of the points of '{}'", key,
                                   text(x, kind), time, file),
                       "outside = \"nearest\", or points that reach further");
    return table->value(coordinates);
  };
}

/// A field of a file, interpolated by the shapes of its cells.
class Field {
 public:
  Field(const PlaceSpec& spec, AnalysisKind kind)
      : spec_(spec),
        kind_(kind),
        read_(results::read_field(spec.file, spec.column, spec.body, spec.length, spec.where)) {
    // The file must have as many dimensions as the analysis.
    const int dimension = kind == AnalysisKind::solid ? 3 : 2;
    if (read_.mesh.dimension != dimension)
      throw InputError(spec.where, fmt::format("'{}' has {} dimensions, the analysis {}", spec.file,
                                               read_.mesh.dimension, dimension));
    search_.emplace(read_.mesh);
    // A unit in the case goes before the one in the file.
    conversion_ = spec.unit;
    if (!spec.unit_given && !read_.unit.empty()) {
      try {
        conversion_ = units::conversion(read_.unit, spec.key_unit);
      } catch (const std::invalid_argument& error) {
        throw InputError(spec.where, fmt::format("the field '{}': {}", spec.column, error.what()));
      }
    }
  }
  double value(const Position& x) const {
    const mesh::ElementSearch::Found found = search_->find(x);
    if (spec_.outside_is_error && found.distance > k_nearby * std::hypot(x[0], x[1], x[2]))
      throw InputError(spec_.where,
                       fmt::format("'{}' is asked for at {}, {:.3g} m outside of '{}'", spec_.key,
                                   text(x, kind_), found.distance, spec_.file),
                       "outside = \"nearest\", or a field that reaches further");
    return conversion_(found.share(read_.values));
  }

 private:
  static constexpr double k_nearby = 1e-6;  ///< coordinates may be stored as single precision
  PlaceSpec spec_;
  AnalysisKind kind_;
  results::ReadField read_;
  std::optional<mesh::ElementSearch> search_;
  units::Conversion conversion_;
};

/// Moves the place, checks the values, and stores those that cannot change.
class CheckedLaw : public PlaceLaw {
 public:
  CheckedLaw(const PlaceSpec& spec, AnalysisKind kind) : spec_(spec), kind_(kind) {
    // A velocity has a component for each direction of the mesh.
    const bool third = spec.velocity_components == 3;
    if (spec.moves() && third != (kind == AnalysisKind::solid))
      throw InputError(spec.where,
                       fmt::format("'moving' of '{}' has {} components", spec.key, spec.velocity_components),
                       fmt::format("{} in this analysis", third ? 2 : 3));
    // Each kind knows whether it depends on time, on place, or on both.
    switch (spec.kind) {
      case PlaceSpec::Kind::formula:
        evaluate_ = formula(spec, kind);
        conversion_ = spec.unit;
        times_ = spec.formula->uses(k_variable_t);
        places_ = false;
        for (std::size_t v = 0; v < k_variable_t; ++v) places_ = places_ || spec.formula->uses(v);
        find_breaks();
        break;
      case PlaceSpec::Kind::points: {
        const auto table = std::make_shared<PointTable>(spec.file, spec.column, spec.key_unit, spec.where);
        evaluate_ = points(spec, kind, table);
        times_ = table->coordinates().back() == "t";
        places_ = table->coordinates().front() != "t";
        break;
      }
      case PlaceSpec::Kind::field: {
        evaluate_ = [field = std::make_shared<Field>(spec, kind)](const Position& x, double) {
          return field->value(x);
        };
        steady_ = !spec.moves();
        times_ = false;
        break;
      }
    }
  }

  bool uses_place() const override { return spec_.moves() || places_; }
  bool uses_time() const override { return spec_.moves() || times_; }
  bool only_moves() const override { return spec_.moves() && !times_; }
  void add_breaks(std::size_t axis, double low, double high, double time,
                  std::vector<double>& coordinates) const override {
    const double moved = spec_.velocity[axis] * time;
    for (const double at : breaks_[axis])
      if (at + moved > low && at + moved < high) coordinates.push_back(at + moved);
  }

  void values(std::span<const Position> x, double time, std::span<double> values) const override {
    // Values that do not change with time are kept for the places they were asked for.
    if (steady_ && std::equal(x.begin(), x.end(), kept_at_.begin(), kept_at_.end())) {
      std::copy(kept_.begin(), kept_.end(), values.begin());
      return;
    }
    // A moving field is evaluated at the place that is there now.
    for (std::size_t i = 0; i < x.size(); ++i) {
      Position there = x[i];
      for (std::size_t k = 0; k < 3; ++k) there[k] -= spec_.velocity[k] * time;
      values[i] = conversion_(evaluate_(there, time));
      check(values[i], x[i], time);
    }
    if (!steady_) return;
    kept_at_.assign(x.begin(), x.end());
    kept_.assign(values.begin(), values.end());
  }

 private:
  /// Coordinates at which comparisons of the formula that have one coordinate and no time change.
  void find_breaks() {
    for (const auto& comparison : spec_.formula->comparisons()) {
      // A comparison of exactly one coordinate has its jump on planes of that coordinate.
      int used = -1, n_used = comparison->uses(k_variable_t) ? 2 : 0;
      for (std::size_t v = 0; v < k_variable_t; ++v)
        if (comparison->uses(v)) used = static_cast<int>(v), ++n_used;
      if (n_used != 1) continue;
      for (const Coordinate& c : coordinates(kind_)) {
        if (static_cast<int>(c.variable) != used) continue;
        // Its value along that coordinate, all others zero.
        const auto value = [&](double x) {
          std::array<double, 5> variables{};
          variables[c.variable] = x;
          return comparison->value(variables);
        };
        // Finer near the origin, where castings lie, and coarse far away.
        constexpr double k_nearby = 1, k_farthest = 30, k_spacing = 0.01;  ///< [m]
        for (const auto& [low, high] :
             {std::pair(-k_farthest, -k_nearby), {-k_nearby, k_nearby}, {k_nearby, k_farthest}})
          for (const TimeEvent& at : breaks(value, low, high, k_spacing))
            breaks_[c.component].push_back(at.time);
      }
    }
    for (std::vector<double>& along : breaks_) std::sort(along.begin(), along.end());
  }
  void check(double value, const Position& x, double time) const {
    if (value >= spec_.lower && value <= spec_.upper && !(spec_.lower_open && value <= spec_.lower) &&
        std::isfinite(value))
      return;
    std::string at = uses_place() ? text(x, kind_) : std::string();
    if (spec_.with_time) at += fmt::format("{}t = {:g} s", at.empty() ? "" : ", ", time);
    if (!std::isfinite(value))
      throw InputError(spec_.where, fmt::format("'{}' is not finite at {}", spec_.key, at),
                       "a value everywhere: no division by zero, no root or logarithm of a negative number");
    throw InputError(
        spec_.where,
        fmt::format("'{}' is {:g} {} at {}, which is out of range", spec_.key, value, spec_.key_unit, at),
        value > spec_.upper ? fmt::format("at most {:g} {}", spec_.upper, spec_.key_unit)
                            : fmt::format("{} {:g} {}", spec_.lower_open ? "above" : "at least", spec_.lower,
                                          spec_.key_unit));
  }

  PlaceSpec spec_;
  AnalysisKind kind_;
  Evaluate evaluate_;
  units::Conversion conversion_;
  bool times_ = true, places_ = true;          ///< what it depends on, but for its motion
  std::array<std::vector<double>, 3> breaks_;  ///< by component of the position, where it is not moved
  bool steady_ = false;                        ///< values are kept: points of a file are searched for once
  mutable std::vector<Position> kept_at_;
  mutable std::vector<double> kept_;
};

}  // namespace

std::shared_ptr<const PlaceLaw> place_law(const PlaceSpec& spec, AnalysisKind kind) {
  return std::make_shared<CheckedLaw>(spec, kind);
}

PlaceFunction place_function(const Function& function, cases::TimeOrigin clock, const cases::StageRun* stage,
                             AnalysisKind kind) {
  if (function.place == nullptr) return cases::on_clock(function, clock, stage);
  std::shared_ptr<const PlaceLaw> law = place_law(*function.place, kind);
  if (clock == cases::TimeOrigin::run || stage == nullptr) return PlaceFunction(std::move(law));
  return PlaceFunction(std::move(law), stage->start, stage->stage->duration);
}

}  // namespace solidus::setup
