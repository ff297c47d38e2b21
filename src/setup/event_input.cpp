/// Tables, formulas and fields are searched for bends and jumps; events too close to each other become one.
#include "setup/event_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "input/place_spec.hpp"
#include "input/point_table.hpp"
#include "setup/source_input.hpp"

namespace solidus::setup {

namespace {

/// Tolerances of corners(), as shares of the range of the table, and of its largest value: a temperature in
/// kelvin that varies by a tenth of a per cent is constant. Loads are averaged over steps, so that bends that
/// are left out cost no heat; motions and temperatures that are prescribed count by their values at the ends.
constexpr double k_of_loads = 0.01, k_of_motions = 1e-4, k_of_values = 1e-3;
/// Formulas are compared at so many times a step.
constexpr double k_times_a_step = 8;

class EventList {
 public:
  EventList(const cases::StageRun* stage, double from, double to, double step)
      : stage_(stage), from_(from), to_(to), spacing_(step / k_times_a_step) {}

  /// @param at_ends  its values at the ends of steps count, rather than its mean over them
  void add(const Function& f, cases::TimeOrigin clock, bool at_ends, std::optional<double> of_values = {}) {
    // Times are counted from the clock of the condition.
    const double start = clock == cases::TimeOrigin::stage && stage_ != nullptr ? stage_->start : 0;
    const double from = from_ - start, to = to_ - start;
    if (f.place != nullptr) return add(*f.place, from, to, start, at_ends);
    if (f.of != Argument::time || f.table.constant()) return;
    // The range of values within the interval decides how small a bend is that still counts.
    double low = HUGE_VAL, high = -HUGE_VAL;
    const auto see = [&](double y) {
      low = std::min(low, y);
      high = std::max(high, y);
    };
    see(f.table.value(from));
    see(f.table.value(to));
    const auto x = f.table.x(), y = f.table.y();
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i] > from && x[i] < to) see(y[i]);
    const double tolerance =
        std::max((at_ends ? k_of_motions : k_of_loads) * (high - low),
                 of_values.value_or(at_ends ? 0 : k_of_loads) * std::max(std::abs(low), std::abs(high)));
    // Every corner of the table beyond that tolerance is an event that a step should end at.
    for (const double time : corners(f.table, from, to, tolerance))
      events.push_back({start + time, at_ends, false});
  }

  /// Times in the interval; none where they are too many for steps to end at each.
  void add(const std::vector<double>& times) {
    if (static_cast<std::ptrdiff_t>(times.size()) > k_most_events) return;
    for (const double time : times) events.push_back({time, false, false});
  }

  std::vector<TimeEvent> events;

 private:
  void add(const PlaceSpec& place, double from, double to, double start, bool at_ends) {
    // Times of a table of points, or those at which a formula of time alone breaks; of others those of their
    // comparisons.
    if (place.kind == PlaceSpec::Kind::points) {
      const std::vector<double> times =
          PointTable(place.file, place.column, place.key_unit, place.where).times();
      const auto inside = std::ranges::count_if(times, [&](double t) { return t > from && t < to; });
      if (inside > k_most_events) return;
      for (const double time : times)
        if (time > from && time < to) events.push_back({start + time, at_ends, false});
      return;
    }
    if (place.kind != PlaceSpec::Kind::formula || !place.formula->uses(k_variable_t)) return;
    if (alone(*place.formula)) return add(*place.formula, from, to, start, at_ends);
    for (const auto& comparison : place.formula->comparisons())
      if (comparison->uses(k_variable_t) && alone(*comparison)) add(*comparison, from, to, start, at_ends);
  }
  /// Whether time is all that a formula depends on.
  static bool alone(const Formula& formula) {
    for (std::size_t v = 0; v < k_variable_t; ++v)
      if (formula.uses(v)) return false;
    return true;
  }
  void add(const Formula& formula, double from, double to, double start, bool at_ends) {
    const auto value = [&](double time) {
      std::array<double, k_variable_t + 1> variables{};
      variables[k_variable_t] = time;
      return formula.value(variables);
    };
    for (TimeEvent event : breaks(value, from, to, spacing_)) {
      event.time += start;
      event.at_ends = at_ends;
      events.push_back(event);
    }
  }

  const cases::StageRun* stage_;
  double from_, to_, spacing_;
};

/// Adds the times of mechanical conditions and tools.
void add_mechanical(const cases::CaseSpec& spec, const cases::StageRun* stage, EventList& list) {
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (!cases::holds(c.stages, stage)) continue;
    using Kind = cases::MechanicalConditionSpec::Kind;
    if (c.kind == Kind::pressure) list.add(c.pressure, c.clock, true);
    if (c.kind == Kind::traction)
      for (const Function& f : c.traction) list.add(f, c.clock, true);
    if (c.kind == Kind::body_force)
      for (const Function& f : c.force) list.add(f, c.clock, true);
    if (c.kind == Kind::metallostatic)
      for (const Function* f : {&c.level, &c.squeeze}) list.add(*f, c.clock, true);
    if (c.kind == Kind::displacement)
      for (const auto* u : {&c.ux, &c.uy, &c.uz, &c.ur})
        if (*u) list.add(**u, c.clock, true);
  }
  if (spec.rotation) list.add(spec.rotation->omega, cases::TimeOrigin::run, true);
  for (const cases::RigidSurfaceSpec& s : spec.rigid_surfaces) {
    for (const auto* motion : {&s.ux, &s.uy, &s.uz, &s.rotation})
      if (*motion) list.add(**motion, cases::TimeOrigin::run, true);
    if (s.temperature) list.add(*s.temperature, cases::TimeOrigin::run, true, k_of_values);
  }
}

}  // namespace

std::vector<TimeEvent> time_events(const cases::CaseSpec& spec, const cases::StageRun* stage, double from,
                                   double to, double step) {
  // The list collects the times at which a condition jumps or changes its slope, so that steps end there.
  // Conditions that are not active in the stage, and functions of temperature, add none.
  EventList list(stage, from, to, step);
  if (spec.has_heat())
    for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
      if (!cases::holds(c.stages, stage)) continue;
      using Kind = cases::ThermalConditionSpec::Kind;
      // A sleeve ignites by its temperature: the time is not known beforehand.
      if (c.kind == Kind::exothermic) continue;
      if (c.kind == Kind::temperature) {
        list.add(c.temperature, c.clock, true, k_of_values);
        continue;
      }
      // A prescribed temperature counts by its values at the ends of steps (true), fluxes and films by their
      // means over steps (false). Temperatures have a tolerance relative to their value in kelvin.
      const bool film = c.kind == Kind::film, radiates = c.kind == Kind::radiation;
      if (c.kind == Kind::flux) list.add(c.flux, c.clock, false);
      if (c.kind == Kind::source) list.add(c.power, c.clock, false);
      if (film && c.coefficient.of != Argument::temperature) list.add(c.coefficient, c.clock, false);
      if (radiates && c.emissivity.of != Argument::temperature) list.add(c.emissivity, c.clock, false);
      if (film || radiates) list.add(c.ambient, c.clock, false, k_of_values);
      list.add(c.factor, c.clock, false);
    }
  // Channels add the events of their flow and of their inlet temperature.
  for (const cases::ChannelSpec& c : spec.channels) {
    if (!cases::holds(c.stages, stage)) continue;
    for (const auto* f : {&c.flow, &c.mass_flow})
      if (*f) list.add(**f, c.clock, false);
    if (c.inlet) list.add(*c.inlet, c.clock, false, k_of_values);
  }
  // Travelling sources add the times at which they are switched or change their direction.
  for (const cases::SourceSpec& source : spec.sources) {
    list.add(source.power, cases::TimeOrigin::run, false);
    list.add(source.efficiency, cases::TimeOrigin::run, false);
    list.add(source_times(source, spec.dimension(), from, to));
  }
  if (spec.has_mechanics()) add_mechanical(spec, stage, list);
  return std::move(list.events);
}

}  // namespace solidus::setup
